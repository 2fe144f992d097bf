//! One move as it lies in the queue.

use super::motion_type::MotionType;
use super::near_limit::NearLimit;
use super::outputs::SynchronisedOutputs;
use super::programmed_feed::FeedWord;
use super::shape::Shape;
use super::synchronisation::Synchronisation;
use super::tag::StateTag;
use super::termination::TerminationCondition;

/// Bit of [`Move::enables`]: the feed or rapid override applies to the move (M48, M50).
pub const FEED_OVERRIDE_ENABLED: u8 = 0x02;

/// One queued move.
#[derive(Clone, Copy, Debug)]
pub struct Move {
    /// LinuxCNC's number of the move, reported while it runs.
    pub id: i32,
    /// The interpreter's state when it issued the move.
    pub tag: StateTag,
    /// What the program meant by the move.
    pub motion_type: MotionType,
    /// Where it goes, with its length.
    pub shape: Shape,
    /// What the program asks for at an override of 100 %, units of the shape's measure per second.
    pub feed: f64,
    /// The F of the program, if it is one for a minute.
    pub feed_word: Option<FeedWord>,
    /// What no override may exceed, units of the shape's measure per second: LinuxCNC derives it
    /// from the velocity limits of the axes.
    pub max_velocity: f64,
    /// What the jerk of no axis may exceed in this move, units per second cubed; infinite where the axes' own limits do.
    pub axis_jerk: f64,
    /// Which overrides apply, LinuxCNC's bits (`FS_ENABLED` and its neighbours).
    pub enables: u8,
    /// Whether the move may only start with all spindles at speed.
    pub wait_for_spindle: bool,
    /// The spindle that the move follows, `None` where its feed is per minute.
    pub synchronisation: Option<Synchronisation>,
    /// The joint of a locking rotary indexer that has to be unlocked for the move.
    pub indexer_joint: Option<i32>,
    /// How the move meets the next one.
    pub termination: TerminationCondition,
    /// Which of its ends are near a soft limit.
    pub near_limit: NearLimit,
    /// What M62, M63 and M67 asked for since the move before: written once, when the move starts.
    pub outputs: SynchronisedOutputs,
}

impl Move {
    /// Whether the feed override, or the rapid override of a rapid move, applies.
    pub fn override_enabled(&self) -> bool {
        self.enables & FEED_OVERRIDE_ENABLED != 0
    }

    /// Which override of the operator scales it, of that of the feed and that of rapid moves; 1 where none does.
    pub fn override_of(&self, feed: f64, rapid: f64) -> f64 {
        if !self.override_enabled() {
            1.0
        } else if self.motion_type.is_rapid() {
            rapid
        } else {
            feed
        }
    }

    /// Whether it follows the angle of a spindle: a thread or a tap.
    pub fn follows_angle(&self) -> bool {
        self.synchronisation
            .is_some_and(|with| with.follows_angle())
    }

    /// How long it takes at its feed and 100 % from end to end, seconds: the least there may be.
    pub fn seconds_at_feed(&self) -> f64 {
        self.shape.length() / self.feed.min(self.max_velocity)
    }
}
