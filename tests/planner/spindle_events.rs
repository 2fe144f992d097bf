//! Motion that follows a spindle: taps, locking indexers, and what goes wrong.

use crate::common::lathe::{Lathe, SPINDLE, fast, feed_of, keeps_limits, off_the_groove, z};
use crate::common::{Machine, PERIOD, feed_move, with_machine};
use framepath::moves::TerminationCondition;
use framepath::planner::{AddError, MoveRequest, SpindleError};

/// Starts a long thread, and runs it for a while.
fn in_a_thread(machine: &mut Machine, speed: f64) -> Lathe<'_> {
    let mut lathe = Lathe::new(machine, speed);
    lathe
        .machine
        .planner
        .set_spindle_synchronisation(SPINDLE as i32, 2.0, false);
    lathe.machine.line(z(200.0), &fast()).expect("a thread");
    for _ in 0..1000 {
        lathe.cycle();
    }
    assert!(lathe.machine.planner.status().following_spindle);
    lathe
}

fn tap(lathe: &mut Lathe, depth: f64, pitch: f64, scale: f64) {
    lathe
        .machine
        .planner
        .set_spindle_synchronisation(SPINDLE as i32, pitch, false);
    let end = z(depth);
    lathe
        .machine
        .planner
        .add_rigid_tap(&end, scale, &fast())
        .expect("a tap");
    lathe
        .machine
        .planner
        .set_spindle_synchronisation(SPINDLE as i32, 0.0, false);
}

#[test]
fn a_spindle_may_stand_for_a_while_before_it_turns_back() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 5.0);
        tap(&mut lathe, -16.0, 1.0, 1.0);
        let mut stood = 0;
        for _ in 0..30_000 {
            let wanted = lathe.commanded;
            if lathe.cycle().done {
                break;
            }
            // A contactor that drops out for three seconds.
            if wanted > 0.0 && lathe.commanded < 0.0 || stood > 0 && stood < 3000 {
                stood += 1;
                lathe.commanded = if stood < 3000 { 0.0 } else { -5.0 };
            }
        }
        assert_eq!(lathe.errors, []);
        assert_eq!(lathe.machine.planner.status().position, z(0.0));
        keeps_limits(lathe.machine);
    });
}

#[test]
fn a_spindle_that_stalls_reverses_or_outruns_the_axes_stops_the_motion() {
    for (commanded, acceleration) in [(0.0, 40.0), (0.0, 400.0), (-8.0, 100.0), (60.0, 30.0)] {
        with_machine(|machine| {
            let mut lathe = in_a_thread(machine, 10.0);
            lathe.commanded = commanded;
            lathe.acceleration = acceleration;
            lathe.run(20_000);
            match lathe.errors[..] {
                [SpindleError::Stalled] => assert_eq!(commanded, 0.0),
                [SpindleError::Reversed] => assert!(commanded < 0.0),
                [SpindleError::Outrun { asked, greatest }] => {
                    assert!(commanded == 60.0 && asked > greatest && greatest == 100.0);
                }
                ref other => panic!("{commanded}: {other:?}"),
            }
            keeps_limits(lathe.machine);
            // What the program had in store is refused until the abort that follows.
            let next = lathe.machine.line(z(0.0), &feed_move(50.0));
            assert_eq!(next, Err(AddError::Tripped));
            lathe.machine.planner.abort();
            lathe.run(10);
            lathe.commanded = 0.0;
            lathe
                .machine
                .line(z(0.0), &feed_move(50.0))
                .expect("a line");
            lathe.run(20_000);
            assert_eq!(lathe.machine.planner.status().position, z(0.0));
            keeps_limits(lathe.machine);
        });
    }
}

/// An angle that is no number is one that does not change. Where it comes back, or is set anew, the tool was a whole pitch
/// and more off the groove, as fast as the axis was able to; what an encoder may be off is followed.
#[test]
fn an_angle_that_is_lost_or_jumps_stops_the_thread() {
    let (stalled, jumped) = (SpindleError::Stalled, SpindleError::Jumped);
    for (change, periods, expected) in [
        (f64::NAN, 1000, Some(stalled)),
        (f64::INFINITY, 1000, Some(stalled)),
        (f64::NAN, 200, Some(jumped)),
        (f64::NAN, 3, None),
        (10.0, 1000, Some(jumped)),
        (0.4, 1000, Some(jumped)),
        (-0.4, 1000, Some(jumped)),
        (0.1, 1000, None),
    ] {
        with_machine(|machine| {
            let mut lathe = in_a_thread(machine, 10.0);
            let zero = lathe.zero;
            lathe.zero -= change;
            for n in 0..1000 {
                if n == periods {
                    lathe.zero = zero;
                }
                lathe.cycle();
            }
            let expected: Vec<_> = expected.into_iter().collect();
            assert_eq!(lathe.errors, expected, "{change} {periods}");
            lathe.machine.planner.abort();
            lathe.run(1000);
            keeps_limits(lathe.machine);
        });
    }
}

