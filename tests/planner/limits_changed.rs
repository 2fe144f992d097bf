//! Limits that change while a program runs: in force from the next rest on.

use crate::common::{Machine, at, equal_limits, feed_move, with_machine};
use framepath::axes::AxisLimits;
use framepath::cycle::JERK_KEPT;
use framepath::moves::TerminationCondition;

/// A thousandth of everything the machine is able to do.
fn feeble() -> AxisLimits {
    let limits = equal_limits(20_000.0);
    AxisLimits {
        velocity: limits.velocity * 1e-3,
        acceleration: limits.acceleration * 1e-3,
        jerk: limits.jerk * 1e-3,
    }
}

/// Servo periods from here to rest.
fn cycles_to_rest(machine: &mut Machine) -> usize {
    (1..5000)
        .find(|_| machine.cycle().done)
        .expect("the machine comes to rest")
}

/// Periods that an abort takes in the middle of a fast line, limits having been changed so many
/// periods before.
fn abort_after_change(periods: Option<usize>) -> usize {
    let mut result = 0;
    with_machine(|machine| {
        machine
            .line(at(200.0, 0.0), &feed_move(100.0))
            .expect("a line");
        for number in 0..400 {
            if periods == Some(400 - number) {
                machine.planner.set_limits(&feeble());
            }
            machine.cycle();
        }
        machine.planner.abort();
        result = cycles_to_rest(machine);
    });
    result
}

#[test]
fn a_stop_takes_as_long_as_with_the_limits_that_the_motion_began_with() {
    let unchanged = abort_after_change(None);
    assert!(unchanged < 200, "{unchanged}");
    for periods in [1, 3, 20, 200, 390] {
        assert_eq!(abort_after_change(Some(periods)), unchanged);
    }
}

#[test]
fn a_move_that_runs_keeps_its_limits_and_the_one_behind_a_rest_has_the_new_ones() {
    for termination in [TerminationCondition::Stop, TerminationCondition::Exact] {
        with_machine(|machine| {
            machine.planner.set_termination(termination);
            machine
                .line(at(40.0, 0.0), &feed_move(100.0))
                .expect("a line");
            machine
                .line(at(40.0, 20.0), &feed_move(100.0))
                .expect("a line");
            for _ in 0..100 {
                machine.cycle();
            }
            let slower = equal_limits(20_000.0);
            machine.planner.set_limits(&AxisLimits {
                velocity: slower.velocity * 0.5,
                ..slower
            });
            machine.run(5000);
            let speed = |from: f64, to: f64, axis: usize| {
                let steps = machine.positions.windows(2);
                steps
                    .filter(|step| step[0][axis] >= from && step[1][axis] <= to)
                    .map(|step| (step[1] - step[0])[axis] / crate::common::PERIOD)
                    .fold(0.0, f64::max)
            };
            assert!(speed(0.0, 40.0, 0) > 99.9, "{}", speed(0.0, 40.0, 0));
            let behind = speed(1e-9, 20.0, 1);
            assert!(behind > 49.9 && behind < 50.001, "{behind}");
        });
    }
}

#[test]
fn a_blended_path_without_a_rest_is_run_with_the_limits_it_began_with() {
    with_machine(|machine| {
        let blended = TerminationCondition::Continuous { tolerance: 0.1 };
        machine.planner.set_termination(blended);
        machine
            .line(at(30.0, 0.0), &feed_move(100.0))
            .expect("a line");
        machine.cycle();
        let mut corner = 0.0;
        for number in 0..5000 {
            if number == 50 {
                machine.planner.set_limits(&feeble());
            }
            if number == 60 {
                machine
                    .line(at(30.0, 30.0), &feed_move(100.0))
                    .expect("a line");
            }
            let status = machine.cycle();
            if status.exec_id == 1 && corner == 0.0 {
                corner = status.current_velocity;
            }
            if status.done {
                break;
            }
        }
        assert!(corner > 5.0, "{corner} mm/s in the corner");
        assert_eq!(machine.planner.status().position, at(30.0, 30.0));
        let extremes = machine.extremes();
        assert!(
            extremes.velocity < 1.001 && extremes.jerk < JERK_KEPT,
            "{extremes:?}"
        );
    });
}

#[test]
fn a_rest_beside_the_program_is_left_along_the_path_that_led_there() {
    // Lines of micrometres, rounded together: they come faster than they are run, until the path has no room and rests.
    let feed = feed_move(0.6);
    for turn in [0.1_f64, 0.2, 0.3] {
        with_machine(|machine| {
            let blended = TerminationCondition::Continuous { tolerance: 0.0 };
            machine.planner.set_termination(blended);
            let mut end = at(0.0, 0.0);
            let mut limits = equal_limits(f64::INFINITY);
            machine.planner.set_limits(&limits);
            assert!(machine.planner.set_cycle_time(0.01));
            for number in 0..500 {
                let (sin, cos) = (turn * f64::from(number)).sin_cos();
                end += at(cos, sin) * 1.6e-3;
                machine.line(end, &feed).expect("a line");
                if number > 200 {
                    limits.velocity[7] = f64::from(number);
                    machine.planner.set_limits(&limits);
                }
                machine.cycle();
            }
            machine.run(5000);
            assert_eq!(machine.planner.status().position, end);
        });
    }
}
