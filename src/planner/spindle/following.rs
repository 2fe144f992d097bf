//! The servo cycle of a thread: where to be, and what goes wrong with the spindle.

use super::super::status::Status;
use super::error::SpindleError;
use super::follower::SpindleFollower;
use super::lead_in::LeadIn;
use super::move_at_hand::MoveAtHand;
use super::start::TOO_FAST;
use super::thread::{Stage, Thread};
use crate::cycle::Follow;

/// A spindle slower than this part of its speed at the start of the thread stands.
const STALLED: f64 = 0.02;

/// Seconds that a spindle may stand in a thread.
const LONGEST_STALL: f64 = 0.5;

/// Seconds that it may stand while it turns back in a tap: contactors take their time.
const LONGEST_TURN: f64 = 10.0;

/// From this part of its speed at the start on a spindle has turned round for sure.
const UNDER_WAY: f64 = 0.2;

/// Turns back in a thread that are more than a vibration.
const REVERSED: f64 = 0.05;

/// Seconds that a spindle may be faster than the axes are able to follow.
const LONGEST_OUTRUN: f64 = 0.02;

impl SpindleFollower {
    /// Whether the way back of a tap goes on, which no operator's hold may delay.
    pub fn is_tapping(&self) -> bool {
        self.thread
            .is_some_and(|thread| thread.stage == Stage::Running && thread.tap.is_some())
    }

    /// Whether the machine is within a tap.
    pub fn has_tap(&self) -> bool {
        self.thread.is_some_and(|thread| thread.tap.is_some())
    }

    /// In a thread: where to be. `None` in any other move.
    pub fn follow(&self, running: &MoveAtHand, status: &Status) -> Option<Follow> {
        let with = running.angle()?;
        let thread = self.thread.as_ref()?;
        let tracker = self.trackers.get(thread.spindle)?;
        let speed = thread.sign * tracker.speed();
        let rise = thread.sign * tracker.acceleration();
        let turns = self.turns_of(thread);
        let target = thread.lead_in.target(turns - thread.begin);
        let distance = running.queued.shape.length() - status.distance_to_go;
        let here = thread.turns_on(&with, distance);
        let forth = match &thread.tap {
            Some(tap) if tap.is_up() => -with.per_turn,
            _ => with.per_turn,
        };
        let [velocity, acceleration, jerk] = target.rates(speed, rise).map(|rate| forth * rate);
        Some(Follow {
            error: forth * (thread.begin + target.place - here),
            velocity,
            acceleration,
            greatest_acceleration: running.limits().acceleration,
            jerk,
        })
    }

    /// In a thread: looks what is wrong with the spindle.
    ///
    /// # Errors
    /// The motion cannot go on with this spindle.
    pub fn watch(&mut self, running: &MoveAtHand) -> Result<(), SpindleError> {
        let (Some(with), Some(mut thread)) = (running.angle(), self.thread) else {
            return Ok(());
        };
        let Some(tracker) = self.trackers.get(thread.spindle) else {
            return Ok(());
        };
        let turning = thread.tap.is_some_and(|tap| tap.is_turning());
        let forth = thread.forth();
        let speed = forth * thread.sign * tracker.speed();
        let jumped = tracker.has_jumped();
        let turns = self.turns_of(&thread);
        let greatest = running.limits().velocity;
        let asked = speed * with.per_turn;
        if turns - thread.begin >= thread.lead_in.lead() {
            // In step: the start does not come again, whatever the spindle does.
            thread.lead_in = LeadIn::NONE;
        }
        let count = |time: f64, counts: bool| {
            if counts { time + running.period } else { 0.0 }
        };
        thread.outrun = count(thread.outrun, asked > greatest * TOO_FAST);
        thread.idle = count(thread.idle, speed.abs() < STALLED * thread.start_speed);
        if turning {
            thread.under_way = false;
        } else if speed > UNDER_WAY * thread.start_speed {
            thread.under_way = true;
        }
        let result = if jumped {
            Err(SpindleError::Jumped)
        } else if thread.outrun > LONGEST_OUTRUN {
            Err(SpindleError::Outrun { asked, greatest })
        } else if thread.idle > thread.longest_stall() {
            Err(SpindleError::Stalled)
        } else if turning {
            Ok(())
        } else {
            thread.go_on_to(turns)
        };
        self.thread = Some(thread);
        result
    }
}

impl Thread {
    /// 1, or -1 on the way back of a tap.
    fn forth(&self) -> f64 {
        if self.tap.is_some_and(|tap| tap.is_up()) {
            -1.0
        } else {
            1.0
        }
    }

    /// Seconds that the spindle may stand.
    fn longest_stall(&self) -> f64 {
        if self.under_way {
            LONGEST_STALL
        } else {
            LONGEST_TURN
        }
    }

    /// The sequence is at `turns`.
    ///
    /// # Errors
    /// The spindle has turned back.
    fn go_on_to(&mut self, turns: f64) -> Result<(), SpindleError> {
        let ahead = self.forth() * (turns - self.furthest);
        if ahead > 0.0 {
            self.furthest = turns;
        } else if ahead < -REVERSED {
            return Err(SpindleError::Reversed);
        }
        Ok(())
    }
}
