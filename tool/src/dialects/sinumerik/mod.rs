//! The language of Sinumerik-like controls.
//!
//! Text is cut into tokens ([`lexer`]), tokens are made into a tree ([`parser`]), and the tree is run
//! ([`interpreter`]) into the form that all dialects share ([`crate::program`]).

mod arc_words;
mod block_words;
mod calls;
mod cursor;
mod drilling;
mod evaluate_words;
mod expressions;
mod flow;
mod flow_parser;
mod frame_commands;
mod g_functions;
mod interpreter;
pub mod lexer;
pub mod parser;
mod polar;
mod procedures;
mod routine;
mod spindle;
mod structure;
mod swivel;
pub mod syntax;
mod tapping;
pub mod token;
mod variables;
mod word_parser;
mod words;

use super::control::About;
use super::guess::Evidence;
use super::library::Library;
use super::run::run;
use super::settings::Settings;
use std::path::Path;

/// Evaluates the part program in file 0 of `sources`; see [`super::evaluate`].
pub fn evaluate<'a>(path: &Path, settings: &'a Settings, about: About<'a>) {
    let library = Library::new(
        path,
        &routine::EXTENSIONS,
        settings,
        about.sources,
        about.diagnostics,
        routine::routines,
    );
    run(&mut interpreter::Interpreter::new(settings, library, about));
}

/// What speaks for this dialect; see [`super::guess`].
pub fn evidence(lines: &[String], extension: &str) -> Evidence {
    const WORDS: [&str; 18] = [
        "TRANS",
        "ATRANS",
        "ROT",
        "AROT",
        "ROTS",
        "AROTS",
        "SCALE",
        "ASCALE",
        "MIRROR",
        "AMIRROR",
        "CYCLE800",
        "CYCLE832",
        "WORKPIECE",
        "STOPRE",
        "SUPA",
        "GOTOF",
        "GOTOB",
        "MCALL",
    ];
    let mut evidence = Evidence::default();
    if matches!(extension, "mpf" | "spf" | "arc") {
        evidence.add_extension(50);
    }
    for (at, line) in lines.iter().enumerate() {
        let code = line.split(';').next().unwrap_or("");
        if code.starts_with("%_N_") || code.starts_with("%MPF") || code.starts_with("%SPF") {
            evidence.add(100, at);
        }
        let mut words = code.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
        if words.any(|word| WORDS.contains(&word)) {
            evidence.add(20, at);
        }
        for assigned in ["=AC(", "=IC(", "CR=", "RPL=", "R[", "MSG("] {
            if code.contains(assigned) {
                evidence.add(10, at);
            }
        }
    }
    evidence
}
