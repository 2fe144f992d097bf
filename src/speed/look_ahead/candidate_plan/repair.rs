//! What is changed in a candidate that does not work as it is: an arc at rest becomes shorter.
//!
//! Anything else is not worth a remedy. An extension that cannot leave the plan where it wants to is given up: the next
//! one is shorter and leaves it later (`extensions.rs`). A first plan is made over a shorter way (`first_plan.rs`).

use super::super::context::PlanContext;
use super::super::refusal::PlanRefusal;
use super::super::route::Route;
use super::super::sweeps::SweepFault;
use super::{CandidateFault, CandidatePhase, CandidatePlan, refused};

/// Candidates that are tried from one beginning.
const MOST_ATTEMPTS: usize = 12;

/// The length of the next arc, of that before.
const SHORTER: f64 = 0.3;

/// Intervals more that an arc of a third of the length takes.
const INTERVALS_FOR_SHORTER_ARC: usize = 12;

impl CandidatePlan {
    /// Makes the arc shorter that a fault has to do with, as long as there are attempts left.
    pub(super) fn repair<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        fault: CandidateFault,
    ) -> CandidatePhase {
        let last = self.spline.last;
        let at_start = match fault {
            CandidateFault::Sweep(SweepFault::Base | SweepFault::Stall) => true,
            CandidateFault::Sweep(SweepFault::End) => false,
            CandidateFault::Interval(k) => k < self.base + (last - self.base) / 2,
        };
        if at_start && !self.first {
            return refused(PlanRefusal::NotFound);
        }
        if let Some(refused) = self.again() {
            return refused;
        }
        if at_start {
            self.most_start = SHORTER * self.spline.start_arc.length;
            self.grid_from = self.cut;
            return self.search_start(context);
        }
        self.most_end = SHORTER * self.spline.end_arc.length;
        // A shorter arc takes more intervals, not an earlier end.
        self.most = self.most.max(last - self.cut + INTERVALS_FOR_SHORTER_ARC);
        self.keep_nodes(last.saturating_sub(self.cut));
        self.bounded = true;
        self.search_end(context)
    }

    /// Counts an attempt; what it ends with if there are no more.
    pub(super) fn again(&mut self) -> Option<CandidatePhase> {
        self.attempt += 1;
        (self.attempt >= MOST_ATTEMPTS).then_some(refused(PlanRefusal::NotFound))
    }
}
