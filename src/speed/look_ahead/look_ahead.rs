//! The planner: what is worked on next, and what the executor takes.

use super::candidate_plan::{self, CandidatePlan, CandidateStep};
use super::context::PlanContext;
use super::cost;
use super::counted_route::CountedRoute;
use super::extensions::Extensions;
use super::final_braking::FinalBraking;
use super::first_plan::FirstPlan;
use super::frozen::Frozen;
use super::newton::NewtonStep;
use super::plan_time::{PlanEnd, PlanTime};
use super::planned_segment::PlannedSegment;
use super::refinement_pace::RefinementPace;
use super::refusal::PlanRefusal;
use super::route::Route;
use super::rows::AxisRows;
use super::spline::{CAPACITY, SampleBanks, Spline};
use super::work::Work;
use crate::axes::AxisLimits;
use crate::machine_map::MachineMap;

/// Intervals ahead of the machine beyond which the plan is not extended: room is left for one
/// extension.
const HORIZON: usize = CAPACITY - candidate_plan::MOST_INTERVALS - 16;

/// Seconds to the final braking, below which an extension comes before the refinement.
const URGENT: f64 = 0.1;

/// The weight that the barrier goes back to where caps were raised.
const RAISED_BARRIER: f64 = 0.05;

/// How a planner stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlanProgress {
    /// [`LookAhead::start`] has not been called.
    Idle,
    /// The path known so far is too short, or the first plan is not finished.
    Starting,
    /// There is a plan that keeps all limits and ends at rest.
    Ready,
    /// No first plan was found.
    Refused(PlanRefusal),
}

/// The speed reference of one run from rest to rest along a [`Route`].
///
/// Memory is of fixed size (about 0.6 MB), work is done in slices.
#[derive(Debug)]
pub struct LookAhead {
    rows: AxisRows,
    plan: Spline,
    samples: SampleBanks,
    candidate: CandidatePlan,
    newton: NewtonStep,
    progress: PlanProgress,
    work: Work,
    frozen: Frozen,
    braking: FinalBraking,
    time: PlanTime,
    refinement: RefinementPace,
    first_plan: FirstPlan,
    extensions: Extensions,
    /// What the program's speeds are multiplied by.
    raise: f64,
}

impl LookAhead {
    /// A planner without anything to do.
    pub const fn new() -> Self {
        Self {
            rows: AxisRows::NONE,
            plan: Spline::NONE,
            samples: SampleBanks::NONE,
            candidate: CandidatePlan::NONE,
            newton: NewtonStep::NONE,
            progress: PlanProgress::Idle,
            work: Work::Nothing,
            frozen: Frozen::NOTHING,
            braking: FinalBraking::AT_REST,
            time: PlanTime::NONE,
            refinement: RefinementPace::AT_REST,
            first_plan: FirstPlan::NONE,
            extensions: Extensions::NONE,
            raise: 1.0,
        }
    }

    /// Forgets everything and begins at rest at `s`. `period` of the servo thread in seconds.
    pub fn start(&mut self, s: f64, limits: &AxisLimits, map: &MachineMap, period: f64) {
        self.rows = AxisRows::new(limits, map, period);
        self.plan.last = 0;
        self.plan.start = s;
        self.plan.end = s;
        self.progress = PlanProgress::Starting;
        self.work = Work::Nothing;
        self.frozen = Frozen::NOTHING;
        self.braking = FinalBraking::AT_REST;
        self.time.begin();
        self.refinement = RefinementPace::AT_REST;
        self.first_plan = FirstPlan::NONE;
        self.extensions = Extensions::NONE;
        self.raise = 1.0;
    }

    /// Whether there is a plan.
    pub fn progress(&self) -> PlanProgress {
        self.progress
    }

    /// Whether the first plan waits for more of the path.
    pub fn waits_for_path(&self) -> bool {
        self.progress == PlanProgress::Starting && self.work == Work::Nothing
    }

    /// Where the plan comes to rest, as s.
    pub fn end(&self) -> f64 {
        self.plan.end
    }

    /// Seconds of the plan that are frozen.
    pub fn frozen_time(&self) -> f64 {
        self.frozen.time()
    }

    /// Goes on with the sum of how long the plan takes. Once in each servo period.
    pub fn sum_time(&mut self) {
        if self.progress == PlanProgress::Ready {
            self.time.pass(&self.plan, &self.frozen);
        }
    }

