//! The language of the Fagor 8055 milling control.
//!
//! Text is cut into tokens ([`lexer`]), tokens are made into a tree ([`parser`]), and the tree is run
//! ([`interpreter`]) into the form that all dialects share ([`crate::program`]).

mod block_words;
mod calls;
mod cursor;
mod cycles;
mod deep_holes;
mod evaluate_words;
mod expressions;
mod g_functions;
mod helix;
mod high_level;
mod interpreter;
mod irregular_pockets;
mod lathe;
pub mod lexer;
mod parameters;
pub mod parser;
mod patterns;
mod plane_moves;
mod pocket_contours;
mod pocket_operations;
mod pockets;
mod polar;
mod routine;
pub mod syntax;
mod threads;
pub mod token;
mod tool_words;
mod transforms;

use super::control::About;
use super::guess::Evidence;
use super::languages::Language;
use super::run::{Files, run_file};
use super::settings::Settings;
use crate::diagnostics::Diagnostics;
use std::path::Path;

/// The Fagor 8055.
pub struct Fagor;

/// For the list of all languages.
pub const LANGUAGE: Fagor = Fagor;

const FILES: Files<routine::Routine> = Files {
    extensions: &routine::EXTENSIONS,
    read: routine::routines,
};

impl Language for Fagor {
    fn evaluate<'a>(&self, path: &Path, settings: &'a Settings, about: About<'a>) {
        if let Some(refusal) = lathe::refusal(path, settings) {
            about.diagnostics.push(refusal);
            return;
        }
        run_file(path, FILES, settings, about, interpreter::Interpreter::new);
    }

    fn evidence(&self, lines: &[String], extension: &str) -> Evidence {
        evidence(lines, extension)
    }
}

/// Whether a line is understood: what stands in parentheses is a comment to other controls, which may begin like a statement.
fn is_block(line: &str) -> bool {
    let mut diagnostics = Diagnostics::default();
    parser::parse_blocks(line.into(), &mut diagnostics);
    diagnostics.errors() == 0
}

/// What speaks for this dialect; see [`super::guess`].
fn evidence(lines: &[String], extension: &str) -> Evidence {
    const STATEMENTS: [&str; 10] = [
        "(RPT", "(SUB", "(CALL", "(PCALL", "(MCALL", "(MDOFF", "(GOTO", "(IF", "(RET", "(ERROR",
    ];
    let mut evidence = Evidence::default();
    // That of lathes is no less one of this control, and is refused there by name.
    if matches!(extension, "pim" | "pit") {
        evidence.add_extension(50);
    }
    for (at, line) in lines.iter().enumerate() {
        let code: String = line
            .split(';')
            .next()
            .unwrap_or("")
            .replace(char::is_whitespace, "");
        let code = code.strip_prefix('N').map_or(code.as_str(), |rest| {
            rest.trim_start_matches(|c: char| c.is_ascii_digit())
        });
        if code.starts_with('%') && code.contains(",MX") {
            evidence.add(100, at);
        }
        let calls = STATEMENTS
            .iter()
            .any(|statement| code.starts_with(statement));
        let assigns = code.strip_prefix("(P").is_some_and(|rest| {
            rest.starts_with(|c: char| c.is_ascii_digit()) && rest.contains('=')
        });
        if (calls || assigns) && is_block(line) {
            evidence.add(40, at);
        }
        if code.starts_with("G72S") || code.starts_with("G73Q") || code.starts_with("G14") {
            evidence.add(10, at);
        }
    }
    evidence
}
