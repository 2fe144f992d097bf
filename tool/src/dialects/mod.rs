//! The languages that are read, and what they share.

pub mod expression;
pub mod scanner;
pub mod settings;
pub mod sinumerik;

use crate::diagnostics::Diagnostics;
use crate::program::Program;
use crate::source::Sources;
use settings::Settings;
use std::path::Path;

/// A language of part programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Dialect {
    /// Sinumerik-like controls: TRANS, ROT, SCALE, MIRROR, subprograms L10.
    Sinumerik,
}

impl Dialect {
    /// The name as it is given on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Dialect::Sinumerik => "sinumerik",
        }
    }
}

/// Reads and evaluates the part program in file 0 of `sources`, which lies at `path`; subprogram
/// files are added to `sources`. The result is only of use when no error was found.
pub fn evaluate(
    dialect: Dialect,
    path: &Path,
    settings: &Settings,
    sources: &mut Sources,
    diagnostics: &mut Diagnostics,
) -> Program {
    match dialect {
        Dialect::Sinumerik => sinumerik::evaluate(path, settings, sources, diagnostics),
    }
}
