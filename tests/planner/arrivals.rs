//! Moves that come one by one, while others run.

use crate::common::{Machine, at, feed_move, with_machine};
use framepath::axes::Axes;
use framepath::moves::TerminationCondition;
use framepath::planner::MoveRequest;

/// A corner between long lines, wherever it is, does not wait for the line behind the next one: the path ended there instead.
#[test]
fn long_lines_that_come_one_by_one_are_run_without_a_rest() {
    for bend in [0.001, 0.1, 1.0] {
        with_machine(move |machine| {
            let tolerance = TerminationCondition::Continuous { tolerance: 0.05 };
            machine.planner.set_termination(tolerance);
            let mut ends = [at(100.0, 0.0), at(200.0, bend), at(300.0, 0.0)].into_iter();
            let mut slowest = f64::INFINITY;
            for cycle in 0..4000 {
                if cycle % 450 == 0
                    && let Some(end) = ends.next()
                {
                    machine.line(end, &feed_move(100.0)).expect("a line");
                }
                let status = machine.cycle();
                if (20.0..280.0).contains(&status.position[0]) {
                    slowest = slowest.min(status.current_velocity);
                }
            }
            assert_eq!(machine.planner.status().position, at(300.0, 0.0));
            assert!(slowest > 80.0, "{bend}: {slowest}");
        });
    }
}

/// Cycles until the machine is at the end of lines along X, each with the termination condition and the cycle with which it comes.
fn cycles(machine: &mut Machine, lines: &[(f64, TerminationCondition, usize)]) -> usize {
    let mut lines = lines.iter();
    let mut next = lines.next();
    let mut last = 0.0;
    for cycle in 0.. {
        while let Some(&(x, condition, _)) = next.filter(|(_, _, comes)| *comes <= cycle) {
            machine.planner.set_termination(condition);
            machine.line(at(x, 0.0), &feed_move(100.0)).expect("a line");
            (last, next) = (x, lines.next());
        }
        let status = machine.cycle();
        if next.is_none() && status.done && status.position == at(last, 0.0) {
            return cycle;
        }
    }
    unreachable!()
}

/// Behind a rest that the machine is still on its way to, along a line that stands alone or along several, the path ended after
/// 8 ms without a move: a rest more.
#[test]
fn what_comes_before_the_machine_rests_is_run_as_if_it_had_been_there() {
    let blended = TerminationCondition::Continuous { tolerance: 0.05 };
    let to_rest = (30.0, TerminationCondition::Stop, 0);
    for before in [&[to_rest][..], &[(20.0, blended, 0), to_rest]] {
        let taken = [0, 60, 150].map(|comes| {
            let mut taken = 0;
            with_machine(|machine| {
                let behind = [
                    (35.0, blended, 0),
                    (40.0, blended, 1),
                    (60.0, blended, comes),
                ];
                taken = cycles(machine, &[before, &behind].concat());
            });
            taken
        });
        let later = taken.iter().any(|&cycles| cycles > taken[0] + 2);
        assert!(!later, "{before:?}: {taken:?}");
    }
}

/// A machine that had just begun with a long line: the path ended there, for good, and what came 12 ms later was a run of its own.
#[test]
fn a_move_that_comes_late_is_passed_on_to_without_a_rest() {
    for (length, speed) in [(5.0, 20.0), (10.0, 20.0), (15.0, 50.0), (60.0, 100.0)] {
        let [in_time, late] = [1, 12].map(|comes| {
            let mut periods = 0;
            with_machine(|machine| {
                let tolerance = TerminationCondition::Continuous { tolerance: 0.05 };
                machine.planner.set_termination(tolerance);
                let mut ends = [
                    at(length, 0.0),
                    at(1.9 * length, 0.4 * length),
                    at(3.0 * length, 0.4 * length),
                ]
                .into_iter();
                for cycle in 0..20_000 {
                    if cycle == 0 || cycle >= comes {
                        for end in ends.by_ref().take(1) {
                            machine.line(end, &feed_move(speed)).expect("a line");
                        }
                    }
                    if machine.cycle().done && cycle > comes + 2 {
                        periods = cycle;
                        break;
                    }
                }
            });
            periods
        });
        assert!(
            late <= in_time + 2 + in_time / 100,
            "{length} mm: {late} periods, {in_time} if it is in time"
        );
    }
}

/// What holds a machine that stands.
#[derive(Clone, Copy, Debug)]
enum HeldBy {
    Overrides,
    FeedHold,
    Pause,
    Spindle,
}

impl HeldBy {
    const ALL: [Self; 4] = [Self::Overrides, Self::FeedHold, Self::Pause, Self::Spindle];

    fn set(self, machine: &mut Machine, held: bool) {
        let scale = if held { 0.0 } else { 1.0 };
        match (self, held) {
            (Self::Overrides, _) => {
                machine.inputs.feed_scale = scale;
                machine.inputs.rapid_scale = scale;
            }
            (Self::Pause, true) => machine.planner.pause(),
            (Self::Pause, false) => machine.planner.resume(),
            (Self::Spindle, held) => machine.inputs.spindles_at_speed = !held,
            (Self::FeedHold, _) => {}
        }
    }

    fn cycle(self, machine: &mut Machine) {
        match self {
            Self::FeedHold => machine.scaled_cycle(0.0),
            _ => machine.cycle(),
        };
    }
}

