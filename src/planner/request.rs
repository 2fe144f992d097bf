//! A request for a move, and what becomes of it.

use crate::moves::{MotionType, StateTag};
use crate::path::ShapeError;

/// What comes with a move besides its shape.
#[derive(Clone, Copy, Debug)]
pub struct MoveRequest {
    /// What the program meant by the move.
    pub motion_type: MotionType,
    /// What the program asks for, units per second, positive.
    pub feed: f64,
    /// What no override may exceed, units per second, positive.
    pub max_velocity: f64,
    /// Which overrides apply, LinuxCNC's bits (`FS_ENABLED` and its neighbours).
    pub enables: u8,
    /// Whether the move may only start with all spindles at speed.
    pub wait_for_spindle: bool,
    /// The joint of a locking rotary indexer that the move turns. Refused so far.
    pub indexer_joint: Option<i32>,
    /// The interpreter's state when it issued the move.
    pub tag: StateTag,
}

/// What became of a move that was not refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Added {
    /// It is in the queue.
    Queued,
    /// It goes nowhere and was dropped. The synchronised outputs given for it wait for the next
    /// move.
    ZeroLength,
}

/// Why a move was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AddError {
    /// The machine is coming to rest after an abort.
    Aborting,
    /// The queue and its margin are full.
    QueueFull,
    /// The duration of a servo period has not been set.
    NotConfigured,
    /// An axis is to move that has no usable limits: one of them is zero, negative or not a
    /// number, or they have never been set.
    AxisLimits {
        /// Index of the axis.
        axis: usize,
    },
    /// The move has no usable shape.
    Shape(ShapeError),
    /// The feed or its greatest value is zero, negative or not finite.
    Feed {
        /// What was asked for, units per second.
        feed: f64,
        /// Its greatest value, units per second.
        max_velocity: f64,
    },
    /// Motion synchronised with a spindle (G33, G76, G95, G96 with feed per turn) is not
    /// supported yet.
    SpindleSynchronised,
    /// Rigid tapping (G33.1) is not supported yet.
    RigidTap,
    /// A locking rotary indexer is not supported yet.
    Indexer {
        /// The joint that was to be unlocked.
        joint: i32,
    },
}
