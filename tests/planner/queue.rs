//! What LinuxCNC relies on: ids, status, outputs, refusals, a full queue.

use core::mem::MaybeUninit;

use crate::common::{Machine, PERIOD, at, equal_limits, feed_move, with_machine, with_room};
use framepath::axes::{Axes, AxisLimits};
use framepath::cycle::JERK_KEPT;
use framepath::moves::shape::{Circle, ShapeError};
use framepath::moves::{CAPACITY, MotionType, STATE_TAG_SIZE, StateTag, TerminationCondition};
use framepath::planner::{AddError, Added, MoveRequest, PositionError};
use nalgebra::Vector3;

/// A tag that has this in all of its bytes.
fn tag_of(byte: u8) -> StateTag {
    StateTag([MaybeUninit::new(byte); STATE_TAG_SIZE])
}

/// The bytes of a tag that has been written in all of its bytes.
#[allow(unsafe_code)]
fn bytes(tag: &StateTag) -> [u8; STATE_TAG_SIZE] {
    // SAFETY: see above.
    tag.0.map(|byte| unsafe { byte.assume_init() })
}

#[test]
fn a_move_is_reported_while_it_runs() {
    with_machine(|machine| {
        machine.planner.set_id(7);
        let tag = tag_of(3);
        let request = MoveRequest {
            tag,
            enables: 0x0d,
            ..feed_move(50.0)
        };
        machine.line(at(30.0, 40.0), &request).expect("a line");
        let status = *machine.planner.status();
        assert!(!status.done && status.queue_depth == 1);
        let mut last_to_go = 50.0;
        let mut fastest = 0f64;
        loop {
            let status = machine.cycle();
            if status.done {
                break;
            }
            assert_eq!(
                (status.exec_id, bytes(&status.tag), status.enables),
                (7, bytes(&tag), Some(0x0d))
            );
            assert_eq!(status.motion_type, Some(MotionType::Feed));
            assert_eq!((status.queue_depth, status.active_depth), (1, 1));
            assert_eq!(status.requested_velocity, 50.0);
            assert!(status.distance_to_go <= last_to_go);
            let to_go = at(30.0, 40.0) - status.position;
            assert!((to_go.norm() - status.distance_to_go).abs() < 1e-9);
            assert!((to_go - status.axis_distance_to_go).amax() < 1e-12);
            last_to_go = status.distance_to_go;
            fastest = fastest.max(status.current_velocity);
        }
        assert!((fastest - 50.0).abs() < 1e-6, "{fastest}");
        let status = *machine.planner.status();
        assert_eq!(
            (status.exec_id, status.motion_type, status.enables),
            (0, None, None)
        );
        assert_eq!((status.queue_depth, status.active_depth), (0, 0));
        assert_eq!((status.distance_to_go, status.current_velocity), (0.0, 0.0));
        assert_eq!(
            (status.position, bytes(&status.tag)),
            (at(30.0, 40.0), bytes(&tag))
        );
    });
}

#[test]
fn what_is_in_force_is_that_of_a_move_that_is_held() {
    let tagged = |byte| MoveRequest {
        tag: tag_of(byte),
        ..feed_move(50.0)
    };
    with_machine(|machine| {
        machine.line(at(10.0, 0.0), &tagged(1)).expect("a line");
        machine.run(10_000);
        machine.line(at(20.0, 0.0), &tagged(2)).expect("a line");
        machine.planner.pause();
        let status = machine.cycle();
        assert_eq!(
            (status.active_depth, bytes(&status.tag)),
            (0, [2; STATE_TAG_SIZE])
        );
        machine.planner.resume();
        machine.run(10_000);
        // but not one that LinuxCNC's planner does not start
        machine.inputs.spindles_at_speed = false;
        let request = MoveRequest {
            wait_for_spindle: true,
            ..tagged(3)
        };
        machine.line(at(30.0, 0.0), &request).expect("a line");
        for _ in 0..50 {
            let status = machine.cycle();
            assert_eq!(
                (status.active_depth, bytes(&status.tag)),
                (0, [2; STATE_TAG_SIZE])
            );
        }
        machine.inputs.spindles_at_speed = true;
        assert_eq!(bytes(&machine.cycle().tag), [3; STATE_TAG_SIZE]);
    });
}

