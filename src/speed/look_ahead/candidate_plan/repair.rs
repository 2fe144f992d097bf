//! What is changed in a candidate that does not work as it is.

use super::super::context::PlanContext;
use super::super::refusal::PlanRefusal;
use super::super::route::Route;
use super::super::spline::{CAPACITY, Spline};
use super::super::sweeps::SweepFault;
use super::{CandidateFault, CandidatePhase, CandidatePlan, refused};

/// Candidates that are tried from one beginning.
const MOST_ATTEMPTS: usize = 12;

/// Intervals more that an arc of a third of the length takes.
const INTERVALS_FOR_SHORTER_ARC: usize = 12;

/// How often bounds are lowered before something else is tried.
const MOST_LOWERED: usize = 4;

impl CandidatePlan {
    /// Changes what caused a fault, as long as there are attempts left.
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
        if let Some(refused) = self.again() {
            return refused;
        }
        // The arc at the start leaves its first interval no choice.
        let free = |k: usize| !self.first || k > self.base;
        // Brakes or bends down harder than it may: lower bounds do not change that.
        let late = match fault {
            _ if self.first => None,
            CandidateFault::Interval(k) if k <= self.base + 1 => self.last_above(context.plan),
            CandidateFault::Sweep(SweepFault::Base) => self.last_above(context.plan),
            _ => None,
        };
        if let CandidateFault::Interval(k) = fault
            && late.is_none()
            && self.lowered < MOST_LOWERED
            && free(k)
        {
            self.lowered += 1;
            self.sweeps.lower(k);
            return self.pin(context.plan);
        }
        match (at_start, self.first) {
            (false, _) => {
                self.most_end = 0.3 * self.spline.end_arc.length;
                // A shorter arc takes more intervals, not an earlier end.
                self.most = self.most.max(last - self.cut + INTERVALS_FOR_SHORTER_ARC);
                self.keep_nodes(last.saturating_sub(self.cut));
                self.bounded = true;
                self.search_end(context)
            }
            (true, true) => {
                self.most_start = 0.3 * self.spline.start_arc.length;
                self.grid_from = self.cut;
                self.search_start(context)
            }
            (true, false) => self.advance_base(context, late),
        }
    }

    /// The last coefficient behind the base at which the plan is above the backward sweep, if any.
    ///
    /// A plan that passes a slow place below its cap may come to it faster than any that passes it
    /// at the cap: the sweep is not the fastest in all places. There is no leaving the plan before.
    fn last_above(&self, plan: &Spline) -> Option<usize> {
        let mut k = self.kept_end(plan);
        for _ in 0..CAPACITY {
            if k <= self.base + 1 {
                return None;
            }
            if plan.at(k).coefficient >= 0.995 * self.sweeps.backward_value(k) {
                return Some(k);
            }
            k -= 1;
        }
        None
    }

    /// The last coefficient that plan and candidate have both.
    fn kept_end(&self, plan: &Spline) -> usize {
        self.cut.min(plan.last) - 1
    }

    /// Follows the plan a little farther before leaving it: behind coefficient `late`, if there is no
    /// leaving it before.
    fn advance_base<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        late: Option<usize>,
    ) -> CandidatePhase {
        let mut base = self.base + if self.attempt <= 3 { 3 } else { 6 };
        if let Some(above) = late {
            base = (above + 1).max(self.base + 2);
        }
        self.base = base;
        self.lowered = 0;
        if base + 3 > self.cut {
            return self.keep_more(context);
        }
        CandidatePhase::Bounds(base - 1)
    }

    /// Keeps more of the intervals that the plan has for the sake of its rest only: where it is left
    /// so late that the nodes behind cannot be made anew from there.
    fn keep_more<R: Route>(&mut self, context: &PlanContext<R>) -> CandidatePhase {
        let plan = context.plan;
        let cut = self.base + 3;
        if cut > plan.last {
            return refused(PlanRefusal::NotFound);
        }
        for k in self.cut..=cut {
            *self.spline.at_mut(k) = *plan.at(k);
        }
        self.cut = cut;
        self.grid_from = cut;
        self.bounded = false;
        let total = self.spline.end - plan.at(cut).start;
        self.most_end = self.most_end.min(0.3 * total);
        self.search_end(context)
    }

    /// Counts an attempt; what it ends with if there are no more.
    pub(super) fn again(&mut self) -> Option<CandidatePhase> {
        self.attempt += 1;
        (self.attempt >= MOST_ATTEMPTS).then_some(refused(PlanRefusal::NotFound))
    }
}
