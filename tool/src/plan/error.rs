//! Why there is no plan.

use crate::canon::CanonError;
use crate::canon::tool_table::ToolTableError;
use crate::report::ReportError;
use std::path::PathBuf;

/// Why there is no plan. Every message says where and what to do.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The program cannot be read, or the interpreter refuses it.
    #[error(transparent)]
    Program(#[from] CanonError),
    /// The INI file cannot be used.
    #[error(transparent)]
    Ini(#[from] ReportError),
    /// The tool table cannot be used.
    #[error(transparent)]
    ToolTable(#[from] ToolTableError),
    /// An option cannot be used.
    #[error("{0}")]
    Option(String),
    /// Nothing moves in the program.
    #[error("{}: nothing moves in this program", .0.display())]
    NoMoves(PathBuf),
    /// An axis moves that the machine does not have.
    #[error(
        "{}:{line}: axis {letter} moves, which the machine does not have: [TRAJ]COORDINATES of {} has \
         no {letter}",
        file.display(), ini.display()
    )]
    NoAxis {
        /// The program.
        file: PathBuf,
        /// Line of the move.
        line: i32,
        /// The axis.
        letter: char,
        /// The INI file.
        ini: PathBuf,
    },
    /// The planner refused a move.
    #[error("{}:{line}: the planner refuses the move: {reason}", file.display())]
    MoveRefused {
        /// The program.
        file: PathBuf,
        /// Line of the move.
        line: i32,
        /// Why.
        reason: String,
    },
    /// The planner stopped the motion.
    #[error("{}:{line}: the planner stops the motion: {reason}", file.display())]
    Stopped {
        /// The program.
        file: PathBuf,
        /// Line of the move.
        line: i32,
        /// Why.
        reason: String,
    },
    /// A file cannot be written.
    #[error("{}: cannot be written: {source}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
}
