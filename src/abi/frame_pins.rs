//! What framekins.c reads from the pins in each servo period, and what it writes to them.

use libc::{c_double, c_int, c_longlong, c_uint};

use nalgebra::Vector3;

use super::tool_pins::ToolPins;
use crate::axes::Axes;
use crate::frame::{AffineMap, ToolLength};
use crate::kinematics::control::{FrameControl, FrameInputs, FrameOutputs};
use crate::kinematics::heartbeat::Guard;
use crate::kinematics::{AngleRange, RotaryLimits};
use crate::machine::{RotaryDirection, TableTiltingParameters};

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
    /// Smallest and greatest angle of the rotary axis.
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
    /// The type that inner kinematics are to have.
    pub inner_type: c_double,
    /// A pin cannot be the external offset of its axis: 0 or 1.
    pub unknown_offset: c_int,
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
    /// The work offset in X Y Z that the frame was made with.
    pub work_offset: [c_double; 3],
    /// Its rotation about Z.
    pub work_rotation: c_double,
    /// A tool offset that changes under the frame leads elsewhere than the program says: 0 or 1.
    pub tool_length_matters: c_int,
    /// Why the last command was refused; 0 if it was not.
    pub refusal: c_int,
    /// Why the tool cannot be put normal to the frame; 0 if it can.
    pub normal_refusal: c_int,
    /// Where the tilting axis has to go for that.
    pub normal_tilt: c_double,
    /// Where the rotary axis has to go for that.
    pub normal_rotary: c_double,
    /// Which axis that tilting axis is: 1, 2, 3 for A, B, C; 0 if there is none.
    pub normal_tilt_axis: c_int,
    /// Which axis that rotary axis is.
    pub normal_rotary_axis: c_int,
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
    /// The type of the inner kinematics in effect.
    pub inner_type: c_int,
    /// Why it is not the one that the pin says; 0 if it is.
    pub inner_refusal: c_int,
    /// The type of the inner kinematics for the tool centre point; -1 if none is known.
    pub tool_centre_type: c_int,
    /// Their type with the machine's own axes; -1 if there is none.
    pub axes_type: c_int,
    /// How the tool is drawn back: 0 by Z without the frame, 1 along `retract_way`, -1 its kinematics are not known, -2 it
    /// lies level or points up, -3 the kinematics of another module have not been asked yet.
    pub retract_kind: c_int,
    /// Where its tip goes, in LinuxCNC's coordinates X Y Z, while the machine's own Z rises by one.
    pub retract_way: [c_double; 3],
    /// Where the machine's own Z is.
    pub retract_z: c_double,
}

pub(super) fn inputs_of(pins: &framepath_frame_inputs, tool_length: ToolLength) -> FrameInputs {
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
        inner_type: pins.inner_type,
        fixed_axes: [false; 3],
        tool_jumped: false,
        other_joints: false,
        offsets_move: false,
        unknown_offset: pins.unknown_offset != 0,
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

pub(super) fn limits_of(pins: &framepath_frame_inputs) -> RotaryLimits {
    let [tilt, rotary] =
        [pins.tilt_range, pins.rotary_range].map(|[min, max]| AngleRange { min, max });
    RotaryLimits { tilt, rotary }
}

/// What is shown of a period, with the machine's axes where they are now.
pub(super) fn outputs_of(
    outputs: &FrameOutputs,
    control: &FrameControl,
    pins: &framepath_frame_inputs,
    position: &Axes,
    shown_of_tool: &ToolPins,
) -> framepath_frame_outputs {
    let tool = Vector3::from(pins.tool_offset);
    let (frame, turned_tool, tool_length_matters) = control.active().map_or_else(
        || (AffineMap::identity(), tool, false),
        |frame| {
            let turned_tool = frame.turned_tool(&tool);
            (*frame.tip_map(), turned_tool, frame.tool_length_matters())
        },
    );
    let ToolPins {
        normal,
        retract,
        types: [tool_centre_type, axes_type],
    } = shown_of_tool;
    framepath_frame_outputs {
        switchkins_type: outputs.switchkins_type.into(),
        acknowledged: outputs.acknowledged,
        active: outputs.active.into(),
        slot: outputs.slot,
        operations: outputs.operations,
        tool_centre_point: outputs.tool_centre_point.into(),
        parameters_pending: outputs.parameters_pending.into(),
        tool_offset: outputs.tool_offset,
        work_offset: outputs.work_offset,
        work_rotation: outputs.work_rotation,
        tool_length_matters: tool_length_matters.into(),
        refusal: outputs.refusal.map_or(0, |refusal| refusal as c_int),
        normal_refusal: normal.refusal,
        normal_tilt: normal.tilt,
        normal_rotary: normal.rotary,
        normal_tilt_axis: normal.axes[0],
        normal_rotary_axis: normal.axes[1],
        releasing: outputs.releasing.into(),
        releases: outputs.releases,
        hold: outputs.hold.into(),
        guarded: outputs.guarded.into(),
        alarm: alarm_of(outputs),
        frame: in_one_row(frame.to_rows()),
        position: position.map(shown).into(),
        turned_tool: turned_tool.map(shown).into(),
        inner_type: outputs.inner_type,
        inner_refusal: outputs.inner_refusal.map_or(0, |refusal| refusal as c_int),
        tool_centre_type: *tool_centre_type,
        axes_type: *axes_type,
        retract_kind: retract.kind,
        retract_way: retract.way,
        retract_z: retract.z,
    }
}
