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
mod run_commands;
mod structure;
mod syntax;
mod variables;

use super::control::About;
use super::guess::Evidence;
use super::library::Library;
use super::run::run;
use super::settings::Settings;
use std::path::Path;

/// Endings of subprogram files.
const EXTENSIONS: [&str; 6] = ["nc", "sub", "cnc", "iso", "prg", "txt"];

/// Evaluates the part program in file 0 of `sources`; see [`super::evaluate`].
pub fn evaluate<'a>(path: &Path, settings: &'a Settings, about: About<'a>) {
    let library = Library::new(
        path,
        &EXTENSIONS,
        settings,
        about.sources,
        about.diagnostics,
        parser::parse,
    );
    run(&mut interpreter::Interpreter::new(settings, library, about));
}

/// What speaks for this dialect; see [`super::guess`].
pub fn evidence(lines: &[String], _extension: &str) -> Evidence {
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
