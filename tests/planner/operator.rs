//! What an operator does to a running program: pause, step, abort, overrides, the slider.

use crate::common::{PERIOD, at, feed_move, with_machine};
use framepath::axes::Axes;
use framepath::cycle::JERK_KEPT;
use framepath::moves::shape::Circle;
use framepath::moves::{MotionType, TerminationCondition};
use framepath::planner::{AddError, MoveRequest};
use nalgebra::Vector3;

#[test]
fn an_abort_takes_back_the_outputs() {
    with_machine(|machine| {
        machine
            .line(at(1.0, 0.0), &feed_move(50.0))
            .expect("a line");
        assert!(machine.planner.set_digital_output(3, true));
        machine.planner.abort();
        while machine.cycle().aborting {}
        machine
            .line(at(1.0, 0.0), &feed_move(50.0))
            .expect("a line");
        while !machine.planner.status().done {
            assert!(machine.cycle().outputs.is_empty());
        }
    });
}

#[test]
fn a_move_waits_for_the_spindle() {
    with_machine(|machine| {
        machine.inputs.spindles_at_speed = false;
        machine
            .line(at(1.0, 0.0), &feed_move(50.0))
            .expect("a line");
        let waiting = MoveRequest {
            wait_for_spindle: true,
            ..feed_move(50.0)
        };
        machine.line(at(2.0, 0.0), &waiting).expect("a line");
        for _ in 0..2000 {
            machine.cycle();
        }
        let status = *machine.planner.status();
        assert!(status.waiting_for_spindle && !status.done);
        assert_eq!(status.position, at(1.0, 0.0));
        machine.inputs.spindles_at_speed = true;
        machine.run(2000);
        assert_eq!(machine.planner.status().position, at(2.0, 0.0));
        assert!(machine.extremes().jerk < 1.001);
    });
}

#[test]
fn an_abort_stops_on_the_path_and_new_moves_start_from_there() {
    with_machine(|machine| {
        let circle = Circle {
            center: Vector3::new(20.0, 0.0, 0.0),
            normal: Vector3::z(),
            revolutions: 0,
        };
        machine
            .circle(at(0.0, 0.0), &circle, &feed_move(60.0))
            .expect("an arc");
        machine
            .line(at(100.0, 0.0), &feed_move(60.0))
            .expect("a line");
        for _ in 0..700 {
            machine.cycle();
        }
        machine.planner.abort();
        assert_eq!(
            machine.line(at(1.0, 0.0), &feed_move(60.0)),
            Err(AddError::Aborting)
        );
        let mut cycles = 0;
        while machine.cycle().aborting {
            cycles += 1;
        }
        // From 60 mm/s with 1000 mm/s2 and 20000 mm/s3: 110 ms.
        assert!((100..150).contains(&cycles), "{cycles}");
        let status = *machine.planner.status();
        assert!(status.done && status.queue_depth == 0 && !status.pausing);
        assert_eq!(*machine.planner.goal(), status.position);
        let from_center = status.position - at(20.0, 0.0);
        assert!((from_center.norm() - 20.0).abs() < 1e-9);
        machine
            .line(at(-5.0, -5.0), &feed_move(60.0))
            .expect("a line");
        machine.run(5000);
        assert_eq!(machine.planner.status().position, at(-5.0, -5.0));
        let extremes = machine.extremes();
        assert!(
            extremes.velocity < 1.001 && extremes.acceleration < 1.001,
            "{extremes:?}"
        );
        assert!(extremes.jerk < JERK_KEPT, "{extremes:?}");
    });
}

