//! The machine's own kinematics: axes to joints and back.
//!
//! What stands behind the programmable frame. A [`Machine`] is chosen once, from the parameters of
//! the module; its transforms run in the servo thread, cannot fail and keep no state.

pub mod configuration;
pub mod coordinates;
pub mod identity;
mod jet;
mod joints;
#[allow(clippy::module_inception, reason = "the type that the folder is about")]
mod machine;
mod table_jet;
pub mod table_tilting;

pub use configuration::ConfigurationError;
pub use coordinates::{Coordinates, CoordinatesError};
pub use identity::Identity;
pub use joints::JOINT_COUNT;
pub use machine::Machine;
pub use table_tilting::{RotaryDirection, TableTilting, TableTiltingParameters, TiltAxis};
