//! Single steps that begin in a pause in motion: each ends at rest at the end of the move under way.

use crate::common::path_check::counted;
use crate::common::seeded_runner::seeded_runner;
use crate::common::{Machine, at, feed_move, with_machine, with_room};
use crate::program::queue::queue;
use crate::program::{Programmed, Shape};
use crate::random_program::{any_corners, any_limits, any_shape};
use framepath::axes::Axes;
use framepath::cycle::JERK_KEPT;
use framepath::moves::TerminationCondition;
use framepath::moves::TerminationCondition::{Continuous, Exact, Stop};
use framepath::planner::{MoveRequest, Status};
use proptest::prelude::*;

/// What is left to rounding.
const ROUNDING: f64 = 1e-6;

/// Servo periods in which anything here comes to an end.
const LONG: usize = 60_000;

/// Cycles until the machine stands, held.
fn come_to_rest(machine: &mut Machine) -> Status {
    for _ in 0..LONG {
        let before = machine.planner.status().position;
        let status = machine.cycle();
        if status.current_velocity == 0.0 && status.position == before {
            return status;
        }
    }
    panic!("never at rest: {:?}", machine.planner.status());
}

/// Takes a single step as LinuxCNC does: resumes, and pauses when the number of the move is another one. The number that
/// it began with, and whether the machine stood before the number changed.
fn step(machine: &mut Machine) -> (i32, bool) {
    let id = machine.planner.status().exec_id;
    machine.inputs.stepping = true;
    machine.planner.resume();
    let mut stood = machine.planner.status().current_velocity == 0.0;
    for _ in 0..LONG {
        let status = machine.cycle();
        if status.exec_id != id || status.done {
            machine.planner.pause();
            machine.inputs.stepping = false;
            return (id, stood);
        }
        stood |= status.current_velocity == 0.0;
    }
    panic!("the step does not end: {:?}", machine.planner.status());
}

/// Pauses in the middle of the first of these moves, and steps to the end of each: how far the machine rests from there.
fn steps_along(
    machine: &mut Machine,
    mode: TerminationCondition,
    request: &MoveRequest,
    ends: &[Axes],
) -> Vec<f64> {
    machine.planner.set_termination(mode);
    for (id, end) in (1..).zip(ends) {
        machine.planner.set_id(id);
        machine.line(*end, request).expect("a line");
    }
    while machine.cycle().position[0] < 3.0 {}
    machine.planner.pause();
    assert_eq!(come_to_rest(machine).exec_id, 1);
    let distances = ends.iter().zip(1..).map(|(end, number)| {
        assert_eq!(step(machine), (number, true));
        (come_to_rest(machine).position - end).norm()
    });
    distances.collect()
}

fn assert_within_limits(machine: &Machine) {
    let extremes = machine.extremes();
    assert!(extremes.velocity < 1.001, "{extremes:?}");
    assert!(extremes.acceleration < 1.001, "{extremes:?}");
    assert!(extremes.jerk < JERK_KEPT, "{extremes:?}");
}

#[test]
fn each_step_ends_where_the_move_does() {
    let straight: Vec<Axes> = (1..=4).map(|n| at(20.0 * f64::from(n), 0.0)).collect();
    let zigzag: Vec<Axes> = (1..=6)
        .map(|n| at(15.0 * f64::from(n), f64::from(n % 2) * 4.0))
        .collect();
    for ends in [straight, zigzag] {
        for (mode, allowed) in [
            (Stop, ROUNDING),
            (Exact, ROUNDING),
            (Continuous { tolerance: 0.1 }, 0.1 + ROUNDING),
        ] {
            with_machine(|machine| {
                let distances = steps_along(machine, mode, &feed_move(80.0), &ends);
                let away = distances.iter().copied().fold(0.0, f64::max);
                assert!(away <= allowed, "{mode:?}: {distances:?}");
                assert!(machine.planner.status().done);
                assert_within_limits(machine);
            });
        }
    }
}

#[test]
fn a_step_in_dense_code_ends_at_the_end_of_its_line() {
    with_machine(|machine| {
        let ends: Vec<Axes> = (1..=160)
            .map(|n| at(0.5 * f64::from(n), 0.02 * f64::from(n % 2)))
            .collect();
        machine
            .planner
            .set_termination(Continuous { tolerance: 0.01 });
        for (id, end) in (1..).zip(&ends) {
            machine.planner.set_id(id);
            machine.line(*end, &feed_move(80.0)).expect("a line");
        }
        for _ in 0..300 {
            machine.cycle();
        }
        machine.planner.pause();
        let held = come_to_rest(machine);
        assert!(held.position[0] > 5.0 && held.position[0] < 70.0);
        for _ in 0..6 {
            let (id, stood) = step(machine);
            assert!(stood);
            let away = come_to_rest(machine).position - ends[id as usize - 1];
            assert!(away.norm() < 0.0101, "{id}: {away}");
        }
        machine.planner.resume();
        let before = machine.positions.len();
        machine.run(LONG);
        // With look-ahead again: lines of .5 mm, each from rest to rest, take longer than a second.
        let taken = machine.positions.len() - before;
        assert!(taken < 1500, "{taken}");
        assert_within_limits(machine);
    });
}

