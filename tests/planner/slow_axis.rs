//! Corners of axes that are unlike.

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::TerminationCondition;

use crate::common::{Machine, feed_move, with_room};

/// Servo periods of a retract, a move of 5 mm along X, and a plunge, 100 mm/s. X and Y have `fast`, Z and the others `slow`: velocity,
/// mm/s, and acceleration, mm/s2.
fn periods(fast: [f64; 2], slow: [f64; 2], termination: TerminationCondition) -> usize {
    let limit = |index: usize| {
        let mut limits = Axes::repeat(slow[index]);
        limits[0] = fast[index];
        limits[1] = fast[index];
        limits
    };
    let mut machine = Machine::new(AxisLimits {
        velocity: limit(0),
        acceleration: limit(1),
        jerk: Axes::repeat(f64::INFINITY),
    });
    machine.planner.set_termination(termination);
    for [x, z] in [[0.0, 1.0], [5.0, 1.0], [5.0, 0.0], [5.3, 0.0]] {
        let mut end = Axes::zeros();
        end[0] = x;
        end[2] = z;
        machine.line(end, &feed_move(100.0)).expect("a line");
        machine.cycle();
    }
    machine.run(4_000);
    machine.extremes().periods
}

/// The slow axis was led to the outer side of its corners and back while the fast one waited for it: 1.13 and 1.21 times what rests
/// at the corners take.
#[test]
fn a_slow_axis_is_not_led_out_while_a_fast_one_waits() {
    for (fast, slow) in [
        ([300.0, 3000.0], [10.0, 100.0]),
        ([500.0, 8000.0], [3.0, 20.0]),
    ] {
        let [rests, rounded] = [
            TerminationCondition::Stop,
            TerminationCondition::Continuous { tolerance: 0.05 },
        ]
        .map(|termination| with_room(|| periods(fast, slow, termination)));
        assert!(
            (rounded as f64) < 1.08 * rests as f64,
            "{slow:?}: {rounded} periods, {rests} with rests"
        );
    }
}
