//! How soon a machine comes to rest whose plan has yet to be continued.

use crate::common::{Machine, at, feed_move, with_machine};
use framepath::cycle::JERK_KEPT;
use framepath::moves::TerminationCondition;

/// Adds the next of many short lines around a circle. They come as fast as the machine runs, so that the plan
/// is always about to brake to an end that is moved on.
fn add_line(machine: &mut Machine, number: usize) {
    const LENGTH: f64 = 0.06;
    const RADIUS: f64 = 30.0;
    let angle = LENGTH / RADIUS * (number + 1) as f64;
    let end = at(RADIUS * angle.sin(), RADIUS * (1.0 - angle.cos()));
    machine.line(end, &feed_move(100.0)).expect("a line");
}

#[test]
fn a_hold_does_not_wait_for_a_better_plan() {
    for start in (400..2400).step_by(250) {
        with_machine(|machine| {
            let blended = TerminationCondition::Continuous { tolerance: 0.01 };
            machine.planner.set_termination(blended);
            for number in 0..start {
                add_line(machine, number);
                machine.cycle();
            }
            let speed = machine.planner.status().current_velocity;
            assert!(speed > 30.0, "{speed} mm/s");
            machine.planner.pause();
            let cycles = (start..start + 1000)
                .position(|number| {
                    add_line(machine, number);
                    machine.cycle().current_velocity == 0.0
                })
                .expect("a rest");
            // An axis by itself takes 2 sqrt(v/J); the machine may have to stop accelerating first, and turns.
            let alone = 2000.0 * (speed / 20_000.0).sqrt();
            assert!(
                (cycles as f64) < 1.25 * alone,
                "{cycles} ms from {speed} mm/s, {alone} for an axis by itself"
            );
            let extremes = machine.extremes();
            assert!(
                extremes.acceleration < 1.001 && extremes.jerk < JERK_KEPT,
                "{extremes:?}"
            );
        });
    }
}
