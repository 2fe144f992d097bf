//! A corner a little before the end of a program.

use framepath::moves::TerminationCondition;

use crate::common::{Machine, at, equal_limits, feed_move, with_room};

/// Servo periods that two legs of 20 mm take within `tolerance`, 100 mm/s, 1000 mm/s2, 20,000 mm/s3.
fn periods(degrees: f64, tolerance: f64) -> usize {
    let mut machine = Machine::new(equal_limits(20_000.0));
    let tolerance = TerminationCondition::Continuous { tolerance };
    machine.planner.set_termination(tolerance);
    let (sin, cos) = degrees.to_radians().sin_cos();
    for end in [at(20.0, 0.0), at(20.0 + 20.0 * cos, 20.0 * sin)] {
        machine.line(end, &feed_move(100.0)).expect("a line");
        machine.cycle();
    }
    machine.run(2_000);
    machine.extremes().periods
}

/// The end was final only shortly before the machine braked for it, and the corner had been planned for a rest that comes
/// sooner: .640, .635 and .616 s. And corners swung out over 8 mm at most. The shortest motions that are known within
/// the tolerance take .612, .581 and .556 s.
#[test]
fn it_is_as_fast_as_if_the_end_had_been_known() {
    for (degrees, tolerance, most) in [(120.0, 0.2, 631), (90.0, 0.5, 600), (90.0, 1.0, 576)] {
        let taken = with_room(|| periods(degrees, tolerance));
        assert!(taken <= most, "{degrees} degrees, P {tolerance}: {taken}");
    }
}
