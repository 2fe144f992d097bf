//! How the joints of a machine of ours move, for blendtp: the frame in force and what is behind it in one.

use libc::{c_double, c_int};

use super::kinematics::{Kinematics, module};
use crate::axes::{AXIS_COUNT, Axes};
use crate::kinematics::Behind;

/// Three derivatives of the joints 0 to 8 for a position and its derivatives by the same parameter: nine numbers, three times
/// nine, and room for three times nine. 0, or -1 where the kinematics behind the frame are another module's.
///
/// # Safety
/// The arguments point to as many numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_jet(
    position: *const c_double,
    derivatives: *const c_double,
    joints: *mut c_double,
) -> c_int {
    // SAFETY: see above.
    let (Some(position), Some(derivatives), Some(out)) = (unsafe {
        (
            position.cast::<[f64; AXIS_COUNT]>().as_ref(),
            derivatives.cast::<[[f64; AXIS_COUNT]; 3]>().as_ref(),
            joints.cast::<[[f64; AXIS_COUNT]; 3]>().as_mut(),
        )
    }) else {
        return -1;
    };
    let Some(control) = module().control.as_ref() else {
        return -1;
    };
    let Some(machine) = control.behind().machine() else {
        return -1;
    };
    let (mut position, mut derivatives) = (Axes::from(*position), derivatives.map(Axes::from));
    if let Some(frame) = control.active() {
        position = frame.to_machine(&position);
        derivatives = derivatives.map(|derivative| frame.derivative_to_machine(&derivative));
    }
    let joints = machine.joint_derivatives(&position, &derivatives);
    *out = joints.map(<[f64; AXIS_COUNT]>::from);
    0
}

/// The axis that tilts the tool against the workpiece while C turns it, 3 for A, 4 for B, where the coordinates of the program
/// are those of its tip; -1 where they are not. Where the kinematics are another module's these are asked how they turn
/// the tool when the machine stands next: -1 until then, and where they do not tell.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_kinematics_tool_tilt_axis() -> c_int {
    let Kinematics {
        control: Some(control),
        position,
        joints,
        inner,
        normal,
        ..
    } = module()
    else {
        return -1;
    };
    let axis = match control.behind() {
        Behind::Own(machine) => machine.tool_tilt_axis(),
        Behind::Inner(_) => normal.tool_tilt_axis(control, position, joints, inner),
    };
    axis.map_or(-1, |axis| axis as c_int)
}

/// The axis of a machine of ours that a joint moves, 0 to 8, as its lamp on a panel says; -1 if there is none, or where the
/// kinematics are another module's.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_kinematics_axis_of_joint(joint: c_int) -> c_int {
    let machine = module()
        .control
        .as_ref()
        .and_then(|control| control.behind().machine());
    let axis = machine.and_then(|machine| {
        let joint = usize::try_from(joint).ok()?;
        machine.coordinates().axis_of_joint(joint)
    });
    axis.map_or(-1, |axis| axis as c_int)
}