/// The slowest speed, mm/s, between two places of lines that are run at 100 mm/s, of which one comes late, while the machine
/// is held.
fn slowest_of(
    hold: HeldBy,
    machine: &mut Machine,
    ends: &[Axes],
    late: (usize, usize),
    between: core::ops::Range<f64>,
) -> f64 {
    for (n, end) in ends.iter().enumerate() {
        for _ in 0..if n == late.0 { late.1 } else { 1 } {
            hold.cycle(machine);
        }
        let request = MoveRequest {
            wait_for_spindle: n == 0 && matches!(hold, HeldBy::Spindle),
            ..feed_move(100.0)
        };
        machine.line(*end, &request).expect("a line");
        hold.set(machine, true);
    }
    hold.cycle(machine);
    assert_eq!(machine.planner.status().position, Axes::zeros(), "{hold:?}");
    hold.set(machine, false);
    let mut slowest = f64::INFINITY;
    while !machine.cycle().done {
        let status = machine.planner.status();
        if between.contains(&status.position[0]) {
            slowest = slowest.min(status.current_velocity);
        }
    }
    slowest
}

/// A host that is busy for a moment while the machine is held: the path had ended there after 8 ms, and the machine rested.
#[test]
fn what_comes_while_the_machine_is_held_is_run_as_if_it_had_been_there() {
    let long = [at(20.0, 0.0), at(40.0, 1.0), at(60.0, 0.0), at(80.0, 0.0)];
    let dense: Vec<Axes> = (1..=200)
        .map(|n| 0.02 * f64::from(n))
        .map(|turn| at(10.0 * turn, 8.0 * (1.0 - turn.cos())))
        .collect();
    for hold in HeldBy::ALL {
        for late in [(1, 12), (1, 100), (2, 30), (2, 2000), (3, 20)] {
            with_machine(|machine| {
                let tolerance = TerminationCondition::Continuous { tolerance: 0.5 };
                machine.planner.set_termination(tolerance);
                let slowest = slowest_of(hold, machine, &long, late, 15.0..70.0);
                assert!(slowest > 40.0, "{hold:?} {late:?}: {slowest}");
            });
        }
        for late in [(60, 12), (60, 1000)] {
            with_machine(|machine| {
                let tolerance = TerminationCondition::Continuous { tolerance: 0.02 };
                machine.planner.set_termination(tolerance);
                let slowest = slowest_of(hold, machine, &dense, late, 10.0..32.0);
                assert!(slowest > 80.0, "{hold:?} {late:?}: {slowest}");
            });
        }
    }
}

/// Once it goes on it begins as soon as there is a plan, without another wait for more.
#[test]
fn a_machine_that_was_held_for_long_begins_at_once() {
    for lines in [1, 2, 40] {
        with_machine(|machine| {
            let tolerance = TerminationCondition::Continuous { tolerance: 0.5 };
            machine.planner.set_termination(tolerance);
            HeldBy::Overrides.set(machine, true);
            for x in (1..=lines).map(f64::from) {
                let end = at(x, 0.01 * x * x);
                machine.line(end, &feed_move(50.0)).expect("a line");
            }
            for _ in 0..2000 {
                machine.cycle();
            }
            HeldBy::Overrides.set(machine, false);
            let stands = |machine: &mut Machine| machine.cycle().position == Axes::zeros();
            let cycles = (0..20).take_while(|_| stands(machine)).count();
            assert!(cycles <= 4, "{lines} lines: {cycles}");
        });
    }
}

/// As dashes between M3 and M5, or holes with dwells: another one is waited for before each of the first, not of those behind them,
/// until two come together.
#[test]
fn moves_that_come_one_by_one_at_rest_begin_at_once() {
    with_machine(|machine| {
        let tolerance = TerminationCondition::Continuous { tolerance: 0.05 };
        machine.planner.set_termination(tolerance);
        let mut x = 0.0;
        let mut standing = |machine: &mut Machine, lines: usize| {
            let from = machine.planner.status().position;
            for _ in 0..lines {
                x += 1.0;
                machine
                    .line(at(x, 0.01 * x * x), &feed_move(50.0))
                    .expect("a line");
            }
            let stands = |machine: &mut Machine| machine.cycle().position == from;
            let cycles = (0..30).take_while(|_| stands(machine)).count();
            machine.run(1000);
            cycles
        };
        let alone = [(); 8].map(|()| standing(machine, 1));
        assert!(alone[..3].iter().all(|cycles| *cycles > 6), "{alone:?}");
        assert!(alone[4..].iter().all(|cycles| *cycles <= 5), "{alone:?}");
        standing(machine, 2);
        assert!(standing(machine, 1) > 6);
    });
}

/// However much of the path is still open when the operator aborts.
#[test]
fn an_abort_while_the_machine_is_held_leaves_nothing_behind() {
    for lines in [1, 3, 40] {
        for held in HeldBy::ALL {
            with_machine(|machine| {
                let tolerance = TerminationCondition::Continuous { tolerance: 0.5 };
                machine.planner.set_termination(tolerance);
                for x in (1..=lines).map(f64::from) {
                    let request = MoveRequest {
                        wait_for_spindle: x == 1.0 && matches!(held, HeldBy::Spindle),
                        ..feed_move(50.0)
                    };
                    machine.line(at(x, 0.01 * x * x), &request).expect("a line");
                    held.set(machine, true);
                }
                (0..100).for_each(|_| held.cycle(machine));
                machine.planner.abort();
                (0..4).for_each(|_| held.cycle(machine));
                let status = machine.planner.status();
                assert!(status.done && !status.aborting, "{held:?} {lines}");
                assert_eq!(status.position, Axes::zeros());
                held.set(machine, false);
                machine
                    .line(at(5.0, 5.0), &feed_move(50.0))
                    .expect("a line");
                machine.run(1000);
                assert_eq!(machine.planner.status().position, at(5.0, 5.0));
            });
        }
    }
}
