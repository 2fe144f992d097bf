//! The coefficients of a draft: bounds, sweeps, hull, and the check of every interval.

use super::super::bounds::Bounds;
use super::super::context::DraftContext;
use super::super::route::Route;
use super::super::spline::{SampleBanks, Spline};
use super::{Draft, DraftStep, Fault, MARGIN, Phase};

/// Less than [`MARGIN`], since the polish needs an interior to start from.
const DRAFT_MARGIN: f64 = MARGIN * 0.9999;

impl Draft {
    pub(super) fn step_bounds<R: Route>(
        &mut self,
        context: &DraftContext<R>,
        samples: &SampleBanks,
        k: usize,
    ) -> Phase {
        let last = self.spline.last;
        let bounds = if self.has_samples(k) {
            let of_interval = samples.of(&self.spline, k);
            Bounds::of(
                context.rows,
                of_interval,
                context.raise_squared,
                &self.shares,
            )
        } else {
            Bounds::NONE
        };
        self.sweeps.bound(k, bounds);
        if k <= last {
            return Phase::Bounds(k + 1);
        }
        self.pin(context.plan)
    }

    /// Sets the two coefficients that the draft starts from, and begins the forward sweep.
    pub(super) fn pin(&mut self, plan: &Spline) -> Phase {
        let base = self.base;
        if self.first {
            let length = self.spline.at(base).length;
            let [before, here] = self.spline.start_arc.coefficients(length);
            self.spline.at_mut(base - 1).coefficient = before;
            self.spline.at_mut(base).coefficient = here;
        } else {
            // Coefficients of an attempt before this one are not those of the plan.
            for k in self.first_base..self.cut {
                self.spline.at_mut(k).coefficient = plan.at(k).coefficient;
            }
        }
        self.sweeps.begin_forward(&self.spline, base);
        Phase::Forward(base)
    }

    pub(super) fn step_forward<R: Route>(&mut self, context: &DraftContext<R>, k: usize) -> Phase {
        let kept = if self.first { 0 } else { self.cut };
        if let Err(fault) = self.sweeps.forward(&self.spline, k, kept) {
            return self.repair(context, Fault::Sweep(fault));
        }
        if k < self.spline.last {
            return Phase::Forward(k + 1);
        }
        self.sweeps.begin_backward(&self.spline);
        Phase::Backward(self.spline.last)
    }

    pub(super) fn step_backward<R: Route>(&mut self, context: &DraftContext<R>, k: usize) -> Phase {
        if k > self.base {
            self.sweeps.backward(&self.spline, k);
            return Phase::Backward(k - 1);
        }
        match self.sweeps.begin_hull(&self.spline) {
            Ok(()) => Phase::Hull(self.base + 1),
            Err(fault) => self.repair(context, Fault::Sweep(fault)),
        }
    }

    pub(super) fn step_hull(&mut self, k: usize) -> Phase {
        self.sweeps.append(&self.spline, k);
        if k <= self.spline.last {
            Phase::Hull(k + 1)
        } else {
            Phase::Lower(k)
        }
    }

    pub(super) fn step_lower<R: Route>(&mut self, context: &DraftContext<R>, k: usize) -> Phase {
        if k <= self.base {
            return Phase::Check(self.base);
        }
        match self.sweeps.coefficient(&self.spline, k) {
            Ok(coefficient) => {
                self.spline.at_mut(k).coefficient = coefficient;
                Phase::Lower(k - 1)
            }
            Err(fault) => self.repair(context, Fault::Sweep(fault)),
        }
    }

    pub(super) fn step_check<R: Route>(
        &mut self,
        context: &DraftContext<R>,
        samples: &SampleBanks,
        k: usize,
    ) -> Phase {
        let parabola = self.spline.parabola(k);
        let of_interval = samples.of(&self.spline, k);
        let (rows, raise) = (context.rows, context.raise_squared);
        if !rows.keeps(&parabola, of_interval, raise, DRAFT_MARGIN) {
            return self.repair(context, Fault::Interval(k));
        }
        if k == self.spline.last {
            return Phase::Finished(DraftStep::Ready);
        }
        Phase::Check(k + 1)
    }
}
