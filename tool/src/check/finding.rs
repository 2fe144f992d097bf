//! What was found, how bad it is, and the line to write.

use crate::machine::place::Place;
use crate::wiring::subject::Subject;
use serde::Serialize;
use std::fmt;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// LinuxCNC does not start, or something goes wrong.
    Error,
    /// Unwise.
    Warning,
    /// Good to know.
    Note,
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Level::Error => "error",
            Level::Warning => "warning",
            Level::Note => "note",
        })
    }
}

/// What to do.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "action", rename_all = "lowercase")]
pub enum Remedy {
    /// Write these lines, into a section of the INI file (`[TRAJ]`) or a HAL file.
    Add {
        /// Where to.
        into: String,
        /// One or several, each as it is to be written.
        lines: Vec<String>,
    },
    /// Write this line in place of the one that was found.
    Replace {
        /// As it is to be written.
        line: String,
    },
    /// Remove the line that was found.
    Remove,
    /// Something else.
    Advice {
        /// What.
        text: String,
    },
}

/// One thing that was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// How bad it is.
    pub level: Level,
    /// The file.
    pub file: String,
    /// From 1; `None`: the file as a whole.
    pub line: Option<usize>,
    /// From 1; `None`: the line as a whole.
    pub column: Option<usize>,
    /// What was found, and what comes of it.
    pub found: String,
    /// What to do.
    pub remedy: Remedy,
}

/// Collects what the rules find.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    list: Vec<Finding>,
}

impl Findings {
    /// Adds one, unless it is there already.
    pub fn add(&mut self, level: Level, place: &Place, found: impl Into<String>, remedy: Remedy) {
        let number = |number: usize| (number > 0).then_some(number);
        let finding = Finding {
            level,
            file: place.file.display().to_string(),
            line: number(place.line),
            column: number(place.column),
            found: found.into(),
            remedy,
        };
        if !self.list.contains(&finding) {
            self.list.push(finding);
        }
    }

    /// An error.
    pub fn error(&mut self, place: &Place, found: impl Into<String>, remedy: Remedy) {
        self.add(Level::Error, place, found, remedy);
    }

    /// A warning.
    pub fn warning(&mut self, place: &Place, found: impl Into<String>, remedy: Remedy) {
        self.add(Level::Warning, place, found, remedy);
    }

    /// A note.
    pub fn note(&mut self, place: &Place, found: impl Into<String>, remedy: Remedy) {
        self.add(Level::Note, place, found, remedy);
    }

    /// All, the worst first, each kind in the order of finding.
    pub fn sorted(mut self) -> Vec<Finding> {
        self.list.sort_by_key(|finding| finding.level);
        self.list
    }
}

/// How bad it is that a line was not found: what was not read may have it.
pub fn if_missing(subject: &Subject) -> Level {
    match subject.script.unread.is_empty() {
        true => Level::Error,
        false => Level::Warning,
    }
}

/// To write a line somewhere.
pub fn add(into: impl Into<String>, line: impl Into<String>) -> Remedy {
    Remedy::Add {
        into: into.into(),
        lines: vec![line.into()],
    }
}

/// To write a line in place of another.
pub fn replace(line: impl Into<String>) -> Remedy {
    Remedy::Replace { line: line.into() }
}

/// Something else to do.
pub fn advice(text: impl Into<String>) -> Remedy {
    Remedy::Advice { text: text.into() }
}
