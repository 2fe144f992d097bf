//! The servo cycle of a thread: index, start in step, where to be, and what goes wrong.

use super::super::error_stop::ErrorStop;
use super::super::inputs::CycleInputs;
use super::super::planner::Planner;
use super::error::SpindleError;
use super::lead_in::LeadIn;
use super::thread::{Stage, Thread};
use crate::cycle::Follow;
use crate::moves::shape::Line9;
use crate::moves::{Move, Synchronisation, SynchronisationMode};
use crate::speed::PathLimits;

/// A spindle slower than this part of its speed at the start of the thread stands.
const STALLED: f64 = 0.02;

/// Seconds that a spindle may stand in a thread.
const LONGEST_STALL: f64 = 0.5;

/// Seconds that it may stand while it turns back in a tap: contactors take their time.
const LONGEST_TURN: f64 = 10.0;

/// From this part of its speed at the start on a spindle has turned round for sure.
const UNDER_WAY: f64 = 0.2;

/// A start later than this, turns and servo periods, waits for the next turn.
const LATE: f64 = 0.002;
const LATE_PERIODS: f64 = 2.0;

/// Seconds that an index may take to come.
const LONGEST_WAIT: f64 = 20.0;

/// Turns in this time below which a spindle stands, and above which its index should have come.
const TURNING: f64 = 0.02;
const MOST_TURNS_WAITED: f64 = 4.0;

/// Turns back in a thread that are more than a vibration.
const REVERSED: f64 = 0.05;

/// Seconds that a spindle may be faster than the axes are able to follow.
const LONGEST_OUTRUN: f64 = 0.02;

/// What of the greatest velocity counts as too fast: the rest is rounding.
const TOO_FAST: f64 = 0.9999;

impl Planner {
    /// Measures the spindles. Once in each servo period.
    pub(in crate::planner) fn track_spindles(&mut self, inputs: &CycleInputs) {
        self.status.index_request = None;
        self.status.spindle_factor = None;
        self.status.spindle_error = None;
        self.spindles = inputs.spindles;
        for (tracker, measured) in self.trackers.iter_mut().zip(&inputs.spindles) {
            tracker.update(measured, self.period);
        }
    }

    /// How a move that follows the angle of a spindle does so.
    fn angle_of(queued: &Move) -> Option<Synchronisation> {
        queued.synchronisation.filter(|with| with.follows_angle())
    }

    /// Whether the next move is the first one of a thread, so that the spindles have to be at
    /// speed.
    pub(in crate::planner) fn begins_thread(&self) -> bool {
        let angle = self.queue.front().and_then(Self::angle_of);
        angle.is_some_and(|with| !self.continues(&with))
    }

    /// Whether the thread that is known goes on with a move that follows a spindle like this.
    fn continues(&self, with: &Synchronisation) -> bool {
        let Some(thread) = &self.thread else {
            return false;
        };
        let first = with.mode == SynchronisationMode::Thread { turns_before: 0.0 };
        let begun = self.queue.has_begun();
        thread.spindle == with.spindle && (thread.stage != Stage::Running || begun || !first)
    }

    /// Turns of the sequence that the spindle has made since its start.
    pub(super) fn turns_of(&self, thread: &Thread) -> f64 {
        let tracker = self.trackers.get(thread.spindle);
        tracker.map_or(0.0, |tracker| thread.sign * tracker.turns()) - thread.zero
    }

    /// Whether the way back of a tap goes on, which no operator's hold may delay.
    pub(in crate::planner) fn is_tapping(&self) -> bool {
        self.thread
            .is_some_and(|thread| thread.stage == Stage::Running && thread.tap.is_some())
    }

    /// At rest: whether the spindle is where the next move may start.
    pub(in crate::planner) fn spindle_permits_start(&mut self, inputs: &CycleInputs) -> bool {
        let Some(queued) = self.queue.front().copied() else {
            return false;
        };
        let Some(with) = Self::angle_of(&queued) else {
            self.thread = None;
            return true;
        };
        if !self.continues(&with) {
            let reverse = inputs
                .spindles
                .get(with.spindle)
                .is_some_and(|spindle| spindle.reverse);
            let tap = match with.mode {
                SynchronisationMode::Tap { .. } => self.tap_of_front(),
                _ => None,
            };
            self.thread = Some(Thread::new(with.spindle, reverse, tap));
            self.status.index_request = Some(with.spindle);
            self.status.waiting_for_index = true;
            return false;
        }
        let (Some(mut thread), Some(tracker), Some(measured)) = (
            self.thread,
            self.trackers.get(with.spindle).copied(),
            inputs.spindles.get(with.spindle),
        ) else {
            return false;
        };
        if thread.tap.is_some() && thread.stage == Stage::Running {
            return true;
        }
        let speed = thread.sign * tracker.speed();
        let limits = self.limits_of(&queued);
        // A tap comes back faster by its factor.
        let faster = match with.mode {
            SynchronisationMode::Tap { reversal_scale } => reversal_scale.max(1.0),
            _ => 1.0,
        };
        let asked = speed * with.per_turn * faster;
        thread.idle += self.period;
        let mut due = false;
        if thread.stage == Stage::Index && measured.awaits_index {
            self.status.waiting_for_index = true;
        } else if asked > limits.velocity * TOO_FAST {
            let greatest = limits.velocity;
            self.trip(SpindleError::Outrun { asked, greatest });
            return false;
        } else if speed > 0.0 {
            // What is left of a move in whose middle the machine rests.
            let left = Line9::new(&self.status.position, &queued.shape.end())
                .map_or(0.0, |line| line.length());
            self.status.distance_to_go = left.min(queued.shape.length());
            let begin = turns_on(
                &thread,
                &with,
                queued.shape.length() - self.status.distance_to_go,
            );
            let lead_in = LeadIn::new(speed, with.per_turn, &limits);
            let turns = thread.sign * tracker.turns();
            let first = turns - begin + lead_in.lead();
            let late = (LATE_PERIODS * speed * self.period).max(LATE);
            if thread.stage != Stage::Waiting || thread.zero < first - late {
                // Whole turns, so that every pass runs in the same groove.
                thread.zero = first.ceil();
                thread.stage = Stage::Waiting;
            }
            thread.begin = begin;
            thread.lead_in = lead_in;
            due = turns >= thread.zero + begin - lead_in.lead();
            if due {
                thread.stage = Stage::Running;
                thread.start_speed = speed;
                thread.furthest = turns - thread.zero;
                thread.outrun = 0.0;
            }
        }
        if due {
            thread.idle = 0.0;
        }
        self.thread = Some(thread);
        // A slow spindle needs its time to come round.
        let turned = tracker.speed().abs() * thread.idle;
        if thread.idle > LONGEST_WAIT && !(TURNING..MOST_TURNS_WAITED).contains(&turned) {
            self.trip(SpindleError::NoIndex);
        }
        due
    }

