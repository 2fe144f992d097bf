//! The making of a plan, or of the continuation of a plan, a little at a time.
//!
//! A candidate is begun with the place where it is to come to rest. It searches for the arcs at rest,
//! places the nodes, sweeps forward and backward, takes the hull, and checks every interval
//! against the rows of all axes. Only then may it replace the plan. Where a step fails, the arc that has
//! to do with it becomes shorter and the candidate begins again, a bounded number of times.

mod coefficients;
mod nodes;
mod repair;

use super::bounds::Shares;
use super::context::PlanContext;
use super::cost;
use super::grid::Grid;
use super::refusal::PlanRefusal;
use super::rest_arc::free_length;
use super::rest_arc_search::RestArcSearch;
use super::route::Route;
use super::sample::MovingAxes;
use super::spline::{CAPACITY, SampleBanks, Spline};
use super::sweeps::{SweepFault, Sweeps};

/// The share of acceleration and jerk that a plan may take at the three points of each interval.
/// The rest is for what happens in between.
pub(super) const MARGIN: f64 = 0.998;

/// What the sweeps hand out: less than [`MARGIN`], since the rows of all axes together are looked at afterwards, and
/// in curves what leaves room for a continuation.
const SHARES: Shares = Shares {
    margin: 0.95 * MARGIN,
    curve: 0.6,
    twist: 0.6,
    across: 0.25,
};

/// Intervals that a candidate adds at most; a longer one is ended behind three quarters of them.
pub(super) const MOST_INTERVALS: usize = 180;
/// The same where the machine is soon to brake: what is short is found soon.
pub(super) const MOST_URGENT_INTERVALS: usize = 90;

/// Nodes of the plan behind the one where a candidate leaves it, at least.
pub(super) const NODES_TO_CONTINUE: usize = 4;

/// What has become of a candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CandidateStep {
    /// The budget is spent.
    More,
    /// It may replace the plan from the coefficient behind its base on.
    Ready,
    /// There is none.
    Refused(PlanRefusal),
}

#[derive(Clone, Copy, Debug)]
enum CandidatePhase {
    StartArc(RestArcSearch),
    EndArc(RestArcSearch),
    Grid,
    Bounds(usize),
    Sweeps(usize),
    Hull(usize),
    Lower(usize),
    Check(usize),
    Finished(CandidateStep),
}

/// Why a candidate does not work as it is.
#[derive(Clone, Copy, Debug)]
enum CandidateFault {
    /// The coefficients cannot be swept.
    Sweep(SweepFault),
    /// An interval breaks a limit.
    Interval(usize),
}

/// A plan that is being made.
#[derive(Debug)]
pub(super) struct CandidatePlan {
    pub spline: Spline,
    /// The last coefficient that is not changed.
    pub base: usize,
    first: bool,
    cut: usize,
    /// From here on the nodes are placed in the attempt that is under way.
    grid_from: usize,
    /// Whether the bounds of the intervals before that are known.
    bounded: bool,
    most_start: f64,
    most_end: f64,
    attempt: usize,
    /// How often it was made slower.
    slowed: usize,
    /// Intervals that it adds at most ..
    most: usize,
    /// .. and those that it is ended behind if it grew longer.
    enough: usize,
    /// Cost of an evaluation of the path.
    evaluation: u32,
    phase: CandidatePhase,
    grid: Grid,
    sweeps: Sweeps,
}

impl CandidatePlan {
    pub const NONE: Self = Self {
        spline: Spline::NONE,
        base: 1,
        first: true,
        cut: 1,
        grid_from: 1,
        bounded: false,
        most_start: 0.0,
        most_end: 0.0,
        attempt: 0,
        slowed: 0,
        most: MOST_INTERVALS,
        enough: enough(MOST_INTERVALS),
        evaluation: 0,
        phase: CandidatePhase::Finished(CandidateStep::Refused(PlanRefusal::NotFound)),
        grid: Grid::new(),
        sweeps: Sweeps::NONE,
    };

    /// Begins a plan from the rest at `start` to a rest at `end`.
    pub fn begin_first<R: Route>(&mut self, context: &PlanContext<R>, start: f64, end: f64) {
        self.spline.start = start;
        self.spline.end = end;
        self.evaluation = context.evaluation(end);
        self.first = true;
        self.most = MOST_INTERVALS;
        self.enough = enough(self.most);
        self.grid.forget();
        self.base = 1;
        self.cut = 1;
        self.grid_from = 1;
        self.attempt = 0;
        self.slowed = 0;
        self.most_start = free_length(context.route, start, end - start);
        self.most_end = free_length(context.route, end, end - start);
        self.phase = self.search_start(context);
    }

