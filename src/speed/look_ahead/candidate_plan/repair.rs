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

/// Intervals beside an arc that may break a limit because of it.
const BESIDE_ARC: usize = 12;

/// A rest at an end of a candidate.
enum Rest {
    Start,
    End,
}

impl CandidatePlan {
    /// Makes the arc shorter that a fault has to do with, as long as there are attempts left.
    pub(super) fn repair<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        fault: CandidateFault,
    ) -> CandidatePhase {
        let Some(rest) = self.rest_beside(fault) else {
            return refused(PlanRefusal::NotFound);
        };
        if let Some(refused) = self.again() {
            return refused;
        }
        match rest {
            Rest::Start => {
                self.most_start = SHORTER * self.spline.start_arc.length;
                self.grid_from = self.cut;
                self.search_start(context)
            }
            Rest::End => {
                let intervals = self.spline.last - self.cut;
                self.most_end = SHORTER * self.spline.end_arc.length;
                // A shorter arc takes more intervals, not an earlier end.
                self.most = self.most.max(intervals + INTERVALS_FOR_SHORTER_ARC);
                self.keep_nodes(intervals);
                self.bounded = true;
                self.search_end(context)
            }
        }
    }

    /// The rest whose arc a fault has to do with, if any: an extension does not begin at one.
    fn rest_beside(&self, fault: CandidateFault) -> Option<Rest> {
        let start = self.first.then_some(Rest::Start);
        match fault {
            CandidateFault::Sweep(SweepFault::Base | SweepFault::Stall) => start,
            CandidateFault::Sweep(SweepFault::End) => Some(Rest::End),
            CandidateFault::Interval(k) if k + BESIDE_ARC >= self.spline.last => Some(Rest::End),
            CandidateFault::Interval(_) => start,
        }
    }

    /// Counts an attempt; what it ends with if there are no more.
    pub(super) fn again(&mut self) -> Option<CandidatePhase> {
        self.attempt += 1;
        (self.attempt >= MOST_ATTEMPTS).then_some(refused(PlanRefusal::NotFound))
    }
}
