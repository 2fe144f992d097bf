//! What framekins does in each servo period: commands for the frame, the checks of them, the switch
//! from one frame to the next, and where the rotary axes have to go for the tool to stand normal to
//! a frame. [`crate::frame`] says what a frame is, [`crate::machine`] where the joints are, unless the
//! kinematics of another module do ([`inner`]).

pub mod behind;
pub mod check;
pub mod command;
pub mod control;
pub mod expected;
pub mod head_circles;
pub mod heartbeat;
pub mod inner;
pub mod inner_normal;
pub mod inner_tool;
pub mod offset_motion;
pub mod pins;
pub mod refusal;
pub mod release;
pub mod request;
pub mod retraction;
pub mod rotary_chain;
pub mod staged;
pub mod switch_place;
pub mod switching;
pub mod tool_angles;
pub mod tool_axes;
pub mod tool_jump;
pub mod tool_normal;

pub use behind::Behind;
pub use inner::{InnerKinematics, InnerType};
pub use inner_normal::inner_normal;
pub use refusal::FrameRefusal;
pub use retraction::{Retraction, RetractionError};
pub use rotary_chain::{RotaryAxis, RotaryChain};
pub use tool_angles::{AngleRange, OrientationError, RotaryAngles, tool_angles};
pub use tool_axes::ToolAxes;
pub use tool_normal::{RotaryLimits, ToolNormalError, tool_normal};
