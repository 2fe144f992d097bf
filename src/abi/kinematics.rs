//! The kinematics as hal-component/framekins.c sees them.
//!
//! Static memory, one machine in a module. LinuxCNC calls `configure` while the module is loaded, and everything else
//! from the servo thread: on another one hal-component/framekins.c neither runs the HAL function of the module nor says where joints
//! are (hal-component/frame_messages.h), and blendtp, which asks for more, takes no command there.

use core::cell::UnsafeCell;
use core::ffi::CStr;

use libc::{c_char, c_double, c_int};

pub use super::frame_pins::{framepath_frame_inputs, framepath_frame_outputs};
use super::frame_pins::{inputs_of, outputs_of};
use super::inner::InnerModule;
use super::inner_normal::AskedNormal;
use super::linuxcnc::EmcPose;
use super::pose::{axes_of, pose_of};
use crate::axes::{AXIS_COUNT, Axes};
use crate::frame::affine::MAX_TRANSLATION;
use crate::frame::{ActiveFrame, AffineMap, ToolLength};
use crate::kinematics::control::{FrameControl, FrameInputs};
use crate::kinematics::offset_motion::OffsetMotion;
use crate::kinematics::switch_place::SwitchPlace;
use crate::kinematics::tool_jump::ToolJump;
use crate::machine::{ConfigurationError, CoordinatesError, JOINT_COUNT, Machine, TiltAxis};

/// What no length of a machine exceeds, machine units.
pub const FRAMEPATH_GREATEST_LENGTH: c_double = 1e6;
const _: () = assert!(FRAMEPATH_GREATEST_LENGTH == MAX_TRANSLATION);

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
/// `tool_types=` is no list of types.
pub const FRAMEPATH_UNKNOWN_TOOL_TYPES: c_int = 7;
/// `tool_axes=` names no axes that could turn a tool.
pub const FRAMEPATH_UNKNOWN_TOOL_AXES: c_int = 8;

/// The machine of the module.
pub(super) struct Kinematics {
    pub(super) control: Option<FrameControl>,
    /// What `tool_length=` says.
    pub(super) tool_length: ToolLength,
    /// The machine's axes as motion asked for them last.
    pub(super) position: [f64; AXIS_COUNT],
    /// The joints that belong to them, where the kinematics are another module's.
    pub(super) joints: [f64; JOINT_COUNT],
    /// The joints that motion was given last, in a place of the machine's axes. Those that it asks with may be where the
    /// machine is really, off what was commanded.
    pub(super) given: Option<([f64; AXIS_COUNT], [f64; JOINT_COUNT])>,
    /// The other module.
    pub(super) inner: InnerModule,
    /// How many guesses of motion's are still positions of the frame before: that of the command and that of the feedback.
    pub(super) old_guesses: u8,
    /// Where its rotary axes have to go for the tool to stand normal to the frame.
    pub(super) normal: AskedNormal,
    /// Whether its joints jump with the tool offset.
    pub(super) tool_jump: ToolJump,
    /// The position that the inverse kinematics were asked for last.
    pub(super) asked: Option<[f64; AXIS_COUNT]>,
    /// The place that motion goes on from behind a switch.
    pub(super) switch_place: SwitchPlace,
    /// Whether external offsets move it.
    offset_motion: OffsetMotion,
    /// The answer of that in this period.
    offsets_move: bool,
}

impl Kinematics {
    /// What the pins say, and whether external offsets move.
    fn inputs_on_pins(&self, pins: &framepath_frame_inputs) -> FrameInputs {
        FrameInputs {
            offsets_move: self.offsets_move,
            ..inputs_of(pins, self.tool_length)
        }
    }

    /// One servo period: whether external offsets move.
    fn watch_offsets(&mut self, pins: &framepath_frame_inputs) {
        let stands = pins.in_position != 0;
        self.offsets_move = self.offset_motion.watch(self.asked.as_ref(), stands);
    }

    /// Forgets where an earlier machine was asked for.
    pub(super) fn forget_asked(&mut self) {
        (self.asked, self.offsets_move) = (None, false);
        self.offset_motion = OffsetMotion::new();
    }

