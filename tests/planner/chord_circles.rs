//! Circles made of chords: more jerk never costs time.

use crate::common::{Machine, PERIOD, at, equal_limits, feed_move, with_room};
use framepath::moves::TerminationCondition;

/// What more jerk may cost: the rest of a servo period, and widths that are chosen in steps.
const ROUNDING: f64 = 1.01;

/// Seconds for `turns` turns of a circle of this radius, made of chords of this length (mm), at 60 mm/s
/// with this jerk (mm/s3).
fn time(radius: f64, chord: f64, tolerance: f64, jerk: f64) -> f64 {
    const TURNS: f64 = 3.0;
    let mut time = 0.0;
    with_room(|| {
        let mut machine = Machine::new(equal_limits(jerk));
        machine
            .planner
            .set_termination(TerminationCondition::Continuous { tolerance });
        let step = chord / radius;
        let count = (TURNS * core::f64::consts::TAU / step) as usize;
        let mut ends = (1..=count)
            .map(|number| number as f64 * step)
            .map(|angle| at(radius * angle.sin(), radius * (1.0 - angle.cos())));
        let mut cycles = 0;
        loop {
            let next = ends.next();
            if let Some(end) = next {
                machine.line(end, &feed_move(60.0)).expect("a line");
            }
            let status = machine.cycle();
            cycles += 1;
            if status.done && next.is_none() {
                break;
            }
        }
        time = cycles as f64 * PERIOD;
    });
    time
}

#[test]
fn more_jerk_costs_no_time() {
    let mut failures = Vec::new();
    for (radius, chord) in [(3.0, 0.3), (3.0, 1.0), (3.0, 2.0), (10.0, 0.5), (10.0, 2.0)] {
        for tolerance in [0.01, 0.05] {
            let jerks = [20_000.0, 50_000.0, 100_000.0, f64::INFINITY];
            let times = jerks.map(|jerk| time(radius, chord, tolerance, jerk));
            println!("radius {radius}, chord {chord}, P {tolerance}: {times:.3?} s");
            if times.windows(2).any(|pair| pair[1] > pair[0] * ROUNDING) {
                failures.push(format!(
                    "radius {radius}, chord {chord}, P {tolerance}: {times:?}"
                ));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