    /// Where the plan comes to rest, as it was summed last; `None` before that.
    pub fn planned_end(&self) -> Option<PlanEnd> {
        self.time.end()
    }

    /// Whether the whole plan is frozen: the reference ends at rest.
    pub fn is_frozen(&self) -> bool {
        self.progress == PlanProgress::Ready && self.frozen.is_whole(&self.plan)
    }

    /// Whether the final braking begins less than `seconds` behind the frozen part. A path whose end is still open has to be ended then.
    pub fn brakes_within(&self, seconds: f64) -> bool {
        self.braking.begins_within(&self.plan, seconds)
    }

    /// The next segment, which stays as it is from now on. `None` if there is no plan, or the
    /// reference has ended at rest.
    pub fn freeze(&mut self) -> Option<PlannedSegment> {
        if self.progress != PlanProgress::Ready || self.is_frozen() {
            return None;
        }
        let segment = self.frozen.freeze(&self.plan);
        self.braking
            .come_nearer(&self.plan, &self.frozen, segment.duration);
        Some(segment)
    }

    /// Multiplies the programmed speeds by `factor` from now on, up to the greatest ones; a factor
    /// below the one in force changes nothing, since every state has to stay feasible.
    pub fn raise(&mut self, factor: f64) {
        if factor.is_finite() && factor > self.raise {
            self.raise = factor;
            self.soften();
        }
    }

    /// What the programmed speeds are multiplied by, 1 and above.
    pub fn raised(&self) -> f64 {
        self.raise
    }

    /// Works on the plan for at most `budget` units of 20 to 40 ns, give or take one step of a few
    /// microseconds.
    pub fn slice<R: Route>(&mut self, route: &R, budget: u32) -> PlanProgress {
        self.first_plan.pass_slice();
        self.extensions.pass_slice();
        let mut left = budget;
        while left > 0 {
            match self.work {
                Work::Candidate => self.continue_candidate(route, &mut left),
                Work::Refinement => self.continue_refinement(&mut left),
                Work::Nothing => {
                    self.work = self.begin_work(route);
                    if self.work == Work::Nothing {
                        break;
                    }
                    left = left.saturating_sub(self.work.beginning());
                }
            }
            left = left.saturating_sub(1);
        }
        self.braking.look(&self.plan);
        self.progress
    }

    fn begin_work<R: Route>(&mut self, route: &R) -> Work {
        match self.progress {
            PlanProgress::Starting => self.begin_first(route),
            PlanProgress::Ready if self.frozen.next() <= self.plan.last => self.begin_next(route),
            _ => Work::Nothing,
        }
    }

    fn begin_first<R: Route>(&mut self, route: &R) -> Work {
        let start = self.plan.start;
        let Some(end) = self.first_plan.end(route, start) else {
            return Work::Nothing;
        };
        let route = CountedRoute::new(route);
        let (context, candidate, _) = self.candidate(&route);
        candidate.begin_first(&context, start, end);
        Work::Candidate
    }

    fn begin_next<R: Route>(&mut self, route: &R) -> Work {
        let committed = self.frozen.committed(&self.plan);
        let gain = route.known_end() - self.plan.end;
        let complete = route.is_complete();
        let room = self.plan.last.saturating_sub(self.frozen.next()) < HORIZON;
        let wanted = room && self.extensions.is_wanted(gain, complete);
        let first = self.brakes_within(URGENT) || self.refinement.lets_extend(committed);
        if wanted && first {
            return self.begin_extension(route, committed);
        }
        if self.begin_refinement(committed, complete && gain <= 0.0) {
            return Work::Refinement;
        }
        if wanted {
            return self.begin_extension(route, committed);
        }
        Work::Nothing
    }

    fn begin_extension<R: Route>(&mut self, route: &R, committed: usize) -> Work {
        self.refinement.note_extension();
        let urgent = self.brakes_within(URGENT);
        let reach = self
            .extensions
            .begin(self.plan.end, route.known_end(), urgent);
        let behind = self
            .frozen
            .interval_behind(&self.plan, self.extensions.lead());
        // It is left at what was refined last: the plan keeps all of that, unless it cannot be continued from there.
        let latest = self
            .refinement
            .refined()
            .saturating_sub(self.extensions.earlier())
            .min(
                self.plan
                    .last
                    .saturating_sub(candidate_plan::NODES_TO_CONTINUE),
            );
        let base = latest
            .max(behind.min(self.braking.start()))
            .max(committed + 1);
        let route = CountedRoute::new(route);
        let (context, candidate, _) = self.candidate(&route);
        candidate.begin_extension(&context, base, reach.end, reach.intervals);
        Work::Candidate
    }

