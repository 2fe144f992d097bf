//! Motion that follows a spindle: feed per turn and threads.

use crate::common::lathe::{
    Lathe, SPINDLE, fast, feed_of, keeps_limits, off_the_groove, spread, z,
};
use crate::common::{Machine, PERIOD, feed_move, with_machine};
use framepath::moves::{MotionType, TerminationCondition};
use framepath::planner::MoveRequest;

#[test]
fn feed_per_turn_follows_speed_and_override() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 10.0);
        lathe
            .machine
            .planner
            .set_spindle_synchronisation(SPINDLE as i32, 0.4, true);
        lathe.machine.line(z(60.0), &fast()).expect("a line");
        for (speed, scale) in [
            (10.0, 1.0),
            (20.0, 1.0),
            (20.0, 0.5),
            (5.0, 1.0),
            (10.0, 1.2),
        ] {
            lathe.commanded = speed;
            lathe.machine.inputs.feed_scale = scale;
            for _ in 0..1200 {
                lathe.cycle();
            }
            let expected = 0.4 * speed * scale;
            assert!(
                (feed_of(&lathe) / expected - 1.0).abs() < 1e-3,
                "{speed} {scale}"
            );
        }
        // A spindle that stands holds the machine.
        lathe.machine.inputs.feed_scale = 1.0;
        lathe.commanded = 0.0;
        for _ in 0..1500 {
            lathe.cycle();
        }
        assert_eq!(feed_of(&lathe), 0.0);
        lathe.commanded = 20.0;
        lathe.run(20_000);
        assert_eq!(lathe.machine.planner.status().position, z(60.0));
        assert_eq!(lathe.errors, []);
        keeps_limits(lathe.machine);
    });
}

#[test]
fn feed_per_turn_without_override() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 10.0);
        lathe
            .machine
            .planner
            .set_spindle_synchronisation(SPINDLE as i32, 0.4, true);
        let fixed = MoveRequest {
            enables: 0,
            ..fast()
        };
        lathe.machine.line(z(20.0), &fixed).expect("a line");
        lathe.machine.inputs.feed_scale = 0.5;
        for _ in 0..1000 {
            lathe.cycle();
        }
        assert!((feed_of(&lathe) - 4.0).abs() < 0.004);
    });
}

#[test]
fn feed_per_turn_and_per_minute_mix_in_one_run() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 10.0);
        let tolerance = TerminationCondition::Continuous { tolerance: 0.05 };
        lathe.machine.planner.set_termination(tolerance);
        for n in 0..6 {
            let per_turn = if n % 2 == 0 { 0.5 } else { 0.0 };
            lathe
                .machine
                .planner
                .set_spindle_synchronisation(SPINDLE as i32, per_turn, true);
            let to = z(10.0 * f64::from(n + 1));
            lathe
                .machine
                .line(
                    to,
                    &MoveRequest {
                        feed: 20.0,
                        ..fast()
                    },
                )
                .expect("a line");
        }
        let mut rests = 0;
        while !lathe.cycle().done {
            let status = lathe.machine.planner.status();
            rests += usize::from(
                status.current_velocity == 0.0 && status.position[2] > 0.1 && !status.done,
            );
            let place = status.position[2] % 20.0;
            if (4.0..6.0).contains(&place) {
                assert!((status.current_velocity - 5.0).abs() < 0.01, "{status:?}");
            } else if (14.0..16.0).contains(&place) {
                assert!((status.current_velocity - 20.0).abs() < 0.1, "{status:?}");
            }
        }
        assert_eq!(rests, 0);
        keeps_limits(lathe.machine);
    });
}

/// The greatest speed, mm/s, along Z from `from` on, of what is queued.
fn fastest_from(lathe: &mut Lathe, from: f64) -> f64 {
    let mut fastest = 0.0_f64;
    let mut last = lathe.machine.planner.status().position;
    while !lathe.cycle().done {
        let position = lathe.machine.planner.status().position;
        if last[2] >= from {
            fastest = fastest.max((position - last).norm() / PERIOD);
        }
        last = position;
    }
    keeps_limits(lathe.machine);
    fastest
}

