//! The language of Sinumerik-like controls.
//!
//! Text is cut into tokens ([`lexer`]), tokens are made into a tree ([`parser`]), and the tree is run
//! ([`interpreter`]) into the form that all dialects share ([`crate::program`]).

mod block_words;
mod calls;
mod cursor;
mod evaluate_words;
mod expressions;
mod flow;
mod flow_parser;
mod frame_commands;
mod g_functions;
mod interpreter;
pub mod lexer;
mod library;
mod machine_moves;
mod modal;
mod motion;
pub mod parser;
mod structure;
pub mod syntax;
pub mod token;
mod variables;
mod word_parser;
mod words;

use super::settings::Settings;
use crate::diagnostics::Diagnostics;
use crate::program::Program;
use crate::source::Sources;
use std::path::Path;

/// Evaluates the part program in file 0 of `sources`; see [`super::evaluate`].
pub fn evaluate(
    path: &Path,
    settings: &Settings,
    sources: &mut Sources,
    diagnostics: &mut Diagnostics,
) -> Program {
    let library = library::Library::new(path, settings, sources, diagnostics);
    interpreter::Interpreter::new(settings, library, sources, diagnostics).run()
}
