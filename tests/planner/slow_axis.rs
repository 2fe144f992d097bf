//! Corners of axes that are unlike.

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::TerminationCondition;

use crate::common::{Machine, feed_move, with_room};

/// A retract, a move of 5 mm along X, and a plunge: X and Z of the ends of moves.
const RETRACT: [[f64; 2]; 4] = [[0.0, 1.0], [5.0, 1.0], [5.0, 0.0], [5.3, 0.0]];

/// A retract with a long way behind it.
const AWAY: [[f64; 2]; 2] = [[0.0, 1.0], [40.0, 1.0]];

/// A long way there and back, 1 mm higher.
const THERE_AND_BACK: [[f64; 2]; 3] = [[40.0, 0.0], [40.0, 1.0], [0.0, 1.0]];

/// Servo periods of moves to these ends, 100 mm/s. X and Y have `fast`, Z and the others `slow`: velocity, mm/s, and acceleration,
/// mm/s2. Jerk is `jerk` accelerations in a second.
fn periods(
    ends: &[[f64; 2]],
    [fast, slow]: [[f64; 2]; 2],
    jerk: f64,
    termination: TerminationCondition,
) -> usize {
    let limit = |index: usize| {
        let mut limits = Axes::repeat(slow[index]);
        limits[0] = fast[index];
        limits[1] = fast[index];
        limits
    };
    let mut machine = Machine::new(AxisLimits {
        velocity: limit(0),
        acceleration: limit(1),
        jerk: limit(1) * jerk,
    });
    machine.planner.set_termination(termination);
    for [x, z] in ends {
        let mut end = Axes::zeros();
        end[0] = *x;
        end[2] = *z;
        machine.line(end, &feed_move(100.0)).expect("a line");
        machine.cycle();
    }
    machine.run(8_000);
    machine.extremes().periods
}

/// The slow axis was led to the outer side of its corners and back while the fast one waited for it: 1.13 and 1.21 times what rests
/// at the corners take.
#[test]
fn a_slow_axis_is_not_led_out_while_a_fast_one_waits() {
    for axes in [
        [[300.0, 3000.0], [10.0, 100.0]],
        [[500.0, 8000.0], [3.0, 20.0]],
    ] {
        let [rests, rounded] = [
            TerminationCondition::Stop,
            TerminationCondition::Continuous { tolerance: 0.05 },
        ]
        .map(|termination| with_room(|| periods(&RETRACT, axes, f64::INFINITY, termination)));
        assert!(
            (rounded as f64) < 1.08 * rests as f64,
            "{axes:?}: {rounded} periods, {rests} with rests"
        );
    }
}

/// Where the tolerance is as large as the leg of the slow axis, what moved it along the other leg as well took up to 2.4 times as
/// long as a rest at the corner.
#[test]
fn more_tolerance_costs_no_time_where_axes_are_unlike() {
    for (ends, axes) in [
        (&AWAY[..], [[100.0, 8000.0], [10.0, 20.0]]),
        (&AWAY, [[200.0, 2000.0], [50.0, 200.0]]),
        (&THERE_AND_BACK, [[300.0, 3000.0], [300.0, 3.0]]),
        (&THERE_AND_BACK, [[300.0, 3000.0], [100.0, 30.0]]),
        (&RETRACT, [[300.0, 3000.0], [10.0, 100.0]]),
    ] {
        for jerk in [f64::INFINITY, 100.0] {
            let run = |termination| with_room(|| periods(ends, axes, jerk, termination)) as f64;
            let mut least = run(TerminationCondition::Stop);
            for tolerance in [0.05, 0.1, 0.2] {
                let rounded = run(TerminationCondition::Continuous { tolerance });
                assert!(
                    rounded < 1.01 * least + 2.0,
                    "{axes:?}, jerk {jerk}, tolerance {tolerance}: {rounded} periods for {least}"
                );
                least = least.min(rounded);
            }
        }
    }
}
