//! What follows the spindles: which one the moves to come follow, and the thread that is cut.

use super::super::inputs::SpindleInputs;
use super::super::request::AddError;
use super::move_at_hand::MoveAtHand;
use super::spindle_command::SpindleCommand;
use super::thread::{Stage, Thread};
use super::tracker::Tracker;
use crate::moves::{Move, SPINDLE_COUNT, Synchronisation, SynchronisationMode};

/// Where the last queued move belongs to threads that follow one another without a break.
#[derive(Clone, Copy, Debug)]
struct Sequence {
    spindle: usize,
    /// Turns of the spindle from the start of the sequence to its end.
    turns: f64,
}

/// The spindles, and how the machine follows them.
#[derive(Debug)]
pub struct SpindleFollower {
    /// The spindle that the moves to come follow.
    command: Option<SpindleCommand>,
    sequence: Option<Sequence>,
    /// The last queued move with feed per turn, its serial number and its spindle.
    last_feed: Option<(u64, usize)>,
    pub(super) trackers: [Tracker; SPINDLE_COUNT],
    /// The spindles as they were in the last cycle.
    pub(super) measured: [SpindleInputs; SPINDLE_COUNT],
    /// The thread that runs or comes next.
    pub(super) thread: Option<Thread>,
}

impl SpindleFollower {
    /// All spindles stand, and nothing follows one.
    pub const NEW: Self = Self {
        command: None,
        sequence: None,
        last_feed: None,
        trackers: [Tracker::NEW; SPINDLE_COUNT],
        measured: [SpindleInputs::STANDSTILL; SPINDLE_COUNT],
        thread: None,
    };

    /// Measures the spindles. Once in each servo period of `period` seconds.
    pub fn track(&mut self, measured: &[SpindleInputs; SPINDLE_COUNT], period: f64) {
        self.measured = *measured;
        for (tracker, measured) in self.trackers.iter_mut().zip(measured) {
            tracker.update(measured, period);
        }
    }

    /// Forgets the thread, and the sequence that moves to come would have belonged to.
    pub fn drop_moves(&mut self) {
        self.thread = None;
        self.sequence = None;
        self.last_feed = None;
    }

    /// Which spindle the moves to come follow.
    pub fn command(&self) -> Option<SpindleCommand> {
        self.command
    }

    /// Sets which spindle the moves to come follow.
    pub fn set_command(&mut self, command: Option<SpindleCommand>) {
        self.command = command;
    }

    /// How a move that is queued now follows its spindle, if it follows one. `alone`: no move is before it.
    pub fn mode_of_next(&self, alone: bool) -> SynchronisationMode {
        let Some(with) = self.command.filter(|with| !with.speed_only) else {
            return SynchronisationMode::Speed;
        };
        let before = self
            .sequence
            .filter(|sequence| usize::try_from(with.spindle) == Ok(sequence.spindle) && !alone);
        SynchronisationMode::Thread {
            turns_before: before.map_or(0.0, |sequence| sequence.turns),
        }
    }

    /// What a move that is queued now does with a spindle.
    pub fn synchronisation_in(
        &self,
        mode: SynchronisationMode,
    ) -> Result<Option<Synchronisation>, AddError> {
        let Some(with) = self.command else {
            return Ok(None);
        };
        let (spindle, per_turn) = (with.spindle, with.per_turn);
        if !(per_turn > 0.0 && per_turn.is_finite()) {
            return Err(AddError::PerTurn(per_turn));
        }
        match usize::try_from(spindle) {
            Ok(number) if number < SPINDLE_COUNT => Ok(Some(Synchronisation {
                spindle: number,
                per_turn,
                mode,
            })),
            _ => Err(AddError::Spindle { spindle }),
        }
    }

    /// What a move that follows a spindle is planned for: a thread as fast as the axes allow, feed
    /// per turn with a reserve for changes of the speed and of the override.
    pub fn planned_feed(&self, with: &Synchronisation, max_velocity: f64) -> f64 {
        let expected = match self.measured.get(with.spindle) {
            Some(spindle) if !with.follows_angle() => {
                Synchronisation::RESERVE
                    * with.per_turn
                    * spindle.speed.abs().max(spindle.commanded)
            }
            _ => 0.0,
        };
        if expected > 0.0 {
            expected.min(max_velocity)
        } else {
            max_velocity
        }
    }

    /// A move was queued with this serial number: the next one may go on with its sequence.
    pub fn take_note_of(&mut self, queued: &Move, serial: u64) {
        if let Some(with) = queued.synchronisation.filter(|with| !with.follows_angle()) {
            self.last_feed = Some((serial, with.spindle));
        }
        self.sequence = match queued.synchronisation {
            Some(Synchronisation {
                spindle,
                per_turn,
                mode: SynchronisationMode::Thread { turns_before },
            }) => Some(Sequence {
                spindle,
                turns: turns_before + queued.shape.length() / per_turn,
            }),
            _ => None,
        };
    }

    /// Whether a thread or a tap has been begun and not left.
    pub fn has_thread(&self) -> bool {
        self.thread.is_some()
    }

    /// Whether the next move is the first one of a thread, so that the spindles have to be at
    /// speed.
    pub fn begins_thread(&self, next: &MoveAtHand) -> bool {
        next.angle()
            .is_some_and(|with| !self.continues(&with, next))
    }

    /// Whether the thread that is known goes on with a move that follows a spindle like this.
    pub(super) fn continues(&self, with: &Synchronisation, next: &MoveAtHand) -> bool {
        let Some(thread) = &self.thread else {
            return false;
        };
        let first = with.mode == SynchronisationMode::Thread { turns_before: 0.0 };
        thread.spindle == with.spindle && (thread.stage != Stage::Running || next.begun || !first)
    }

    /// Turns of the sequence that the spindle has made since its start.
    pub(super) fn turns_of(&self, thread: &Thread) -> f64 {
        let tracker = self.trackers.get(thread.spindle);
        tracker.map_or(0.0, |tracker| thread.sign * tracker.turns()) - thread.zero
    }

    /// The spindle of the last queued move with feed per turn, if that is not behind the move with the serial number `first`.
    pub fn feed_ahead(&self, first: u64) -> Option<usize> {
        let (_, spindle) = self.last_feed.filter(|(serial, _)| *serial >= first)?;
        Some(spindle)
    }

    /// How fast each spindle turns, turns a second.
    pub fn speeds(&self) -> [f64; SPINDLE_COUNT] {
        self.measured.map(|spindle| spindle.speed.abs())
    }

    /// Turns a second that feed per turn counts with where it follows this spindle; infinite where it follows none.
    pub fn feed_turns(&self, spindle: Option<usize>) -> f64 {
        let spindle = spindle.and_then(|number| self.measured.get(number));
        spindle.map_or(f64::INFINITY, |spindle| spindle.speed.abs())
    }

    /// What a move asks for at the present speed of its spindle, machine units per second; what it is planned for where that
    /// speed is no number.
    pub fn feed(&self, queued: &Move) -> f64 {
        let with = queued.synchronisation;
        let asked = with.map(|with| with.per_turn * self.feed_turns(Some(with.spindle)));
        asked
            .filter(|asked| asked.is_finite())
            .unwrap_or(queued.feed)
    }
}
