//! What is changed in a draft that does not work as it is.

use super::super::context::DraftContext;
use super::super::refusal::Refusal;
use super::super::route::Route;
use super::super::spline::CAPACITY;
use super::super::sweeps::SweepFault;
use super::{Draft, Fault, Phase, refused};

/// Drafts that are tried from one beginning.
const MOST_ATTEMPTS: usize = 12;

/// Intervals more that an arc of a third of the length takes.
const INTERVALS_FOR_SHORTER_ARC: usize = 12;

/// How often bounds are lowered before something else is tried.
const MOST_LOWERED: usize = 4;

impl Draft {
    /// Changes what caused a fault, as long as there are attempts left.
    pub(super) fn repair<R: Route>(&mut self, context: &DraftContext<R>, fault: Fault) -> Phase {
        let last = self.spline.last;
        let at_start = match fault {
            Fault::Sweep(SweepFault::Base) => true,
            Fault::Sweep(SweepFault::End) => false,
            Fault::Interval(k) => k < self.base + (last - self.base) / 2,
        };
        if let Some(refused) = self.again() {
            return refused;
        }
        // The arc at the start leaves its first interval no choice.
        let free = |k: usize| !self.first || k > self.base;
        if let Fault::Interval(k) = fault
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
            (true, false) => self.advance_base(context, fault),
        }
    }

    /// Follows the plan a little farther before leaving it.
    pub(super) fn advance_base<R: Route>(
        &mut self,
        context: &DraftContext<R>,
        fault: Fault,
    ) -> Phase {
        let mut base = self.base + if self.attempt <= 3 { 3 } else { 6 };
        if let Fault::Sweep(SweepFault::Base) = fault {
            // Where the plan brakes harder than the sweep would, there is no leaving it.
            base = self.base + 1;
            for _ in 0..CAPACITY {
                let planned = context.plan.at(base).coefficient;
                if base + 3 >= self.cut || planned < 0.995 * self.sweeps.backward_value(base) {
                    break;
                }
                base += 1;
            }
            base = base.max(self.base + 2);
        }
        if base + 3 > self.cut {
            return refused(Refusal::NotFound);
        }
        self.base = base;
        self.lowered = 0;
        Phase::Bounds(base - 1)
    }

    /// Counts an attempt; what it ends with if there are no more.
    pub(super) fn again(&mut self) -> Option<Phase> {
        self.attempt += 1;
        (self.attempt >= MOST_ATTEMPTS).then_some(refused(Refusal::NotFound))
    }
}
