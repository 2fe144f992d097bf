//! A rotary axis that turns little beside X and Y takes away nothing of what the tolerance gives them.

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::TerminationCondition;

use crate::common::{Machine, at, feed_move, with_room};

/// Servo periods of a zigzag with legs of this length, mm, along which C turns by so many degrees, at F6000 and G64 P.5.
fn periods(leg: f64, jerk: f64, turn: f64) -> usize {
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
        end[5] = turn * f64::from(number % 3);
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
fn a_rotary_axis_that_turns_little_costs_no_time() {
    for jerk in [f64::INFINITY, 1e5, 2e4] {
        for leg in [0.5, 1.0, 2.0] {
            let alone = with_room(|| periods(leg, jerk, 0.0)) as f64;
            for turn in [1e-5, 0.001, 0.003] {
                let beside = with_room(|| periods(leg, jerk, turn)) as f64;
                let fits = beside <= 1.02 * alone + 2.0;
                assert!(
                    fits,
                    "{turn} degrees on {leg} mm, jerk {jerk}: {beside}, alone {alone}"
                );
            }
        }
    }
}
