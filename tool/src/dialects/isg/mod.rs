//! The language of ISG kernels, which TwinCAT CNC has too.
//!
//! Comments and continued lines are taken out ([`clean`]), blocks are parsed into a tree
//! ([`parser`]), and the tree is run ([`interpreter`]) into the form that all dialects share
//! ([`crate::program`]). Mirrors, the reference point offset and coordinate systems are in
//! [`frames`].

mod block_words;
mod calls;
mod clean;
mod commands;
mod expressions;
mod flow;
mod flow_parser;
mod frames;
mod g_functions;
mod interpreter;
mod modes;
mod parser;
mod reader;
mod routine;
mod run_commands;
mod spindle;
mod structure;
mod syntax;
mod variables;

use super::control::About;
use super::guess::{Evidence, without_comments};
use super::languages::Language;
use super::run::{Files, run_file};
use super::settings::Settings;
use std::path::Path;

/// Endings of subprogram files.
const EXTENSIONS: [&str; 6] = ["nc", "sub", "cnc", "iso", "prg", "txt"];

/// ISG kernels.
pub struct Isg;

/// For the list of all languages.
pub const LANGUAGE: Isg = Isg;

const FILES: Files<syntax::Routine> = Files {
    extensions: &EXTENSIONS,
    read: routine::routines,
};

impl Language for Isg {
    fn evaluate<'a>(&self, path: &Path, settings: &'a Settings, about: About<'a>) {
        run_file(path, FILES, settings, about, interpreter::Interpreter::new);
    }

    fn evidence(&self, lines: &[String], extension: &str) -> Evidence {
        evidence(lines, extension)
    }
}

/// What speaks for this dialect; see [`super::guess`].
fn evidence(lines: &[String], _extension: &str) -> Evidence {
    const STATEMENTS: [&str; 9] = [
        "$IF", "$FOR", "$WHILE", "$DO", "$SWITCH", "$GOTO", "$ENDIF", "$ENDFOR", "$REPEAT",
    ];
    const COMMANDS: [&str; 8] = [
        "#HSC",
        "#CS",
        "#MSG",
        "#SLOPE",
        "#SET",
        "#CONTOUR",
        "#VAR",
        "#ROTATION",
    ];
    const FUNCTIONS: [&str; 6] = ["G161", "G162", "G261", "G351", "V.P.", "V.L."];
    let mut evidence = Evidence::default();
    for (index, line) in lines.iter().enumerate() {
        let line = without_comments(line.split(';').next().unwrap_or(""), |_| false);
        let code = line.strip_prefix('N').map_or(line.as_str(), |rest| {
            rest.trim_start_matches(|c: char| c.is_ascii_digit())
                .trim_start()
        });
        let word = code
            .split(|c: char| c.is_whitespace() || c == '[')
            .next()
            .unwrap_or("");
        let calls = code.starts_with("LL ") || line.starts_with("%L ");
        let only_here = calls || STATEMENTS.contains(&word) || COMMANDS.contains(&word);
        if only_here {
            evidence.add(100, index);
        } else if FUNCTIONS.iter().any(|known| code.contains(known)) {
            evidence.add(40, index);
        }
    }
    evidence
}
