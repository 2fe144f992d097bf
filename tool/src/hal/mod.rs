//! HAL files as `halcmd` and the script `linuxcnc` run them, read and not run.
//!
//! In the order of the work: [`script`] finds the files that an INI file names, [`line`] cuts their lines into
//! words, with what [`variables`] puts in for `[SECTION]KEY` and `$NAME`; [`tcl`] tells what files of LinuxCNC's in
//! Tcl do; [`values`] says what may be set; [`model`] has what is loaded, added, set and linked when all of them have run.

mod basic_sim;
mod commands;
mod line;
mod model;
mod script;
mod tcl;
mod values;
mod variables;

pub use model::{Added, Module, Program, Setting, State};
pub use script::{Script, read_script};
pub use tcl::Stock;
pub use values::{is_bit, is_value, number};
pub use variables::HALLIB;

use crate::machine::place::Place;
use std::path::PathBuf;

/// A word of a statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// With what variables stand for.
    pub text: String,
    /// Where it begins.
    pub place: Place,
}

/// One line of a HAL file, or a `HALCMD` of the INI file.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// At least one.
    pub words: Vec<Word>,
    /// The line as it stands there, without its comment.
    pub text: String,
    /// Where the first word begins.
    pub place: Place,
}

impl Statement {
    /// The text of a word, empty where there is none.
    pub fn word(&self, index: usize) -> &str {
        self.words.get(index).map_or("", |word| word.text.as_str())
    }
}

/// What `halcmd` refuses, upon which LinuxCNC does not start.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Where.
    pub place: Place,
    /// What is wrong.
    pub found: String,
    /// What to do.
    pub remedy: Fix,
}

/// What to do about a [`Problem`].
#[derive(Clone, Debug, PartialEq)]
pub enum Fix {
    /// Write this key into the INI file.
    Key {
        /// Its section.
        section: String,
        /// Its name.
        key: String,
    },
    /// Something else.
    Advice(String),
}

/// A file that LinuxCNC runs and that was not read here, so that what is not found may be in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Unread {
    /// Where it is named.
    pub place: Place,
    /// Its name.
    pub name: String,
    /// Why.
    pub reason: String,
    /// The file, if it is one in Tcl.
    pub tcl: Option<PathBuf>,
}
