//! Motion that follows a spindle: threads (G33, G76), rigid taps (G33.1), feed per turn (G95).
//!
//! Feed per turn is a cap of the feed. In threads and taps the machine has to be where the angle of
//! the spindle says: the reference is planned as fast as the axes allow, and the executor runs it
//! no faster than the spindle turns, with what is missing in position made up for.

mod command;
mod error;
mod following;
mod lead_in;
mod spindle_command;
mod tap;
mod tapping;
mod thread;
mod tracker;

pub use error::SpindleError;
pub(super) use spindle_command::SpindleCommand;
pub(super) use thread::Thread;
pub(super) use tracker::Tracker;
