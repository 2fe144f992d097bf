//! Motion that follows a spindle: threads (G33, G76), rigid taps (G33.1), feed per turn (G95).
//!
//! Feed per turn is a cap of the feed. In threads and taps the machine has to be where the angle of
//! the spindle says: the reference is planned as fast as the axes allow, and the executor runs it
//! no faster than the spindle turns, with what is missing in position made up for.

mod error;
mod follower;
mod following;
mod lead_in;
mod move_at_hand;
mod spindle_command;
mod start;
mod tap;
mod tapping;
mod thread;
mod tracker;

pub use error::SpindleError;
pub(super) use follower::SpindleFollower;
pub(super) use move_at_hand::MoveAtHand;
pub(super) use spindle_command::SpindleCommand;
pub(super) use tap::way_down;
pub(super) use tapping::Way;
