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

/// Whether external offsets stand, and are known: motion goes on from a place without them, and their velocity would turn
/// with the axes. With the machine off there are none: motion forgets them when it is switched on again.
pub fn offsets_stand(inputs: &FrameInputs) -> Result<(), FrameRefusal> {
    if inputs.enabled && inputs.offsets_move {
        Err(FrameRefusal::OffsetsMove)
    } else if inputs.enabled && inputs.unknown_offset {
        Err(FrameRefusal::UnknownOffset)
    } else {
        Ok(())
    }
}

/// Whether no joint jumps when the kinematics change.
pub fn same_joints(inputs: &FrameInputs) -> Result<(), FrameRefusal> {
    if inputs.other_joints {
        Err(FrameRefusal::OtherJoints)
    } else {
        offsets_stand(inputs)
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
