//! A rapid away from dense code, as at the end of each pass.

use framepath::cycle::JERK_KEPT;
use framepath::moves::TerminationCondition;

use crate::common::{Extremes, Machine, equal_limits, feed_move, with_room, xyz};

/// What so many chords of .022 mm of a helix and a retract take: 100 mm/s, 1000 mm/s2, 20,000 mm/s3, P .01.
fn extremes(chords: u32) -> Extremes {
    let mut machine = Machine::new(equal_limits(20_000.0));
    let tolerance = TerminationCondition::Continuous { tolerance: 0.01 };
    machine.planner.set_termination(tolerance);
    let place = |chord: u32| {
        let (sin, cos) = (0.3 / 3.4 * f64::from(chord)).sin_cos();
        xyz(0.25 * sin, 0.25 - 0.25 * cos, -0.002 * f64::from(chord))
    };
    let last = place(chords);
    let up = last + xyz(0.0, 0.0, 13.0);
    let over = up + xyz(0.0, 10.5, 0.0);
    let retract = [up, over, over - xyz(0.0, 0.0, 13.0)];
    for end in (1..=chords).map(place).chain(retract) {
        machine.line(end, &feed_move(100.0)).expect("a line");
        machine.cycle();
    }
    machine.run(20_000);
    machine.extremes()
}

/// The sharpest part of the first corner was left out of the plan where as many chords were in sight as there is room for, at one
/// number of chords in thirty: eight times the jerk.
#[test]
fn it_keeps_the_jerk_however_many_chords_there_were() {
    for chords in [311, 312, 411, 419, 427, 446, 459, 803, 891] {
        let found = with_room(move || extremes(chords));
        assert!(
            found.velocity < 1.001 && found.acceleration < 1.001 && found.jerk < JERK_KEPT,
            "{chords} chords: {found:?}"
        );
    }
}