#[test]
fn a_thread_that_the_axes_cannot_follow_does_not_begin() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 30.0);
        lathe.thread(50.0, 4.0);
        assert!(
            matches!(lathe.errors[..], [SpindleError::Outrun { asked, .. }] if (asked - 120.0).abs() < 0.1)
        );
        assert_eq!(lathe.machine.planner.status().position, z(0.0));
    });
}

#[test]
fn a_spindle_that_stands_or_turns_the_other_way_begins_no_thread() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 0.0);
        lathe.thread(50.0, 1.0);
        assert_eq!(lathe.errors, [SpindleError::NoIndex]);
        assert_eq!(lathe.machine.planner.status().position, z(0.0));
    });
}

#[test]
fn an_index_is_waited_for_as_long_as_the_spindle_needs_for_four_turns() {
    // Below a thousandth of a turn a second the spindle stands.
    for (speed, seconds) in [
        (0.0, 20.0),
        (5e-4, 20.0),
        (0.1, 40.0),
        (0.15, 26.7),
        (2.0, 20.0),
    ] {
        with_machine(|machine| {
            let mut lathe = Lathe::new(machine, speed);
            lathe.has_index = false;
            lathe.thread(50.0, 1.0);
            assert_eq!(lathe.errors, [SpindleError::NoIndex]);
            let waited = lathe.record.len() as f64 * PERIOD;
            assert!(
                (waited - seconds).abs() < 0.03 * seconds,
                "{speed}: {waited} s"
            );
        });
    }
}

#[test]
fn an_abort_in_a_thread_leaves_nothing_behind() {
    with_machine(|machine| {
        let mut lathe = in_a_thread(machine, 10.0);
        lathe.machine.planner.abort();
        lathe.run(1000);
        keeps_limits(lathe.machine);
        let rest = lathe.machine.planner.status().position[2];
        lathe
            .machine
            .line(z(rest + 20.0), &feed_move(40.0))
            .expect("a line");
        for _ in 0..400 {
            let status = lathe.cycle();
            assert!(!status.following_spindle && !status.waiting_for_index);
        }
        assert!((feed_of(&lathe) - 40.0).abs() < 1e-6);
        lathe.run(10_000);
        assert_eq!(lathe.errors, []);
    });
}

#[test]
fn a_tap_follows_the_spindle_down_and_up() {
    for (speed, pitch, scale, acceleration) in [
        (5.0, 1.0, 1.0, 20.0),
        (-5.0, 1.0, 1.0, 20.0),
        (12.0, 1.75, 1.5, 60.0),
        (2.0, 0.5, 2.0, 5.0),
    ] {
        with_machine(|machine| {
            let mut lathe = Lathe::new(machine, speed);
            lathe.acceleration = acceleration;
            tap(&mut lathe, -16.0, pitch, scale);
            lathe.run(60_000);
            assert_eq!(lathe.errors, []);
            assert_eq!(lathe.machine.planner.status().position, z(0.0));
            assert!((lathe.commanded - speed).abs() < 1e-9);
            // In the hole, down, at the bottom and up again.
            let forth = -speed.signum();
            let pairs = lathe.record.windows(3).filter(|pair| pair[0].1 < -8.0);
            let phases: Vec<_> = pairs
                .map(|pair| pair[0].1 / pitch - forth * pair[2].0)
                .collect();
            let off = off_the_groove(&phases) * pitch;
            // Where the spindle begins and ends to accelerate, its acceleration jumps by this much.
            let most = 0.002 + 1.3e-4 * acceleration * pitch;
            assert!(off < most, "{speed} {pitch}: {off} mm off");
            assert!(phases.iter().all(|phase| (phase - phases[0]).abs() < 0.01));
            let lowest = lathe.record.iter().map(|(_, z)| *z).fold(0.0, f64::min);
            assert!(lowest < -16.0 && lowest > -16.0 - 10.0 * pitch);
            keeps_limits(lathe.machine);
        });
    }
}

