//! Moves wait until it is known that the joints stay within their soft limits, and do not jump where they have limits of their own.

use super::error_stop::ErrorStop;
use super::planner::Planner;
use super::range::{Finding, JointRange, JointSolver, Joints};
use crate::moves::Move;

impl Planner {
    /// Chooses whether moves wait until [`Self::check_range`] has looked at them. At rest only.
    pub fn wait_for_range_check(&mut self, wait: bool) {
        self.range_check.set_on(wait);
        if !wait {
            self.queue.release_all();
        }
    }

    /// Looks at more of the queued moves, before each [`cycle`](Self::cycle). `range` are the limits
    /// of the joints now, `machine` the joints that the machine is commanded to be at.
    ///
    /// A move that leaves the range, or that joints with limits cannot follow, stops the motion on the path, before that move, and no move is
    /// taken before the operator's side, or the program's, has aborted too.
    pub fn check_range(
        &mut self,
        range: &JointRange,
        machine: &Joints,
        solver: &mut impl JointSolver,
    ) -> Option<Finding> {
        if !self.range_check.is_on() || self.status.aborting {
            return None;
        }
        // Where no path is under way, the one that begins will have it.
        if !self.reference.is_active() {
            self.blending.take(&self.queue);
        }
        let blending = self.blending;
        let deviation = |queued: &Move| blending.greatest_deviation(queued);
        let finding = self
            .range_check
            .go_on(&mut self.queue, range, machine, deviation, solver);
        if finding.as_ref().is_some_and(Finding::stops) {
            self.stop_for_error(ErrorStop::JointsOnTheWay);
        }
        finding
    }
}