    /// Begins a step of the refinement behind the committed part; up to the end if nothing follows.
    /// Whether it is worth its time.
    fn begin_refinement(&mut self, committed: usize, to_the_end: bool) -> bool {
        let limit = if to_the_end {
            self.plan.last + 1
        } else {
            let before_braking = self.braking.start().saturating_sub(3);
            self.refinement.settled().max(before_braking)
        };
        if !self.refinement.is_due(committed) {
            return false;
        }
        let first = self.refinement.first(committed);
        let Some(end) = self.newton.begin(first, limit) else {
            return false;
        };
        if !to_the_end {
            self.refinement.note_window(end);
        }
        true
    }

    fn continue_refinement(&mut self, left: &mut u32) {
        if self.frozen.next() > self.newton.first() {
            self.work = Work::Nothing;
            return;
        }
        let raise = self.raise_squared();
        let done = self
            .newton
            .advance(&mut self.plan, &self.samples, &self.rows, raise, left);
        if done {
            self.work = Work::Nothing;
            self.braking.look_anew(&self.plan, &self.frozen);
            let committed = self.frozen.committed(&self.plan);
            self.refinement
                .note_step(committed, self.newton.unconverged());
        }
    }

    fn continue_candidate<R: Route>(&mut self, route: &R, left: &mut u32) {
        // Interval `base` depends on the first coefficient that is changed.
        if self.frozen.next() > self.candidate.base {
            self.work = Work::Nothing;
            self.extensions.note_overtaken();
            return;
        }
        let route = CountedRoute::new(route);
        let (context, candidate, samples) = self.candidate(&route);
        match candidate.advance(&context, samples, left) {
            CandidateStep::More => {}
            CandidateStep::Ready => {
                self.adopt();
                *left = left.saturating_sub(cost::ADOPT);
            }
            CandidateStep::Refused(refusal) => self.note_refusal(refusal),
        }
    }

    fn adopt(&mut self) {
        self.work = Work::Nothing;
        let base = self.candidate.base;
        self.plan
            .copy_from(&self.candidate.spline, self.candidate.changed());
        self.refinement
            .replan(base, self.candidate.settled(), self.plan.last);
        self.braking.replan(&self.plan, &self.frozen, base);
        self.time.replan(&self.frozen, base);
        self.extensions.note_adopted(self.candidate.added());
        if self.progress == PlanProgress::Starting {
            self.progress = PlanProgress::Ready;
            if self.first_plan.note_adopted() {
                self.soften();
            }
        }
    }

    fn note_refusal(&mut self, refusal: PlanRefusal) {
        self.work = Work::Nothing;
        if self.progress != PlanProgress::Starting {
            self.extensions.note_refusal();
        } else if !self.first_plan.note_refusal(refusal) {
            self.progress = PlanProgress::Refused(refusal);
        }
    }

    /// Refuses the plan as if none had been found, unless some of it is frozen.
    #[cfg(test)]
    pub fn refuse(&mut self) {
        if self.frozen.next() == 0 {
            self.progress = PlanProgress::Refused(PlanRefusal::NotFound);
        }
    }

    /// Makes room for caps that were raised.
    fn soften(&mut self) {
        if self.work == Work::Refinement {
            self.work = Work::Nothing;
        }
        self.refinement.begin_anew();
        for k in self.frozen.next()..=self.plan.last {
            let interval = self.plan.at_mut(k);
            interval.barrier = interval.barrier.max(RAISED_BARRIER);
            interval.resistance = 1.0;
        }
    }

    /// Square of what the program's caps are multiplied by.
    fn raise_squared(&self) -> f64 {
        let factor = self.raise * self.first_plan.speed_share();
        factor * factor
    }

    /// The candidate, with what it works with.
    fn candidate<'a, R: Route>(
        &'a mut self,
        route: &'a CountedRoute<'a, R>,
    ) -> (
        PlanContext<'a, R>,
        &'a mut CandidatePlan,
        &'a mut SampleBanks,
    ) {
        let context = PlanContext {
            route,
            raise_squared: self.raise_squared(),
            oldest: self.frozen.oldest(),
            rows: &self.rows,
            plan: &self.plan,
        };
        (context, &mut self.candidate, &mut self.samples)
    }
}

impl Default for LookAhead {
    fn default() -> Self {
        Self::new()
    }
}
