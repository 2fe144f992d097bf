//! What framekins tells the operator, with the remedy.

use core::ffi::CStr;

use libc::{c_char, c_int};

use super::frame_pins::{FRAMEPATH_GUARD_LATE, FRAMEPATH_GUARD_LOST};
use crate::kinematics::FrameRefusal;

/// What the operator is told of an alarm.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_kinematics_alarm_text(alarm: c_int) -> *const c_char {
    match alarm {
        FRAMEPATH_GUARD_LATE => c"frame_guard has not been heard of for a second and a frame is active: the machine is held until it is",
        FRAMEPATH_GUARD_LOST => c"frame_guard does not live any more: the machine is switched off, and the frame is removed. Without a frame it can be moved by hand; start LinuxCNC again for frames",
        _ => c"no alarm",
    }
    .as_ptr()
}

/// The words for a refusal, with the remedy.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_kinematics_refusal_text(refusal: c_int) -> *const c_char {
    const WORDS: [(FrameRefusal, &CStr); 22] = [
        (FrameRefusal::UnknownCommand, c"there is no such command; use the subroutines of framepath"),
        (FrameRefusal::NotFinite, c"a value is infinite or not a number"),
        (FrameRefusal::ZeroScale, c"a scale factor is 0; use 1 for an axis that keeps its size"),
        (FrameRefusal::TranslationTooLarge, c"a shift is larger than a machine"),
        (FrameRefusal::TooManyOperations, c"more operations are added than there is room for; begin anew with TRANS, ROT, SCALE or MIRROR"),
        (FrameRefusal::ImpossibleAngles, c"no plane meets these two angles"),
        (FrameRefusal::Singular, c"the frame is singular: it flattens space, so that no position could be found back"),
        (FrameRefusal::IllConditioned, c"the scales of the frame are too unequal"),
        (FrameRefusal::ScaleOutOfRange, c"the frame enlarges or shrinks more than a thousandfold"),
        (FrameRefusal::Moving, c"the machine moves; wait for the end of the motion"),
        (FrameRefusal::Teleop, c"motion is in teleop mode, where a switch would make the joints jump; leave it first"),
        (FrameRefusal::NotSwitched, c"motion did not switch; link framekins.switchkins-type to motion.switchkins-type"),
        (FrameRefusal::UnknownType, c"motion.switchkins-type has to be 0, 1 or 2, with inner= 16 times that and the type of the inner kinematics"),
        (FrameRefusal::MissingAxis, c"the frame moves an axis that the machine does not have; see coordinates= of framekins, behind inner= the axes that its kinematics move"),
        (FrameRefusal::MachineParameters, c"a dimension of the machine is not a number or larger than a machine; see the pins framekins.x-rot-point and those beside it"),
        (FrameRefusal::WrongCheck, c"the values that have arrived are not those that were sent: a net from an analog output to framekins is missing or wrong, such as net frame-check motion.analog-out-08 => framekins.check; compare with the HAL file of a sample"),
        (FrameRefusal::Unguarded, c"frame_guard does not live, and nobody would remove the frame: load it in the HAL file, loadusr -Wn frame-guard .../frame_guard.py"),
        (FrameRefusal::UnknownInnerType, c"framekins.inner-type is no type of the kinematics of inner=; what is linked to it, M68 for one, has to say a whole number from 0 that they can be switched to"),
        (FrameRefusal::OtherJoints, c"the kinematics of inner= lead back from where the machine is to other joints, which would jump: go where they do not, an arm with its wrist bent, maxkins with B or C at 0, and give the command again"),
        (FrameRefusal::Suspended, c"the frame is suspended, and this command would add to it: o<frame_resume> call brings it back first, o<frame_off> call gives it up"),
        (FrameRefusal::OffsetsMove, c"an external offset (axis.L.eoffset) moves the axes, which would turn under it: wait until it stands, with G4; one that never stands (height control) has to be held, or taken away first"),
        (FrameRefusal::UnknownOffset, c"a pin framekins.external-offset.L is not the external offset of its axis, and the joints would jump by the difference"),
    ];
    WORDS
        .iter()
        .find(|(known, _)| *known as c_int == refusal)
        .map_or(c"refused".as_ptr(), |(_, words)| words.as_ptr())
}
