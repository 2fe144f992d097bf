//! How fast a shape may be run, and the fastest run from rest to rest.

mod derivative_bounds;
mod limits;
pub mod look_ahead;
mod path_limits;
mod profile;
mod profile_state;
mod ramp;

pub use derivative_bounds::DerivativeBounds;
pub use path_limits::PathLimits;
pub use profile::JerkLimitedProfile;
pub use profile_state::ProfileState;
