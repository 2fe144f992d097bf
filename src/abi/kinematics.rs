//! The kinematics as hal-component/framekins.c sees them.
//!
//! Static memory, one machine in a module. LinuxCNC calls `configure` while the module is loaded, and everything else
//! from the servo thread: the HAL function of the module has to be in the same thread as motion-controller.

use core::cell::UnsafeCell;
use core::ffi::CStr;

use libc::{c_char, c_double, c_int, c_longlong, c_uint};

use nalgebra::Vector3;

use super::linuxcnc::EmcPose;
use super::pose::{axes_of, pose_of};
use crate::axes::{AXIS_COUNT, Axes};
use crate::frame::{AffineMap, ToolLength};
use crate::kinematics::control::{FrameControl, FrameInputs, FrameOutputs};
use crate::kinematics::heartbeat::Guard;
use crate::kinematics::{AngleRange, RotaryLimits, tool_normal};
use crate::machine::{
    ConfigurationError, CoordinatesError, JOINT_COUNT, Machine, RotaryDirection,
    TableTiltingParameters, TiltAxis,
};

/// Errors of `framepath_kinematics_configure`: `coordinates=` names no axis.
pub const FRAMEPATH_NO_AXIS: c_int = 1;
/// `coordinates=` has a letter that is no axis.
pub const FRAMEPATH_UNKNOWN_AXIS: c_int = 2;
/// `coordinates=` has more letters than LinuxCNC has joints.
pub const FRAMEPATH_TOO_MANY_JOINTS: c_int = 3;
/// `coordinates=` leaves out an axis that the machine needs.
pub const FRAMEPATH_MISSING_AXIS: c_int = 4;
/// There is no such `machine=`.
pub const FRAMEPATH_UNKNOWN_MACHINE: c_int = 5;
/// There is no such `tool_length=`.
pub const FRAMEPATH_UNKNOWN_TOOL_LENGTH: c_int = 6;
/// Alarm: the guard is late with a frame in force, and the machine is held.
pub const FRAMEPATH_GUARD_LATE: c_int = 1;
/// Alarm: the guard is lost with a frame in force, and the machine is switched off.
pub const FRAMEPATH_GUARD_LOST: c_int = 2;

/// What is read from the pins in each servo period. Lengths in machine units, angles in degrees.
#[repr(C)]
pub struct framepath_frame_inputs {
    /// Number of the command times 1000, plus its code.
    pub command: c_double,
    /// Values of the command.
    pub value: [c_double; 3],
    /// Work offset in X Y Z.
    pub work_offset: [c_double; 3],
    /// Rotation of the work offset about Z.
    pub work_rotation: c_double,
    /// Tool offset in X Y Z.
    pub tool_offset: [c_double; 3],
    /// The tool's length stays along the machine's axes in a frame: 0 or 1.
    pub tool_length_machine: c_int,
    /// Table: where its rotary axis is.
    pub rotation_point: [c_double; 3],
    /// Table: from there to the tilting axis.
    pub offset: [c_double; 3],
    /// Table: length of the tool along Z.
    pub table_tool_offset: c_double,
    /// Table: positive angles turn the tool relative to the workpiece: 0 or 1.
    pub conventional_directions: c_int,
    /// Table: X Y Z are to be the tool centre point on the turning workpiece: 0 or 1.
    pub tool_centre_point: c_int,
    /// Smallest and greatest angle of the tilting axis.
    pub tilt_range: [c_double; 2],
    /// Smallest and greatest angle of the rotary axis C.
    pub rotary_range: [c_double; 2],
    /// A ready frame: three rows of a 3x4 map.
    pub map: [c_double; 12],
    /// Which of A B C U V W are mirrored: 0 or 1.
    pub mirror: [c_int; 6],
    /// Motion stands still: 0 or 1.
    pub in_position: c_int,
    /// Motion is in teleop mode: 0 or 1.
    pub teleop: c_int,
    /// The sum over the command, its values and the work offset that was sent with them.
    pub check: c_double,
    /// The machine is switched on: 0 or 1.
    pub enabled: c_int,
    /// An abort and machine off remove the frame: 0 or 1.
    pub release_on_abort: c_int,
    /// The guard wants the frame removed: 0 or 1.
    pub release: c_int,
    /// How many of `releases` the guard has told the interpreter of.
    pub releases_seen: c_int,
    /// Changes while the guard lives; 0: it has never lived.
    pub heartbeat: c_uint,
    /// The servo period, s.
    pub period: c_double,
    /// A clock that runs on, ns.
    pub clock: c_longlong,
}

