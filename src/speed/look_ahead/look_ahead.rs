//! The planner: what is worked on next, and what the executor takes.

use super::candidate_plan::{self, CandidatePlan, CandidateStep};
use super::context::PlanContext;
use super::cost;
use super::newton::{MOST_INTERVALS, NewtonStep};
use super::planned_segment::PlannedSegment;
use super::refusal::PlanRefusal;
use super::route::{Route, SpeedCap};
use super::rows::AxisRows;
use super::run_state::{RunState, SHORTEST_LEAD};
use super::spline::{CAPACITY, SampleBanks, Spline};
use crate::axes::{AxisLimits, MachineMap};

/// Seconds behind the frozen part that are left alone, so that work begun is seldom overtaken.
const COMMITTED_TIME: f64 = 8e-3;
/// See [`SHORTEST_LEAD`].
const LONGEST_LEAD: f64 = 128e-3;
/// The most intervals that these may be.
const MOST_COMMITTED: usize = 128;

/// Intervals ahead of the machine beyond which the plan is not extended: room is left for one
/// extension.
const HORIZON: usize = CAPACITY - candidate_plan::MOST_INTERVALS - 16;

/// Intervals that an extension is meant to add.
const EXTENSION: f64 = 64.0;

/// Lengths with which an extension is tried in turn: whole, a half, a third. What is refused once is refused again
/// from there. In programs that run undisturbed a shorter one hardly ever helps; where an operator raises an override
/// it does: arcspiral takes 2 to 13 % longer without.
const EXTENSION_LENGTHS: u32 = 3;

/// An extension by fewer intervals than this waits for more, but no longer than [`PATIENCE`].
const WORTHWHILE: f64 = 8.0;
/// Slices.
const PATIENCE: u32 = 8;

/// Seconds to the final braking that are looked at.
const BRAKING_SEEN: f64 = 0.15;

/// Seconds to the final braking, below which an extension comes before the refinement.
const URGENT: f64 = 0.1;

/// Seconds at the programmed speed that the first plan covers. It is short, so that the motion
/// begins soon.
const FIRST_TIME: f64 = 0.04;

/// While the path is shorter than that and grows, the first plan waits, for this many slices at
/// most.
const LONGEST_WAIT: u32 = 40;

/// A first plan over less than this share of the path distance waits for more: rounding.
const LEAST_LENGTH: f64 = 1e-9;

/// A first plan that is refused is made over half the length, this often ..
const SHORTER_FIRST_PLANS: u32 = 6;
/// .. and then, as often again, at this share of the programmed speed.
const SLOWER_FIRST_PLANS: u32 = 4;
const SLOWER: f64 = 0.4;

