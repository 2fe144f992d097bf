//! The work of a servo period: the path, and the runs along it.

use super::outlook::Outlook;
use super::reference::Reference;
use super::rest_to_rest::RestToRest;
use super::return_route::may_go_back;
use super::supply_depth::Expected;
use crate::path::BlendError;

/// Work on the path in [`BUDGET_PERIOD`], kernel terms of 5 ns or so.
const PATH_BUDGET: f64 = 1800.0;

/// What that is multiplied by while the speed has to wait for the path.
const WAITED_FOR: f64 = 2.0;

/// Work on the speed in [`BUDGET_PERIOD`], units of 20 to 40 ns.
const SPEED_BUDGET: f64 = 300.0;

/// What that is multiplied by while the machine is soon to brake for want of a longer plan.
const HURRY: f64 = 2.0;
/// The same where the host keeps the queue short: a plan that comes a period late is a rest there, and the path is little work.
const HURRY_OF_SHORT_QUEUE: f64 = 3.5;

/// The servo period that the budgets are meant for, seconds. In another one the work of a second is
/// the same ..
const BUDGET_PERIOD: f64 = 1e-3;
/// .. within these shares of the budgets.
const LEAST_SHARE: f64 = 0.25;
const GREATEST_SHARE: f64 = 2.0;

/// When the machine is going to brake to the end of the path within so many seconds, and nothing
/// more has come, the end is final.
const LAST_CALL: f64 = 0.08;
/// Where all moves came at once, so many times besides as acceleration takes to be built up: a corner on the way to a rest
/// that comes sooner is planned to be slower, and mended only in part.
const RAMPS: f64 = 4.0;
/// No more than this of that counts, seconds.
const LONGEST_RAMP: f64 = 0.05;
/// The same where the next move may still be on its way, but not be here in time: a rest at the end
/// of the last move is better than one in the middle of it.
const LAST_MOMENT: f64 = 0.04;

/// Of a long move whose next one is late so many seconds become final at a time.
const NEEDED: f64 = 1.5 * LAST_CALL;

/// Where nothing more comes the path is settled so many seconds later at the latest, or ends.
const SETTLING: f64 = 4e-3;

/// Where moves come slowly, nothing waits for the next one on the path while less than so many times what is not final is
/// final behind the plan.
const SHORT_OF_PATH: f64 = 4.0;

/// A path that is final up to its end within this share of the path distance is final up to there: rounding.
const ROUNDING: f64 = 1e-8;

/// Servo periods before a rest in which the next run is planned at the latest.
const PERIODS_BEFORE_REST: f64 = 4.0;

impl Reference {
    /// Plans on, a fixed amount of work. Once in each servo period.
    ///
    /// # Errors
    /// A move that cannot be put on the path, which never happens to moves that follow one
    /// another.
    pub fn work(&mut self, outlook: &Outlook) -> Result<(), BlendError> {
        if !self.active {
            return Ok(());
        }
        self.feeder.feed(&mut self.path, outlook)?;
        if !self.backwards {
            self.end_path(outlook);
        }
        let share = (outlook.now.period / BUDGET_PERIOD).clamp(LEAST_SHARE, GREATEST_SHARE);
        // Where the plan waits for more of the path, the path comes first.
        let path_share = if self.current().brakes_for_now(&self.path) {
            WAITED_FOR * share
        } else {
            share
        };
        self.path.step((PATH_BUDGET * path_share) as usize);
        self.begin_runs(outlook);
        self.serves_next = !self.serves_next;
        let serves_next = self.serves_next;
        let (current, other) = both(&mut self.runs, self.swapped);
        current.look_for_stop(&self.path, outlook.queue);
        other.look_for_stop(&self.path, outlook.queue);
        let urgent = current.brakes_for_now(&self.path);
        let worked = if serves_next && other.is_begun() && !urgent {
            other
        } else {
            current
        };
        let hurry = match self.feeder.expected() {
            _ if !urgent => 1.0,
            Expected::Anything => HURRY,
            Expected::OneAtOnce | Expected::NothingBeforeOneLeaves => HURRY_OF_SHORT_QUEUE,
        };
        worked.work(&self.path, outlook, (SPEED_BUDGET * share * hurry) as u32);
        Ok(())
    }

