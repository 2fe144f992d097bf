//! The making of a plan, or of the continuation of a plan, a little at a time.
//!
//! A draft is begun with the place where it is to come to rest. It searches for the arcs at rest,
//! places the nodes, sweeps forward and backward, takes the hull, and checks every interval
//! against the rows of all axes. Only then may it replace the plan. Where a step fails, what caused
//! it is changed (a shorter arc, a later first coefficient) and the draft begins again, a bounded
//! number of times.

use super::bounds::Bounds;
use super::context::DraftContext;
use super::cost;
use super::grid::{GROWTH, Grid, GridStep};
use super::refusal::Refusal;
use super::rest_arc::{ArcStep, LASTING, RestArcSearch, free_length};
use super::route::Route;
use super::spline::{CAPACITY, Interval, SampleBanks, Spline};
use super::sweeps::{SweepFault, Sweeps};

/// The share of acceleration and jerk that a plan may take at the three points of each interval.
/// The rest is for what happens in between.
pub(super) const MARGIN: f64 = 0.998;

/// Less than [`MARGIN`], since the polish needs an interior to start from.
const DRAFT_MARGIN: f64 = MARGIN * 0.9999;

/// Shares of [`MARGIN`] that the sweeps hand out, in turn from failure to failure. Lower ones are
/// slower without the polish, and some drafts succeed with one and not with another.
const SWEEP_MARGINS: [f64; 4] = [0.95, 0.985, 0.97, 0.93];

/// Drafts that are tried from one beginning.
const MOST_ATTEMPTS: usize = 9;

/// Intervals that a draft adds at most; a longer one is ended behind three quarters of them.
pub(super) const MOST_INTERVALS: usize = 128;
/// The same where the machine is soon to brake: what is short is found soon.
pub(super) const MOST_URGENT_INTERVALS: usize = 64;

/// How many times its length an interval is away from the rest if that has no influence on it.
const NODES_BEFORE_REST: f64 = 6.0;

/// What has become of a draft.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DraftStep {
    /// The budget is spent.
    More,
    /// It may replace the plan from the coefficient behind its base on.
    Ready,
    /// There is none.
    Refused(Refusal),
}

#[derive(Clone, Copy, Debug)]
enum Phase {
    StartArc(RestArcSearch),
    EndArc(RestArcSearch),
    Grid,
    Bounds(usize),
    Forward(usize),
    Backward(usize),
    Hull(usize),
    Lower(usize),
    Check(usize),
    Finished(DraftStep),
}

/// Why a draft does not work as it is.
#[derive(Clone, Copy, Debug)]
enum Fault {
    /// The coefficients cannot be swept.
    Sweep(SweepFault),
    /// An interval breaks a limit.
    Interval(usize),
}

/// A plan that is being made.
#[derive(Debug)]
pub(super) struct Draft {
    pub spline: Spline,
    /// The last coefficient that is not changed.
    pub base: usize,
    /// The base of the first attempt.
    first_base: usize,
    first: bool,
    cut: usize,
    /// From here on the nodes are placed in the attempt that is under way.
    grid_from: usize,
    /// Whether the bounds of the intervals before that are known.
    bounded: bool,
    most_start: f64,
    most_end: f64,
    attempt: usize,
    margin: f64,
    /// Intervals that it adds at most.
    most: usize,
    /// Cost of an evaluation of the path.
    evaluation: u32,
    phase: Phase,
    grid: Grid,
    sweeps: Sweeps,
}

impl Draft {
    pub const NONE: Self = Self {
        spline: Spline::NONE,
        base: 1,
        first_base: 1,
        first: true,
        cut: 1,
        grid_from: 1,
        bounded: false,
        most_start: 0.0,
        most_end: 0.0,
        attempt: 0,
        margin: 0.95,
        most: MOST_INTERVALS,
        evaluation: 0,
        phase: Phase::Finished(DraftStep::Refused(Refusal::NotFound)),
        grid: Grid::new(),
        sweeps: Sweeps::NONE,
    };