/// What is written to the pins after each servo period.
#[repr(C)]
pub struct framepath_frame_outputs {
    /// The kinematics type that motion is asked for.
    pub switchkins_type: c_double,
    /// Number of the last command that was carried out or refused.
    pub acknowledged: c_double,
    /// Whether a frame is active: 0 or 1.
    pub active: c_int,
    /// Kinematics type in effect.
    pub slot: c_int,
    /// How many operations make up the frame.
    pub operations: c_int,
    /// The tool centre point is on: 0 or 1.
    pub tool_centre_point: c_int,
    /// The dimensions of the table, or the tool centre point asked for, are not those in effect: 0 or 1.
    pub parameters_pending: c_int,
    /// The tool offset in X Y Z that the frame was made with.
    pub tool_offset: [c_double; 3],
    /// Why the last command was refused; 0 if it was not.
    pub refusal: c_int,
    /// Why the tool cannot be put normal to the frame; 0 if it can.
    pub normal_refusal: c_int,
    /// Where the tilting axis has to go for that.
    pub normal_tilt: c_double,
    /// Where the rotary axis C has to go for that.
    pub normal_rotary: c_double,
    /// The frame has to go and cannot yet: 0 or 1.
    pub releasing: c_int,
    /// How often a frame was removed without a command while a guard lived.
    pub releases: c_int,
    /// Nothing may be moved: 0 or 1.
    pub hold: c_int,
    /// The machine may be on: 0 or 1.
    pub guarded: c_int,
    /// How far a guard that is missed has brought it: 0, or one of the alarms above.
    pub alarm: c_int,
    /// Where the tip of the tool is with the frame, for where it would be without: three rows of a 3x4 map.
    pub frame: [c_double; 12],
    /// The machine's axes behind the frame. With the tool centre point on these are coordinates of the workpiece.
    pub position: [c_double; 9],
    /// From the tip of the tool to the position of the axes, X Y Z.
    pub turned_tool: [c_double; 3],
}

/// The machine of the module.
struct Kinematics {
    control: Option<FrameControl>,
    /// What `tool_length=` says.
    tool_length: ToolLength,
    /// The machine's axes as motion asked for them last.
    position: [f64; AXIS_COUNT],
}

/// Memory for the one machine of a module.
struct KinematicsMemory(UnsafeCell<Kinematics>);

// SAFETY: LinuxCNC calls the kinematics from one thread at a time, see the head of this file.
unsafe impl Sync for KinematicsMemory {}

static MEMORY: KinematicsMemory = KinematicsMemory(UnsafeCell::new(Kinematics {
    control: None,
    tool_length: ToolLength::Frame,
    position: [0.0; AXIS_COUNT],
}));

/// The machine of the module.
fn module() -> &'static mut Kinematics {
    // SAFETY: one thread at a time, and no function of this file hands the reference on or calls another one with it.
    unsafe { &mut *MEMORY.0.get() }
}

fn inputs_of(pins: &framepath_frame_inputs, tool_length: ToolLength) -> FrameInputs {
    FrameInputs {
        command: pins.command,
        value: pins.value,
        work_offset: pins.work_offset,
        work_rotation: pins.work_rotation,
        tool_offset: pins.tool_offset,
        tool_length: if pins.tool_length_machine != 0 {
            ToolLength::Machine
        } else {
            tool_length
        },
        map: pins.map,
        mirror: pins.mirror.map(|mirrored| mirrored != 0),
        table: TableTiltingParameters {
            rotation_point: Vector3::from(pins.rotation_point),
            offset: Vector3::from(pins.offset),
            tool_offset: pins.table_tool_offset,
            direction: if pins.conventional_directions != 0 {
                RotaryDirection::Conventional
            } else {
                RotaryDirection::Table
            },
            tool_centre_point: pins.tool_centre_point != 0,
        },
        in_position: pins.in_position != 0,
        teleop: pins.teleop != 0,
        check: pins.check,
        enabled: pins.enabled != 0,
        release_on_abort: pins.release_on_abort != 0,
        release: pins.release != 0,
        releases_seen: pins.releases_seen,
        heartbeat: pins.heartbeat,
        period: pins.period,
        clock: pins.clock,
    }
}

/// The alarm of a guard that is missed while a frame is in force.
fn alarm_of(outputs: &FrameOutputs) -> c_int {
    match outputs.guard {
        Guard::Late if outputs.active => FRAMEPATH_GUARD_LATE,
        Guard::Lost if outputs.active => FRAMEPATH_GUARD_LOST,
        _ => 0,
    }
}

/// The rows of a map one behind the other.
fn in_one_row(
    [[xx, xy, xz, x], [yx, yy, yz, y], [zx, zy, zz, z]]: [[f64; 4]; 3],
) -> [c_double; 12] {
    [xx, xy, xz, x, yx, yy, yz, y, zx, zy, zz, z]
}