    /// Where nothing more is to be expected the path may end.
    pub(super) fn end_path(&mut self, outlook: &Outlook) {
        // A line may still wait to be merged with the next one, behind what is known to end at rest.
        let last = self.path.leg_ending_at(self.path.programmed_end());
        let complete = last.is_some_and(|(serial, _)| serial + 1 >= self.feeder.next());
        if self.path.rests_at_end() && complete {
            return;
        }
        // A machine that is held uses up no path: what comes late meanwhile is in time.
        if outlook.now.held && self.feeder.may_follow_while_held() {
            return;
        }
        let last = if self.other().is_begun() {
            self.other()
        } else {
            self.current()
        };
        let brakes_within = |seconds: f64| self.is_near_last_run() && last.brakes_within(seconds);
        let planned = last.planned().unwrap_or(self.rest);
        let waits = self.lacks_path_behind(planned);
        let lack = self.path.added_end() - self.path.final_end();
        let in_vain = !self.resting && self.feeder.comes_in_vain(lack);
        let last_moment = (self.feeder.is_late(LAST_MOMENT) || in_vain)
            && last.is_ready()
            && brakes_within(LAST_MOMENT);
        // What is final and not planned yet will be, unless it is so little that more is waited for.
        let is_planned = last.is_ready() || last.waits_for_path();
        let all_planned = is_planned || planned >= self.path.final_end();
        let last_call = waits && all_planned && brakes_within(self.last_call(planned, outlook));
        // A single move has nothing to wait for.
        let is_single = self.resting
            && self.path.programmed_end() <= self.rest
            && self.feeder.pauses(outlook.now.period);
        if (is_single || self.feeder.is_slow())
            && self.is_short_of_path_behind(planned)
            && self.path.press()
        {
            return;
        }
        if self.feeder.is_barred() {
            return self.path.finish();
        }
        match self.feeder.expected() {
            Expected::NothingBeforeOneLeaves if self.keeps_waiting(outlook) => {
                self.path.finish();
            }
            Expected::NothingBeforeOneLeaves | Expected::OneAtOnce => {}
            Expected::Anything if last_moment && waits => self.path.finish(),
            Expected::Anything if self.feeder.is_silent() => {
                self.path.flush();
                if last_call && !self.stays_open(planned, outlook) {
                    self.path.finish();
                }
            }
            Expected::Anything => {}
        }
    }

    /// Makes as much of a long move final as the machine needs of it now, so that a move that comes late may still be passed on to without
    /// a rest. Answers whether the rest of it stays open.
    fn stays_open(&mut self, planned: f64, outlook: &Outlook) -> bool {
        if self.path.is_settled() {
            self.path.leave_open(planned, NEEDED)
        } else {
            self.resting
                && self.is_long_behind(planned, outlook)
                && !self.feeder.is_silent_beyond(SETTLING)
        }
    }

    /// Whether the last move is so long that some of it might stay open.
    fn is_long_behind(&self, planned: f64, outlook: &Outlook) -> bool {
        let last = outlook.queue.get(self.feeder.next().wrapping_sub(1));
        last.is_some_and(|last| {
            let share_of_length = last.feed * NEEDED / last.shape.length();
            self.path.added_end() - planned > self.path.path_length(&last.shape) * share_of_length
        })
    }

    /// Whether the machine is soon to come to rest where the last run begins, or is under way in that.
    fn is_near_last_run(&self) -> bool {
        let left = self.segments.duration() - self.elapsed;
        let rests = !self.resting || left <= LAST_CALL;
        rests && (!self.other().is_begun() || self.current().brakes_within(LAST_CALL))
    }

