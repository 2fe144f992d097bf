//! What can be wrong with the files a report is made from. Every message says where and what to do.

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
    /// Two outputs would be written to one file.
    #[error("{}: --html and --json would both be written there: give each a file of its own", .0.display())]
    SameFile(PathBuf),
    /// A line of the INI file does not have the form of LinuxCNC's INI files.
    #[error("{}:{line}: {problem}", file.display())]
    IniLine {
        /// The INI file.
        file: PathBuf,
        /// Line, 1 for the first.
        line: usize,
        /// What is wrong and the remedy.
        problem: String,
    },
    /// A section or key is missing from the INI file.
    #[error("{}: {entry} is missing: {remedy}", file.display())]
    IniMissing {
        /// The INI file.
        file: PathBuf,
        /// `[SECTION]KEY`.
        entry: String,
        /// What to write.
        remedy: String,
    },
    /// A value in the INI file cannot be used.
    #[error("{}:{line}: {entry}: {problem}", file.display())]
    IniValue {
        /// The INI file.
        file: PathBuf,
        /// Line, 1 for the first.
        line: usize,
        /// `[SECTION]KEY = value`.
        entry: String,
        /// What is wrong and the remedy.
        problem: String,
    },
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
    /// The part program could not be turned into a path.
    #[error("{}: {problem}", file.display())]
    Program {
        /// The part program.
        file: PathBuf,
        /// What is wrong.
        problem: String,
    },
}