    /// Begins a plan from the rest at `start` to a rest at `end`. `failures` chooses the margin.
    pub fn begin_first<R: Route>(
        &mut self,
        context: &DraftContext<R>,
        start: f64,
        end: f64,
        failures: usize,
    ) {
        self.spline.start = start;
        self.spline.end = end;
        self.evaluation = cost::evaluation(context.kernels_before(end));
        self.first = true;
        self.most = MOST_INTERVALS;
        self.grid.forget();
        self.base = 1;
        self.cut = 1;
        self.grid_from = 1;
        self.attempt = 0;
        self.margin = MARGIN * SWEEP_MARGINS[failures & 3];
        self.most_start = free_length(context.route, start, end - start);
        self.most_end = free_length(context.route, end, end - start);
        self.phase = self.search_start(context);
    }

    /// Begins the continuation of the plan to a rest at `end`; coefficients up to `base` at least
    /// stay as they are. It adds at most `most` intervals. `failures` chooses the margin.
    pub fn begin_extension<R: Route>(
        &mut self,
        context: &DraftContext<R>,
        base: usize,
        end: f64,
        most: usize,
        failures: usize,
    ) {
        let plan = context.plan;
        self.base = base;
        if base + 4 > plan.last {
            self.phase = Phase::Finished(DraftStep::Refused(Refusal::TooLate));
            return;
        }
        self.spline.copy_from(plan, base - 2);
        self.spline.end = end;
        self.evaluation = cost::evaluation(context.kernels_before(end));
        self.first = false;
        self.most = most;
        self.first_base = base;
        self.attempt = 0;
        self.margin = MARGIN * SWEEP_MARGINS[failures & 3];
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
        self.most_end = free_length(context.route, end, total).min(0.3 * total);
        self.phase = self.search_end(context);
    }

    /// Works until it is finished or the budget is spent.
    pub fn advance<R: Route>(
        &mut self,
        context: &DraftContext<R>,
        samples: &mut SampleBanks,
        budget: &mut u32,
    ) -> DraftStep {
        while *budget > 0 {
            let price = match self.phase {
                Phase::StartArc(_) | Phase::EndArc(_) => {
                    cost::REST_ARC + cost::REST_ARC_EVALUATIONS * self.evaluation
                }
                Phase::Grid => cost::NODE + cost::NODE_EVALUATIONS * self.evaluation,
                Phase::Bounds(_) => cost::BOUNDS,
                Phase::Check(_) => cost::CHECK,
                Phase::Finished(step) => return step,
                _ => cost::SWEEP,
            };
            *budget = budget.saturating_sub(price);
            self.phase = self.step(context, samples);
        }
        match self.phase {
            Phase::Finished(step) => step,
            _ => DraftStep::More,
        }
    }

    fn step<R: Route>(&mut self, context: &DraftContext<R>, samples: &mut SampleBanks) -> Phase {
        match self.phase {
            Phase::StartArc(search) => self.step_start_arc(context, search),
            Phase::EndArc(search) => self.step_end_arc(context, samples, search),
            Phase::Grid => self.step_grid(context, samples),
            Phase::Bounds(k) => self.step_bounds(context, samples, k),
            Phase::Forward(k) => self.step_forward(context, k),
            Phase::Backward(k) => self.step_backward(context, k),
            Phase::Hull(k) => self.step_hull(k),
            Phase::Lower(k) => self.step_lower(context, k),
            Phase::Check(k) => self.step_check(context, samples, k),
            Phase::Finished(_) => self.phase,
        }
    }

    fn search_start<R: Route>(&self, context: &DraftContext<R>) -> Phase {
        Phase::StartArc(context.search(self.spline.start, 1.0, self.most_start, LASTING))
    }

    fn search_end<R: Route>(&self, context: &DraftContext<R>) -> Phase {
        let share = context.end_share(self.spline.end);
        Phase::EndArc(context.search(self.spline.end, -1.0, self.most_end, share))
    }

    fn step_start_arc<R: Route>(
        &mut self,
        context: &DraftContext<R>,
        mut search: RestArcSearch,
    ) -> Phase {
        match search.advance(context.rows, context.route) {
            ArcStep::More => Phase::StartArc(search),
            ArcStep::Failed => refused(Refusal::NoRest),
            ArcStep::Found(arc) => {
                self.spline.start_arc = arc;
                self.search_end(context)
            }
        }
    }

