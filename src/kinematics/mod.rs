//! What framekins does in each servo period: commands for the frame, the checks of them, the switch
//! from one frame to the next, and where the rotary axes have to go for the tool to stand normal to
//! a frame. [`crate::frame`] says what a frame is, [`crate::machine`] where the joints are.

pub mod check;
pub mod command;
pub mod control;
pub mod heartbeat;
pub mod pins;
pub mod refusal;
pub mod release;
pub mod tool_angles;
pub mod tool_normal;

pub use refusal::FrameRefusal;
pub use tool_angles::{AngleRange, OrientationError, RotaryAngles, tool_angles};
pub use tool_normal::{RotaryLimits, ToolNormalError, tool_normal};
