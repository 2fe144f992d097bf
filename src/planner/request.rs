//! A request for a move, and what becomes of it.

use crate::moves::shape::ShapeError;
use crate::moves::{MotionType, StateTag};

/// Feeds and limits of velocity from here on are taken, units per second: with less a micrometre takes more than a quarter
/// of an hour, and times overflow.
pub const LEAST_VELOCITY: f64 = 1e-9;

/// Limits of acceleration from here on are taken, units per second squared.
pub const LEAST_ACCELERATION: f64 = 1e-3;

/// What of velocity, acceleration and jerk is taken for a limit from here on, units per second, second squared and cubed. A
/// jerk that reaches the acceleration in a time that makes sense is never as small.
pub(super) const LEAST_LIMITS: [f64; 3] = [LEAST_VELOCITY, LEAST_ACCELERATION, 1e-4];

/// What comes with a move besides its shape.
#[derive(Clone, Copy, Debug)]
pub struct MoveRequest {
    /// What the program meant by the move.
    pub motion_type: MotionType,
    /// What the program asks for, units per second, positive.
    pub feed: f64,
    /// What no override may exceed, units per second, positive.
    pub max_velocity: f64,
    /// What LinuxCNC lets the jerk along the path be, units per second cubed, positive; infinite where it does not say.
    pub path_jerk: f64,
    /// Which overrides apply, LinuxCNC's bits (`FS_ENABLED` and its neighbours).
    pub enables: u8,
    /// Whether the move may only start with all spindles at speed.
    pub wait_for_spindle: bool,
    /// The joint of a locking rotary indexer that has to be unlocked for the move.
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
    /// An axis is to move that has no usable limits: one of them is next to zero or not a number,
    /// or they have never been set.
    AxisLimits {
        /// Index of the axis.
        axis: usize,
    },
    /// The move has no usable shape.
    Shape(ShapeError),
    /// The feed or its greatest value is less than 1e-9 or not finite.
    Feed {
        /// What was asked for, units per second.
        feed: f64,
        /// Its greatest value, units per second.
        max_velocity: f64,
    },
    /// The limit of jerk that came with the move is not positive, or an axis would take more than 5 s to its acceleration.
    PathJerk(f64),
    /// A move is to follow a spindle that the motion controller cannot have.
    Spindle {
        /// Number of the spindle.
        spindle: i32,
    },
    /// The feed per turn or pitch is negative or not finite.
    PerTurn(f64),
    /// A thread or a rigid tap along a way that the frame in force makes longer or shorter: so would be its pitch.
    ScaledPitch,
    /// A rigid tap that does not follow the angle of a spindle, or whose factor for the way back is
    /// not positive and finite.
    RigidTap,
    /// An error has stopped the motion, and nothing has been aborted since.
    Tripped,
}
