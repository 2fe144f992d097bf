//! The reference: a trajectory through the queued moves, in a time of its own that starts at 0.
//!
//! ```text
//! queue -> feeder -> blended path -> run (look-ahead, or a single move) -> segments -> cells
//! ```
//!
//! What is always true of it: it keeps the limits of the axes; what it has handed out as cells
//! never changes; and wherever the queue ends it comes to rest, so that the executor can finish
//! what it was given whether or not more moves arrive.

mod backwards;
mod bulge;
mod cell_builder;
mod coast;
mod creep;
mod handing_out;
mod last_resort;
mod move_feeder;
mod outlook;
mod path_route;
mod progress;
#[allow(clippy::module_inception, reason = "the type that the folder is about")]
mod reference;
mod reference_segment;
mod rest_to_rest;
mod return_route;
mod running_move;
mod runs;
mod single_move;
mod step_by_step;
mod supply_depth;
mod time_ahead;

pub use outlook::{Conditions, Outlook};
pub use reference::{Ahead, Reference, ReferencePoint, Rest};
pub use time_ahead::{PlaceInMoves, TimeAhead};
