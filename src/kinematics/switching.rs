//! When kinematics may change.

use super::pins::FrameInputs;
use super::refusal::FrameRefusal;

/// Whether kinematics may change now.
pub fn standing(inputs: &FrameInputs) -> Result<(), FrameRefusal> {
    if inputs.teleop {
        Err(FrameRefusal::Teleop)
    } else if !inputs.in_position {
        Err(FrameRefusal::Moving)
    } else {
        Ok(())
    }
}

/// Whether no joint jumps when the kinematics change.
pub fn same_joints(inputs: &FrameInputs) -> Result<(), FrameRefusal> {
    if inputs.other_joints {
        Err(FrameRefusal::OtherJoints)
    } else {
        Ok(())
    }
}

/// Whether the frame may be removed now. With the machine off teleop mode is no obstacle: motion takes its position
/// from the kinematics when it is switched on again.
pub fn may_remove(inputs: &FrameInputs) -> Result<(), FrameRefusal> {
    standing(&FrameInputs {
        teleop: inputs.teleop && inputs.enabled,
        ..*inputs
    })
}