#[test]
fn what_is_to_go_is_told_while_the_step_is_planned() {
    with_machine(|machine| {
        machine
            .planner
            .set_termination(Continuous { tolerance: 0.1 });
        for n in 1..=3 {
            machine.planner.set_id(n);
            machine
                .line(at(20.0 * f64::from(n), 0.0), &feed_move(50.0))
                .expect("a line");
        }
        for _ in 0..200 {
            machine.cycle();
        }
        machine.planner.pause();
        let held = come_to_rest(machine);
        machine.inputs.stepping = true;
        machine.planner.resume();
        let mut greatest = held.distance_to_go;
        while machine.planner.status().exec_id == 1 {
            let status = machine.cycle();
            if status.exec_id == 1 {
                assert!(status.distance_to_go <= greatest + ROUNDING);
                greatest = status.distance_to_go;
            }
        }
        assert!(greatest < 0.1, "{greatest}");
    });
}

#[test]
fn outputs_of_moves_that_are_stepped_through_are_written_once() {
    with_machine(|machine| {
        machine
            .planner
            .set_termination(Continuous { tolerance: 0.2 });
        for n in 1..=5 {
            machine.planner.set_id(n);
            assert!(machine.planner.set_digital_output(n as usize, true));
            let end = at(10.0 * f64::from(n), f64::from(n % 2) * 5.0);
            machine.line(end, &feed_move(50.0)).expect("a line");
        }
        let mut written = Vec::new();
        let mut steps = 0;
        for period in 0.. {
            assert!(period < LONG);
            if period > 100 && period % 400 == 0 {
                machine.inputs.stepping = true;
                machine.planner.resume();
                steps += 1;
            } else if period == 100 {
                machine.planner.pause();
            }
            let id = machine.planner.status().exec_id;
            let status = machine.cycle();
            written.extend(status.outputs.digital().map(|(index, _)| index));
            if status.done {
                break;
            }
            if machine.inputs.stepping && status.exec_id != id {
                machine.planner.pause();
                machine.inputs.stepping = false;
            }
        }
        assert_eq!(written, [1, 2, 3, 4, 5]);
        assert_eq!(steps, 5);
    });
}

/// Wherever in a step, and while it waits for the machine to stand.
#[test]
fn an_abort_in_a_step_leaves_nothing_behind() {
    for braking in [0, 20, 400] {
        for stepped in [0, 1, 5, 60, 300] {
            with_machine(|machine| {
                let blended = Continuous { tolerance: 0.1 };
                machine.planner.set_termination(blended);
                for n in 1..=3 {
                    machine.planner.set_id(n);
                    let end = at(20.0 * f64::from(n), f64::from(n % 2));
                    machine.line(end, &feed_move(80.0)).expect("a line");
                }
                for _ in 0..150 {
                    machine.cycle();
                }
                machine.planner.pause();
                for _ in 0..braking {
                    machine.cycle();
                }
                machine.inputs.stepping = true;
                machine.planner.resume();
                for _ in 0..stepped {
                    machine.cycle();
                }
                machine.planner.abort();
                machine.inputs.stepping = false;
                machine.run(LONG);
                assert!(!machine.planner.status().aborting);
                machine
                    .line(at(5.0, 5.0), &feed_move(50.0))
                    .expect("a line");
                machine.run(LONG);
                assert_eq!(machine.planner.status().position, at(5.0, 5.0));
                assert_within_limits(machine);
            });
        }
    }
}