#[test]
fn an_abort_in_a_tap_leaves_nothing_behind() {
    for cycles in [900, 2500, 4200, 4600, 5600] {
        with_machine(|machine| {
            let mut lathe = Lathe::new(machine, 5.0);
            tap(&mut lathe, -16.0, 1.0, 1.0);
            for _ in 0..cycles {
                lathe.cycle();
            }
            lathe.machine.planner.abort();
            lathe.run(1000);
            let rest = lathe.machine.planner.status().position[2];
            lathe
                .machine
                .line(z(rest + 20.0), &feed_move(40.0))
                .expect("a line");
            lathe.run(5000);
            assert_eq!(lathe.machine.planner.status().position[2], rest + 20.0);
            assert_eq!(lathe.errors, []);
            keeps_limits(lathe.machine);
        });
    }
}

#[test]
fn a_spindle_that_does_not_turn_back_stops_the_tap() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 5.0);
        tap(&mut lathe, -16.0, 1.0, 1.0);
        for _ in 0..20_000 {
            let status = lathe.cycle();
            lathe.commanded = 5.0;
            if status.done {
                break;
            }
        }
        assert_eq!(lathe.errors, [SpindleError::NotReversed]);
        assert!(lathe.machine.planner.status().done);
        keeps_limits(lathe.machine);
    });
}

#[test]
fn a_locking_indexer_is_unlocked_before_and_locked_after_its_move() {
    with_machine(|machine| {
        let indexer = MoveRequest {
            indexer_joint: Some(4),
            ..feed_move(50.0)
        };
        let tolerance = TerminationCondition::Continuous { tolerance: 0.05 };
        machine.planner.set_termination(tolerance);
        for (n, request) in [feed_move(50.0), indexer, feed_move(50.0)]
            .iter()
            .enumerate()
        {
            machine
                .line(z(10.0 * (n + 1) as f64), request)
                .expect("a line");
        }
        let (mut told, mut delay, mut events) = (false, 0, Vec::new());
        for _ in 0..5000 {
            machine.inputs.indexer_unlocked = if delay == 0 { told } else { !told };
            delay = std::cmp::max(delay, 1) - 1;
            let before = machine.planner.status().position[2];
            let status = machine.cycle();
            if let Some((joint, unlock)) = status.indexer {
                assert_eq!(joint, 4);
                if unlock != told {
                    told = unlock;
                    delay = 100;
                    events.push((unlock, status.position[2]));
                }
            }
            let place = status.position[2];
            if machine.inputs.indexer_unlocked {
                assert!((10.0..=20.0).contains(&place));
            } else if place != before {
                assert!(place <= 10.0 || place >= 20.0);
            }
        }
        assert_eq!(events, [(true, 10.0), (false, 20.0)]);
        assert!(machine.planner.status().done);
        assert_eq!(machine.planner.status().position, z(30.0));
        keeps_limits(machine);
    });
}

/// An indexer's lock that does what it is told 50 periods later.
struct Lock {
    told: bool,
    delay: usize,
}

impl Lock {
    fn cycle(&mut self, machine: &mut Machine) {
        machine.inputs.indexer_unlocked = if self.delay == 0 {
            self.told
        } else {
            !self.told
        };
        self.delay = self.delay.saturating_sub(1);
        let status = machine.cycle();
        if let Some((joint, unlock)) = status.indexer {
            assert_eq!(joint, 4);
            if unlock != self.told {
                *self = Self {
                    told: unlock,
                    delay: 50,
                };
            }
        }
    }

    /// Runs until it is told to open for the move behind z 10, which has not begun then.
    fn opens(machine: &mut Machine) -> Self {
        let indexer = MoveRequest {
            indexer_joint: Some(4),
            ..feed_move(50.0)
        };
        for (end, request) in [(10.0, feed_move(50.0)), (20.0, indexer)] {
            machine.line(z(end), &request).expect("a line");
        }
        let mut lock = Self {
            told: false,
            delay: 0,
        };
        for _ in 0..5000 {
            lock.cycle(machine);
            if lock.told {
                assert_eq!(machine.planner.status().position, z(10.0));
                return lock;
            }
        }
        panic!("the indexer is not unlocked");
    }
}

