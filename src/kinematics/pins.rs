//! What the kinematics with a frame read and write in each servo period.

use super::heartbeat::Guard;
use super::refusal::FrameRefusal;
use crate::frame::ToolLength;
use crate::machine::TableTiltingParameters;

/// What is read from the pins in each servo period. Lengths in machine units, angles in degrees.
#[derive(Clone, Copy, Debug)]
pub struct FrameInputs {
    /// Number of the command times 1000, plus its code; acted on when the number changes.
    pub command: f64,
    /// Values of the command.
    pub value: [f64; 3],
    /// The sum of [`super::check::check_sum`], as it was sent.
    pub check: f64,
    /// Work offset (G5x and G92 together) in X Y Z.
    pub work_offset: [f64; 3],
    /// Rotation of the work offset about Z.
    pub work_rotation: f64,
    /// Tool offset in X Y Z.
    pub tool_offset: [f64; 3],
    /// What becomes of the tool's length in a frame while the tool centre point is off.
    pub tool_length: ToolLength,
    /// A ready frame: three rows of a 3x4 map.
    pub map: [f64; 12],
    /// Which of A B C U V W are mirrored.
    pub mirror: [bool; 6],
    /// Dimensions of a machine with a tilting table, and whether the tool centre point is wanted.
    pub table: TableTiltingParameters,
    /// The type that inner kinematics are to have.
    pub inner_type: f64,
    /// Which of X Y Z the inner kinematics cannot move, where that has been looked at.
    pub fixed_axes: [bool; 3],
    /// The joints of the inner kinematics have jumped in this period, with the tool offset.
    pub tool_jumped: bool,
    /// The inner kinematics lead to other joints than those that they were given, where that has been looked at.
    pub other_joints: bool,
    /// External offsets move the axes while motion stands, or have just done so.
    pub offsets_move: bool,
    /// A pin cannot be the external offset of its axis.
    pub unknown_offset: bool,
    /// Motion stands still.
    pub in_position: bool,
    /// Motion is in teleop (world jogging) mode.
    pub teleop: bool,
    /// The machine is switched on.
    pub enabled: bool,
    /// An abort and machine off remove the frame.
    pub release_on_abort: bool,
    /// The guard wants the frame removed.
    pub release: bool,
    /// How many of [`FrameOutputs::releases`] the guard has told the interpreter of.
    pub releases_seen: i32,
    /// Changes while the guard lives; 0: it has never lived.
    pub heartbeat: u32,
    /// The servo period, s.
    pub period: f64,
    /// A clock that runs on, ns.
    pub clock: i64,
}

/// What is written to the pins after each servo period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameOutputs {
    /// The kinematics type that motion is asked for.
    pub switchkins_type: i32,
    /// Number of the last command that was carried out or refused.
    pub acknowledged: f64,
    /// A frame is active.
    pub active: bool,
    /// The slot in effect: 0, 1 or 2.
    pub slot: i32,
    /// How many operations make up the frame.
    pub operations: i32,
    /// The tool centre point is on.
    pub tool_centre_point: bool,
    /// The machine's dimensions on the pins, or the tool centre point asked for, are not those in
    /// effect: they take effect at the next switch. Or joints of the inner kinematics have jumped with the tool offset.
    pub parameters_pending: bool,
    /// The tool offset in X Y Z that the frame was made with.
    pub tool_offset: [f64; 3],
    /// The work offset in X Y Z that the frame was made with.
    pub work_offset: [f64; 3],
    /// Its rotation about Z.
    pub work_rotation: f64,
    /// Why the last command was refused.
    pub refusal: Option<FrameRefusal>,
    /// The frame has to go, and does so as soon as motion stands outside of teleop mode.
    pub releasing: bool,
    /// How often a frame was removed without a command while a guard lived.
    pub releases: i32,
    /// Nothing may be moved: dimensions are pending, the guard is late with a frame in force or wants it removed, or the
    /// interpreter does not know yet that the frame is gone.
    pub hold: bool,
    /// The machine may be on: the guard is not lost, or there is no frame.
    pub guarded: bool,
    /// What is known of the guard.
    pub guard: Guard,
    /// The type of the inner kinematics in effect.
    pub inner_type: i32,
    /// Why it is not the one that the pin says.
    pub inner_refusal: Option<FrameRefusal>,
}

impl FrameOutputs {
    /// Before the first period.
    pub fn first() -> Self {
        Self {
            switchkins_type: 0,
            acknowledged: 0.0,
            active: false,
            slot: 0,
            operations: 0,
            tool_centre_point: false,
            parameters_pending: false,
            tool_offset: [0.0; 3],
            work_offset: [0.0; 3],
            work_rotation: 0.0,
            refusal: None,
            releasing: false,
            releases: 0,
            hold: false,
            guarded: true,
            guard: Guard::Never,
            inner_type: 0,
            inner_refusal: None,
        }
    }
}
