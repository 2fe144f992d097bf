//! Moves that come one by one, while others run.

use crate::common::{Machine, at, feed_move, with_machine};
use framepath::moves::TerminationCondition;

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