/// What a pin shows that operators read: without a frame nothing looks at what comes in.
fn shown(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

fn limits_of(pins: &framepath_frame_inputs) -> RotaryLimits {
    let [tilt, rotary] =
        [pins.tilt_range, pins.rotary_range].map(|[min, max]| AngleRange { min, max });
    RotaryLimits { tilt, rotary }
}

/// The bytes of a parameter of loadrt.
///
/// # Safety
/// `text` is a string or null, which is the empty text.
unsafe fn parameter<'a>(text: *const c_char) -> &'a [u8] {
    if text.is_null() {
        return b"";
    }
    // SAFETY: see above.
    unsafe { CStr::from_ptr(text) }.to_bytes()
}

/// Chooses the machine from the texts of `coordinates=`, `machine=` and `tool_length=`. Returns 0, or an error for
/// `framepath_kinematics_configure_text`, one of the constants above. Where it is about the coordinates, `letter` says at
/// which of them, counted from 1, 0 if at none.
///
/// # Safety
/// The texts are strings or null, `letter` points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_configure(
    coordinates: *const c_char,
    machine: *const c_char,
    tool_length: *const c_char,
    letter: *mut c_int,
) -> c_int {
    // SAFETY: see above.
    let [coordinates, machine, tool_length] = unsafe {
        [
            parameter(coordinates),
            parameter(machine),
            parameter(tool_length),
        ]
    };
    // SAFETY: see above.
    if let Some(letter) = unsafe { letter.as_mut() } {
        *letter = 0;
    }
    let machine = match Machine::configured(machine, coordinates) {
        Ok(machine) => machine,
        Err(ConfigurationError::UnknownMachine) => return FRAMEPATH_UNKNOWN_MACHINE,
        Err(ConfigurationError::Coordinates(error)) => {
            let (error, place) = match error {
                CoordinatesError::Empty => (FRAMEPATH_NO_AXIS, 0),
                CoordinatesError::UnknownLetter { position, .. } => {
                    (FRAMEPATH_UNKNOWN_AXIS, position + 1)
                }
                CoordinatesError::TooManyJoints { position } => {
                    (FRAMEPATH_TOO_MANY_JOINTS, position + 1)
                }
                CoordinatesError::MissingAxis { .. } => (FRAMEPATH_MISSING_AXIS, 0),
            };
            // SAFETY: see above.
            if let Some(letter) = unsafe { letter.as_mut() } {
                *letter = place as c_int;
            }
            return error;
        }
    };
    let module = module();
    module.tool_length = match tool_length {
        b"" | b"frame" => ToolLength::Frame,
        b"machine" => ToolLength::Machine,
        _ => return FRAMEPATH_UNKNOWN_TOOL_LENGTH,
    };
    module.control = Some(FrameControl::new(machine));
    0
}

/// What is wrong, and the remedy, for an error of `framepath_kinematics_configure`.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_kinematics_configure_text(error: c_int) -> *const c_char {
    match error {
        FRAMEPATH_NO_AXIS => c"no axis is named",
        FRAMEPATH_UNKNOWN_AXIS => c"this is no axis letter",
        FRAMEPATH_TOO_MANY_JOINTS => c"more letters than LinuxCNC has joints (16)",
        FRAMEPATH_MISSING_AXIS => c"an axis that this machine needs is missing: xyzac needs X Y Z A C, xyzbc needs X Y Z B C",
        FRAMEPATH_UNKNOWN_MACHINE => c"there is no such machine; write machine=identity, machine=xyzac or machine=xyzbc",
        FRAMEPATH_UNKNOWN_TOOL_LENGTH => c"there is no such rule; write tool_length=frame or tool_length=machine",
        _ => c"no error",
    }
    .as_ptr()
}

/// Which axis tilts the table: 1 is A, 2 is B, 0 is a machine without such a table.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_kinematics_tilt_axis() -> c_int {
    match module().control.as_ref().map(FrameControl::machine) {
        Some(Machine::TableTilting(table)) => match table.tilt_axis() {
            TiltAxis::A => 1,
            TiltAxis::B => 2,
        },
        Some(Machine::Identity(_)) | None => 0,
    }
}

/// The pose for joint positions. 0, or -1 if the module is not configured or a result is not finite.
///
/// # Safety
/// `joints` has 16 numbers, `world` is a pose.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_forward(
    joints: *const c_double,
    world: *mut EmcPose,
) -> c_int {
    // SAFETY: see above.
    let (Some(joints), Some(world)) =
        (unsafe { (joints.cast::<[f64; JOINT_COUNT]>().as_ref(), world.as_mut()) })
    else {
        return -1;
    };
    let Kinematics {
        control: Some(control),
        position,
        ..
    } = module()
    else {
        return -1;
    };
    let axes = control.machine().forward(joints);
    *position = axes.into();
    let axes = control.active().map_or(axes, |frame| frame.to_world(&axes));
    *world = pose_of(&axes);
    if axes.iter().all(|value| value.is_finite()) {
        0
    } else {
        -1
    }
}

