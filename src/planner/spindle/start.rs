//! The start of a thread or a tap: the index, the angle that the machine leaves at, and what goes wrong there.

use super::super::status::Status;
use super::error::SpindleError;
use super::follower::SpindleFollower;
use super::lead_in::LeadIn;
use super::move_at_hand::MoveAtHand;
use super::tap::Tap;
use super::thread::{Stage, Thread};
use super::tracker::Tracker;
use crate::moves::shape::Line9;
use crate::moves::{Synchronisation, SynchronisationMode};

/// A start later than this, turns and servo periods, waits for the next turn.
const LATE: f64 = 0.002;
const LATE_PERIODS: f64 = 2.0;

/// Seconds that an index may take to come.
const LONGEST_WAIT: f64 = 20.0;

/// Turns in this time below which a spindle stands, and above which its index should have come.
const TURNING: f64 = 0.02;
const MOST_TURNS_WAITED: f64 = 4.0;

/// What of the greatest velocity counts as too fast: the rest is rounding.
pub(super) const TOO_FAST: f64 = 0.9999;

impl SpindleFollower {
    /// At rest: whether the spindle is where the next move may start. `status` is told what is waited for.
    ///
    /// # Errors
    /// The move cannot be run with this spindle, or its index does not come.
    pub fn permits_start(
        &mut self,
        next: &MoveAtHand,
        status: &mut Status,
    ) -> Result<bool, SpindleError> {
        let Some(with) = next.angle() else {
            self.thread = None;
            return Ok(true);
        };
        if !self.continues(&with, next) {
            self.thread = Some(self.thread_of(next, &with, status));
            status.index_request = Some(with.spindle);
            status.waiting_for_index = true;
            return Ok(false);
        }
        let (Some(mut thread), Some(tracker), Some(measured)) = (
            self.thread,
            self.trackers.get(with.spindle),
            self.measured.get(with.spindle),
        ) else {
            return Ok(false);
        };
        if thread.tap.is_some() && thread.stage == Stage::Running {
            return Ok(true);
        }
        let speed = thread.sign * tracker.speed();
        let greatest = next.limits().velocity;
        let asked = speed * with.per_turn * faster(&with);
        thread.idle += next.period;
        let mut due = false;
        if thread.stage == Stage::Index && measured.awaits_index {
            status.waiting_for_index = true;
        } else if asked > greatest * TOO_FAST {
            return Err(SpindleError::Outrun { asked, greatest });
        } else if speed > 0.0 {
            due = thread.wait_for_angle(next, &with, tracker, status);
        }
        if due {
            thread.idle = 0.0;
        }
        // A slow spindle needs its time to come round.
        let turned = tracker.speed().abs() * thread.idle;
        self.thread = Some(thread);
        if thread.idle > LONGEST_WAIT && !(TURNING..MOST_TURNS_WAITED).contains(&turned) {
            return Err(SpindleError::NoIndex);
        }
        Ok(due)
    }

    /// The thread or tap that a move begins.
    fn thread_of(&self, next: &MoveAtHand, with: &Synchronisation, status: &Status) -> Thread {
        let spindle = self.measured.get(with.spindle);
        let reverse = spindle.is_some_and(|spindle| spindle.reverse);
        let tap = match with.mode {
            SynchronisationMode::Tap { .. } => Tap::of(next.queued, &status.position),
            _ => None,
        };
        Thread::new(with.spindle, reverse, tap)
    }
}

/// How much faster than at first the spindle will turn: a tap comes back by its factor.
fn faster(with: &Synchronisation) -> f64 {
    match with.mode {
        SynchronisationMode::Tap { reversal_scale } => reversal_scale.max(1.0),
        _ => 1.0,
    }
}

impl Thread {
    /// Whether the spindle, which turns the right way, has come to where the machine leaves. `status` is told
    /// how much of the move is left.
    fn wait_for_angle(
        &mut self,
        next: &MoveAtHand,
        with: &Synchronisation,
        tracker: &Tracker,
        status: &mut Status,
    ) -> bool {
        let speed = self.sign * tracker.speed();
        let shape = &next.queued.shape;
        // What is left of a move in whose middle the machine rests.
        let left = Line9::new(&status.position, &shape.end()).map_or(0.0, |line| line.length());
        status.distance_to_go = left.min(shape.length());
        let begin = self.turns_on(with, shape.length() - status.distance_to_go);
        let lead_in = LeadIn::new(speed, with.per_turn, &next.limits());
        let turns = self.sign * tracker.turns();
        let first = turns - begin + lead_in.lead();
        let late = (LATE_PERIODS * speed * next.period).max(LATE);
        if self.stage != Stage::Waiting || self.zero < first - late {
            // Whole turns, so that every pass runs in the same groove.
            self.zero = first.ceil();
            self.stage = Stage::Waiting;
        }
        self.begin = begin;
        self.lead_in = lead_in;
        let due = turns >= self.zero + begin - lead_in.lead();
        if due {
            self.stage = Stage::Running;
            self.start_speed = speed;
            self.furthest = turns - self.zero;
            self.outrun = 0.0;
        }
        due
    }
}
