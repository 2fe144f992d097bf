//! The main program and the subroutines of a file.

use super::lexer::tokens;
use super::parser::{is_empty, parse};
use super::syntax::{Block, Section};
use crate::diagnostics::Diagnostics;
use crate::dialects::library;
use crate::source::{Sources, Span, Text};
use std::collections::HashMap;

/// Endings of program files.
pub const EXTENSIONS: [&str; 3] = ["pim", "pit", "nc"];

/// A program or a subroutine, ready to run.
#[derive(Debug)]
pub struct Routine {
    /// The name of the program, or `SUB 10`.
    pub name: String,
    /// The file it was found in.
    pub file: usize,
    /// Its blocks.
    pub blocks: Vec<Block>,
    /// Where the blocks with a number are, in order.
    labels: HashMap<u32, Vec<usize>>,
    subroutine: bool,
}

impl Routine {
    fn new(name: String, file: usize, section: Section) -> Routine {
        let mut labels: HashMap<u32, Vec<usize>> = HashMap::new();
        for (index, block) in section.blocks.iter().enumerate() {
            if let Some(number) = block.number {
                labels.entry(number).or_default().push(index);
            }
        }
        Routine {
            name,
            file,
            labels,
            subroutine: section.subroutine.is_some(),
            blocks: section.blocks,
        }
    }

    /// The block with this number: towards the end from the block `at` first, then from the beginning.
    pub fn label(&self, number: u32, at: usize) -> Option<usize> {
        let places = self.labels.get(&number)?;
        let after = places.partition_point(|place| *place <= at);
        places.get(after).or(places.first()).copied()
    }
}

/// The name of a subroutine in the library.
pub fn subroutine_name(number: u32) -> String {
    format!("SUB {number}")
}

/// The routines of a file. Of a file other than the program itself, the main program is not one.
pub fn routines(
    text: Text,
    stem: &str,
    _: &Sources,
    diagnostics: &mut Diagnostics,
) -> Vec<Routine> {
    let tokens = tokens(text, diagnostics);
    let (header, sections) = parse(text, &tokens, diagnostics);
    let routine = |section: Section| {
        let name = match section.subroutine {
            Some(number) => subroutine_name(number),
            None => header.clone().unwrap_or(stem.to_string()),
        };
        Routine::new(name, text.file, section)
    };
    let wanted = |section: &Section| text.file == 0 || section.subroutine.is_some();
    let sections = sections.into_iter().filter(wanted);
    sections.map(routine).collect()
}

/// Whether a text seems to define the subroutine with this name: a quick look that spares parsing
/// every file of a folder.
pub fn defines(text: &str, name: &str) -> bool {
    let number = name.trim_start_matches("SUB ");
    text.lines().any(|line| {
        let code = line.split(';').next().unwrap_or("").to_ascii_uppercase();
        let Some((_, rest)) = code.split_once('(') else {
            return false;
        };
        let Some(rest) = rest.trim_start().strip_prefix("SUB") else {
            return false;
        };
        let digits = rest.split(')').next().unwrap_or("").trim();
        digits
            .parse::<u32>()
            .is_ok_and(|found| found.to_string() == number)
    })
}

impl library::Routine for Routine {
    fn name(&self) -> &str {
        &self.name
    }

    fn is_main(&self) -> bool {
        !self.subroutine
    }

    fn is_empty(&self) -> bool {
        self.blocks.iter().all(is_empty)
    }

    fn first_span(&self) -> Span {
        let first = self.blocks.first();
        first.map_or(Span::start_of(self.file), |block| block.span)
    }
}
