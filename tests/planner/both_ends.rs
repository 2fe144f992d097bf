//! U and V beside X and Y, as the two ends of a wire: each keeps the tolerance by itself, and takes away nothing of the other's.

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::TerminationCondition;

use crate::common::{Machine, at, feed_move, with_room};

/// Servo periods of a zigzag with legs of this length, mm, along which U and V move by so many times what X and Y do, at F6000 and
/// G64 P.5.
fn periods(leg: f64, jerk: f64, times: [f64; 2]) -> usize {
    let mut machine = Machine::new(AxisLimits {
        velocity: Axes::repeat(100.0),
        acceleration: Axes::repeat(1000.0),
        jerk: Axes::repeat(jerk),
    });
    machine
        .planner
        .set_termination(TerminationCondition::Continuous { tolerance: 0.5 });
    let mut ends = (1..25u8).map(|number| {
        let mut end = at(f64::from(number), f64::from(number % 2)) * leg;
        for (axis, times) in times.into_iter().enumerate() {
            end[6 + axis] = times * end[axis];
        }
        end
    });
    loop {
        let next = ends.next();
        if let Some(end) = next {
            machine.line(end, &feed_move(100.0)).expect("a line");
        }
        if machine.cycle().done && next.is_none() {
            return machine.extremes().periods;
        }
    }
}

#[test]
fn another_end_that_moves_no_more_costs_no_time() {
    for jerk in [f64::INFINITY, 1e5, 2e4] {
        for leg in [0.5, 1.0, 2.0] {
            let alone = with_room(|| periods(leg, jerk, [0.0; 2])) as f64;
            for times in [[1.0, 1.0], [1.0, -1.0], [0.8, 0.3]] {
                let both = with_room(|| periods(leg, jerk, times)) as f64;
                let fits = both <= 1.03 * alone + 2.0;
                assert!(
                    fits,
                    "{times:?} on {leg} mm, jerk {jerk}: {both}, alone {alone}"
                );
            }
        }
    }
}
