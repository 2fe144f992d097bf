//! Corners that are rounded on their inner side only.

use crate::common::{Machine, at, feed_move, with_machine};
use framepath::moves::TerminationCondition;

const ROUNDED: TerminationCondition = TerminationCondition::Continuous { tolerance: 0.05 };

/// Runs a square of 10 mm from the origin, and answers how far it leads out of that. `before_corner`: what the operator does on
/// the first side.
fn outside(machine: &mut Machine, before_corner: impl FnOnce(&mut Machine)) -> f64 {
    machine.planner.set_termination(ROUNDED);
    for end in [at(10.0, 0.0), at(10.0, 10.0), at(0.0, 10.0), at(0.0, 0.0)] {
        machine.line(end, &feed_move(60.0)).expect("a line");
    }
    run(machine, before_corner)
}

/// Runs what is queued.
fn run(machine: &mut Machine, before_corner: impl FnOnce(&mut Machine)) -> f64 {
    let mut operate = Some(before_corner);
    let mut greatest = 0.0f64;
    loop {
        let status = machine.cycle();
        if status.position[0] > 2.0
            && let Some(operate) = operate.take()
        {
            operate(machine);
        }
        let [x, y] = [status.position[0], status.position[1]];
        let out = [-x, x - 10.0, -y, y - 10.0];
        greatest = out.into_iter().fold(greatest, f64::max);
        if status.done {
            return greatest;
        }
    }
}

#[test]
fn none_swings_out_where_that_is_asked_for() {
    with_machine(|machine| {
        machine.planner.set_corners_inside(true);
        assert!(outside(machine, |_| {}) < 1e-12);
        machine.planner.set_corners_inside(false);
        assert!(outside(machine, |_| {}) > 0.02);
    });
}

#[test]
fn a_change_in_motion_holds_from_the_next_rest_on() {
    with_machine(|machine| {
        let change = |machine: &mut Machine| machine.planner.set_corners_inside(true);
        assert!(outside(machine, change) > 0.02);
        assert!(outside(machine, |_| {}) < 1e-12);
    });
}

/// Two squares in one program, the first of which comes to rest at its end: what is asked for on its way holds for the second.
fn outside_of_the_second(machine: &mut Machine, change: impl FnOnce(&mut Machine)) -> f64 {
    machine.planner.set_termination(TerminationCondition::Stop);
    for end in [at(5.0, 5.0), at(0.0, 0.0)] {
        machine.line(end, &feed_move(60.0)).expect("a line");
    }
    outside(machine, change)
}

#[test]
fn a_rest_within_the_program_is_one() {
    with_machine(|machine| {
        let change = |machine: &mut Machine| machine.planner.set_corners_inside(true);
        assert!(outside_of_the_second(machine, change) < 1e-12);
        let change = |machine: &mut Machine| machine.planner.set_corners_inside(false);
        assert!(outside_of_the_second(machine, change) > 0.02);
    });
}