    /// Seconds before the machine brakes to the end of the path from which on that is final, if nothing more has come and there
    /// is a plan up to the path distance `planned`.
    fn last_call(&self, planned: f64, outlook: &Outlook) -> f64 {
        // Where the path or the plan has just been begun it always ends soon.
        let begun = !self.path.is_settled() || planned < self.path.final_end();
        if begun || !self.feeder.came_at_once() {
            return LAST_CALL;
        }
        let limits = outlook.limits_behind();
        let ramps = limits.acceleration.component_div(&limits.jerk);
        // Without a limit of jerk, and without one of both, there is none.
        let ramp = ramps.iter().copied().fold(0.0, f64::max);
        LAST_CALL + RAMPS * ramp.min(LONGEST_RAMP)
    }

    /// Whether it is the path that a plan up to the path distance `planned` waits for: not more of it is final behind that
    /// than would become final if it ended. A plan may be short of time or be refused as well, however long the path is.
    /// To end the path then would bring the machine to rest there later, with all moves known.
    fn lacks_path_behind(&self, planned: f64) -> bool {
        let (known, end) = (self.path.final_end(), self.path.added_end());
        known - planned <= end - known + ROUNDING * (1.0 + end)
    }

    /// Whether a plan up to the path distance `planned` is soon going to wait for the path.
    fn is_short_of_path_behind(&self, planned: f64) -> bool {
        let (known, end) = (self.path.final_end(), self.path.added_end());
        known - planned <= SHORT_OF_PATH * (end - known) + ROUNDING * (1.0 + end)
    }

    /// Whether no move would leave the queue before the machine rests, so that whoever waits for that would wait for ever.
    fn keeps_waiting(&self, outlook: &Outlook) -> bool {
        if self.resting {
            // Until the machine is there more moves come.
            let left = self.frontier - self.elapsed;
            return self.segments.len() <= 1 && left <= PERIODS_BEFORE_REST * outlook.now.period;
        }
        let current = self.current();
        let end = self.path.progress(current.end());
        let leaves =
            current.is_ready() && end.is_some_and(|end| end.first > outlook.queue.first_serial());
        !leaves && !current.has_stop(&self.path)
    }

    /// Begins the runs that are due: from where the reference rests, and from where the run that
    /// is handed out will come to rest.
    pub(super) fn begin_runs(&mut self, outlook: &Outlook) {
        let s = if self.resting {
            self.rest
        } else {
            match self.current().final_stop(&self.path) {
                Some(stop) => stop,
                None => return,
            }
        };
        let leads_on = if self.backwards {
            may_go_back(&self.path, outlook.queue, s).is_some()
        } else {
            s < self.path.programmed_end() && !self.stands_alone(s)
        };
        if !leads_on {
            return;
        }
        if self.other().starts_at(s) || self.resting && self.current().starts_at(s) {
            return;
        }
        let (current, other) = both(&mut self.runs, self.swapped);
        let due = if self.resting { current } else { other };
        due.begin(s, self.backwards, outlook);
        if self.step_by_step {
            due.end_with_move();
        }
    }

    /// Drops what is planned and not handed out.
    pub(super) fn drop_plans(&mut self) {
        for run in &mut self.runs {
            run.clear();
        }
    }

    pub(super) fn current(&self) -> &RestToRest {
        let [first, second] = &self.runs;
        if self.swapped { second } else { first }
    }

    pub(super) fn current_mut(&mut self) -> &mut RestToRest {
        both(&mut self.runs, self.swapped).0
    }

    pub(super) fn other(&self) -> &RestToRest {
        let [first, second] = &self.runs;
        if self.swapped { first } else { second }
    }
}

/// The current run, and the other one.
fn both(runs: &mut [RestToRest; 2], swapped: bool) -> (&mut RestToRest, &mut RestToRest) {
    let [first, second] = runs;
    if swapped {
        (second, first)
    } else {
        (first, second)
    }
}
