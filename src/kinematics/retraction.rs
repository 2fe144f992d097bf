//! Which way the tip of the tool goes when the tool is drawn back until the machine's own Z is at a place.
//!
//! Along the tool the tip goes by t on the workpiece, and the head by h in the machine; its Z rises by the z of h. Of a table
//! h is Z itself, so that no other joint moves; of a head X and Y move with it.

use nalgebra::{Unit, Vector3};

use super::rotary_chain::{RotaryAxis, RotaryChain};
use super::tool_angles::RotaryAngles;
use crate::frame::ActiveFrame;
use crate::machine::table_tilting::{RotaryDirection, TableTilting, TiltAxis};

/// The least part of the way along the tool that has to be a rise of Z: below it, or with a tool that points up, Z does not
/// take the tool off the workpiece.
const LEAST_RISE: f64 = 0.1;

/// How the tool is drawn back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Retraction {
    /// By Z alone without the frame: nothing turns the tool against the coordinates.
    ByZ,
    /// Along the tool.
    AlongTool {
        /// Where the tip goes in LinuxCNC's coordinates, without work offset, while the machine's own Z rises by one.
        way: Vector3<f64>,
        /// Where the machine's own Z is, machine units.
        z: f64,
    },
}

/// Why the tool cannot be drawn back along itself. The numbers are those of the pin `framekins.retract-kind`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum RetractionError {
    /// How the kinematics of another module turn the tool is not known.
    UnknownKinematics = -1,
    /// The tool lies level, or points up.
    Level = -2,
    /// Nobody has asked the kinematics of another module yet.
    NotAsked = -3,
}

/// Along the tool, with its axes at `angles` and the machine's own Z at `z`.
///
/// # Errors
///
/// [`RetractionError::Level`].
pub fn along_tool(
    chain: &RotaryChain,
    angles: RotaryAngles,
    frame: Option<&ActiveFrame>,
    z: f64,
) -> Result<Retraction, RetractionError> {
    let rise = chain.direction_in_machine(angles).z;
    if rise < LEAST_RISE {
        return Err(RetractionError::Level);
    }
    let way = chain.direction(angles) / rise;
    let way = frame.map_or(way, |frame| frame.vector_to_world(&way));
    Ok(Retraction::AlongTool { way, z })
}

/// How a tilting rotary table of ours turns the tool against the workpiece.
pub fn chain_of_table(table: &TableTilting) -> RotaryChain {
    let reversed = match table.parameters().direction {
        RotaryDirection::Table => true,
        RotaryDirection::Conventional => false,
    };
    let axis = |letter, line: Unit<Vector3<f64>>| RotaryAxis {
        letter,
        line: if reversed { -line } else { line },
        is_of_head: false,
    };
    let tilt = match table.tilt_axis() {
        TiltAxis::A => axis(0, Vector3::x_axis()),
        TiltAxis::B => axis(1, Vector3::y_axis()),
    };
    RotaryChain {
        rotary: Some(axis(2, Vector3::z_axis())),
        tilt,
    }
}
