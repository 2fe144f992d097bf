//! How fast a shape may be run, and the fastest run from rest to rest.

mod limits;
pub mod look_ahead;
mod profile;
mod ramp;

pub use limits::PathLimits;
pub use profile::{JerkLimitedProfile, ProfileState};
