//! From the program form to LinuxCNC G-code.

mod blocks;
mod comment;
pub mod kinematics;
mod line;
mod number;
pub mod rewrite;
mod words;

use crate::program::PathControl;
use crate::program::arc::ArcTolerance;
use crate::source::Sources;

/// What every backend needs to know.
#[derive(Clone, Copy, Debug)]
pub struct WriteSettings<'a> {
    /// Name of the dialect, for the first line.
    pub dialect: &'a str,
    /// Whether LinuxCNC's unit of length is the inch.
    pub machine_in_inch: bool,
    /// How corners are passed until the program says otherwise.
    pub path_mode: PathControl,
    /// The files of the program, for their names.
    pub sources: &'a Sources,
    /// Largest distance of the chords from the ellipse that unequal scales make of an arc, machine
    /// units.
    pub chord_tolerance: f64,
    /// How far the end of an arc may be off its circle.
    pub arc_tolerance: &'a ArcTolerance,
    /// Texts that the operator is to see when the program starts.
    pub warnings: &'a [String],
}

/// The last part of a path, for comments.
fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}
