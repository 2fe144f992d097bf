//! Moves that come one by one, while others run.

use crate::common::{at, feed_move, with_machine};
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
