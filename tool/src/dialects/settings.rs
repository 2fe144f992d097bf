//! What a program means can depend on how the control was set up: the settings that say so.

use crate::program::arc::ArcTolerance;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Settings of the control that is imitated.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Where subprogram files are looked for, after the folder of the program itself.
    pub subprogram_folders: Vec<PathBuf>,
    /// How far the end of an arc may be off its circle.
    pub arc_tolerance: ArcTolerance,
    /// Whether LinuxCNC's unit of length is the inch: all output is in this unit.
    pub machine_in_inch: bool,
    /// What an increment counts from when the frame has changed since the axis last moved.
    pub increment_after_frame: IncrementBase,
    /// Whether blocks that begin with `/` are left out.
    pub skip_blocks: bool,
    /// M functions that are passed on to LinuxCNC unchanged.
    pub passed_m: Vec<u32>,
    /// Values that variables have before the program begins, such as `R5`.
    pub variables: BTreeMap<String, f64>,
    /// Numbers of the tools that are called by name.
    pub tool_names: BTreeMap<String, u32>,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            subprogram_folders: Vec::new(),
            arc_tolerance: ArcTolerance {
                absolute: 0.01,
                relative: 0.001,
            },
            machine_in_inch: false,
            increment_after_frame: IncrementBase::Programmed,
            skip_blocks: false,
            passed_m: Vec::new(),
            variables: BTreeMap::new(),
            tool_names: BTreeMap::new(),
        }
    }
}

/// What an increment counts from when the frame has changed since the axis last moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum IncrementBase {
    /// From the coordinate that was programmed last, now taken in the new frame: the change of the
    /// frame is travelled too. Sinumerik controls are delivered like this (setting data 42440 = 1).
    Programmed,
    /// From where the tool is: the axis moves by the increment and nothing else (42440 = 0).
    Position,
}
