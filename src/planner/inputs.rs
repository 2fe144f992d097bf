//! What the planner has to know anew in each servo period.

use crate::moves::SPINDLE_COUNT;

/// What the motion controller says of a spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpindleInputs {
    /// Angle in turns, with the sign of the encoder: counted from the index after an index was
    /// asked for.
    pub turns: f64,
    /// Measured speed, turns a second.
    pub speed: f64,
    /// The greatest speed that is commanded, turns a second, 0 and above. With constant surface
    /// speed (G96) the speed comes up to it as the diameter shrinks.
    pub commanded: f64,
    /// Whether the spindle is commanded to turn in reverse (M4).
    pub reverse: bool,
    /// Whether an index was asked for and has not been seen yet.
    pub awaits_index: bool,
}

impl SpindleInputs {
    /// A spindle that stands.
    pub const STANDSTILL: Self = Self {
        turns: 0.0,
        speed: 0.0,
        commanded: 0.0,
        reverse: false,
        awaits_index: false,
    };
}

/// Live values of one servo period. All factors are 0 and above, 1 for 100 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CycleInputs {
    /// The operator's feed override.
    pub feed_scale: f64,
    /// The operator's rapid override.
    pub rapid_scale: f64,
    /// The motion controller's product of everything that scales the running move: feed or rapid
    /// override, adaptive feed, and 0 for feed hold or inhibit. LinuxCNC computes it from the
    /// motion type and the enables that were reported in the last cycle.
    pub net_feed_scale: f64,
    /// Whether the motion controller runs a single move and will pause when the id changes.
    pub stepping: bool,
    /// Whether all spindles are at speed.
    pub spindles_at_speed: bool,
    /// Each spindle, those that do not exist stand still.
    pub spindles: [SpindleInputs; SPINDLE_COUNT],
    /// Whether the locking indexer of [`Planner::indexer_joint`](super::Planner::indexer_joint) is
    /// unlocked.
    pub indexer_unlocked: bool,
}

impl Default for CycleInputs {
    /// Everything at 100 %, nothing to wait for.
    fn default() -> Self {
        Self {
            feed_scale: 1.0,
            rapid_scale: 1.0,
            net_feed_scale: 1.0,
            stepping: false,
            spindles_at_speed: true,
            spindles: [SpindleInputs::STANDSTILL; SPINDLE_COUNT],
            indexer_unlocked: false,
        }
    }
}
