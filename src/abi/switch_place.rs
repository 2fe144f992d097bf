//! Where motion goes on from behind a switch of the kinematics, as hal-component/external_offsets.h sees it.

use libc::{c_double, c_int};

use super::kinematics::module;
use super::linuxcnc::EmcPose;
use super::pose::{axes_of, pose_of};
use crate::axes::{AXIS_COUNT, Axes};

/// Where joints would jump behind a switch.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct framepath_place_jump {
    /// The first axis that does, in the order X Y Z A B C U V W, from 0.
    pub axis: c_int,
    /// Where that is, machine units or degrees.
    pub place: c_double,
    /// Where motion goes on from.
    pub goes_on: c_double,
}

/// Motion has switched and asked for the place of its joints: the external offsets are taken off what it is to give its
/// planner.
///
/// # Safety
/// `place` is the pose that motion asked with, `offsets` has nine numbers; or they are null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_take_offsets_off(
    place: *mut EmcPose,
    offsets: *const c_double,
) {
    // SAFETY: see above.
    let (Some(pose), Some(offsets)) = (unsafe {
        (
            place.as_mut(),
            offsets.cast::<[c_double; AXIS_COUNT]>().as_ref(),
        )
    }) else {
        return;
    };
    let switch_place = &mut module().switch_place;
    let without = switch_place.of_planner(place.addr(), &axes_of(pose), offsets);
    *pose = pose_of(&Axes::from(without));
}

/// Whether motion, which asks with this pose, goes on from another place than that of its joints behind a switch, and from
/// which one. An answer that fails has motion switch the machine off where it stands.
///
/// # Safety
/// `asked` is a pose, `jump` points to a structure of this header; or they are null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_jumps_behind_switch(
    asked: *const EmcPose,
    jump: *mut framepath_place_jump,
) -> c_int {
    // SAFETY: see above.
    let (Some(pose), Some(out)) = (unsafe { (asked.as_ref(), jump.as_mut()) }) else {
        return 0;
    };
    let switch_place = &mut module().switch_place;
    let Some(found) = switch_place.jump(asked.addr(), &axes_of(pose)) else {
        return 0;
    };
    *out = framepath_place_jump {
        axis: found.axis as c_int,
        place: found.place,
        goes_on: found.goes_on,
    };
    1
}

/// The period of a switch is over: from the next one on motion moves.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_kinematics_forget_switch() {
    module().switch_place.forget();
}