/// Feed per turn is planned with a reserve for a spindle that becomes faster. From rest, and behind a rapid, the machine had been
/// that fast before it came down.
#[test]
fn feed_per_turn_is_not_exceeded_where_it_begins() {
    let exact = TerminationCondition::Exact;
    let blended = TerminationCondition::Continuous { tolerance: 0.05 };
    for per_turn in [0.2, 1.0, 3.0] {
        for (scale, condition) in [(1.0, exact), (1.0, blended), (0.5, blended), (1.4, blended)] {
            for rapid in [false, true] {
                with_machine(|machine| {
                    let mut lathe = Lathe::new(machine, 10.0);
                    lathe.machine.planner.set_termination(condition);
                    lathe.machine.inputs.feed_scale = scale;
                    let planner = &mut lathe.machine.planner;
                    planner.set_spindle_synchronisation(SPINDLE as i32, 0.0, true);
                    let mut begin = 0.0;
                    if rapid {
                        begin = 20.0;
                        let before = MoveRequest {
                            motion_type: MotionType::Traverse,
                            ..feed_move(100.0)
                        };
                        lathe.machine.line(z(begin), &before).expect("a line");
                    }
                    let planner = &mut lathe.machine.planner;
                    planner.set_spindle_synchronisation(SPINDLE as i32, per_turn, true);
                    for end in [begin + 10.0, begin + 11.0, begin + 20.0] {
                        lathe.machine.line(z(end), &fast()).expect("a line");
                    }
                    let fastest = fastest_from(&mut lathe, begin + 0.06);
                    let share = fastest / (per_turn * 10.0 * scale);
                    assert!(
                        (0.99..1.005).contains(&share),
                        "{per_turn} {scale} {condition:?} {rapid}: {share}"
                    );
                });
            }
        }
    }
}

/// Whatever a spindle is said to turn, what the operator sees is a number.
#[test]
fn what_feed_per_turn_asks_for_is_a_number_whatever_the_spindle_turns() {
    for speed in [f64::NAN, f64::INFINITY, 1e308] {
        with_machine(|machine| {
            machine.inputs.spindles[SPINDLE].speed = speed;
            let planner = &mut machine.planner;
            planner.set_spindle_synchronisation(SPINDLE as i32, 10.0, true);
            machine.line(z(1.0), &fast()).expect("a line");
            for _ in 0..200 {
                let requested = machine.cycle().requested_velocity;
                assert!(requested.is_finite(), "{speed}: {requested}");
            }
        });
    }
}

/// However little or much a turn is to feed, a spindle that stands holds the machine: it is no fault.
#[test]
fn feed_per_turn_of_any_size_waits_for_a_spindle_that_stands() {
    for per_turn in [1e-310, 1e-30, 1e-12, 1e12, 1e300] {
        with_machine(|machine| {
            let mut lathe = Lathe::new(machine, 0.0);
            let planner = &mut lathe.machine.planner;
            planner.set_spindle_synchronisation(SPINDLE as i32, per_turn, true);
            lathe.machine.line(z(10.0), &fast()).expect("a line");
            // Each cycle asserts that there is no fault.
            for _ in 0..600 {
                lathe.cycle();
            }
            let status = lathe.machine.planner.status();
            assert_eq!(
                (status.position, status.done),
                (z(0.0), false),
                "{per_turn}"
            );
        });
    }
}

/// The rapid is run, however the spindle stands behind it, and the machine goes on once that turns.
#[test]
fn feed_per_turn_waits_behind_a_rapid_for_a_spindle_that_stands() {
    for tolerance in [0.0, 0.05] {
        with_machine(|machine| {
            let mut lathe = Lathe::new(machine, 0.0);
            let condition = TerminationCondition::Continuous { tolerance };
            lathe.machine.planner.set_termination(condition);
            let before = MoveRequest {
                motion_type: MotionType::Traverse,
                ..feed_move(100.0)
            };
            lathe.machine.line(z(20.0), &before).expect("a line");
            let planner = &mut lathe.machine.planner;
            planner.set_spindle_synchronisation(SPINDLE as i32, 1.0, true);
            lathe.machine.line(z(30.0), &fast()).expect("a line");
            for _ in 0..3000 {
                lathe.cycle();
            }
            let place = lathe.machine.planner.status().position[2];
            assert!((19.9..20.1).contains(&place), "{tolerance}: {place}");
            assert_eq!(feed_of(&lathe), 0.0);
            lathe.commanded = 10.0;
            lathe.run(3000);
            assert_eq!(lathe.machine.planner.status().position, z(30.0));
            keeps_limits(lathe.machine);
        });
    }
}

