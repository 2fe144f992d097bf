//! The reverse run: back along the path and forward again, within the limits, through a history of
//! several hundred moves.

use crate::common::seeded_runner::seeded_runner;
use crate::common::{Machine, at, equal_limits, feed_move, with_machine, with_room};
use framepath::axes::Axes;
use framepath::cycle::JERK_KEPT;
use framepath::moves::shape::Circle;
use framepath::moves::{MotionType, TerminationCondition};
use framepath::planner::{DirectionError, MoveRequest, Status};
use nalgebra::Vector3;
use proptest::prelude::*;

/// Brings the machine to rest by feed hold and turns the direction, as LinuxCNC's motion controller
/// does for an adaptive feed below 0. `false` if everything was done before.
fn turn(machine: &mut Machine, backwards: bool) -> bool {
    for _ in 0..5000 {
        if machine.planner.run_backwards(backwards).is_ok() {
            return true;
        }
        if machine.planner.status().done {
            return false;
        }
        machine.scaled_cycle(0.0);
    }
    panic!("did not turn: {:?}", machine.planner.status());
}

/// Cycles until the machine has stood still for a while.
fn run_to_rest(machine: &mut Machine) -> Status {
    let mut still = 0;
    for _ in 0..60_000 {
        let before = machine.planner.status().position;
        let status = machine.cycle();
        still = if status.position == before {
            still + 1
        } else {
            0
        };
        if still > 300 {
            return status;
        }
    }
    panic!("never at rest");
}

