//! The languages that are read, and what they share.

pub mod control;
pub mod cursor;
pub mod expression;
pub mod fagor;
pub mod guess;
pub mod indices;
pub mod isg;
pub mod library;
pub mod mefi;
pub mod operators;
pub mod run;
pub mod scanner;
pub mod settings;
pub mod sinumerik;
pub mod spelling;
pub mod straight;
pub mod token;

use crate::diagnostics::Diagnostics;
use crate::program::Program;
use crate::source::Sources;
use control::About;
use settings::Settings;
use std::path::Path;

/// A language of part programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Dialect {
    /// Sinumerik-like controls: TRANS, ROT, SCALE, MIRROR, subprograms L10.
    Sinumerik,
    /// Fagor 8055: G10 to G14, G72, G73, (RPT N10,N20), (CALL 10), P parameters.
    Fagor,
    /// MEFI controls: G34 to G37, subprograms G79 L100, comments after a quotation mark.
    Mefi,
    /// ISG kernels and TwinCAT CNC: G20 to G23, #commands, $IF, subprograms %L NAME.
    Isg,
    /// Whichever of the others the program seems to be written in.
    Auto,
}

impl Dialect {
    /// The name as it is given on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Dialect::Sinumerik => "sinumerik",
            Dialect::Fagor => "fagor",
            Dialect::Mefi => "mefi",
            Dialect::Isg => "isg",
            Dialect::Auto => "auto",
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
    let mut program = Program::default();
    let about = About {
        sources,
        diagnostics,
        sink: &mut program,
    };
    run_program(dialect, path, settings, about);
    program
}

/// The same, with the blocks handed on as they are worked out.
pub fn run_program<'a>(dialect: Dialect, path: &Path, settings: &'a Settings, about: About<'a>) {
    match dialect {
        Dialect::Sinumerik => sinumerik::evaluate(path, settings, about),
        Dialect::Fagor => fagor::evaluate(path, settings, about),
        Dialect::Mefi => mefi::evaluate(path, settings, about),
        Dialect::Isg => isg::evaluate(path, settings, about),
        Dialect::Auto => match guess::guess(path, about.sources.file(0).text()) {
            Some(guess) => run_program(guess.dialect, path, settings, about),
            None => about.diagnostics.push(guess::undecided()),
        },
    }
}