#[test]
fn ids_follow_the_moves() {
    with_machine(|machine| {
        machine.planner.set_id(10);
        for i in 1..=5 {
            machine
                .line(at(f64::from(i), 0.0), &feed_move(50.0))
                .expect("a line");
        }
        machine.planner.set_id(20);
        machine
            .line(at(0.0, 0.0), &feed_move(50.0))
            .expect("a line");
        machine.run(10_000);
        assert_eq!(machine.ids, [10, 11, 12, 13, 14, 20, 0]);
    });
}

#[test]
fn a_move_that_goes_nowhere_needs_no_feed() {
    // LinuxCNC sends them with a feed and a greatest velocity of 0
    with_machine(|machine| {
        let mut request = feed_move(0.0);
        request.max_velocity = 0.0;
        assert_eq!(machine.line(at(0.0, 0.0), &request), Ok(Added::ZeroLength));
        assert!(machine.line(at(1.0, 0.0), &request).is_err());
    });
}

#[test]
fn outputs_are_written_once_when_their_move_starts() {
    with_machine(|machine| {
        machine
            .line(at(1.0, 0.0), &feed_move(50.0))
            .expect("a line");
        assert!(machine.planner.set_digital_output(3, true));
        assert!(machine.planner.set_analog_output(1, 2.5));
        assert!(!machine.planner.set_digital_output(64, true));
        assert!(!machine.planner.set_analog_output(1, f64::NAN));
        assert_eq!(
            machine.line(at(1.0, 0.0), &feed_move(50.0)),
            Ok(Added::ZeroLength)
        );
        machine
            .line(at(2.0, 0.0), &feed_move(50.0))
            .expect("a line");
        machine
            .line(at(3.0, 0.0), &feed_move(50.0))
            .expect("a line");
        let mut written = Vec::new();
        while !machine.planner.status().done {
            let status = machine.cycle();
            for output in status.outputs.digital() {
                written.push((output.0, f64::from(u8::from(output.1)), status.exec_id));
            }
            for output in status.outputs.analog() {
                written.push((output.0, output.1, status.exec_id));
            }
        }
        assert_eq!(written, [(3, 1.0, 1), (1, 2.5, 1)]);
    });
}