    fn step_end_arc<R: Route>(
        &mut self,
        context: &DraftContext<R>,
        samples: &mut SampleBanks,
        mut search: RestArcSearch,
    ) -> Phase {
        match search.advance(context.rows, context.route) {
            ArcStep::More => Phase::EndArc(search),
            ArcStep::Failed => refused(Refusal::NoRest),
            ArcStep::Found(arc) => {
                self.spline.end_arc = arc;
                self.begin_grid(context, samples)
            }
        }
    }

    /// Gives the node at the cut its place and sample, in the bank that the plan does not use.
    fn begin_grid<R: Route>(
        &mut self,
        context: &DraftContext<R>,
        samples: &mut SampleBanks,
    ) -> Phase {
        let from = self.grid_from;
        let bank = context.plan.at(from).bank ^ 1;
        if from > self.cut {
            let Interval { start, length, .. } = *self.spline.at(from);
            let sample = context.rows.sample(context.route, start, length);
            samples.place_mut(&self.spline, from).start = sample;
        } else if self.first {
            let length = self.spline.start_arc.length;
            let start = self.spline.start + length;
            *self.spline.at_mut(0) = Interval {
                start,
                length: GROWTH * length,
                ..Interval::NONE
            };
            *self.spline.at_mut(1) = Interval {
                start,
                bank,
                ..Interval::NONE
            };
            let sample = context.rows.sample(context.route, start, 0.0);
            if !sample.is_sound() {
                return refused(Refusal::Unsound);
            }
            samples.place_mut(&self.spline, 1).start = sample;
        } else {
            let Interval { start, length, .. } = *context.plan.at(from);
            let sample = context.rows.sample(context.route, start, length);
            self.spline.at_mut(from).start = start;
            self.spline.at_mut(from).bank = bank;
            samples.place_mut(&self.spline, from).start = sample;
        }
        self.grid
            .restart(&self.spline, from, context.route, context.raise_squared);
        Phase::Grid
    }

    fn step_grid<R: Route>(
        &mut self,
        context: &DraftContext<R>,
        samples: &mut SampleBanks,
    ) -> Phase {
        let step = self.grid.advance(
            &mut self.spline,
            context.plan,
            samples,
            context.rows,
            context.route,
            context.raise_squared,
            context.oldest,
        );
        match step {
            GridStep::More if self.grid.reached() > self.cut + self.most => self.shorten(context),
            GridStep::More => Phase::Grid,
            GridStep::TooLong => refused(Refusal::TooLong),
            GridStep::Unsound => refused(Refusal::Unsound),
            GridStep::Done if self.first && self.spline.last < 3 => {
                // So short that the arcs leave hardly anything between them.
                self.most_start = 0.35 * self.spline.start_arc.length;
                self.most_end = 0.35 * self.spline.end_arc.length;
                self.grid_from = self.cut;
                self.again().unwrap_or_else(|| self.search_start(context))
            }
            GridStep::Done => {
                if self.first {
                    let length = self.spline.at(1).length;
                    self.spline.at_mut(0).length = length;
                }
                // Bounds of intervals that were kept are known.
                let kept = if self.bounded && self.grid_from > self.cut {
                    self.grid_from - 1
                } else {
                    0
                };
                Phase::Bounds(kept.max(self.base - 1))
            }
        }
    }

    /// Keeps the nodes that the rest at the end has no influence on: where it is approached the
    /// spacing is [`GROWTH`] of the distance from it, however long its arc is. `count` nodes behind
    /// the cut are known.
    fn keep_nodes(&mut self, count: usize) {
        let end = self.spline.end;
        let mut from = self.cut;
        for _ in 0..count {
            let interval = self.spline.at(from);
            let left = end - interval.start - interval.length;
            if interval.near_end || left < NODES_BEFORE_REST * interval.length {
                break;
            }
            from += 1;
        }
        self.grid_from = from;
    }

    /// Intervals that a draft which grew too long is ended behind.
    fn enough(&self) -> usize {
        self.most - self.most / 4
    }