#[test]
fn a_step_that_is_taken_while_the_machine_still_brakes_ends_there_too() {
    with_machine(|machine| {
        machine.planner.set_termination(Exact);
        for n in 1..=3 {
            machine.planner.set_id(n);
            machine
                .line(at(30.0 * f64::from(n), 0.0), &feed_move(80.0))
                .expect("a line");
        }
        for _ in 0..200 {
            machine.cycle();
        }
        machine.planner.pause();
        for _ in 0..20 {
            machine.cycle();
        }
        assert!(machine.planner.status().current_velocity > 10.0);
        assert_eq!(step(machine), (1, true));
        assert_eq!(come_to_rest(machine).position, at(30.0, 0.0));
        // Paused in the middle of a step, and stepped again.
        machine.inputs.stepping = true;
        machine.planner.resume();
        for _ in 0..150 {
            machine.cycle();
        }
        machine.planner.pause();
        let held = come_to_rest(machine);
        assert!(held.exec_id == 2 && held.position[0] < 59.0);
        assert_eq!(step(machine), (2, true));
        assert_eq!(come_to_rest(machine).position, at(60.0, 0.0));
        machine.planner.resume();
        machine.run(LONG);
        assert_within_limits(machine);
    });
}

/// What an operator does: after so many periods a pause, after so many more a step, and so many of them.
#[derive(Clone, Debug)]
struct Paused {
    after: usize,
    braking: usize,
    steps: usize,
}

fn any_pauses() -> impl Strategy<Value = Vec<Paused>> {
    let pause = (1usize..600, prop_oneof![Just(LONG), 0usize..60], 1usize..5);
    let pause = pause.prop_map(|(after, braking, steps)| Paused {
        after,
        braking,
        steps,
    });
    prop::collection::vec(pause, 1..5)
}

/// Moves of one feed, as arcs or as lines.
fn any_moves() -> impl Strategy<Value = Vec<Programmed>> {
    let arcs = any_shape().prop_map(|shape| Programmed::feed(shape, 100.0));
    // Collinear lines, which are merged.
    let merged = (0.01..3.0f64, 2usize..30).prop_map(|(length, count)| {
        let line = Programmed::feed(Shape::Line(at(length, 0.0)), 100.0);
        vec![line; count]
    });
    prop_oneof![
        any_corners(),
        prop::collection::vec(arcs, 2..20),
        prop::collection::vec(merged, 1..3).prop_map(|parts| parts.concat()),
    ]
}

/// Runs the moves with pauses and steps. Answers how far from the end of its move a step ended, and what was allowed.
fn run_paused(machine: &mut Machine, moves: &[Programmed], pauses: &[Paused]) -> Vec<(f64, f64)> {
    let mut ends = Vec::new();
    for (id, programmed) in (1..).zip(moves) {
        machine.planner.set_id(id);
        let (_, shape) = queue(machine, programmed, 250.0);
        let tolerance = match machine.planner.termination() {
            Continuous { tolerance } if tolerance > 0.0 => tolerance,
            Continuous { .. } => f64::INFINITY,
            Exact => 1e-3,
            Stop => 0.0,
        };
        ends.push(shape.map(|shape| (shape.end(), tolerance)));
    }
    let mut found = Vec::new();
    for pause in pauses {
        for _ in 0..pause.after {
            machine.cycle();
        }
        if machine.planner.status().done {
            break;
        }
        machine.planner.pause();
        for _ in 0..pause.braking.min(1500) {
            machine.cycle();
        }
        for _ in 0..pause.steps {
            if machine.planner.status().done {
                return found;
            }
            let (id, stood) = step(machine);
            let rest = come_to_rest(machine);
            if let Some((end, tolerance)) = ends[id as usize - 1].filter(|_| stood) {
                let next = ends.get(id as usize).copied().flatten();
                let allowed = next.map_or(tolerance, |(_, next)| tolerance.max(next));
                found.push((counted(&(rest.position - end)), allowed));
            }
        }
        machine.planner.resume();
    }
    machine.run(10 * LONG);
    found
}

#[test]
fn steps_from_anywhere_end_at_the_end_of_their_moves() {
    with_room(|| {
        let mut runner = seeded_runner(ProptestConfig::with_cases(120));
        let strategy = (any_limits(), any_moves(), any_pauses());
        let result = runner.run(&strategy, |(limits, moves, pauses)| {
            let mut machine = Machine::new(limits);
            machine
                .planner
                .set_termination(Continuous { tolerance: 0.05 });
            let found = run_paused(&mut machine, &moves, &pauses);
            for (away, allowed) in found {
                prop_assert!(away <= allowed + 1e-5, "{away} {allowed}");
            }
            prop_assert_eq!(machine.planner.status().position, *machine.planner.goal());
            let extremes = machine.extremes();
            prop_assert!(extremes.velocity < 1.001, "{:?}", extremes);
            prop_assert!(extremes.acceleration < 1.001, "{:?}", extremes);
            prop_assert!(extremes.jerk < JERK_KEPT, "{:?}", extremes);
            Ok(())
        });
        result.expect("every step ends at the end of its move");
    });
}
