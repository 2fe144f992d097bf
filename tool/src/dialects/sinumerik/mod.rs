//! The language of Sinumerik-like controls.
//!
//! Text is cut into tokens ([`lexer`]), tokens are made into a tree ([`parser`]), and the tree is run
//! ([`interpreter`]) into the form that all dialects share ([`crate::program`]).

mod approach;
mod approach_side;
mod arc_plane;
mod arc_words;
mod block_words;
mod calls;
mod contour_angle;
mod contour_exit;
mod contour_milling;
mod cursor;
mod cycle_parameters;
mod cycle_tables;
mod deep_hole;
mod drilling;
mod evaluate_words;
mod expressions;
mod external;
mod flow;
mod flow_parser;
mod frame_commands;
mod g_functions;
mod hole_patterns;
mod interpreter;
mod kept_modes;
pub mod lexer;
mod milling;
mod offset_parser;
mod outline;
pub mod parser;
mod pockets;
mod polar;
mod procedures;
mod programmed_offset;
mod refusals;
mod routine;
mod settable_offset;
mod slots;
mod smoothing;
mod spindle;
mod spindle_speed;
mod structure;
mod swivel;
pub mod syntax;
mod tapping;
pub mod token;
mod variables;
mod word_parser;
mod words;
mod words_beside;

use super::control::About;
use super::guess::{Evidence, without_comments};
use super::languages::Language;
use super::run::{Files, run_file};
use super::settings::Settings;
use std::path::Path;

/// Sinumerik-like controls.
pub struct Sinumerik;

/// For the list of all languages.
pub const LANGUAGE: Sinumerik = Sinumerik;

const FILES: Files<routine::Routine> = Files {
    extensions: &routine::EXTENSIONS,
    read: routine::routines,
};

impl Language for Sinumerik {
    fn evaluate<'a>(&self, path: &Path, settings: &'a Settings, about: About<'a>) {
        run_file(path, FILES, settings, about, interpreter::Interpreter::new);
    }

    fn evidence(&self, lines: &[String], extension: &str) -> Evidence {
        evidence(lines, extension)
    }
}

/// Whether a parenthesis behind this text belongs to a call or an expression. Where a line begins, and behind a word such as G1 or
/// X10., this dialect has none: there it is the comment of another.
fn goes_on(before: &str) -> bool {
    let before = before.trim_end();
    let name = before.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.');
    let is_letter = |c: &char| c.is_ascii_alphabetic() || *c == '_';
    let letters = name.chars().rev().take_while(is_letter).count();
    let operators = ['=', '+', '-', '*', '/', '<', '>', ',', '(', '['];
    match name.len() < before.len() {
        true => letters > 1,
        false => letters > 0 || (name != "/" && name.ends_with(operators)),
    }
}

/// What speaks for this dialect; see [`super::guess`].
fn evidence(lines: &[String], extension: &str) -> Evidence {
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
        let code = without_comments(line.split(';').next().unwrap_or(""), goes_on);
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