    /// Ends the draft where the grid has come to.
    fn shorten<R: Route>(&mut self, context: &DraftContext<R>) -> Phase {
        if let Some(refused) = self.again() {
            return refused;
        }
        let end = self.spline.at(self.cut + self.enough()).start;
        self.spline.end = end;
        let total = end - self.spline.at(self.cut).start;
        self.most_end = free_length(context.route, end, total);
        self.keep_nodes(self.enough());
        self.bounded = false;
        self.search_end(context)
    }

    fn step_bounds<R: Route>(
        &mut self,
        context: &DraftContext<R>,
        samples: &SampleBanks,
        k: usize,
    ) -> Phase {
        let last = self.spline.last;
        let bounds = if k == 0 || k > last {
            Bounds::NONE
        } else {
            let of_interval = samples.of(&self.spline, k);
            Bounds::of(
                context.rows,
                of_interval,
                context.raise_squared,
                self.margin,
            )
        };
        self.sweeps.bound(k, bounds);
        if k <= last {
            return Phase::Bounds(k + 1);
        }
        self.pin(context.plan)
    }

    /// Sets the two coefficients that the draft starts from, and begins the forward sweep.
    fn pin(&mut self, plan: &Spline) -> Phase {
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

    fn step_forward<R: Route>(&mut self, context: &DraftContext<R>, k: usize) -> Phase {
        if let Err(fault) = self.sweeps.forward(&self.spline, k) {
            return self.repair(context, Fault::Sweep(fault));
        }
        if k < self.spline.last {
            return Phase::Forward(k + 1);
        }
        self.sweeps.begin_backward(&self.spline);
        Phase::Backward(self.spline.last)
    }

    fn step_backward<R: Route>(&mut self, context: &DraftContext<R>, k: usize) -> Phase {
        if k > self.base {
            self.sweeps.backward(&self.spline, k);
            return Phase::Backward(k - 1);
        }
        match self.sweeps.begin_hull(&self.spline) {
            Ok(()) => Phase::Hull(self.base + 1),
            Err(fault) => self.repair(context, Fault::Sweep(fault)),
        }
    }

    fn step_hull(&mut self, k: usize) -> Phase {
        self.sweeps.append(&self.spline, k);
        if k <= self.spline.last {
            Phase::Hull(k + 1)
        } else {
            Phase::Lower(k)
        }
    }

    fn step_lower<R: Route>(&mut self, context: &DraftContext<R>, k: usize) -> Phase {
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

    fn step_check<R: Route>(
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

    /// A coefficient that what comes behind the known end hardly changes any more; 0 if none.
    pub fn settled(&self) -> usize {
        self.sweeps.settled()
    }

    /// The first interval that may differ from the plan.
    pub fn changed(&self) -> usize {
        if self.first { 0 } else { self.first_base }
    }

    /// The mean length of the intervals that were made.
    pub fn added(&self) -> f64 {
        let count = self.spline.last + 1 - self.cut;
        (self.spline.end - self.spline.at(self.cut).start) / count.max(1) as f64
    }

    /// Changes what caused a fault, as long as there are attempts left.
    fn repair<R: Route>(&mut self, context: &DraftContext<R>, fault: Fault) -> Phase {
        let last = self.spline.last;
        let at_start = match fault {
            Fault::Sweep(SweepFault::Base) => true,
            Fault::Sweep(SweepFault::End) => false,
            Fault::Interval(k) if self.first => k < last / 2,
            Fault::Interval(k) => k < self.base + 3,
        };
        if let Some(refused) = self.again() {
            return refused;
        }
        match (at_start, self.first) {
            (false, _) => {
                self.most_end = 0.3 * self.spline.end_arc.length;
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
    fn advance_base<R: Route>(&mut self, context: &DraftContext<R>, fault: Fault) -> Phase {
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
        Phase::Bounds(base - 1)
    }

    /// Counts an attempt; what it ends with if there are no more.
    fn again(&mut self) -> Option<Phase> {
        self.attempt += 1;
        (self.attempt >= MOST_ATTEMPTS).then_some(refused(Refusal::NotFound))
    }
}

fn refused(refusal: Refusal) -> Phase {
    Phase::Finished(DraftStep::Refused(refusal))
}
