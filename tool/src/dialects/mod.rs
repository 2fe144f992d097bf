//! The languages that are read, and what they share.

pub mod blocks;
pub mod clearing;
pub mod control;
pub mod cursor;
pub mod expression;
pub mod fagor;
pub mod fanuc;
pub mod fillers;
pub mod foreign;
pub mod guess;
pub mod indices;
pub mod ini;
pub mod isg;
mod languages;
mod lathe;
pub mod lexer;
pub mod library;
pub mod mefi;
pub mod operators;
pub mod outline;
pub mod program_options;
pub mod run;
pub mod scanner;
pub mod settings;
pub mod sinumerik;
pub mod spelling;
pub mod token;
pub mod tools;

pub use languages::{Dialect, Language};

use crate::diagnostics::Diagnostics;
use crate::program::Program;
use crate::source::Sources;
use control::About;
use settings::Settings;
use std::path::Path;

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
    let known = match dialect {
        Dialect::Auto => {
            let guess = guess::decide(path, &about.sources.file(0).beginning());
            guess.map(|guess| guess.dialect)
        }
        named => Ok(named),
    };
    match known.map(Dialect::language) {
        Ok(Some(language)) => language.evaluate(path, settings, about),
        // No guess is that it is to be guessed.
        Ok(None) => {}
        Err(error) => about.diagnostics.push(error),
    }
}