#[test]
fn what_cannot_be_done_is_refused() {
    with_machine(|machine| {
        let to = at(1.0, 0.0);
        let good = feed_move(50.0);
        for (feed, max_velocity) in [
            (0.0, 1.0),
            (-1.0, 1.0),
            (f64::INFINITY, 1.0),
            (1.0, 0.0),
            (9e-10, 1.0),
            (5e-324, 1.0),
            (1.0, 1e-300),
        ] {
            let request = MoveRequest {
                feed,
                max_velocity,
                ..good
            };
            assert_eq!(
                machine.line(to, &request),
                Err(AddError::Feed { feed, max_velocity })
            );
        }
        assert_eq!(
            machine.planner.add_rigid_tap(&to, 1.0, &good),
            Err(AddError::RigidTap)
        );
        for (spindle, per_turn, speed_only, error) in [
            (0, -1.0, true, AddError::PerTurn(-1.0)),
            (0, f64::INFINITY, false, AddError::PerTurn(f64::INFINITY)),
            (8, 1.0, true, AddError::Spindle { spindle: 8 }),
            (-1, 1.0, false, AddError::Spindle { spindle: -1 }),
        ] {
            machine
                .planner
                .set_spindle_synchronisation(spindle, per_turn, speed_only);
            for _ in 0..5 {
                machine.cycle();
            }
            assert_eq!(machine.line(to, &good), Err(error));
            let tap = machine.planner.add_rigid_tap(&to, 1.0, &good);
            let expected = if speed_only {
                AddError::RigidTap
            } else {
                error
            };
            assert_eq!(tap, Err(expected));
        }
        machine.planner.set_spindle_synchronisation(0, 1.0, false);
        for scale in [0.0, -1.0, f64::NAN] {
            let tap = machine.planner.add_rigid_tap(&to, scale, &good);
            assert_eq!(tap, Err(AddError::RigidTap));
        }
        machine.planner.set_spindle_synchronisation(0, 0.0, false);
        let nowhere = at(f64::NAN, 0.0);
        assert_eq!(
            machine.line(nowhere, &good),
            Err(AddError::Shape(ShapeError::NotFinite))
        );
        assert_eq!(machine.planner.set_position(&nowhere), Err(PositionError));
        let circle = Circle {
            center: Vector3::zeros(),
            normal: Vector3::z(),
            revolutions: 0,
        };
        assert_eq!(
            machine.circle(to, &circle, &good),
            Err(AddError::Shape(ShapeError::RadiusTooSmall))
        );
        for far in [1.1e7, -1e300] {
            assert_eq!(
                machine.line(at(0.0, far), &good),
                Err(AddError::Shape(ShapeError::TooFar))
            );
        }
        let mut up = to;
        up[2] = 1.0;
        for (velocity, acceleration) in [
            (100.0, 0.0),
            (100.0, 9e-4),
            (100.0, 5e-324),
            (100.0, f64::NAN),
            (9e-10, 1000.0),
            (-1.0, 1000.0),
        ] {
            let mut limits = equal_limits(20_000.0);
            (limits.velocity[2], limits.acceleration[2]) = (velocity, acceleration);
            machine.planner.set_limits(&limits);
            assert_eq!(
                machine.line(up, &good),
                Err(AddError::AxisLimits { axis: 2 }),
                "{velocity} {acceleration}"
            );
        }
        assert_eq!(
            machine.line(to, &good),
            Ok(Added::Queued),
            "nothing of it changed the goal"
        );
        assert!(!machine.planner.set_cycle_time(0.0));
        machine.cycle();
        assert!(!machine.planner.set_cycle_time(PERIOD), "a move runs");
    });
}

#[test]
fn a_planner_without_a_period_or_limits_refuses_moves() {
    with_room(|| {
        let mut planner = framepath::planner::Planner::new();
        let (to, request) = (at(1.0, 0.0), feed_move(50.0));
        assert_eq!(
            planner.add_line(&to, &request),
            Err(AddError::NotConfigured)
        );
        assert!(planner.set_cycle_time(PERIOD));
        assert_eq!(
            planner.add_line(&to, &request),
            Err(AddError::AxisLimits { axis: 0 })
        );
    });
}

#[test]
fn the_queue_takes_2000_moves_and_one_more_a_cycle() {
    with_machine(|machine| {
        let place = |i: usize| at(0.02 * i as f64, 0.0);
        for i in 1..=CAPACITY {
            assert!(!machine.planner.status().queue_full);
            assert_eq!(machine.line(place(i), &feed_move(100.0)), Ok(Added::Queued));
        }
        assert!(machine.planner.status().queue_full);
        // The margin for what was on its way, as long as the memory for a way back, then no more.
        let mut added = CAPACITY;
        while machine.line(place(added + 1), &feed_move(100.0)).is_ok() {
            added += 1;
        }
        assert_eq!(added, 4096);
        assert_eq!(
            machine.line(place(added + 1), &feed_move(100.0)),
            Err(AddError::QueueFull)
        );
        for _ in 0..3000 {
            machine.cycle();
            if !machine.planner.status().queue_full {
                added += 1;
                machine.line(place(added), &feed_move(100.0)).expect("room");
            }
        }
        machine.planner.abort();
        while machine.cycle().aborting {}
        assert_eq!(machine.planner.status().queue_depth, 0);
        assert!(
            machine
                .ids
                .windows(2)
                .all(|ids| ids[1] == ids[0] + 1 || ids[1] == 0)
        );
        let extremes = machine.extremes();
        assert!(
            extremes.acceleration < 1.001 && extremes.jerk < JERK_KEPT,
            "{extremes:?}"
        );
    });
}