/// Steps of the refinement for what is new ..
const FRESH_STEPS: u32 = 24;
/// .. and then one more each time that the machine has come on by so many intervals: more gain nothing.
const PACE: usize = 2;

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
    state: RunState,
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
            state: RunState::AT_REST,
        }
    }

    /// Forgets everything and begins at rest at `s`. `period` of the servo thread in seconds.
    pub fn start(&mut self, s: f64, limits: &AxisLimits, map: &MachineMap, period: f64) {
        self.rows = AxisRows::new(limits, map, period);
        self.plan.last = 0;
        self.plan.start = s;
        self.plan.end = s;
        self.newton.cancel();
        self.progress = PlanProgress::Starting;
        self.state = RunState::AT_REST;
    }

    /// Whether there is a plan.
    pub fn progress(&self) -> PlanProgress {
        self.progress
    }

    /// Where the plan comes to rest, as s.
    pub fn end(&self) -> f64 {
        self.plan.end
    }

    /// Seconds of the plan that are frozen.
    pub fn frozen_time(&self) -> f64 {
        self.state.frozen_time
    }

    /// Whether the whole plan is frozen: the reference ends at rest.
    pub fn is_frozen(&self) -> bool {
        self.progress == PlanProgress::Ready && self.state.next > self.plan.last + 1
    }

    /// Whether the final braking begins less than `seconds`, at most 0.1, behind the
    /// frozen part. A path whose end is still open has to be ended then.
    pub fn brakes_within(&self, seconds: f64) -> bool {
        self.state.braking_in < seconds
    }

    /// Looks how long it is until the final braking: goes on from where it looked before.
    fn look_for_braking(&mut self) {
        while self.state.counted < self.state.braking && self.state.braking_in < BRAKING_SEEN {
            self.state.braking_in += self.plan.duration(self.state.counted);
            self.state.counted += 1;
        }
    }

    /// The same anew: the plan behind the frozen part has changed.
    fn look_anew_for_braking(&mut self) {
        self.state.braking_in = 0.0;
        self.state.counted = self.state.next;
        self.look_for_braking();
    }

    /// The next segment, which stays as it is from now on. `None` if there is no plan, or the
    /// reference has ended at rest.
    pub fn freeze(&mut self) -> Option<PlannedSegment> {
        if self.progress != PlanProgress::Ready || self.is_frozen() {
            return None;
        }
        let segment = PlannedSegment::of(&self.plan, self.state.next, self.state.frozen_time);
        self.state.next += 1;
        self.state.frozen_time += segment.duration;
        if self.state.next < self.state.counted {
            self.state.braking_in -= segment.duration;
        } else {
            self.look_anew_for_braking();
        }
        Some(segment)
    }

    /// Multiplies the programmed speeds by `factor` from now on, up to the greatest ones; a factor
    /// below the one in force changes nothing, since every state has to stay feasible.
    pub fn raise(&mut self, factor: f64) {
        if factor.is_finite() && factor > self.state.raise {
            self.state.raise = factor;
            self.soften();
        }
    }

    /// Works on the plan for at most `budget` units of 20 to 40 ns, give or take one step of a few
    /// microseconds.
    pub fn slice<R: Route>(&mut self, route: &R, budget: u32) -> PlanProgress {
        self.state.pause = self.state.pause.saturating_sub(1);
        self.state.waited = self.state.waited.saturating_add(1);
        let mut left = budget;
        while left > 0 {
            if self.state.candidate_begun {
                self.continue_candidate(route, &mut left);
            } else if !self.newton.is_idle() {
                self.continue_refinement(&mut left);
            } else if self.begin_work(route) {
                let price = if self.state.candidate_begun {
                    cost::BEGIN_CANDIDATE
                } else {
                    cost::BEGIN_REFINEMENT
                };
                left = left.saturating_sub(price);
            } else {
                break;
            }
            left = left.saturating_sub(1);
        }
        self.look_for_braking();
        self.progress
    }

    fn begin_work<R: Route>(&mut self, route: &R) -> bool {
        match self.progress {
            PlanProgress::Idle | PlanProgress::Refused(_) => false,
            PlanProgress::Starting => self.begin_first(route),
            PlanProgress::Ready => self.state.next <= self.plan.last && self.begin_next(route),
        }
    }

    fn begin_first<R: Route>(&mut self, route: &R) -> bool {
        let start = self.plan.start;
        let known = route.known_end() - start;
        if known <= 0.0 || !route.is_complete() && known <= LEAST_LENGTH * (1.0 + start.abs()) {
            return false;
        }
        let SpeedCap { programmed, .. } = route.speed_cap(start, &route.point(start).first);
        let halvings = self.state.failures.min(SHORTER_FIRST_PLANS);
        let most = FIRST_TIME * programmed;
        if known > self.state.seen {
            self.state.seen = known;
            self.state.quiet = 0;
        }
        self.state.quiet += 1;
        let waits = self.state.quiet < PATIENCE && self.state.waited < LONGEST_WAIT;
        if known < most && !route.is_complete() && waits {
            return false;
        }
        let mut length = if most < 0.7 * known { most } else { known };
        for _ in 0..halvings {
            length *= 0.5;
        }
        let end = if length < known {
            start + length
        } else {
            route.known_end()
        };
        let (context, candidate) = self.context(route);
        candidate.begin_first(&context, start, end);
        self.state.candidate_begun = true;
        true
    }

    fn begin_next<R: Route>(&mut self, route: &R) -> bool {
        let committed = self.committed();
        let gain = route.known_end() - self.plan.end;
        let complete = route.is_complete();
        let enough =
            complete || gain >= WORTHWHILE * self.state.spacing || self.state.waited >= PATIENCE;
        let room = self.plan.last.saturating_sub(self.state.next) < HORIZON;
        let wanted = gain > 0.0 && enough && room && self.state.pause == 0;
        let urgent = wanted && self.brakes_within(URGENT);
        if urgent || wanted && self.state.steps >= self.steps_between(committed) {
            self.begin_extension(route, committed, gain);
            return true;
        }
        if self.begin_refinement(committed, complete && gain <= 0.0) {
            return true;
        }
        if wanted {
            self.begin_extension(route, committed, gain);
        }
        wanted
    }

    /// How many steps of the refinement are due between two extensions: few while the machine is near
    /// to what is not settled, since a longer plan gains more than a smoother one.
    fn steps_between(&self, committed: usize) -> u32 {
        let ahead = self.state.settled.saturating_sub(committed);
        if ahead > 2 * MOST_INTERVALS {
            12
        } else if ahead > MOST_INTERVALS * 5 / 4 {
            4
        } else if ahead > MOST_INTERVALS / 2 {
            2
        } else {
            1
        }
    }

    fn begin_extension<R: Route>(&mut self, route: &R, committed: usize, gain: f64) {
        self.state.steps = 0;
        self.state.waited = 0;
        // The less time there is, the shorter: what is short is found soon.
        let (hurry, most) = if self.brakes_within(URGENT) {
            (0.5, candidate_plan::MOST_URGENT_INTERVALS)
        } else {
            (1.0, candidate_plan::MOST_INTERVALS)
        };
        let length = EXTENSION / f64::from(1 + self.state.failures % EXTENSION_LENGTHS);
        let step = hurry * length * self.state.spacing;
        let end = if gain > 1.5 * step {
            self.plan.end + step
        } else {
            route.known_end()
        };
        // It is left at what was refined last: the plan keeps all of that.
        let latest = self.state.refined.min(self.plan.last.saturating_sub(4));
        let base = latest
            .max(
                self.interval_behind(self.state.lead)
                    .min(self.state.braking),
            )
            .max(committed + 1);
        let (context, candidate) = self.context(route);
        candidate.begin_extension(&context, base, end, most);
        self.state.candidate_begun = true;
    }

    /// Whether a step of the refinement is worth its time.
    fn is_refinement_due(&self, committed: usize) -> bool {
        self.state.fresh_steps < FRESH_STEPS || committed >= self.state.paced + PACE
    }

    /// Begins a step of the refinement behind the committed part; up to the end if nothing follows.
    fn begin_refinement(&mut self, committed: usize, to_the_end: bool) -> bool {
        let limit = if to_the_end {
            self.plan.last + 1
        } else {
            self.state.settled.max(self.state.braking.saturating_sub(3))
        };
        let end = limit.min(committed + MOST_INTERVALS);
        if end < committed + 4 || !self.is_refinement_due(committed) {
            return false;
        }
        self.newton.begin(committed, end);
        if !to_the_end {
            self.state.refined = self.state.refined.max(end);
        }
        true
    }

    fn continue_refinement(&mut self, left: &mut u32) {
        if self.state.next > self.newton.first() {
            self.newton.cancel();
            return;
        }
        let raise = self.raise_squared();
        self.newton
            .advance(&mut self.plan, &self.samples, &self.rows, raise, left);
        if self.newton.is_idle() {
            self.look_anew_for_braking();
            self.state.steps = self.state.steps.saturating_add(1);
            self.state.fresh_steps = self.state.fresh_steps.saturating_add(1);
            self.state.paced = self.newton.first();
        }
    }

    fn continue_candidate<R: Route>(&mut self, route: &R, left: &mut u32) {
        // Interval `base` depends on the first coefficient that is changed.
        if self.state.next > self.candidate.base {
            self.state.candidate_begun = false;
            self.state.lead = (2.0 * self.state.lead).min(LONGEST_LEAD);
            return;
        }
        let context = PlanContext {
            route,
            rows: &self.rows,
            plan: &self.plan,
            raise_squared: self.raise_squared(),
            oldest: self.state.next.saturating_sub(1),
        };
        match self.candidate.advance(&context, &mut self.samples, left) {
            CandidateStep::More => {}
            CandidateStep::Ready => {
                self.adopt();
                *left = left.saturating_sub(cost::ADOPT);
            }
            CandidateStep::Refused(refusal) => self.note_refusal(refusal),
        }
    }

    fn adopt(&mut self) {
        self.state.candidate_begun = false;
        let base = self.candidate.base;
        let added = self.candidate.added();
        self.state.spacing = added;
        self.plan
            .copy_from(&self.candidate.spline, self.candidate.changed());
        self.state.refined = base;
        self.state.fresh_steps = 0;
        self.state.settled = self
            .candidate
            .settled()
            .max(self.state.settled.min(base))
            .min(self.plan.last - 1);
        self.state.braking = self.plan.final_braking(base + 1);
        self.look_anew_for_braking();
        self.state.failures = 0;
        self.state.lead = SHORTEST_LEAD;
        if self.progress == PlanProgress::Starting {
            self.progress = PlanProgress::Ready;
            if self.state.slower < 1.0 {
                self.state.slower = 1.0;
                self.soften();
            }
        }
    }

    fn note_refusal(&mut self, refusal: PlanRefusal) {
        self.state.candidate_begun = false;
        self.state.failures = self.state.failures.saturating_add(1);
        if self.progress != PlanProgress::Starting {
            self.state.pause = PATIENCE;
            return;
        }
        let over = self.state.failures > SHORTER_FIRST_PLANS + SLOWER_FIRST_PLANS;
        if over || refusal == PlanRefusal::Unsound {
            self.progress = PlanProgress::Refused(refusal);
        } else if self.state.failures > SHORTER_FIRST_PLANS {
            self.state.slower *= SLOWER;
        }
    }

    /// Refuses the plan as if none had been found, unless some of it is frozen.
    #[cfg(test)]
    pub fn refuse(&mut self) {
        if self.state.next == 0 {
            self.progress = PlanProgress::Refused(PlanRefusal::NotFound);
        }
    }

    /// Makes room for caps that were raised.
    fn soften(&mut self) {
        self.newton.cancel();
        self.state.fresh_steps = 0;
        for k in self.state.next..=self.plan.last {
            let interval = self.plan.at_mut(k);
            interval.barrier = interval.barrier.max(RAISED_BARRIER);
            interval.resistance = 1.0;
        }
    }

    /// The first interval that may be changed.
    fn committed(&self) -> usize {
        if self.state.next == 0 {
            return 1;
        }
        self.interval_behind(COMMITTED_TIME)
    }

    /// The interval that begins `seconds` behind the frozen part, or a little later.
    fn interval_behind(&self, seconds: f64) -> usize {
        let mut time = 0.0;
        let mut k = self.state.next;
        for _ in 0..MOST_COMMITTED {
            if k > self.plan.last || time >= seconds {
                break;
            }
            time += self.plan.duration(k);
            k += 1;
        }
        k
    }

    fn raise_squared(&self) -> f64 {
        let factor = self.state.raise * self.state.slower;
        factor * factor
    }

    fn context<'a, R: Route>(
        &'a mut self,
        route: &'a R,
    ) -> (PlanContext<'a, R>, &'a mut CandidatePlan) {
        let raise_squared = self.raise_squared();
        let context = PlanContext {
            route,
            rows: &self.rows,
            plan: &self.plan,
            raise_squared,
            oldest: self.state.next.saturating_sub(1),
        };
        (context, &mut self.candidate)
    }
}

impl Default for LookAhead {
    fn default() -> Self {
        Self::new()
    }
}
