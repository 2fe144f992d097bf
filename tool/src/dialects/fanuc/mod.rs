//! The language of Fanuc-like controls of milling machines, with macro B.
//!
//! Text is cut into tokens ([`lexer`]), tokens are made into a tree ([`parser`]), and the tree is run
//! ([`interpreter`]) into the form that all dialects share ([`crate::program`]).

mod arguments;
mod block_words;
mod calls;
mod circular_pocket;
mod cycles;
mod evaluate_words;
mod expressions;
mod flow;
mod g_functions;
mod hole_circles;
mod holes;
mod interpreter;
mod lathe;
pub mod lexer;
mod look_ahead;
mod machine_moves;
pub mod parser;
mod polar;
mod routine;
mod set_offset;
mod skipped_places;
mod smoothness;
mod spindle;
pub mod syntax;
mod system_variables;
mod tilted_plane;
pub mod token;
mod tool_offsets;
mod transforms;
mod values;
mod variables;

use super::control::About;
use super::guess::{Evidence, without_comments};
use super::languages::Language;
use super::lathe::on_lathe;
use super::run::{Files, run_file};
use super::settings::Settings;
use std::path::Path;

/// Fanuc-like controls.
pub struct Fanuc;

/// For the list of all languages.
pub const LANGUAGE: Fanuc = Fanuc;

const FILES: Files<routine::Routine> = Files {
    extensions: &routine::EXTENSIONS,
    read: routine::routines,
};

impl Language for Fanuc {
    fn evaluate<'a>(&self, path: &Path, settings: &'a Settings, about: About<'a>) {
        if settings.lathe {
            about.diagnostics.push(on_lathe());
            return;
        }
        run_file(path, FILES, settings, about, interpreter::Interpreter::new);
    }

    fn evidence(&self, lines: &[String], _: &str) -> Evidence {
        let mut evidence = Evidence::default();
        for (at, line) in lines.iter().enumerate() {
            evidence.add(weight(&code(line)), at);
        }
        evidence
    }
}

/// A line without comments and blanks.
fn code(line: &str) -> String {
    without_comments(line, |_| false).replace(char::is_whitespace, "")
}

/// How much the words of a line speak for this dialect.
fn weight(code: &str) -> u32 {
    const WORDS: [(&str, u32); 16] = [
        ("M98P", 40),
        ("G65P", 40),
        ("G66P", 40),
        ("IF[", 30),
        ("WHILE[", 30),
        ("G68.2", 40),
        ("G53.1", 30),
        ("G51.1", 40),
        ("G50.1", 40),
        ("G5.1Q", 40),
        ("G05.1Q", 40),
        ("G54.1P", 40),
        ("G43H", 15),
        ("G43Z", 10),
        ("G91G28", 20),
        ("M29S", 20),
    ];
    let known = WORDS.iter().filter(|(word, _)| code.contains(word));
    let words: u32 = known.map(|(_, weight)| weight).sum();
    let number = code.strip_prefix(['O', ':']).unwrap_or("");
    let is_head = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
    let variable = code.trim_start_matches(|c: char| c == 'N' || c.is_ascii_digit());
    let assigns = variable.strip_prefix('#').is_some_and(|rest| {
        rest.starts_with(|c: char| c.is_ascii_digit() || c == '[') && rest.contains('=')
    });
    words + 60 * u32::from(is_head) + 30 * u32::from(assigns)
}
