//! The kinematics of the process that drives a module: those of framekins, where joints have limits of their own.

use crate::joints::LimitedJoints;
use crate::loaded::stubs::HostKinematics;
use framepath::abi::linuxcnc::EmcPose;
use framepath::abi::pose::{axes_of, pose_of};
use framepath::axes::{AXIS_COUNT, Axes};
use framepath::machine::JOINT_COUNT;
use std::ffi::c_int;
use std::sync::OnceLock;

/// The joints of this process.
static JOINTS: OnceLock<LimitedJoints> = OnceLock::new();

/// What `stubs.c` hands on to modules.
static KINEMATICS: HostKinematics = HostKinematics {
    forward,
    inverse,
    jet,
    axis_of_joint,
    tool_tilt_axis,
};

/// The kinematics with these joints, of which a process has one.
pub(super) fn with(joints: &LimitedJoints) -> &'static HostKinematics {
    JOINTS.get_or_init(|| joints.clone());
    &KINEMATICS
}

unsafe extern "C" fn forward(joints: *const f64, world: *mut EmcPose) -> c_int {
    // SAFETY: what modules hand to kinematicsForward: as many joints as LinuxCNC has, and a pose.
    let (Some(machine), Some(joints), Some(world)) = (
        JOINTS.get(),
        unsafe { joints.cast::<[f64; JOINT_COUNT]>().as_ref() },
        unsafe { world.as_mut() },
    ) else {
        return -1;
    };
    let position = machine.position(joints, &axes_of(world));
    *world = pose_of(&position);
    match position.iter().all(|value| value.is_finite()) {
        true => 0,
        false => -1,
    }
}

unsafe extern "C" fn inverse(world: *const EmcPose, joints: *mut f64) -> c_int {
    // SAFETY: what modules hand to kinematicsInverse: a pose, and room for as many joints as LinuxCNC has.
    let (Some(machine), Some(world), Some(joints)) =
        (JOINTS.get(), unsafe { world.as_ref() }, unsafe {
            joints.cast::<[f64; JOINT_COUNT]>().as_mut()
        })
    else {
        return -1;
    };
    match machine.move_to(&axes_of(world), joints) {
        true => 0,
        false => -1,
    }
}

unsafe extern "C" fn jet(position: *const f64, derivatives: *const f64, joints: *mut f64) -> c_int {
    // SAFETY: what framekinsJet takes: nine numbers, three times nine, and room for as many.
    let (Some(machine), Some(position), Some(derivatives), Some(joints)) = (
        JOINTS.get(),
        unsafe { position.cast::<[f64; AXIS_COUNT]>().as_ref() },
        unsafe { derivatives.cast::<[[f64; AXIS_COUNT]; 3]>().as_ref() },
        unsafe { joints.cast::<[[f64; AXIS_COUNT]; 3]>().as_mut() },
    ) else {
        return -1;
    };
    let derivatives = derivatives.map(Axes::from);
    let Some(found) = machine.exact_derivatives(&Axes::from(*position), &derivatives) else {
        return -1;
    };
    *joints = found.map(<[f64; AXIS_COUNT]>::from);
    0
}

unsafe extern "C" fn axis_of_joint(joint: c_int) -> c_int {
    let axis = JOINTS.get().zip(usize::try_from(joint).ok());
    let axis = axis.and_then(|(machine, joint)| machine.axis(joint));
    axis.and_then(|axis| c_int::try_from(axis).ok())
        .unwrap_or(-1)
}

unsafe extern "C" fn tool_tilt_axis() -> c_int {
    let axis = JOINTS.get().and_then(|machine| machine.tool_tilt_axis);
    axis.and_then(|axis| c_int::try_from(axis).ok())
        .unwrap_or(-1)
}