#[test]
fn an_indexer_that_opens_for_a_move_that_does_not_come_is_locked_again() {
    with_machine(|machine| {
        let mut lock = Lock::opens(machine);
        machine.planner.clear();
        for _ in 0..200 {
            lock.cycle(machine);
        }
        assert!(!lock.told && !machine.inputs.indexer_unlocked);
        // The next move waits for the lock only.
        machine.line(z(5.0), &feed_move(50.0)).expect("a line");
        for _ in 0..2000 {
            lock.cycle(machine);
        }
        assert_eq!(machine.planner.status().position, z(5.0));
    });
}

#[test]
fn an_indexer_is_locked_again_where_the_direction_turns() {
    with_machine(|machine| {
        let mut lock = Lock::opens(machine);
        for _ in 0..20 {
            lock.cycle(machine);
        }
        // There is no way back over what was before it.
        machine.planner.run_backwards(true).expect("at rest");
        for _ in 0..200 {
            lock.cycle(machine);
        }
        assert!(!lock.told && !machine.inputs.indexer_unlocked);
        assert_eq!(machine.planner.status().position, z(10.0));
        machine.planner.run_backwards(false).expect("at rest");
        for _ in 0..5000 {
            lock.cycle(machine);
        }
        assert_eq!(machine.planner.status().position, z(20.0));
        assert!(machine.planner.status().done && !lock.told);
        keeps_limits(machine);
    });
}

/// Brings the machine to rest by a pause, and turns its direction.
fn turn(lathe: &mut Lathe, backwards: bool) {
    lathe.machine.planner.pause();
    for _ in 0..1000 {
        lathe.cycle();
    }
    let turned = lathe.machine.planner.run_backwards(backwards);
    turned.expect("at rest");
    lathe.machine.planner.resume();
}

#[test]
fn feed_per_turn_is_run_backwards_as_fast_as_the_spindle_asks_for() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 10.0);
        let tolerance = TerminationCondition::Continuous { tolerance: 0.05 };
        lathe.machine.planner.set_termination(tolerance);
        for (end, per_turn) in [(10.0, 0.0), (30.0, 0.4), (50.0, 0.4)] {
            lathe
                .machine
                .planner
                .set_spindle_synchronisation(SPINDLE as i32, per_turn, true);
            lathe.machine.line(z(end), &fast()).expect("a line");
        }
        while lathe.cycle().position[2] < 49.0 {}
        turn(&mut lathe, true);
        for (speed, scale) in [(10.0, 1.0), (20.0, 1.0), (20.0, 0.5), (0.0, 1.0)] {
            lathe.commanded = speed;
            lathe.machine.inputs.feed_scale = scale;
            for _ in 0..1500 {
                lathe.cycle();
            }
            let (feed, expected) = (feed_of(&lathe), 0.4 * speed * scale);
            assert!(
                (feed - expected).abs() <= 1e-3 * expected,
                "{speed} {scale}"
            );
        }
        // The move before it has a feed per minute.
        lathe.commanded = 10.0;
        while lathe.cycle().position[2] > 6.0 {}
        let feed = feed_of(&lathe);
        assert!((feed - 5.0).abs() < 0.02, "{feed}");
        for _ in 0..3000 {
            lathe.cycle();
        }
        assert_eq!(lathe.machine.planner.status().position, z(0.0));
        turn(&mut lathe, false);
        lathe.run(20_000);
        assert_eq!(lathe.machine.planner.status().position, z(50.0));
        assert_eq!(lathe.errors, []);
        keeps_limits(lathe.machine);
    });
}

#[test]
fn a_reverse_run_ends_at_a_thread() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 10.0);
        for (end, per_turn) in [(10.0, 0.0), (15.0, 0.4), (30.0, 0.0)] {
            lathe
                .machine
                .planner
                .set_spindle_synchronisation(SPINDLE as i32, per_turn, false);
            lathe.machine.line(z(end), &fast()).expect("a line");
        }
        while lathe.cycle().position[2] < 20.0 {}
        turn(&mut lathe, true);
        for _ in 0..2000 {
            lathe.cycle();
        }
        assert_eq!(lathe.machine.planner.status().position, z(15.0));
        turn(&mut lathe, false);
        lathe.run(20_000);
        assert_eq!(lathe.machine.planner.status().position, z(30.0));
    });
}
