//! Which spindle a move follows, and how.

/// How many spindles LinuxCNC's motion controller has at most.
pub const SPINDLE_COUNT: usize = 8;

/// What a move does with a spindle. Lengths are units of the move's measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Synchronisation {
    /// Number of the spindle, below [`SPINDLE_COUNT`].
    pub spindle: usize,
    /// How far the move goes in a turn of the spindle, positive.
    pub per_turn: f64,
    /// What of the spindle it follows.
    pub mode: SynchronisationMode,
}

/// What of the spindle a move follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SynchronisationMode {
    /// Its speed: feed per turn (G95).
    Speed,
    /// Its angle, counted from the index: a thread (G33, G76).
    Thread {
        /// Turns of the spindle from the start of the first thread of an unbroken sequence to the
        /// start of this one.
        turns_before: f64,
    },
    /// Its angle, to the end and back: a rigid tap (G33.1).
    Tap {
        /// The spindle turns back faster than it went, by this factor.
        reversal_scale: f64,
    },
}

impl Synchronisation {
    /// What feed per turn is planned for, over what the spindle is expected to do.
    pub const RESERVE: f64 = 2.2;

    /// Whether the move follows the angle of the spindle.
    pub fn follows_angle(&self) -> bool {
        !matches!(self.mode, SynchronisationMode::Speed)
    }
}
