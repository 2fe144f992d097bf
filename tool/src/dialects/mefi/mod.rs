//! The language of MEFI controls.
//!
//! Lines are cut into words and subprograms ([`parser`]); the program is run ([`interpreter`]) into
//! the form that all dialects share ([`crate::program`]). Mirror, scale and shift of its eleventh
//! group of G functions (G34 to G37) are in [`recalculation`].

mod block_words;
mod calls;
mod g_functions;
mod interpreter;
mod parser;
mod recalculation;
mod routine;
mod syntax;

use super::control::About;
use super::guess::{Evidence, without_comments};
use super::languages::Language;
use super::run::{Files, run_file};
use super::settings::Settings;
use std::path::Path;

/// Endings of subprogram files.
const EXTENSIONS: [&str; 4] = ["nc", "prg", "cnc", "txt"];

/// MEFI controls.
pub struct Mefi;

/// For the list of all languages.
pub const LANGUAGE: Mefi = Mefi;

const FILES: Files<syntax::Routine> = Files {
    extensions: &EXTENSIONS,
    read: routine::routines,
};

impl Language for Mefi {
    fn evaluate<'a>(&self, path: &Path, settings: &'a Settings, about: About<'a>) {
        run_file(path, FILES, settings, about, interpreter::Interpreter::new);
    }

    fn evidence(&self, lines: &[String], extension: &str) -> Evidence {
        evidence(lines, extension)
    }
}

/// What speaks for this dialect; see [`super::guess`].
fn evidence(lines: &[String], _extension: &str) -> Evidence {
    let mut evidence = Evidence::default();
    for (index, line) in lines.iter().enumerate() {
        // These controls have neither ; nor parentheses: inches in comments of others are marked like their own comments.
        let line = without_comments(line.split(';').next().unwrap_or(""), |_| false);
        let code = line.strip_prefix('N').map_or(line.as_str(), |rest| {
            rest.trim_start_matches(|c: char| c.is_ascii_digit())
                .trim_start()
        });
        let words: Vec<&str> = code.split_whitespace().collect();
        let begins = |wanted: &[&str]| words.first().is_some_and(|word| wanted.contains(word));
        let label = words.iter().any(|word| {
            let number = word.strip_prefix('L').unwrap_or("");
            !number.is_empty() && number.chars().all(|c| c.is_ascii_digit())
        });
        if begins(&["G71", "G79"]) && label {
            evidence.add(100, index);
        }
        if begins(&["G34", "G35", "G36", "G37"]) {
            evidence.add(10, index);
        }
        // An opening quotation mark that is never closed: a comment.
        if line.contains(['“', '„']) || line.matches('"').count() == 1 {
            evidence.add(20, index);
        }
    }
    evidence
}
