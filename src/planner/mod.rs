//! The planner as LinuxCNC's motion controller sees it: moves are added, and each servo period
//! one [`Planner::cycle`] says where the machine is to be.
//!
//! Three parts work one behind the other, and only the first knows what the motion between two
//! moves looks like:
//!
//! 1. the reference ([`reference`]): a trajectory through the queued moves that keeps all limits
//!    and ends at rest;
//! 2. the executor ([`crate::cycle`]): runs the reference with a time of its own, for feed hold,
//!    override, abort;
//! 3. the bookkeeping ([`Planner`]): which move runs, what is reported, what is written.

mod blending;
mod direction;
mod error_stop;
mod holding;
mod indexer;
mod inputs;
mod jerk_limit;
mod machine_axes;
mod motion_state;
mod move_jerk;
mod next_move;
#[allow(clippy::module_inception)]
mod planner;
pub mod range;
pub mod reference;
mod request;
mod servo;
mod soft_limits;
mod speed_limit;
mod spindle;
mod status;
mod stepping;
mod survey;
mod surveying;
mod velocity_slider;
mod with_spindle;

pub use blending::{Blending, BlendingError};
pub use direction::DirectionError;
pub use inputs::{CycleInputs, SpindleInputs};
pub use jerk_limit::JerkLimit;
pub use planner::{Planner, PositionError};
pub use request::{AddError, Added, LEAST_ACCELERATION, LEAST_VELOCITY, MoveRequest};
pub use speed_limit::{Quantity, SpeedLimit};
pub use spindle::SpindleError;
pub use status::{Fault, Status};
pub use survey::Survey;
