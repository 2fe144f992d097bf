//! The coefficients of a candidate: bounds, sweeps, hull, and the check of every interval.

use super::super::bounds::PathBounds;
use super::super::context::PlanContext;
use super::super::route::Route;
use super::super::spline::{SampleBanks, Spline};
use super::{CandidateFault, CandidatePhase, CandidatePlan, CandidateStep, MARGIN, SHARES};

/// Less than [`MARGIN`], since the refinement needs an interior to start from.
const CANDIDATE_MARGIN: f64 = MARGIN * 0.9999;

impl CandidatePlan {
    pub(super) fn step_bounds<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        samples: &SampleBanks,
        k: usize,
    ) -> CandidatePhase {
        let last = self.spline.last;
        let bounds = if self.has_samples(k) {
            let of_interval = samples.of(&self.spline, k);
            PathBounds::of(context.rows, of_interval, context.raise_squared, &SHARES)
        } else {
            PathBounds::NONE
        };
        self.sweeps.bound(k, bounds);
        if k <= last {
            return CandidatePhase::Bounds(k + 1);
        }
        self.pin(context.plan)
    }

    /// Sets the two coefficients that the candidate starts from, and begins the sweeps.
    pub(super) fn pin(&mut self, plan: &Spline) -> CandidatePhase {
        let base = self.base;
        if self.first {
            let length = self.spline.at(base).length;
            let [before, here] = self.spline.start_arc.coefficients(length);
            self.spline.at_mut(base - 1).coefficient = before;
            self.spline.at_mut(base).coefficient = here;
        } else {
            // Coefficients of an attempt before this one are not those of the plan.
            for k in base..self.cut {
                self.spline.at_mut(k).coefficient = plan.at(k).coefficient;
            }
        }
        self.sweeps.begin_forward(&self.spline, base);
        self.sweeps.begin_backward(&self.spline);
        CandidatePhase::Sweeps(base)
    }

    /// A step of both sweeps, `k` of the forward one: neither waits for the other, and a processor works on both at a time.
    pub(super) fn step_sweeps<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        k: usize,
    ) -> CandidatePhase {
        let kept = if self.first { 0 } else { self.cut };
        let forward = self.sweeps.forward(&self.spline, k, kept);
        let back = self.spline.last + self.base - k;
        if back > self.base {
            self.sweeps.backward(&self.spline, back);
        }
        let done = match forward {
            Ok(()) if back > self.base => return CandidatePhase::Sweeps(k + 1),
            Ok(()) => self.sweeps.begin_hull(&self.spline),
            Err(fault) => Err(fault),
        };
        match done {
            Ok(()) => CandidatePhase::Hull(self.base + 1),
            Err(fault) => self.repair(context, CandidateFault::Sweep(fault)),
        }
    }

    pub(super) fn step_hull(&mut self, k: usize) -> CandidatePhase {
        self.sweeps.append(&self.spline, k);
        if k <= self.spline.last {
            CandidatePhase::Hull(k + 1)
        } else {
            CandidatePhase::Lower(k)
        }
    }

    pub(super) fn step_lower<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        k: usize,
    ) -> CandidatePhase {
        if k <= self.base {
            return CandidatePhase::Check(self.base);
        }
        match self.sweeps.coefficient(&self.spline, k) {
            Ok(coefficient) => {
                self.spline.at_mut(k).coefficient = coefficient;
                CandidatePhase::Lower(k - 1)
            }
            Err(fault) => self.repair(context, CandidateFault::Sweep(fault)),
        }
    }

    pub(super) fn step_check<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        samples: &SampleBanks,
        k: usize,
    ) -> CandidatePhase {
        let parabola = self.spline.parabola(k);
        let of_interval = samples.of(&self.spline, k);
        let (rows, raise) = (context.rows, context.raise_squared);
        if !rows.keeps(&parabola, of_interval, raise, CANDIDATE_MARGIN) {
            return self.repair(context, CandidateFault::Interval(k));
        }
        if k == self.spline.last {
            return CandidatePhase::Finished(CandidateStep::Ready);
        }
        CandidatePhase::Check(k + 1)
    }
}