    /// What the pins say, and what has to be known for a frame that they ask for.
    pub(super) fn inputs(&self, pins: &framepath_frame_inputs) -> FrameInputs {
        let mut inputs = self.inputs_on_pins(pins);
        let Some(control) = &self.control else {
            return inputs;
        };
        if control.expects_frame(&inputs) {
            inputs.fixed_axes = self.inner.fixed_axes(&self.position, &self.joints);
        }
        if control.expects_switch(&inputs) {
            let coming = control.frame_of_command(&inputs);
            inputs.other_joints = self.other_joints(coming.as_ref(), &inputs);
        }
        inputs
    }

    /// The same where motion switches to this kinematics type.
    fn inputs_of_switch(&self, slot: c_int, pins: &framepath_frame_inputs) -> FrameInputs {
        let mut inputs = self.inputs_on_pins(pins);
        inputs.fixed_axes = self.inner.fixed_axes(&self.position, &self.joints);
        let control = self.control.as_ref();
        let coming = control.and_then(|control| control.frame_of_switch(slot, &inputs));
        inputs.other_joints = self.other_joints(coming.as_ref(), &inputs);
        inputs
    }

    /// Whether the joints would jump at a switch, with the frame that comes. With the machine off motion takes its position
    /// from them when it is switched on again.
    fn other_joints(&self, coming: Option<&ActiveFrame>, inputs: &FrameInputs) -> bool {
        let given = self.given.filter(|_| inputs.enabled);
        given.is_some_and(|(position, joints)| self.inner.other_joints(coming, &position, &joints))
    }
}

/// Memory for the one machine of a module.
struct KinematicsMemory(UnsafeCell<Kinematics>);

// SAFETY: LinuxCNC calls the kinematics from one thread at a time, see the head of this file.
unsafe impl Sync for KinematicsMemory {}

static MEMORY: KinematicsMemory = KinematicsMemory(UnsafeCell::new(Kinematics {
    control: None,
    tool_length: ToolLength::Frame,
    position: [0.0; AXIS_COUNT],
    joints: [0.0; JOINT_COUNT],
    given: None,
    inner: InnerModule::NONE,
    old_guesses: 0,
    normal: AskedNormal::NONE,
    tool_jump: ToolJump::new(),
    asked: None,
    switch_place: SwitchPlace::new(),
    offset_motion: OffsetMotion::new(),
    offsets_move: false,
}));

/// The machine of the module.
pub(super) fn module() -> &'static mut Kinematics {
    // SAFETY: one thread at a time, and no function of this folder uses a part of it any more once it has asked for it again.
    unsafe { &mut *MEMORY.0.get() }
}

/// Joint positions that LinuxCNC hands over.
///
/// # Safety
/// `joints` has 16 numbers, or is null.
pub(super) unsafe fn joints_of<'a>(joints: *const c_double) -> Option<&'a [f64; JOINT_COUNT]> {
    // SAFETY: see above.
    unsafe { joints.cast::<[f64; JOINT_COUNT]>().as_ref() }
}

/// The same to be written to.
///
/// # Safety
/// `joints` has room for 16 numbers that nobody else looks at, or is null.
pub(super) unsafe fn joints_of_mut<'a>(
    joints: *mut c_double,
) -> Option<&'a mut [f64; JOINT_COUNT]> {
    // SAFETY: see above.
    unsafe { joints.cast::<[f64; JOINT_COUNT]>().as_mut() }
}

/// A machine of ours behind the frame, and the place where its axes are kept.
fn our_machine() -> Option<(
    &'static FrameControl,
    &'static Machine,
    &'static mut [f64; AXIS_COUNT],
)> {
    let Kinematics {
        control: Some(control),
        position,
        ..
    } = module()
    else {
        return None;
    };
    let control = &*control;
    Some((control, control.behind().machine()?, position))
}

