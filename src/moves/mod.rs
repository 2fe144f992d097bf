//! What LinuxCNC queues: moves with their shape, feed, flags and synchronised outputs.

mod motion_type;
mod near_limit;
mod outputs;
mod programmed_feed;
mod queue;
mod queued_move;
pub mod shape;
mod synchronisation;
mod tag;
mod termination;

pub use motion_type::MotionType;
pub use near_limit::NearLimit;
pub use outputs::{OUTPUT_COUNT, SynchronisedOutputs};
pub use programmed_feed::{FeedWord, INCHES, INVERSE_TIME, ProgrammedFeed, UNITS_PER_MINUTE};
pub use queue::{CAPACITY, MoveQueue, QueueFull};
pub use queued_move::{FEED_OVERRIDE_ENABLED, Move};
pub use synchronisation::{SPINDLE_COUNT, Synchronisation, SynchronisationMode};
pub use tag::{STATE_TAG_SIZE, StateTag};
pub use termination::TerminationCondition;
