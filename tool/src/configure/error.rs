//! Why nothing was configured.

use crate::machine::IniError;
use crate::machine::place::Place;
use std::fmt;
use std::path::PathBuf;

/// What is in the way, and what to write.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// Where.
    pub(super) place: Place,
    /// What was found.
    pub(super) found: String,
    /// What to write instead.
    pub(super) help: String,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: error: {}\n  help: {}",
            self.place, self.found, self.help
        )
    }
}

/// Why nothing was written.
#[derive(Debug, thiserror::Error)]
pub enum ConfigureError {
    /// The INI file cannot be read.
    #[error(transparent)]
    Ini(#[from] IniError),
    /// All that is in the way.
    #[error("{}", lines(.0))]
    Refused(Vec<Refusal>),
    /// Lines of included files would change, which first have to be in the INI file.
    #[error("lines of included files would change")]
    Included,
    /// A file of this name is there.
    #[error("{}: error: this file is there already\n  help: --force replaces it", .0.display())]
    Exists(PathBuf),
    /// A file of this name is part of the configuration that is read.
    #[error(
        "{}: error: the configuration itself reads this file, and it would be written anew\n  help: rename it where \
         the configuration names it",
        .0.display()
    )]
    Overwritten(PathBuf),
    /// What changes cannot be told.
    #[error(
        "standard output: error: it cannot be written: {0}\n  help: nothing is changed; send it elsewhere, as with > changes.diff"
    )]
    Told(std::io::Error),
    /// A file cannot be written.
    #[error("{}: error: it cannot be written: {source}\n  help: copy the configuration to a folder of your own", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
}

fn lines(refusals: &[Refusal]) -> String {
    let lines: Vec<String> = refusals.iter().map(Refusal::to_string).collect();
    lines.join("\n")
}
