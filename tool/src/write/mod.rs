//! From the program form to LinuxCNC G-code.

mod blocks;
mod comment;
mod contour_start;
mod kinematics;
mod line;
mod machine_move;
mod modes;
mod number;
mod rewrite;
mod tolerance;
mod turns;
mod words;

pub use blocks::header;
pub use kinematics::KinematicsWriter;
pub use rewrite::RewriteWriter;

use crate::diagnostics::Diagnostics;
use crate::program::arc::ArcTolerance;
use crate::program::{Block, FrameScope, PathControl, Program};
use crate::source::Sources;
use std::io;

/// Stretches that differ by less, relative to one of them, are the same.
const SAME_SIZE: f64 = 1e-9;

/// How frames are carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backend {
    /// By the frame kinematics: calls of its subroutines, moves as programmed.
    Kinematics,
    /// By rewriting the coordinates.
    Program,
}

/// What every backend needs to know.
#[derive(Clone, Copy, Debug)]
pub struct WriteSettings<'a> {
    /// Name of the dialect, for the first line.
    pub dialect: &'a str,
    /// Whether LinuxCNC's unit of length is the inch.
    pub machine_in_inch: bool,
    /// Whether X may be a diameter (G7) before the program: where it is, the program makes it one again at its end.
    pub diameters_before: bool,
    /// How corners are passed until the program says otherwise.
    pub path_mode: PathControl,
    /// By how much corners are rounded where the program names no tolerance, machine units.
    pub tolerance: f64,
    /// Largest distance of the chords from the ellipse that unequal scales make of an arc, machine
    /// units.
    pub chord_tolerance: f64,
    /// How far the end of an arc may be off its circle.
    pub arc_tolerance: &'a ArcTolerance,
}

/// Writes blocks as G-code, as they come.
pub trait Writer {
    /// The next block. `scope`: what the frames of the program turn.
    fn block(&mut self, block: &Block, scope: FrameScope, sources: &Sources);

    /// What this backend cannot do, so far: the text is of no use then.
    fn diagnostics(&self) -> &Diagnostics;

    /// All blocks have been given.
    ///
    /// # Errors
    ///
    /// Where a line could not be written.
    fn finish(self: Box<Self>) -> io::Result<Diagnostics>;
}

/// The writer of a backend.
pub fn writer<'a>(
    backend: Backend,
    settings: &'a WriteSettings,
    out: &'a mut dyn io::Write,
) -> Box<dyn Writer + 'a> {
    match backend {
        Backend::Kinematics => Box::new(KinematicsWriter::new(settings, out)),
        Backend::Program => Box::new(RewriteWriter::new(settings, out)),
    }
}

/// A program that is held as a whole, written as a whole; `warnings` are what the operator is to see
/// when it starts.
///
/// # Errors
///
/// Where memory is short.
pub fn write(
    backend: Backend,
    program: &Program,
    settings: &WriteSettings,
    sources: &Sources,
    warnings: &[String],
) -> io::Result<(String, Diagnostics)> {
    let mut body = Vec::new();
    let mut writer = writer(backend, settings, &mut body);
    for block in &program.blocks {
        writer.block(block, program.frame_scope, sources);
    }
    let diagnostics = writer.finish()?;
    let mut text = header(backend, settings, sources, warnings);
    text.push_str(&String::from_utf8_lossy(&body));
    Ok((text, diagnostics))
}

/// The last part of a path, for comments.
fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}