#[test]
fn late_moves_cost_less_than_two_cycles_each() {
    with_machine(|machine| {
        let mut cycles = 0;
        for i in 1..=20 {
            machine
                .line(at(f64::from(i), 0.0), &feed_move(100.0))
                .expect("a line");
            cycles += machine.run(1000);
        }
        let waited = cycles;
        for i in 21..=40 {
            machine
                .line(at(f64::from(i), 0.0), &feed_move(100.0))
                .expect("a line");
        }
        let at_once = machine.run(10_000);
        assert!(waited <= at_once + 40, "{waited} {at_once}");
    });
}

#[test]
fn a_new_position_drops_everything_and_a_clear_keeps_the_termination_condition() {
    with_machine(|machine| {
        let exact = TerminationCondition::Exact;
        machine.planner.set_termination(exact);
        machine
            .line(at(100.0, 0.0), &feed_move(60.0))
            .expect("a line");
        for _ in 0..100 {
            machine.cycle();
        }
        machine
            .planner
            .set_position(&at(5.0, 6.0))
            .expect("a position");
        let status = *machine.planner.status();
        assert!(status.done && status.queue_depth == 0 && status.exec_id == 0);
        assert_eq!(
            (status.position, *machine.planner.goal()),
            (at(5.0, 6.0), at(5.0, 6.0))
        );
        machine
            .line(at(6.0, 6.0), &feed_move(60.0))
            .expect("a line");
        machine.run(1000);
        assert_eq!(machine.planner.status().position, at(6.0, 6.0));
        machine.planner.clear();
        assert_eq!(machine.planner.termination(), exact);
        assert_eq!(machine.planner.status().position, at(6.0, 6.0));
    });
}

#[test]
fn an_axis_that_never_moves_needs_no_limits() {
    with_room(|| {
        let mut limits = equal_limits(20_000.0);
        for axis in 3..9 {
            limits.velocity[axis] = 0.0;
            limits.acceleration[axis] = f64::NAN;
        }
        let mut machine = Machine::new(AxisLimits { ..limits });
        machine
            .line(at(1.0, 2.0), &feed_move(60.0))
            .expect("a line");
        machine.run(1000);
        assert_eq!(machine.planner.status().position, at(1.0, 2.0));
    });
}

/// Servo periods that lines to these places take with G64 P`tolerance` through a queue of so many moves, below `most`, and how often
/// the machine comes to rest.
fn periods_and_rests(depth: usize, places: &[Axes], tolerance: f64, most: usize) -> (usize, usize) {
    let (mut periods, mut rests, mut moved) = (0, 0, false);
    with_machine(|machine| {
        machine
            .planner
            .set_termination(TerminationCondition::Continuous { tolerance });
        let mut sent = 0;
        while sent < places.len() || !machine.planner.status().done {
            if sent < places.len() && machine.planner.status().queue_depth < depth {
                machine
                    .line(places[sent], &feed_move(100.0))
                    .expect("a line");
                sent += 1;
            }
            let moves = machine.cycle().active_depth > 0;
            rests += usize::from(moved && !moves);
            moved = moves;
            periods += 1;
            assert!(periods < most, "{sent} moves with {depth} queued");
        }
    });
    (periods, rests)
}

/// Whoever has a queue of two hands over a move when another has left: the planner waited for more, its host for the planner,
/// a quarter of a second at each move. Now it takes what a rest after each takes, 31 ms, at most.
#[test]
fn short_moves_through_a_short_queue_go_on() {
    let chords: Vec<Axes> = (1..=300)
        .map(|number| 0.01 * f64::from(number))
        .map(|angle| at(2.0 * angle.sin(), 2.0 - 2.0 * angle.cos()))
        .collect();
    for depth in [2, 5] {
        periods_and_rests(depth, &chords, 0.0, 40 * chords.len());
    }
}

/// 200 legs of 1 mm through a queue of five. A plan that came a period late was a rest: 77 of them, 17.9 s instead of 16.7 to 17.0 s.
#[test]
fn plans_for_a_short_queue_come_in_time() {
    let legs: Vec<Axes> = (1..=200)
        .map(|leg: i32| at(f64::from((leg + 1) / 2), f64::from(leg / 2)))
        .collect();
    let (periods, rests) = periods_and_rests(5, &legs, 0.05, 20_000);
    assert!(rests <= 50 && periods < 17_100, "{rests} {periods}");
}
