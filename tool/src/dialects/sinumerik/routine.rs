//! The programs and subprograms of a file.

use super::lexer::tokens;
use super::parser::parse;
use super::structure::Structure;
use super::syntax::{Section, Statement, Target};
use crate::diagnostics::Diagnostics;
use crate::dialects::library;
use crate::source::{Sources, Span, Text};
use std::collections::HashMap;

/// Endings of subprogram files; a subprogram file comes before a main program of the same name.
pub const EXTENSIONS: [&str; 2] = ["spf", "mpf"];

/// A program or subprogram, ready to run.
#[derive(Debug)]
pub struct Routine {
    /// Its name in upper case.
    pub name: String,
    /// The file it was found in.
    pub file: usize,
    /// Its blocks.
    pub section: Section,
    /// Which blocks of it belong together.
    pub structure: Structure,
    labels: HashMap<String, Vec<usize>>,
    numbers: HashMap<u32, Vec<usize>>,
}

impl Routine {
    fn new(name: String, file: usize, section: Section, structure: Structure) -> Routine {
        let mut labels: HashMap<String, Vec<usize>> = HashMap::new();
        let mut numbers: HashMap<u32, Vec<usize>> = HashMap::new();
        for (index, block) in section.blocks.iter().enumerate() {
            if let Some(label) = &block.label {
                labels.entry(label.clone()).or_default().push(index);
            }
            if let Some(number) = block.number {
                numbers.entry(number).or_default().push(index);
            }
        }
        Routine {
            name,
            file,
            section,
            structure,
            labels,
            numbers,
        }
    }

    /// The blocks that a jump can mean, in their order.
    pub fn targets(&self, target: &Target) -> &[usize] {
        let places = match target {
            Target::Label(label) => self.labels.get(label),
            Target::Number(number) => self.numbers.get(number),
        };
        places.map_or(&[], Vec::as_slice)
    }
}

/// The routines of a file.
pub fn routines(
    text: Text,
    stem: &str,
    _: &Sources,
    diagnostics: &mut Diagnostics,
) -> Vec<Routine> {
    let tokens = tokens(text, diagnostics);
    let sections = parse(text, &tokens, diagnostics);
    let routine = |section: Section| {
        let name = match section.name.is_empty() {
            true => stem.to_string(),
            false => section.name.clone(),
        };
        let structure = Structure::of(&section, diagnostics);
        Routine::new(name, text.file, section, structure)
    };
    sections.into_iter().map(routine).collect()
}

impl library::Routine for Routine {
    fn name(&self) -> &str {
        &self.name
    }

    fn is_main(&self) -> bool {
        self.section.main
    }

    fn is_empty(&self) -> bool {
        let mut blocks = self.section.blocks.iter();
        blocks.all(|block| block.statement == Statement::Empty)
    }

    fn first_span(&self) -> Span {
        let mut blocks = self.section.blocks.iter();
        let first = blocks.find(|block| block.statement != Statement::Empty);
        first.map_or(Span::start_of(self.file), |block| block.span)
    }
}
