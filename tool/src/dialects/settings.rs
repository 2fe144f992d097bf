//! What a program means can depend on how the control was set up: the settings that say so.

use super::tools::ToolFiles;
use crate::program::PathControl;
use crate::program::arc::ArcTolerance;
use crate::source::open::Reading;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The default of [`Settings::most_blocks`]: about 200 MB where nearly every block moves.
pub const MOST_BLOCKS: usize = 500_000;

/// The default of [`Settings::tolerance`], mm.
pub const TOLERANCE: f64 = 0.01;

/// Settings of the control that is imitated.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Where subprogram files are looked for, after the folder of the program itself.
    pub subprogram_folders: Vec<PathBuf>,
    /// How files are read, and for how long.
    pub reading: Reading,
    /// How far the end of an arc may be off its circle.
    pub arc_tolerance: ArcTolerance,
    /// Whether LinuxCNC's unit of length is the inch: all output is in this unit.
    pub machine_in_inch: bool,
    /// What an increment counts from when the frame, an offset or the tool has changed since the axis last moved.
    pub increment_after_frame: IncrementBase,
    /// Whether the machine that runs the program is a lathe.
    pub lathe: bool,
    /// Whether X may be a diameter (G7) in that machine when the program begins.
    pub diameters_before: bool,
    /// Whether blocks that begin with `/` are left out.
    pub skip_blocks: bool,
    /// M functions that are passed on to LinuxCNC unchanged.
    pub passed_m: Vec<u32>,
    /// The feed in force when the program begins, machine units per minute.
    pub feed: Option<f64>,
    /// How corners are passed until the program says otherwise.
    pub path_mode: PathControl,
    /// By how much corners may be rounded where the program asks for that and names no tolerance,
    /// machine units.
    pub tolerance: f64,
    /// Where CYCLE800 retracts Z to, in coordinates of the machine, machine units.
    pub retract_z: Option<f64>,
    /// How many blocks a program may run besides twice the lines that it has: a loop that never ends
    /// must not fill the memory.
    pub most_blocks: usize,
    /// Values that variables have before the program begins, such as `R5`.
    pub variables: BTreeMap<String, f64>,
    /// Rows of LinuxCNC's tool table that hold further edges of tools, by tool and edge.
    pub tool_edges: BTreeMap<(u32, u32), u32>,
    /// Numbers of the tools that are called by name, in upper case; they count before those of the files.
    pub tool_names: BTreeMap<String, u32>,
    /// Where other names, and the diameters of tools, are looked up.
    pub tool_files: ToolFiles,
    /// What a number without a decimal point is in Fanuc-like programs.
    pub decimal_point: DecimalPoint,
    /// What ISG's G21 to G23 mirror outside of G17.
    pub mirror_outside_xy: MirrorOutsideXy,
    /// What becomes of a full circle with an absolute centre right after an ISG mirror.
    pub mirrored_circle: MirroredCircle,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            subprogram_folders: Vec::new(),
            reading: Reading::default(),
            arc_tolerance: ArcTolerance {
                absolute: 0.01,
                relative: 0.001,
            },
            machine_in_inch: false,
            increment_after_frame: IncrementBase::Programmed,
            lathe: false,
            diameters_before: false,
            skip_blocks: false,
            passed_m: Vec::new(),
            feed: None,
            path_mode: PathControl::ExactPath,
            tolerance: TOLERANCE,
            retract_z: None,
            most_blocks: MOST_BLOCKS,
            variables: BTreeMap::new(),
            tool_edges: BTreeMap::new(),
            tool_names: BTreeMap::new(),
            tool_files: ToolFiles::default(),
            decimal_point: DecimalPoint::Calculator,
            mirror_outside_xy: MirrorOutsideXy::Refuse,
            mirrored_circle: MirroredCircle::Refuse,
        }
    }
}

/// What an increment counts from when the frame, an offset or the tool has changed since the axis last moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum IncrementBase {
    /// From the coordinate that was programmed last, as it counts now: the change is travelled too. Sinumerik
    /// controls are delivered like this (setting data 42440 = 1 for frames and work offsets, 42442 = 1 for
    /// tools).
    Programmed,
    /// From where the tool is: the axis moves by the increment and nothing else (42440 = 0, 42442 = 0).
    Position,
}

/// What a length or an angle is in Fanuc-like programs that is written without a decimal point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum DecimalPoint {
    /// Whole units, as on a calculator: X100 is 100 mm, inch or degrees.
    Calculator,
    /// Least increments of the control: X100 is .1 mm, .01 inch or .1 degrees.
    Increments,
}

/// What ISG's G21, G22 and G23 mirror outside of G17: the manual of the control says both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum MirrorOutsideXy {
    /// Nothing: an error.
    Refuse,
    /// The first and the second axis of the plane that is active.
    Plane,
    /// X and Y, in every plane.
    Xy,
}

/// What becomes of a full circle with an absolute centre (G161) whose start was not mirrored: the
/// control cuts another radius.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum MirroredCircle {
    /// An error.
    Refuse,
    /// A warning, and the circle that the control would cut.
    Warn,
}