#[test]
fn a_thread_runs_in_its_groove_at_every_speed() {
    for (speed, pitch) in [
        (0.5, 2.0),
        (4.0, 1.5),
        (15.0, 1.5),
        (25.0, 3.0),
        (-8.0, 1.0),
        (50.0, 0.25),
    ] {
        with_machine(|machine| {
            let mut lathe = Lathe::new(machine, speed);
            let depth = -12.0 * pitch;
            for _ in 0..2 {
                lathe.thread(depth, pitch);
                lathe
                    .machine
                    .line(z(0.0), &feed_move(90.0))
                    .expect("a line");
                lathe.run(10_000);
            }
            assert_eq!(lathe.errors, []);
            let forth = -speed.signum();
            // From the fourth turn on, until the machine brakes.
            let phases = lathe.phases(4.0 * pitch, 10.0 * pitch, pitch);
            assert!(phases.is_empty());
            let down: Vec<_> = lathe
                .record
                .windows(3)
                .filter(|pair| pair[0].1 < -4.0 * pitch && pair[0].1 > -8.0 * pitch)
                .filter(|pair| {
                    let step = (pair[1].1 - pair[0].1) / PERIOD / pitch;
                    (step + speed.abs()).abs() < 0.02 * speed.abs()
                })
                .map(|pair| pair[0].1 / pitch - forth * pair[2].0)
                .collect();
            let off = off_the_groove(&down) * pitch;
            assert!(off < 5e-5, "{speed} {pitch}: {off} mm off");
            keeps_limits(lathe.machine);
        });
    }
}

#[test]
fn a_thread_without_a_jerk_limit_runs_in_its_groove() {
    crate::common::with_room(|| {
        let mut machine = Machine::new(crate::common::equal_limits(f64::INFINITY));
        let mut lathe = Lathe::new(&mut machine, 12.0);
        lathe.thread(30.0, 1.5);
        assert_eq!(lathe.errors, []);
        assert!(off_the_groove(&lathe.phases(6.0, 28.0, 1.5)) * 1.5 < 1e-3);
        let worst = machine.extremes();
        assert!(
            worst.velocity < 1.001 && worst.acceleration < 1.001,
            "{worst:?}"
        );
    });
}

#[test]
fn a_coarse_encoder_makes_a_smooth_thread() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 8.3);
        lathe.counts = 400.0;
        lathe.thread(30.0, 1.5);
        let steps: Vec<_> = lathe
            .record
            .windows(3)
            .filter(|pair| (8.0..20.0).contains(&pair[0].1))
            .map(|pair| (pair[1].1 - pair[0].1) / PERIOD)
            .collect();
        assert!(spread(&steps) < 0.5, "{}", spread(&steps));
        keeps_limits(lathe.machine);
    });
}

#[test]
fn the_spindle_may_change_its_speed_in_the_thread() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 10.0);
        lathe
            .machine
            .planner
            .set_spindle_synchronisation(SPINDLE as i32, 1.5, false);
        lathe.machine.line(z(90.0), &fast()).expect("a thread");
        let mut changed = [0; 3];
        let mut count = 0;
        while !lathe.cycle().done {
            count += 1;
            let place = lathe.record[lathe.record.len() - 1].1;
            if place > 20.0 && changed[0] == 0 {
                lathe.commanded = 16.0;
                changed[0] = count;
            } else if place > 45.0 && changed[1] == 0 {
                lathe.commanded = 3.0;
                changed[1] = count;
            } else if place > 60.0 && changed[2] == 0 {
                changed[2] = count;
                // Operators' overrides and pause are no matter of a thread.
                lathe.machine.planner.pause();
                lathe.machine.inputs.feed_scale = 0.3;
            }
        }
        let off = off_the_groove(&lathe.phases(5.0, 85.0, 1.5)) * 1.5;
        assert!(off < 0.02, "{off} mm off");
        assert!(off_the_groove(&lathe.phases(12.0, 19.0, 1.5)) * 1.5 < 1e-4);
        assert!(off_the_groove(&lathe.phases(65.0, 85.0, 1.5)) * 1.5 < 1e-4);
        keeps_limits(lathe.machine);
        assert_eq!(lathe.errors, []);
    });
}

