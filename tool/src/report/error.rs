//! What can be wrong with the files a report is made from. Every message says where and what to do.

use crate::machine::IniError;
use crate::part_program::Refused;
use std::path::PathBuf;

/// Why there is no report. Nothing is written in that case, neither text nor files.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A file could not be opened or read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// A file could not be written.
    #[error("{}: cannot be written: {source}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// The page would take the place of what is read.
    #[error(
        "{}: this file is read for the report, and --html would be written there: give it a file of its own",
        .0.display()
    )]
    Overwritten(PathBuf),
    /// An option that does not go with the others.
    #[error("{0}")]
    Option(String),
    /// The INI file cannot be used.
    #[error(transparent)]
    Ini(#[from] IniError),
    /// The header or a row of the recording cannot be used.
    #[error("{}:{line}: {problem}", file.display())]
    Recording {
        /// The recording.
        file: PathBuf,
        /// Line, 1 for the header.
        line: u64,
        /// What is wrong and the remedy.
        problem: String,
    },
    /// Recording and INI file do not belong together.
    #[error("{} and {} do not belong together: {problem}", recording.display(), ini.display())]
    Mismatch {
        /// The recording.
        recording: PathBuf,
        /// The INI file.
        ini: PathBuf,
        /// What differs and the remedy.
        problem: String,
    },
    /// --check, and the run exceeds a limit or a tolerance, or leaves the path. The report itself has been told.
    #[error("not kept: {0}")]
    NotKept(String),
    /// --check, and nothing is known to be exceeded, but not all is known.
    #[error("not all could be checked: {0}")]
    Incomplete(String),
    /// The part program has no path.
    #[error(transparent)]
    Program(#[from] Refused),
}
