//! What is changed in a candidate that does not work as it is.
//!
//! An arc at rest becomes shorter where the fault has to do with it. A first plan, which leads from rest to rest, is made
//! slower as a whole where it breaks a limit on the way: what a limit bounds falls with the square or the cube of the speed.
//!
//! An extension has to join the plan, which may be faster where it is left than the more careful bounds of the sweeps allow: then
//! it keeps more of it. Where that mends nothing it is given up: the next one is shorter and leaves the plan earlier
//! (`extensions.rs`).

use super::super::context::PlanContext;
use super::super::refusal::PlanRefusal;
use super::super::route::Route;
use super::super::sweeps::SweepFault;
use super::{CandidateFault, CandidatePhase, CandidatePlan, NODES_TO_CONTINUE, refused};

/// Candidates that are tried from one beginning.
const MOST_ATTEMPTS: usize = 12;

/// The length of the next arc, of that before.
const SHORTER: f64 = 0.3;

/// Intervals more that an arc of a third of the length takes.
const INTERVALS_FOR_SHORTER_ARC: usize = 12;

/// Intervals beside an arc that may break a limit because of it.
const BESIDE_ARC: usize = 12;

/// A first plan that breaks a limit on the way is run at this share of its speed ..
const SLOWER: f64 = 0.8;
/// .. and again, so often at most.
const MOST_SLOWED: usize = 24;

/// What a fault has to do with.
enum Cause {
    ArcAtStart,
    ArcAtEnd,
    /// The candidate as a whole, from rest to rest.
    Speed,
    /// The plan that is to be continued, which is too fast where it is left.
    LeftTooEarly,
    /// The plan that is to be continued.
    Plan,
}

impl CandidatePlan {
    /// Changes what a fault has to do with, as long as there are attempts left.
    pub(super) fn repair<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        fault: CandidateFault,
    ) -> CandidatePhase {
        match self.cause(fault) {
            Cause::Plan => refused(PlanRefusal::NotFound),
            Cause::LeftTooEarly => self.again().unwrap_or_else(|| self.leave_later(context)),
            Cause::Speed => self.slow_down(),
            Cause::ArcAtStart => self.again().unwrap_or_else(|| {
                self.most_start = SHORTER * self.spline.start_arc.length;
                self.grid_from = self.cut;
                self.search_start(context)
            }),
            Cause::ArcAtEnd => self.again().unwrap_or_else(|| {
                let intervals = self.spline.last - self.cut;
                self.most_end = SHORTER * self.spline.end_arc.length;
                // A shorter arc takes more intervals, not an earlier end.
                self.most = self.most.max(intervals + INTERVALS_FOR_SHORTER_ARC);
                self.keep_nodes(intervals);
                self.bounded = true;
                self.search_end(context)
            }),
        }
    }

    fn cause(&self, fault: CandidateFault) -> Cause {
        match fault {
            CandidateFault::Sweep(SweepFault::End) => Cause::ArcAtEnd,
            CandidateFault::Interval(k) if k + BESIDE_ARC >= self.spline.last => Cause::ArcAtEnd,
            CandidateFault::Interval(k) if self.first && k > self.base + BESIDE_ARC => Cause::Speed,
            _ if self.first => Cause::ArcAtStart,
            CandidateFault::Sweep(SweepFault::Base) => Cause::LeftTooEarly,
            _ => Cause::Plan,
        }
    }

    /// Keeps the plan up to where the backward sweep has come down to it.
    fn leave_later<R: Route>(&mut self, context: &PlanContext<R>) -> CandidatePhase {
        let PlanContext { plan, .. } = context;
        match self.sweeps.meeting(plan, self.base, self.cut) {
            Some(base) if base + NODES_TO_CONTINUE <= plan.last => {
                self.base = base;
                self.pin(plan)
            }
            _ => refused(PlanRefusal::NotFound),
        }
    }

    /// Runs all of the candidate, with its arcs, at a share of its speed.
    fn slow_down(&mut self) -> CandidatePhase {
        self.slowed += 1;
        if self.slowed > MOST_SLOWED {
            return refused(PlanRefusal::NotFound);
        }
        for k in 0..=self.spline.last + 1 {
            self.spline.at_mut(k).coefficient *= SLOWER * SLOWER;
        }
        for arc in [&mut self.spline.start_arc, &mut self.spline.end_arc] {
            arc.jerk *= SLOWER * SLOWER * SLOWER;
        }
        CandidatePhase::Check(self.base)
    }

    /// Counts an attempt; what it ends with if there are no more.
    pub(super) fn again(&mut self) -> Option<CandidatePhase> {
        self.attempt += 1;
        (self.attempt >= MOST_ATTEMPTS).then_some(refused(PlanRefusal::NotFound))
    }
}