/// The bytes of a parameter of loadrt.
///
/// # Safety
/// `text` is a string or null, which is the empty text.
pub(super) unsafe fn parameter<'a>(text: *const c_char) -> &'a [u8] {
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
    module.forget_asked();
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
        FRAMEPATH_UNKNOWN_TOOL_TYPES => c"this is no list of types from 0 to 15; write those of the kinematics that have a tool-offset pin, as in tool_types=0,2",
        FRAMEPATH_UNKNOWN_TOOL_AXES => c"this is no axis of A B C that tilts the tool, nor one that carries another; write tool_axes=B, tool_axes=C,B for C that carries B, tool_axes=-C,-A for those of a table, tool_axes=C,B:0:1:1 for B about another line, or tool_axes=none",
        _ => c"no error",
    }
    .as_ptr()
}

/// Which axis tilts the table: 1 is A, 2 is B, 0 is a machine without such a table.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_kinematics_tilt_axis() -> c_int {
    let control = module().control.as_ref();
    match control.and_then(|control| control.behind().machine()) {
        Some(Machine::TableTilting(table)) => match table.tilt_axis() {
            TiltAxis::A => 1,
            TiltAxis::B => 2,
        },
        Some(Machine::Identity(_)) | None => 0,
    }
}

/// The pose for joint positions of a machine of ours. 0, or -1 if none is configured or a result is not finite.
///
/// # Safety
/// `joints` has 16 numbers, `world` is a pose.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_forward(
    joints: *const c_double,
    world: *mut EmcPose,
) -> c_int {
    // SAFETY: see above.
    let (Some(joints), Some(world), Some((control, machine, position))) =
        (unsafe { (joints_of(joints), world.as_mut(), our_machine()) })
    else {
        return -1;
    };
    let axes = machine.forward(joints);
    *position = axes.into();
    let axes = control.active().map_or(axes, |frame| frame.to_world(&axes));
    *world = pose_of(&axes);
    if axes.iter().all(|value| value.is_finite()) {
        0
    } else {
        -1
    }
}

/// The joint positions for a pose, of a machine of ours. 0, or -1 if none is configured or a result is not finite.
///
/// # Safety
/// `world` is a pose, `joints` has room for 16 numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_kinematics_inverse(
    world: *const EmcPose,
    joints: *mut c_double,
) -> c_int {
    // SAFETY: see above.
    let (Some(world), Some(joints), Some((control, machine, position))) =
        (unsafe { (world.as_ref(), joints_of_mut(joints), our_machine()) })
    else {
        return -1;
    };
    let axes = axes_of(world);
    let axes = control
        .active()
        .map_or(axes, |frame| frame.to_machine(&axes));
    *position = axes.into();
    machine.inverse(&axes, joints);
    // The table may turn what is finite beyond all numbers. Joints of no axis are motion's.
    let coordinates = machine.coordinates();
    let finite = axes.iter().enumerate().all(|(axis, value)| {
        let joint = coordinates
            .joint_of_axis(axis)
            .and_then(|joint| joints.get(joint));
        value.is_finite() && joint.is_none_or(|joint| joint.is_finite())
    });
    module().asked = Some(axes_of(world).into());
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

/// Motion switches to a kinematics type; with inner kinematics it is 16 times the slot of the frame plus theirs. 0, or the number of a refusal: then nothing has changed.
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
    let inputs = module().inputs_of_switch(slot, pins);
    let Kinematics {
        control: Some(control),
        inner,
        old_guesses,
        offset_motion,
        ..
    } = module()
    else {
        return -1;
    };
    match control.switch(slot, &inputs, |kind| inner.switch(kind)) {
        Ok(()) => {
            *old_guesses = 2;
            offset_motion.switched();
            0
        }
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
    module().watch_offsets(pins);
    let mut inputs = module().inputs(pins);
    let Kinematics {
        control: Some(control),
        position,
        joints,
        given,
        inner,
        normal,
        tool_jump,
        ..
    } = module()
    else {
        return;
    };
    inputs.tool_jumped = tool_jump.watch(&pins.tool_offset, given.as_ref());
    let outputs = control.update(&inputs);
    let shown = normal.update(control, pins, position, joints, inner, outputs.slot);
    *out = outputs_of(&outputs, control, pins, &Axes::from(*position), &shown);
}