#[test]
fn a_pause_holds_on_the_path_and_a_resume_goes_on() {
    with_machine(|machine| {
        machine
            .line(at(100.0, 0.0), &feed_move(60.0))
            .expect("a line");
        for _ in 0..500 {
            machine.cycle();
        }
        machine.planner.pause();
        for _ in 0..300 {
            machine.cycle();
        }
        let held = machine.cycle();
        assert_eq!(held.current_velocity, 0.0);
        assert!(!held.done && held.pausing && held.exec_id == machine.ids[0]);
        assert_eq!(machine.cycle().position, held.position);
        machine.planner.resume();
        machine.run(5000);
        assert_eq!(machine.planner.status().position, at(100.0, 0.0));
        let extremes = machine.extremes();
        assert!(
            extremes.acceleration < 1.001 && extremes.jerk < JERK_KEPT,
            "{extremes:?}"
        );
    });
}

#[test]
fn a_step_stops_at_the_end_of_the_move() {
    with_machine(|machine| {
        for i in 1..=3 {
            machine.planner.set_id(i);
            machine
                .line(at(10.0 * f64::from(i), 0.0), &feed_move(60.0))
                .expect("a line");
        }
        machine.planner.pause();
        machine.cycle();
        for step in 1..=3 {
            // As LinuxCNC does it: resume, and pause again when the id is another one.
            let id = machine.planner.status().exec_id;
            assert_eq!(id, step);
            machine.inputs.stepping = true;
            machine.planner.resume();
            for _ in 0..2000 {
                if machine.cycle().exec_id != id && machine.inputs.stepping {
                    machine.planner.pause();
                    machine.inputs.stepping = false;
                }
            }
            assert_eq!(
                machine.planner.status().position,
                at(10.0 * f64::from(step), 0.0)
            );
        }
        assert!(machine.planner.status().done);
    });
}

#[test]
fn adaptive_feed_slows_moves_with_and_without_override() {
    with_machine(|machine| {
        for enables in [0x0f, 0x0d] {
            let request = MoveRequest {
                enables,
                ..feed_move(60.0)
            };
            let end = at(100.0, 0.0) - *machine.planner.goal();
            machine.line(end, &request).expect("a line");
            machine.inputs.feed_scale = 0.8;
            let plain = if enables & 2 == 0 { 60.0 } else { 48.0 };
            let mut velocities = Vec::new();
            for adaptive in [1.0, 0.25, 0.0, 1.0] {
                for _ in 0..500 {
                    machine.scaled_cycle(adaptive);
                }
                velocities.push(machine.planner.status().current_velocity);
            }
            for (velocity, scale) in velocities.iter().zip([1.0, 0.25, 0.0, 1.0]) {
                assert!(
                    (velocity - plain * scale).abs() < 0.01 * plain,
                    "{velocities:?}"
                );
            }
            machine.run(10_000);
        }
        let extremes = machine.extremes();
        assert!(
            extremes.acceleration < 1.001 && extremes.jerk < JERK_KEPT,
            "{extremes:?}"
        );
    });
}

/// A move of `length` mm without an override and 5 mm with one of `scale` behind it, F given in mm/s, through a planner
/// that gets the second one `delay` periods later: what share of the first feed the fastest quarter of the first move
/// has, and by what the feed of the second is exceeded.
fn masked_and_not(feed: f64, scale: f64, length: f64, delay: usize) -> (f64, f64) {
    let mut figures = (0.0, 0.0);
    with_machine(|machine| {
        machine
            .planner
            .set_termination(TerminationCondition::Continuous { tolerance: 0.0 });
        machine.inputs.feed_scale = scale;
        let masked = MoveRequest {
            enables: 0x0d,
            ..feed_move(feed)
        };
        machine.line(at(length, 0.0), &masked).expect("a line");
        for _ in 0..delay {
            machine.cycle();
        }
        let end = at(length + 5.0, 0.0);
        machine.line(end, &feed_move(feed)).expect("a line");
        machine.run(30_000);
        let x: Vec<f64> = machine.positions.iter().map(|place| place[0]).collect();
        let speeds = |from: f64, to: f64| {
            let inside = |pair: &&[f64]| pair[0] >= from && pair[1] <= to;
            x.windows(2)
                .filter(inside)
                .map(|pair| (pair[1] - pair[0]) / PERIOD)
                .collect::<Vec<_>>()
        };
        let mut first = speeds(1e-9, length);
        first.sort_by(f64::total_cmp);
        let fast = first.get(3 * first.len() / 4).copied().unwrap_or(0.0);
        let second = speeds(length, length + 5.0).into_iter().fold(0.0, f64::max);
        figures = (fast / feed, second / (feed * scale));
        let extremes = machine.extremes();
        assert!(
            extremes.acceleration < 1.001 && extremes.jerk < JERK_KEPT,
            "{extremes:?}"
        );
    });
    figures
}