    /// Begins the continuation of the plan to a rest at `end`; coefficients up to `base` at least
    /// stay as they are. It adds at most `most` intervals.
    pub fn begin_extension<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        base: usize,
        end: f64,
        most: usize,
    ) {
        let plan = context.plan;
        self.base = base;
        if base + NODES_TO_CONTINUE > plan.last {
            self.phase = CandidatePhase::Finished(CandidateStep::Refused(PlanRefusal::TooLate));
            return;
        }
        self.spline.copy_from(plan, base - 2);
        self.spline.end = end;
        self.evaluation = context.evaluation(end);
        self.first = false;
        self.most = most;
        self.enough = enough(self.most);
        self.attempt = 0;
        // Intervals that are short only for the old rest are made anew.
        let mut cut = plan.last;
        for _ in 0..CAPACITY {
            if cut <= base + 2 || !plan.at(cut - 1).near_end {
                break;
            }
            cut -= 1;
        }
        self.cut = cut;
        self.grid_from = cut;
        let total = end - plan.at(cut).start;
        self.most_end = free_length(context.route, end, total);
        self.phase = self.search_end(context);
    }

    /// Works until it is finished or the budget is spent.
    pub fn advance<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        samples: &mut SampleBanks,
        budget: &mut u32,
    ) -> CandidateStep {
        while *budget > 0 {
            let price = match self.phase {
                CandidatePhase::StartArc(_) | CandidatePhase::EndArc(_) => {
                    cost::REST_ARC + cost::REST_ARC_EVALUATIONS * self.evaluation
                }
                // Not known before.
                CandidatePhase::Grid => 0,
                CandidatePhase::Bounds(k) => cost::bounds(self.axes(samples, k)),
                CandidatePhase::Sweeps(_) => cost::SWEEPS,
                CandidatePhase::Check(_) => cost::CHECK,
                CandidatePhase::Finished(step) => return step,
                _ => cost::SWEEP,
            };
            *budget = budget.saturating_sub(price);
            let is_grid = matches!(self.phase, CandidatePhase::Grid);
            context.route.take_looks();
            self.phase = self.step(context, samples);
            if is_grid {
                let price = cost::node(context.route.take_looks(), self.evaluation);
                *budget = budget.saturating_sub(price);
            }
        }
        match self.phase {
            CandidatePhase::Finished(step) => step,
            _ => CandidateStep::More,
        }
    }

    /// How many axes move in interval k.
    fn axes(&self, samples: &SampleBanks, k: usize) -> u32 {
        if self.has_samples(k) {
            MovingAxes::at_any(samples.of(&self.spline, k).places()).count()
        } else {
            0
        }
    }

    /// Whether k is an interval of the candidate: beside the ends there is what an earlier plan left.
    fn has_samples(&self, k: usize) -> bool {
        0 < k && k <= self.spline.last
    }

    fn step<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        samples: &mut SampleBanks,
    ) -> CandidatePhase {
        match self.phase {
            CandidatePhase::StartArc(search) => self.step_start_arc(context, search),
            CandidatePhase::EndArc(search) => self.step_end_arc(context, samples, search),
            CandidatePhase::Grid => self.step_grid(context, samples),
            CandidatePhase::Bounds(k) => self.step_bounds(context, samples, k),
            CandidatePhase::Sweeps(k) => self.step_sweeps(context, k),
            CandidatePhase::Hull(k) => self.step_hull(k),
            CandidatePhase::Lower(k) => self.step_lower(context, k),
            CandidatePhase::Check(k) => self.step_check(context, samples, k),
            CandidatePhase::Finished(_) => self.phase,
        }
    }

    /// A coefficient that what comes behind the known end hardly changes any more; 0 if none.
    pub fn settled(&self) -> usize {
        self.sweeps.settled()
    }

    /// The first interval that may differ from the plan.
    pub fn changed(&self) -> usize {
        if self.first { 0 } else { self.base }
    }

    /// The mean length of the intervals that were made.
    pub fn added(&self) -> f64 {
        let count = self.spline.last + 1 - self.cut;
        (self.spline.end - self.spline.at(self.cut).start) / count.max(1) as f64
    }
}

/// Intervals that a candidate which came to be longer than `most` is ended behind: the others lead to its rest.
const fn enough(most: usize) -> usize {
    most - most / 4
}

fn refused(refusal: PlanRefusal) -> CandidatePhase {
    CandidatePhase::Finished(CandidateStep::Refused(refusal))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_room::with_room;
    use std::boxed::Box;

    #[test]
    fn what_a_plan_before_this_one_left_costs_nothing() {
        with_room(|| {
            let (mut candidate, mut samples) =
                (Box::new(CandidatePlan::NONE), Box::new(SampleBanks::NONE));
            candidate.spline.last = 3;
            for k in 0..6 {
                samples.place_mut(&candidate.spline, k).middle.axes.add(k);
            }
            let axes: [u32; 6] = std::array::from_fn(|k| candidate.axes(&samples, k));
            assert_eq!(axes, [0, 1, 1, 1, 0, 0]);
        });
    }
}
