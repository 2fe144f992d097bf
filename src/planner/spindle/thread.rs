//! What is known of the spindle's angle while a thread or a tap is cut.

use super::lead_in::LeadIn;
use super::tap::Tap;
use crate::moves::{Synchronisation, SynchronisationMode};

/// How far a thread is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stage {
    /// The index was asked for.
    Index,
    /// At rest, until the spindle comes to where the thread begins or goes on.
    Waiting,
    /// In motion with the spindle.
    Running,
}

/// A thread, or an unbroken sequence of threads; or a tap.
#[derive(Clone, Copy, Debug)]
pub struct Thread {
    pub spindle: usize,
    pub stage: Stage,
    /// 1, or -1 for a spindle that was started in reverse: its angle then counts down.
    pub sign: f64,
    /// Angle of the spindle at the start of the sequence, whole turns from the index.
    pub zero: f64,
    /// Turns of the sequence at which the machine leaves its rest and is in step after
    /// [`Self::lead_in`].
    pub begin: f64,
    pub lead_in: LeadIn,
    /// Speed of the spindle at the start, turns a second.
    pub start_speed: f64,
    /// Where the sequence has been furthest, turns.
    pub furthest: f64,
    /// Seconds that the spindle has stood, or the index has not come.
    pub idle: f64,
    /// Whether the spindle turns in the direction of this way: a tap's may stand before it does.
    pub under_way: bool,
    /// Seconds that the spindle has been too fast.
    pub outrun: f64,
    pub tap: Option<Tap>,
}

impl Thread {
    /// Waits for the index of a spindle.
    pub fn new(spindle: usize, reverse: bool, tap: Option<Tap>) -> Self {
        Self {
            spindle,
            stage: Stage::Index,
            sign: if reverse { -1.0 } else { 1.0 },
            zero: 0.0,
            begin: 0.0,
            lead_in: LeadIn::NONE,
            start_speed: 0.0,
            furthest: 0.0,
            idle: 0.0,
            under_way: true,
            outrun: 0.0,
            tap,
        }
    }

    /// Turns of the sequence at a distance from the start of a move.
    pub fn turns_on(&self, with: &Synchronisation, distance: f64) -> f64 {
        let turns_before = match (with.mode, &self.tap) {
            (SynchronisationMode::Thread { turns_before }, _) => turns_before,
            (_, Some(tap)) => return tap.turns_at(distance, with.per_turn),
            _ => 0.0,
        };
        turns_before + distance / with.per_turn
    }
}
