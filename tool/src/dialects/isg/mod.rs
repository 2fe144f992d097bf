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
mod evidence;
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
use super::guess::Evidence;
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

    fn evidence(&self, lines: &[String], _: &str) -> Evidence {
        evidence::evidence(lines)
    }
}