    /// What the axes allow along the path of a move.
    fn limits_of(&self, queued: &Move) -> PathLimits {
        PathLimits::of(&queued.shape, &self.map, &self.limits, queued.max_velocity)
    }

    /// In a thread: where to be. `None` in any other move.
    pub(in crate::planner) fn follow(&self) -> Option<Follow> {
        let front = self.queue.front()?;
        let with = Self::angle_of(front)?;
        let thread = self.thread.as_ref()?;
        let tracker = self.trackers.get(thread.spindle)?;
        let speed = thread.sign * tracker.speed();
        let rise = thread.sign * tracker.acceleration();
        let turns = self.turns_of(thread);
        let target = thread.lead_in.target(turns - thread.begin);
        let distance = front.shape.length() - self.status.distance_to_go;
        let here = turns_on(thread, &with, distance);
        let forth = match &thread.tap {
            Some(tap) if tap.is_up() => -with.per_turn,
            _ => with.per_turn,
        };
        let square = speed * speed;
        Some(Follow {
            error: forth * (thread.begin + target.place - here),
            velocity: forth * target.first * speed,
            acceleration: forth * (target.second * square + target.first * rise),
            greatest_acceleration: self.limits_of(front).acceleration,
            jerk: forth * (target.third * square * speed + 3.0 * target.second * speed * rise),
        })
    }

    /// In a thread: looks what is wrong with the spindle.
    pub(in crate::planner) fn watch_spindle(&mut self) {
        if self.status.aborting {
            return;
        }
        let Some(queued) = self.queue.front() else {
            return;
        };
        let (Some(with), Some(mut thread)) = (Self::angle_of(queued), self.thread) else {
            return;
        };
        let Some(tracker) = self.trackers.get(thread.spindle) else {
            return;
        };
        let back = thread.tap.is_some_and(|tap| tap.is_up());
        let turning = thread.tap.is_some_and(|tap| tap.is_turning());
        let forth = if back { -1.0 } else { 1.0 };
        let speed = forth * thread.sign * tracker.speed();
        let turns = self.turns_of(&thread);
        let greatest = self.limits_of(queued).velocity;
        let asked = speed * with.per_turn;
        if turns - thread.begin >= thread.lead_in.lead() {
            // In step: the start does not come again, whatever the spindle does.
            thread.lead_in = LeadIn::NONE;
        }
        let count = |time: f64, counts: bool| if counts { time + self.period } else { 0.0 };
        thread.outrun = count(thread.outrun, asked > greatest * TOO_FAST);
        thread.idle = count(thread.idle, speed.abs() < STALLED * thread.start_speed);
        if turning {
            thread.under_way = false;
        } else if speed > UNDER_WAY * thread.start_speed {
            thread.under_way = true;
        }
        let mut error = None;
        if thread.outrun > LONGEST_OUTRUN {
            error = Some(SpindleError::Outrun { asked, greatest });
        } else if thread.idle
            > (if thread.under_way {
                LONGEST_STALL
            } else {
                LONGEST_TURN
            })
        {
            error = Some(SpindleError::Stalled);
        } else if !turning {
            let ahead = forth * (turns - thread.furthest);
            if ahead > 0.0 {
                thread.furthest = turns;
            } else if ahead < -REVERSED {
                error = Some(SpindleError::Reversed);
            }
        }
        self.thread = Some(thread);
        if let Some(error) = error {
            self.trip(error);
        }
    }

    /// Stops for the sake of the spindle: what follows a broken thread must not run.
    pub(super) fn trip(&mut self, error: SpindleError) {
        self.stop_for_error(ErrorStop::Spindle(error));
        self.status.spindle_error = Some(error);
    }

    /// Turns a second that feed per turn counts with for the move that runs.
    pub(in crate::planner) fn feed_turns(&self) -> f64 {
        let with = self.queue.front().and_then(|front| front.synchronisation);
        let spindle = with.and_then(|with| self.spindles.get(with.spindle));
        spindle.map_or(f64::INFINITY, |spindle| spindle.speed.abs())
    }
}

/// Turns of the sequence at a distance from the start of a move.
fn turns_on(thread: &Thread, with: &Synchronisation, distance: f64) -> f64 {
    match (with.mode, &thread.tap) {
        (SynchronisationMode::Thread { turns_before }, _) => {
            turns_before + distance / with.per_turn
        }
        (_, Some(tap)) => tap.turns_at(distance, with.per_turn),
        _ => distance / with.per_turn,
    }
}