/// The joint positions for a pose. 0, or -1 if the module is not configured or a result is not finite.
///
/// # Safety
/// `world` is a pose, `joints` has room for 16 numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_inverse(
    world: *const EmcPose,
    joints: *mut c_double,
) -> c_int {
    // SAFETY: see above.
    let (Some(world), Some(joints)) =
        (unsafe { (world.as_ref(), joints.cast::<[f64; JOINT_COUNT]>().as_mut()) })
    else {
        return -1;
    };
    let Kinematics {
        control: Some(control),
        position,
        ..
    } = module()
    else {
        return -1;
    };
    let axes = axes_of(world);
    let axes = control
        .active()
        .map_or(axes, |frame| frame.to_machine(&axes));
    *position = axes.into();
    control.machine().inverse(&axes, joints);
    // The table may turn what is finite beyond all numbers. Joints of no axis are motion's.
    let coordinates = control.machine().coordinates();
    let finite = axes.iter().enumerate().all(|(axis, value)| {
        let joint = coordinates
            .joint_of_axis(axis)
            .and_then(|joint| joints.get(joint));
        value.is_finite() && joint.is_none_or(|joint| joint.is_finite())
    });
    if finite { 0 } else { -1 }
}

/// The linear part of the frame in force, from the program's X Y Z to the machine's: three rows of three, the identity
/// without a frame. What a tool centre point turns behind it is not part of it. Returns whether a frame is in force.
///
/// # Safety
/// `map` has room for nine numbers, or is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_linear_map(map: *mut c_double) -> c_int {
    // SAFETY: see above.
    let Some(map) = (unsafe { map.cast::<[[f64; 3]; 3]>().as_mut() }) else {
        return 0;
    };
    let frame = module().control.as_ref().and_then(FrameControl::active);
    let [[xx, xy, xz, _], [yx, yy, yz, _], [zx, zy, zz, _]] = frame.map_or_else(
        || AffineMap::identity().to_rows(),
        |frame| frame.map().to_rows(),
    );
    *map = [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]];
    frame.is_some().into()
}

/// Motion switches to a kinematics type. 0, or the number of a refusal: then nothing has changed.
///
/// # Safety
/// `pins` points to the values of the pins.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_switch(
    slot: c_int,
    pins: *const framepath_frame_inputs,
) -> c_int {
    // SAFETY: see above.
    let Some(pins) = (unsafe { pins.as_ref() }) else {
        return -1;
    };
    let Kinematics {
        control: Some(control),
        tool_length,
        ..
    } = module()
    else {
        return -1;
    };
    match control.switch(slot, &inputs_of(pins, *tool_length)) {
        Ok(()) => 0,
        Err(refusal) => refusal as c_int,
    }
}

/// One servo period of taking commands: what is to be written to the pins.
///
/// # Safety
/// Both point to structures of this header.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_update(
    pins: *const framepath_frame_inputs,
    out: *mut framepath_frame_outputs,
) {
    // SAFETY: see above.
    let (Some(pins), Some(out)) = (unsafe { (pins.as_ref(), out.as_mut()) }) else {
        return;
    };
    let Kinematics {
        control: Some(control),
        tool_length,
        position,
    } = module()
    else {
        return;
    };
    let outputs = control.update(&inputs_of(pins, *tool_length));
    let tool = Vector3::from(pins.tool_offset);
    let (frame, turned_tool) = control.active().map_or_else(
        || (AffineMap::identity(), tool),
        |frame| (*frame.tip_map(), frame.turned_tool(&tool)),
    );
    let position = Axes::from(*position);
    let normal = tool_normal(
        control.machine(),
        control.active(),
        &position,
        &limits_of(pins),
    );
    let (normal_tilt, normal_rotary) = match normal {
        Ok(Some(angles)) => (angles.tilt, angles.rotary),
        Ok(None) | Err(_) => (0.0, 0.0),
    };
    *out = framepath_frame_outputs {
        switchkins_type: outputs.switchkins_type.into(),
        acknowledged: outputs.acknowledged,
        active: outputs.active.into(),
        slot: outputs.slot,
        operations: outputs.operations,
        tool_centre_point: outputs.tool_centre_point.into(),
        parameters_pending: outputs.parameters_pending.into(),
        tool_offset: outputs.tool_offset,
        refusal: outputs.refusal.map_or(0, |refusal| refusal as c_int),
        normal_refusal: normal.map_or_else(|error| error as c_int, |_| 0),
        normal_tilt,
        normal_rotary,
        releasing: outputs.releasing.into(),
        releases: outputs.releases,
        hold: outputs.hold.into(),
        guarded: outputs.guarded.into(),
        alarm: alarm_of(&outputs),
        frame: in_one_row(frame.to_rows()),
        position: position.map(shown).into(),
        turned_tool: turned_tool.map(shown).into(),
    };
}
