//! Limits of jerk that come with a move, as LinuxCNC 2.10 sends them.

use crate::common::{Machine, PERIOD, at, equal_limits, feed_move, with_machine, with_room};
use framepath::moves::TerminationCondition;
use framepath::planner::{AddError, MoveRequest};

/// The jerk of these machines, and a third of it.
const JERK: f64 = 20_000.0;
const LOW: f64 = JERK / 3.0;

fn move_with(path_jerk: f64) -> MoveRequest {
    MoveRequest {
        path_jerk,
        ..feed_move(100.0)
    }
}

/// The greatest jerk of an axis where it is between these two places, over `JERK`.
fn jerk_between(machine: &Machine, axis: usize, from: f64, to: f64) -> f64 {
    let cubed = PERIOD * PERIOD * PERIOD * JERK;
    machine
        .positions
        .windows(4)
        .filter(|window| {
            window
                .iter()
                .all(|place| (from..=to).contains(&place[axis]))
        })
        .map(|p| ((p[3] - p[2] * 3.0 + p[1] * 3.0 - p[0])[axis] / cubed).abs())
        .fold(0.0, f64::max)
}

/// Two lines, along X and then along Y, rounded where they meet if that can be.
fn corner(machine: &mut Machine, first: f64, second: f64) {
    let blended = TerminationCondition::Continuous { tolerance: 0.1 };
    machine.planner.set_termination(blended);
    machine
        .line(at(40.0, 0.0), &move_with(first))
        .expect("a line");
    machine
        .line(at(40.0, 40.0), &move_with(second))
        .expect("a line");
}

#[test]
fn each_of_two_moves_keeps_its_own_and_the_machine_rests_between_them() {
    for (limits, expected) in [
        ([LOW, f64::INFINITY], [1.0 / 3.0, 1.0]),
        ([f64::INFINITY, LOW], [1.0, 1.0 / 3.0]),
    ] {
        with_machine(|machine| {
            corner(machine, limits[0], limits[1]);
            machine.run(5000);
            assert!(machine.positions.contains(&at(40.0, 0.0)));
            for (axis, expected) in expected.into_iter().enumerate() {
                let jerk = jerk_between(machine, axis, 0.0, 40.0);
                assert!((jerk / expected - 1.0).abs() < 0.05, "{axis}: {jerk}");
            }
        });
    }
}

#[test]
fn what_the_axes_keep_anyway_changes_nothing() {
    let periods = |first: f64, second: f64| {
        let mut cycles = 0;
        with_machine(|machine| {
            corner(machine, first, second);
            cycles = machine.run(5000);
            assert!(!machine.positions.contains(&at(40.0, 0.0)));
        });
        cycles
    };
    let without = periods(f64::INFINITY, f64::INFINITY);
    assert_eq!(periods(JERK, JERK), without);
    assert_eq!(periods(JERK * (1.0 + 1e-9), JERK * (1.0 - 1e-9)), without);
    assert_eq!(periods(1e300, 2.0 * JERK), without);
}

#[test]
fn it_is_the_only_limit_where_the_axes_have_none() {
    with_room(|| {
        let mut machine = Machine::new(equal_limits(f64::INFINITY));
        // On a diagonal both axes share what the path may.
        machine
            .line(at(30.0, 30.0), &move_with(JERK))
            .expect("a line");
        machine.run(5000);
        let along = jerk_between(&machine, 0, 0.0, 30.0) * 2.0_f64.sqrt();
        assert!((along - 1.0).abs() < 0.05, "{along}");
    });
}

#[test]
fn what_nobody_can_mean_is_refused() {
    with_machine(|machine| {
        for path_jerk in [-1.0, f64::NAN, 0.0, 1.0, 199.0] {
            let refused = machine.line(at(1.0, 0.0), &move_with(path_jerk));
            let Err(AddError::PathJerk(named)) = refused else {
                panic!("{path_jerk}: {refused:?}");
            };
            assert_eq!(named.to_bits(), path_jerk.to_bits());
        }
        assert!(machine.planner.status().done);
        machine
            .line(at(1.0, 0.0), &move_with(201.0))
            .expect("a line");
    });
}
