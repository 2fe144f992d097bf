//! What can be wrong with an INI file. Every message says where and what to do.

use std::path::PathBuf;

/// Why an INI file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum IniError {
    /// The file could not be opened or read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// A line does not have the form of LinuxCNC's INI files.
    #[error("{}:{line}: {problem}", file.display())]
    Line {
        /// The file.
        file: PathBuf,
        /// Line, 1 for the first.
        line: usize,
        /// What is wrong and the remedy.
        problem: String,
    },
    /// A line that LinuxCNC reads and this does not: what it has to say is not known.
    #[error("{}:{line}: {problem}", file.display())]
    Unread {
        /// The file.
        file: PathBuf,
        /// Line, 1 for the first.
        line: usize,
        /// What is wrong and the remedy.
        problem: String,
    },
    /// LinuxCNC does not read the file, or reads something that nobody means.
    #[error("{}:{line}: {problem}: {remedy}", file.display())]
    Refused {
        /// The file.
        file: PathBuf,
        /// Line, 1 for the first.
        line: usize,
        /// What is wrong.
        problem: String,
        /// What to write.
        remedy: String,
    },
    /// A section or key is missing.
    #[error("{}: {entry} is missing: {remedy}", file.display())]
    Missing {
        /// The file.
        file: PathBuf,
        /// `[SECTION]KEY`.
        entry: String,
        /// What to write.
        remedy: String,
    },
    /// A value cannot be used.
    #[error("{}:{line}: {entry}: {problem}", file.display())]
    Value {
        /// The file.
        file: PathBuf,
        /// Line, 1 for the first.
        line: usize,
        /// `[SECTION]KEY = value`.
        entry: String,
        /// What is wrong and the remedy.
        problem: String,
    },
}