/// Distance from a point to what the machine has run through in these cycles.
fn distance_to(trace: &[Axes], point: &Axes) -> f64 {
    let to_step = |step: &[Axes]| {
        let way = step[1] - step[0];
        let square = way.norm_squared();
        let t = if square > 0.0 {
            ((point - step[0]).dot(&way) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (step[0] + way * t - point).norm()
    };
    trace.windows(2).map(to_step).fold(f64::INFINITY, f64::min)
}

/// A staircase of `count` moves, every tenth of them half a circle, rounded by .05 mm.
fn stairs(machine: &mut Machine, count: usize) -> Axes {
    machine
        .planner
        .set_termination(TerminationCondition::Continuous { tolerance: 0.05 });
    let mut position = at(0.0, 0.0);
    for k in 0..count {
        let mut end = position;
        end[k % 2] += 1.0;
        machine.planner.set_id(k as i32 + 1);
        if k % 10 == 9 {
            let middle = (position + end) * 0.5;
            let circle = Circle {
                center: Vector3::new(middle[0], middle[1], 0.0),
                normal: Vector3::z(),
                revolutions: 0,
            };
            machine
                .circle(end, &circle, &feed_move(40.0))
                .expect("an arc");
        } else {
            machine.line(end, &feed_move(40.0)).expect("a line");
        }
        position = end;
    }
    position
}

#[test]
fn goes_back_over_its_own_path_and_forward_again() {
    with_machine(|machine| {
        let end = stairs(machine, 300);
        while machine.planner.status().exec_id < 260 {
            machine.cycle();
        }
        assert!(turn(machine, true));
        let there = machine.positions.clone();
        let turned = *machine.planner.status();
        assert!(turned.backwards && !turned.done);
        let back = run_to_rest(machine);
        assert_eq!(back.position, at(0.0, 0.0));
        assert_eq!((back.exec_id, back.done), (1, false));
        for point in machine.positions.iter().skip(there.len()).step_by(7) {
            // The corners of .05 mm are run through in steps of .04 mm at most.
            let away = distance_to(&there, point);
            assert!(away < 2e-3, "{away} off the way there");
        }
        // As far as it went, one by one.
        let ids: Vec<i32> = machine.ids.iter().copied().filter(|id| *id > 0).collect();
        let furthest = ids.iter().copied().max().expect("an id");
        let expected: Vec<i32> = (1..=furthest).chain((1..furthest).rev()).collect();
        assert_eq!(ids, expected);

        assert!(turn(machine, false));
        machine.run(60_000);
        assert_eq!(machine.planner.status().position, end);
        let extremes = machine.extremes();
        assert!(extremes.velocity <= 1.001 && extremes.acceleration <= 1.001);
        assert!(extremes.jerk <= JERK_KEPT, "{extremes:?}");
    });
}

/// At rest before lines that are merged into one none of the later ones is reported.
#[test]
fn merged_lines_are_left_backwards_by_the_first() {
    with_machine(|machine| {
        machine
            .planner
            .set_termination(TerminationCondition::Continuous { tolerance: 0.3 });
        let mut position = at(0.0, 0.0);
        for k in 0..11 {
            position[k % 2] += 0.0018;
            machine.planner.set_id(k as i32 + 1);
            machine.line(position, &feed_move(40.0)).expect("a line");
        }
        machine.planner.set_id(12);
        machine
            .line(at(20.0, -10.0), &feed_move(40.0))
            .expect("a line");
        while machine.planner.status().position[0] < 5.0 {
            machine.cycle();
        }
        assert!(turn(machine, true));
        let turned = machine.ids.len();
        assert_eq!(run_to_rest(machine).position, at(0.0, 0.0));
        let back = &machine.ids[turned..];
        assert!(back.windows(2).all(|ids| ids[1] <= ids[0]), "{back:?}");
    });
}

#[test]
fn remembers_some_hundred_moves_and_rests_there() {
    with_machine(|machine| {
        stairs(machine, 1900);
        while machine.planner.status().exec_id < 1500 {
            machine.cycle();
        }
        assert!(turn(machine, true));
        let back = run_to_rest(machine);
        assert!((1..=1300).contains(&back.exec_id), "{}", back.exec_id);
        assert!(!back.done);
        // It can be left in both directions and by an abort.
        machine.planner.abort();
        while machine.cycle().aborting {}
        assert!(machine.planner.status().done && !machine.planner.status().backwards);
        machine
            .line(at(0.0, 0.0), &feed_move(40.0))
            .expect("a line");
        machine.run(60_000);
        assert!(machine.extremes().jerk <= JERK_KEPT);
    });
}

#[test]
fn is_refused_where_it_makes_no_sense() {
    with_machine(|machine| {
        assert_eq!(machine.planner.run_backwards(false), Ok(()));
        assert_eq!(
            machine.planner.run_backwards(true),
            Err(DirectionError::NoWayBack)
        );
        let probing = MoveRequest {
            motion_type: MotionType::Probing,
            ..feed_move(50.0)
        };
        machine
            .line(at(10.0, 0.0), &feed_move(50.0))
            .expect("a line");
        machine.line(at(20.0, 0.0), &probing).expect("a line");
        machine
            .line(at(30.0, 0.0), &feed_move(50.0))
            .expect("a line");
        while machine.planner.status().position[0] < 5.0 {
            machine.cycle();
        }
        assert_eq!(
            machine.planner.run_backwards(true),
            Err(DirectionError::Moving)
        );
        while machine.planner.status().position[0] < 12.0 {
            machine.cycle();
        }
        for _ in 0..500 {
            machine.scaled_cycle(0.0);
        }
        assert_eq!(
            machine.planner.run_backwards(true),
            Err(DirectionError::NoWayBack)
        );
        while machine.planner.status().position[0] < 25.0 {
            machine.cycle();
        }
        assert!(turn(machine, true));
        let back = run_to_rest(machine);
        assert_eq!(back.position, at(20.0, 0.0), "not back over a probing move");
        assert!(turn(machine, false));
        machine.run(5000);
        assert_eq!(machine.planner.status().position, at(30.0, 0.0));
    });
}

#[test]
fn outputs_are_written_once() {
    with_machine(|machine| {
        for k in 0..4 {
            assert!(machine.planner.set_digital_output(k, true));
            machine
                .line(at(k as f64 + 1.0, 0.0), &feed_move(20.0))
                .expect("a line");
        }
        let mut written = 0;
        let mut cycle = |machine: &mut Machine, adaptive| {
            let status = machine.scaled_cycle(adaptive);
            written += status.outputs.digital().count();
            status
        };
        while cycle(machine, 1.0).position[0] < 2.2 {}
        while machine.planner.run_backwards(true).is_err() {
            cycle(machine, 0.0);
        }
        while cycle(machine, 1.0).position[0] > 0.5 {}
        while machine.planner.run_backwards(false).is_err() {
            cycle(machine, 0.0);
        }
        while !cycle(machine, 1.0).done {}
        assert_eq!(written, 4);
    });
}

/// A random program, and when the operator turns the direction.
#[derive(Clone, Debug)]
struct Case {
    jerk: f64,
    /// Displacement, P (0: exact stop), feed.
    moves: Vec<([f64; 3], f64, f64)>,
    /// Cycles until the next turn, and the override until then.
    turns: Vec<(usize, f64)>,
}

fn any_case() -> impl Strategy<Value = Case> {
    let p = prop_oneof![1 => Just(0.0), 4 => (-5.0..0.0f64).prop_map(f64::exp)];
    let length = (-3.0..3.0f64).prop_map(f64::exp);
    let one = (
        prop::array::uniform3(-1.0..1.0f64),
        length,
        p,
        5.0..100.0f64,
    )
        .prop_map(|(way, length, p, feed)| (way.map(|part| part * length), p, feed));
    (
        prop_oneof![Just(f64::INFINITY), (9.0..12.0f64).prop_map(f64::exp)],
        prop::collection::vec(one, 5..60),
        prop::collection::vec((1..3000usize, 0.1..2.0f64), 1..8),
    )
        .prop_map(|(jerk, moves, turns)| Case { jerk, moves, turns })
}

#[test]
fn random_turns_keep_the_limits() {
    let cases = std::env::var("FRAMEPATH_CASES").map_or(40, |n| n.parse().expect("a number"));
    let config = ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let run = |case: &Case| {
        let mut machine = Machine::new(equal_limits(case.jerk));
        let mut position = Axes::zeros();
        for (way, p, feed) in &case.moves {
            for axis in 0..3 {
                position[axis] += way[axis];
            }
            machine.planner.set_termination(if *p > 0.0 {
                TerminationCondition::Continuous { tolerance: *p }
            } else {
                TerminationCondition::Stop
            });
            machine.line(position, &feed_move(*feed)).expect("a line");
        }
        let mut backwards = false;
        for (cycles, scale) in &case.turns {
            machine.inputs.feed_scale = *scale;
            for _ in 0..*cycles {
                machine.cycle();
            }
            backwards = !backwards;
            if !turn(&mut machine, backwards) {
                break;
            }
        }
        if !machine.planner.status().done {
            assert!(turn(&mut machine, false));
            machine.run(200_000);
        }
        assert_eq!(machine.planner.status().position, position);
        let extremes = machine.extremes();
        assert!(extremes.velocity <= 1.001, "{extremes:?}");
        assert!(extremes.acceleration <= 1.001, "{extremes:?}");
        assert!(
            !case.jerk.is_finite() || extremes.jerk <= JERK_KEPT,
            "{extremes:?}"
        );
    };
    let result = with_room(|| {
        seeded_runner(config).run(&any_case(), |case| {
            run(&case);
            Ok(())
        })
    });
    if let Err(error) = result {
        panic!("{error}");
    }
}
