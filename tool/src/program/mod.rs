//! What a part program does, whatever language it was written in: the one form between the dialects,
//! which produce it, and the backends and the contour, which are made from it.
//!
//! All lengths are in the unit of the machine (millimetres unless the caller says otherwise), angles
//! in degrees, feeds per minute unless the mode says otherwise. Calls, loops and arithmetic are
//! evaluated: a program here is a plain list of blocks.

pub mod arc;
pub mod contour;
pub mod contour_end;
pub mod contour_entry;
pub mod contour_start;
pub mod corners;
pub mod fillet;
pub mod frame;
pub mod moves;
pub mod position;
pub mod trace;

use crate::source::{Sources, Span};
use contour_start::ContourStart;
use frame::FrameCommand;
use moves::Move;
use nalgebra::Vector3;

/// A program whose flow has been evaluated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// The blocks in the order in which they run.
    pub blocks: Vec<Block>,
    /// What the frames turn.
    pub frame_scope: FrameScope,
}

/// Takes the blocks of a program as they are worked out.
pub trait Sink {
    /// The next blocks. `scope` is what the frames of the program turn; `sources` has their lines.
    fn take(&mut self, blocks: Vec<Block>, scope: FrameScope, sources: &Sources);
}

/// Keeps all blocks.
impl Sink for Program {
    fn take(&mut self, mut blocks: Vec<Block>, scope: FrameScope, _: &Sources) {
        self.frame_scope = scope;
        self.blocks.append(&mut blocks);
    }
}

/// What the frames of a program turn, mirror and scale.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FrameScope {
    /// The machine: the length of the tool turns with the frame.
    #[default]
    Machine,
    /// The coordinates of the blocks, before compensation: the tool stays as it is.
    Block,
}

/// Where a block was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Origin {
    /// Index of the source file; 0 is the program itself.
    pub file: usize,
    /// Line, 1 for the first.
    pub line: u32,
    /// The block number (`N10`), if it has one.
    pub number: Option<u32>,
    /// The text of the block.
    pub span: Span,
}

/// One block of the source, each time it runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Where it was written.
    pub origin: Origin,
    /// What it does, in the order in which that happens.
    pub actions: Vec<Action>,
    /// The comment of the block.
    pub comment: Option<String>,
    /// The text of a block that changes nothing but the frame, which may leave nothing else behind.
    pub frame_text: Option<String>,
}

/// One thing that a block does.
#[derive(Clone, Debug, PartialEq)]
#[expect(
    clippy::large_enum_variant,
    reason = "nearly all actions of a program are moves"
)]
pub enum Action {
    /// Another plane for arcs and compensation.
    Plane(Plane),
    /// Work offset 1 to 9: G54 to G59.3.
    WorkOffset(u8),
    /// Values for a work offset, whether it is in force or not; they are kept.
    SystemValues(Box<SystemValues>),
    /// How feeds are given.
    FeedMode(FeedMode),
    /// Feed in the unit of the feed mode.
    Feed(f64),
    /// Spindle speed in revolutions per minute.
    SpindleSpeed(f64),
    /// The spindle keeps this speed of the surface under the tool, metres or feet per minute, turning at
    /// most so fast; `None`: it keeps its own speed again, which follows.
    SurfaceSpeed(Option<SurfaceSpeed>),
    /// Spindle on or off.
    Spindle(Spindle),
    /// The spindle stops at this angle, degrees.
    Orient(f64, OrientWay),
    /// Whether the operator's feed and speed overrides act.
    Overrides(bool),
    /// The tool to be changed to next.
    Tool(u32),
    /// The tool change itself.
    ToolChange,
    /// Tool length compensation on (of the tool in the spindle) or off.
    ToolLength(bool),
    /// Length and radius compensation by this row of the tool table, whatever tool is in the spindle.
    ToolOffset(u32),
    /// Radius compensation by this row of the tool table from here on; `None`: that of the tool in the
    /// spindle.
    RadiusRow(Option<u32>),
    /// Coolant on or off.
    Coolant(Coolant),
    /// The diameter that cutter compensation takes from here on; `None`: that in the tool table.
    CutterDiameter(Option<f64>),
    /// Cutter radius compensation.
    Compensation(Compensation),
    /// How the contour begins onto which the next motion leads, where LinuxCNC would begin it elsewhere.
    ContourStart(Box<ContourStart>),
    /// How corners are passed.
    PathControl(PathControl),
    /// A pause in seconds.
    Dwell(f64),
    /// A change of the programmable frame.
    Frame(FrameCommand),
    /// A motion.
    Move(Move),
    /// G92: the present position gets these coordinates (X Y Z A B C U V W).
    Preset([Option<f64>; 9]),
    /// G52: the zero of the work offset lies at these coordinates.
    LocalOffset([Option<f64>; 9]),
    /// The rotary axes turn so that the tool stands normal to the plane of the frame.
    ToolNormal,
    /// The rotary axes turn to zero of the machine, as far as they are not there.
    RotaryZero,
    /// Rapid along the tool until Z of the machine itself is at this place, machine units.
    Retract(f64),
    /// The end of G92: coordinates are those of the work offset again.
    PresetOff,
    /// M0, or M1 where the operator decides.
    Pause {
        /// Whether this is M1.
        optional: bool,
    },
    /// M-number that the settings pass on.
    OtherM(u32),
    /// A text for the operator.
    Message(String),
    /// A subprogram begins.
    Enter {
        /// Name of the subprogram.
        name: String,
        /// Name of the file it was found in.
        file: String,
        /// Which of the passes this is, 1 for the first.
        pass: u32,
        /// How many passes the call asks for.
        passes: u32,
    },
    /// A subprogram ends.
    Leave {
        /// Name of the subprogram.
        name: String,
    },
    /// The end of the program: M30, or M2.
    End {
        /// Whether this is M30.
        rewind: bool,
    },
}