/// What a cap ahead wants frozen was frozen in the first periods, as it was planned until then: .98 of the feed.
#[test]
fn a_move_without_override_is_as_fast_from_the_start() {
    for delay in 0..3 {
        let (share, excess) = masked_and_not(40.0, 0.5, 10.0, delay);
        assert!(share > 0.99 && excess < 1.001, "{delay}: {share} {excess}");
    }
}

/// However short the way to them is from the start.
#[test]
fn overrides_behind_a_move_without_are_kept() {
    for feed in [20.0, 90.0] {
        for scale in [0.05, 0.3, 0.8] {
            for doublings in 0..14 {
                let length = 0.01 * f64::from(1 << doublings);
                let (_, excess) = masked_and_not(feed, scale, length, 0);
                assert!(excess < 1.001, "{feed} {scale} {length}: {excess}");
            }
        }
    }
}

/// A rapid, machine units (or degrees) per second.
fn rapid(velocity: f64) -> MoveRequest {
    MoveRequest {
        motion_type: MotionType::Traverse,
        max_velocity: velocity,
        ..feed_move(velocity)
    }
}

#[test]
fn the_slider_holds_for_linear_and_rotary_moves() {
    with_machine(|machine| {
        machine.planner.set_velocity_limit(200.0);
        machine.planner.set_velocity_limit(20.0);
        machine
            .line(at(20.0, 0.0), &feed_move(60.0))
            .expect("a line");
        let mut fastest = 0f64;
        while !machine.planner.status().done {
            fastest = fastest.max(machine.cycle().current_velocity);
        }
        assert!((fastest - 20.0).abs() < 0.2, "{fastest}");
        let mut end = at(20.0, 0.0);
        end[3] = 40.0;
        // A tenth of the slider is a tenth of the greatest rate.
        let rapid = rapid(90.0);
        machine.line(end, &rapid).expect("a line");
        fastest = 0.0;
        while !machine.planner.status().done {
            fastest = fastest.max(machine.cycle().current_velocity);
        }
        assert!((fastest - 9.0).abs() < 0.1, "{fastest}");
        machine.planner.set_velocity_limit(0.0);
        machine.line(at(20.0, 0.0), &rapid).expect("a line");
        for _ in 0..100 {
            assert_eq!(machine.cycle().position, end);
        }
    });
}

/// LinuxCNC says 1e9 or more where [TRAJ]MAX_LINEAR_VELOCITY is missing.
#[test]
fn the_slider_is_a_share_of_what_the_axes_reach_where_the_machine_has_no_greatest_velocity() {
    let reach = 100.0 * 6f64.sqrt();
    for none in [1e6, 1e9, 1e99, f64::INFINITY] {
        with_machine(|machine| {
            machine.planner.set_velocity_limit(none);
            machine.planner.set_velocity_limit(0.1 * reach);
            let mut end = Axes::zeros();
            end[3] = 20.0;
            let rapid = rapid(90.0);
            machine.line(end, &rapid).expect("a line");
            machine.run(10_000);
            assert_eq!(machine.planner.status().position, end);
            let fastest = machine.extremes().velocity * 100.0;
            assert!((fastest - 9.0).abs() < 0.1, "{none}: {fastest}");
            machine.planner.set_velocity_limit(0.0);
            machine.line(Axes::zeros(), &rapid).expect("a line");
            for _ in 0..100 {
                assert_eq!(machine.cycle().position, end);
            }
        });
    }
}