#[test]
fn threads_in_sequence_keep_the_count() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 6.0);
        let tolerance = TerminationCondition::Continuous { tolerance: 0.05 };
        lathe.machine.planner.set_termination(tolerance);
        // 10 turns, 12.5 turns of another pitch, and a taper that starts in the middle of a turn.
        let mut taper = z(75.0);
        taper[0] = 10.0;
        let turns = (25.0_f64.hypot(10.0)) / 2.0;
        for (to, pitch) in [(z(20.0), 2.0), (z(50.0), 2.4), (taper, 2.0)] {
            lathe
                .machine
                .planner
                .set_spindle_synchronisation(SPINDLE as i32, pitch, false);
            lathe.machine.line(to, &fast()).expect("a thread");
        }
        lathe.run(100_000);
        assert_eq!(lathe.errors, []);
        let off = |from: f64, to: f64, origin: f64, before: f64, pitch: f64| {
            let pairs = lathe
                .record
                .windows(3)
                .filter(|pair| (from..to).contains(&pair[0].1));
            let phases: Vec<_> = pairs
                .map(|pair| before + (pair[0].1 - origin) / pitch - pair[2].0)
                .collect();
            off_the_groove(&phases) * pitch
        };
        assert!(off(10.0, 19.0, 0.0, 0.0, 2.0) < 1e-4);
        assert!(off(30.0, 49.0, 20.0, 10.0, 2.4) < 1e-4);
        // Along the taper: a turn is 2 mm of path.
        assert!(off(60.0, 70.0, 50.0, 22.5, 25.0 / turns) < 1e-4);
        keeps_limits(lathe.machine);
    });
}

#[test]
fn a_rest_in_a_sequence_waits_for_the_same_groove() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 6.0);
        // G61.1
        for to in [10.0, 31.0] {
            lathe
                .machine
                .planner
                .set_spindle_synchronisation(SPINDLE as i32, 2.0, false);
            lathe.machine.line(z(to), &fast()).expect("a thread");
        }
        lathe.run(100_000);
        assert!(off_the_groove(&lathe.phases(5.0, 9.0, 2.0)) * 2.0 < 1e-4);
        assert!(off_the_groove(&lathe.phases(17.0, 30.0, 2.0)) * 2.0 < 1e-4);
        keeps_limits(lathe.machine);
    });
}

#[test]
fn a_pause_before_the_index_holds_the_thread() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 5.0);
        lathe
            .machine
            .planner
            .set_spindle_synchronisation(SPINDLE as i32, 2.0, false);
        lathe.machine.line(z(30.0), &fast()).expect("a thread");
        for _ in 0..5 {
            lathe.cycle();
        }
        lathe.machine.planner.pause();
        for _ in 0..777 {
            assert_eq!(lathe.cycle().position, z(0.0));
        }
        lathe.machine.planner.resume();
        lathe.run(20_000);
        assert!(off_the_groove(&lathe.phases(10.0, 28.0, 2.0)) * 2.0 < 1e-4);
        keeps_limits(lathe.machine);
    });
}

#[test]
fn a_thread_that_is_held_before_it_begins_takes_a_later_turn() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 6.0);
        lathe
            .machine
            .planner
            .set_spindle_synchronisation(SPINDLE as i32, 1.5, false);
        lathe.machine.line(z(30.0), &fast()).expect("a thread");
        while !lathe.awaits_index {
            lathe.cycle();
        }
        while lathe.awaits_index {
            lathe.cycle();
        }
        // It knows the turn that it would begin with.
        for _ in 0..20 {
            lathe.cycle();
        }
        lathe.machine.planner.pause();
        for _ in 0..900 {
            assert_eq!(lathe.cycle().position, z(0.0));
        }
        lathe.machine.planner.resume();
        lathe.run(100_000);
        assert_eq!(lathe.errors, []);
        assert!(off_the_groove(&lathe.phases(6.0, 28.0, 1.5)) * 1.5 < 1e-3);
        // Nothing has to be made up for.
        let steps = lathe.record.windows(2).map(|pair| pair[1].1 - pair[0].1);
        let fastest = steps.fold(0.0, f64::max) / PERIOD;
        assert!(fastest < 1.05 * 1.5 * 6.0, "{fastest}");
    });
}
