//! A zigzag in XY with something beside it.

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::TerminationCondition;

use super::{Machine, at, feed_move, with_room};

/// Servo periods of one with legs of this length, mm, at F6000 and G64 P.5 with 1000 mm/s2; each end, with its number, is
/// changed by `beside`.
pub fn periods(leg: f64, jerk: f64, beside: impl Fn(u8, &mut Axes) + Sync) -> usize {
    with_room(|| {
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
            beside(number, &mut end);
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
    })
}