/// The plane of arcs, compensation and rotations in the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// G17: first axis X, second Y, normal Z.
    Xy,
    /// G18: first axis Z, second X, normal Y.
    Zx,
    /// G19: first axis Y, second Z, normal X.
    Yz,
}

impl Plane {
    /// Indices of the first and the second axis and of the normal: a right-handed triple.
    pub fn axes(self) -> [usize; 3] {
        match self {
            Plane::Xy => [0, 1, 2],
            Plane::Zx => [2, 0, 1],
            Plane::Yz => [1, 2, 0],
        }
    }

    /// A vector with these components along the first and the second axis.
    pub fn vector(self, along: [f64; 2]) -> Vector3<f64> {
        let [first, second, _] = self.axes();
        let mut vector = Vector3::zeros();
        vector[first] = along[0];
        vector[second] = along[1];
        vector
    }
}

/// The unit in which feeds are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// G93: the reciprocal of the time of the block, 1/min.
    InverseTime,
    /// G94: length per minute.
    PerMinute,
    /// G95: length per revolution.
    PerRevolution,
}

/// Values for a work offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SystemValues {
    /// 1 to 9: G54 to G59.3.
    pub system: u8,
    /// X Y Z A B C U V W, as far as they change.
    pub axes: [Option<f64>; 9],
    /// The turn about Z, degrees, if it changes.
    pub rotation: Option<f64>,
}

/// Constant surface speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSpeed {
    /// Metres per minute, or feet where LinuxCNC's unit is the inch.
    pub speed: f64,
    /// Revolutions per minute at most.
    pub limit: Option<f64>,
}

/// State of the main spindle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spindle {
    /// M3.
    Clockwise,
    /// M4.
    Counterclockwise,
    /// M5.
    Stop,
}

/// How the spindle turns to an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OrientWay {
    /// The shorter way.
    Shorter,
    /// As with M3.
    Clockwise,
    /// As with M4.
    Counterclockwise,
}

/// State of the coolant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coolant {
    /// M7.
    Mist,
    /// M8.
    Flood,
    /// M9.
    Off,
}

/// Cutter radius compensation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compensation {
    /// G40.
    Off,
    /// G41.
    Left,
    /// G42.
    Right,
}

/// How the corner between two blocks is passed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathControl {
    /// Every block ends at rest in its end point.
    ExactStop,
    /// Corners are not rounded; where two blocks meet tangentially there is no stop.
    ExactPath,
    /// Corners may be rounded.
    Continuous {
        /// Largest distance from the programmed path, machine units: without one LinuxCNC cuts a corner
        /// by as much as the feed asks for.
        tolerance: f64,
    },
}
