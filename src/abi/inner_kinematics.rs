//! The kinematics of another module behind the frame: framekins.c looks its functions up, and hands them over here.

use libc::{c_char, c_double, c_int, c_ulong};

use super::frame_pins::framepath_frame_inputs;
use super::inner::{Calls, InnerModule};
use super::inner_normal::AskedNormal;
use super::kinematics::{
    FRAMEPATH_UNKNOWN_TOOL_AXES, FRAMEPATH_UNKNOWN_TOOL_TYPES, Kinematics, joints_of,
    joints_of_mut, module, parameter,
};
use super::linuxcnc::EmcPose;
use super::pose::{axes_of, pose_of};
use crate::axes::Axes;
use crate::frame::{ActiveFrame, ToolLength};
use crate::kinematics::control::FrameControl;
use crate::kinematics::inner::{self, Guess, InnerType};
use crate::kinematics::tool_jump::ToolJump;
use crate::kinematics::{Behind, ToolAxes};
use crate::machine::JOINT_COUNT;

/// Chooses the kinematics of another module in place of a machine: `tool_types` is a list of their types that turn the
/// tool's length themselves, empty if none do; `tool_axes` says how they turn the tool, empty if they are to be asked. Returns
/// 0, or an error for `framepath_kinematics_configure_text`.
///
/// # Safety
/// The texts are strings or null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_configure_inner(
    tool_types: *const c_char,
    tool_axes: *const c_char,
) -> c_int {
    // SAFETY: see above.
    let (types, axes) = unsafe { (parameter(tool_types), parameter(tool_axes)) };
    let Some(types) = inner::tool_types(types) else {
        return FRAMEPATH_UNKNOWN_TOOL_TYPES;
    };
    let Some(said) = ToolAxes::from_text(axes) else {
        return FRAMEPATH_UNKNOWN_TOOL_AXES;
    };
    let module = module();
    module.tool_length = ToolLength::Frame;
    module.inner = InnerModule::NONE;
    module.given = None;
    module.tool_jump = ToolJump::new();
    module.forget_asked();
    module.normal = AskedNormal::with(said);
    module.control = Some(FrameControl::new(Behind::Inner(InnerType::first(types))));
    0
}

/// The functions of the other module, which has type 0 now; null for `switch` if it cannot be switched. 0, or -1 if it
/// cannot and `tool_types` names another type: then nothing is taken.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_kinematics_inner_functions(
    inverse: Option<
        unsafe extern "C" fn(*const EmcPose, *mut c_double, *const c_ulong, *mut c_ulong) -> c_int,
    >,
    forward: Option<
        unsafe extern "C" fn(*const c_double, *mut EmcPose, *const c_ulong, *mut c_ulong) -> c_int,
    >,
    switch: Option<unsafe extern "C" fn(c_int) -> c_int>,
) -> c_int {
    let module = module();
    let behind = module.control.as_ref().map(FrameControl::behind);
    if let (None, Some(Behind::Inner(kind))) = (switch, behind)
        && kind.has_other_tool_types()
    {
        return -1;
    }
    module.inner = InnerModule {
        inverse,
        forward,
        switch,
    };
    0
}

/// Before motion looks at `motion.switchkins-type`, where the type on the pin is another one than that in force: what to
/// write to `framekins.switchkins-type`, so that motion switches in this very period, as it would without framekins.
///
/// # Safety
/// `pins` points to the values of the pins.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_take_inner_type(
    pins: *const framepath_frame_inputs,
) -> c_int {
    // SAFETY: see above.
    let Some(pins) = (unsafe { pins.as_ref() }) else {
        return 0;
    };
    let inputs = module().inputs(pins);
    let control = module().control.as_mut();
    control.map_or(0, |control| control.take_inner_type(&inputs))
}

/// A question to the other module, with flags as LinuxCNC hands them over: keeps the axes and the joints that it comes to,
/// and gives back the flags and what the module returned.
fn ask(
    forward_flags: c_ulong,
    inverse_flags: c_ulong,
    question: impl FnOnce(
        Option<&ActiveFrame>,
        &mut Calls,
        Guess<'_>,
    ) -> (Axes, [f64; JOINT_COUNT], c_int),
) -> Option<(Calls, c_int)> {
    let Kinematics {
        control: Some(control),
        position,
        joints,
        inner,
        old_guesses,
        ..
    } = module()
    else {
        return None;
    };
    let mut calls = Calls {
        module: *inner,
        forward_flags,
        inverse_flags,
    };
    let last = Axes::from(*position);
    let guess = if control.active().is_some() || *old_guesses > 0 {
        Guess::At(&last)
    } else {
        Guess::Before
    };
    let (axes, found, result) = question(control.active(), &mut calls, guess);
    (*position, *joints) = (axes.into(), found);
    Some((calls, result))
}

/// The pose for joint positions, from a guess at it, with the flags of `kinematicsForward`. What the other module returns;
/// -1 if there is none.
///
/// # Safety
/// `joints` has 16 numbers, `world` is a pose, the flags are numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_inner_forward(
    joints: *const c_double,
    world: *mut EmcPose,
    forward_flags: *const c_ulong,
    inverse_flags: *mut c_ulong,
) -> c_int {
    // SAFETY: see above.
    let (Some(joints), Some(world), Some(read), Some(written)) = (unsafe {
        (
            joints_of(joints),
            world.as_mut(),
            forward_flags.as_ref(),
            inverse_flags.as_mut(),
        )
    }) else {
        return -1;
    };
    let mut pose = axes_of(world);
    let answer = ask(*read, *written, |frame, calls, guess| {
        let (axes, result) = inner::forward(frame, calls, joints, guess, &mut pose);
        (axes, *joints, result)
    });
    let Some((calls, result)) = answer else {
        return -1;
    };
    *world = pose_of(&pose);
    *written = calls.inverse_flags;
    module().old_guesses = module().old_guesses.saturating_sub(1);
    result
}

/// The joint positions for a pose, from the joints of before, with the flags of `kinematicsInverse`. What the other module
/// returns; -1 if there is none.
///
/// # Safety
/// `world` is a pose, `joints` has 16 numbers, the flags are numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_inner_inverse(
    world: *const EmcPose,
    joints: *mut c_double,
    inverse_flags: *const c_ulong,
    forward_flags: *mut c_ulong,
) -> c_int {
    // SAFETY: see above.
    let (Some(world), Some(joints), Some(read), Some(written)) = (unsafe {
        (
            world.as_ref(),
            joints_of_mut(joints),
            inverse_flags.as_ref(),
            forward_flags.as_mut(),
        )
    }) else {
        return -1;
    };
    let answer = ask(*written, *read, |frame, calls, _| {
        let mut axes = axes_of(world);
        let result = inner::inverse(frame, calls, &mut axes, joints);
        (axes, *joints, result)
    });
    let Some((calls, result)) = answer else {
        return -1;
    };
    *written = calls.forward_flags;
    module().asked = Some(axes_of(world).into());
    module().given = Some((module().position, module().joints));
    result
}
