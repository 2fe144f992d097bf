//! The blocks and subprograms of a MEFI part program.

use crate::diagnostics::Diagnostics;
use crate::dialects::blocks::{self, Blocks};
use crate::dialects::control::Place;
use crate::dialects::library;
use crate::source::{Sources, Span};
use std::io;

/// An address and its value: `X10`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Word {
    /// The letter, in upper case.
    pub letter: char,
    /// The number after it.
    pub value: f64,
    /// Where both stand.
    pub span: Span,
}

/// One line.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Its text, number and comment.
    pub place: Place,
    /// Whether it begins with `/`.
    pub skip: bool,
    /// The words after the number.
    pub words: Vec<Word>,
    /// Whether something in it was not understood; that has been reported.
    pub invalid: bool,
}

impl Block {
    /// Whether it does nothing.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty() && !self.invalid
    }

    /// The word with this letter and number, if there is one: `G79`.
    pub fn function(&self, letter: char, number: f64) -> Option<&Word> {
        let wanted = |word: &&Word| word.letter == letter && word.value == number;
        self.words.iter().find(wanted)
    }

    /// The first word with this letter.
    pub fn word(&self, letter: char) -> Option<&Word> {
        self.words.iter().find(|word| word.letter == letter)
    }
}

/// A program, or a subprogram from `G79 L100` to `G70`.
#[derive(Debug)]
pub struct Routine {
    /// `L100`; of a program, the name of its file.
    pub name: String,
    /// Whether it is a program.
    pub main: bool,
    /// Index of its file.
    pub file: usize,
    /// Its blocks.
    pub blocks: Blocks<Block>,
    /// The first block that does something, if there is one.
    pub first: Option<Span>,
}

impl blocks::Block for Block {
    fn place(&self) -> &Place {
        &self.place
    }

    fn is_blank(&self) -> bool {
        self.is_empty() && self.place.number.is_none() && self.place.comment.is_none()
    }

    fn is_invalid(&self) -> bool {
        self.invalid
    }
}

impl library::Routine for Routine {
    fn check_rest(&self, sources: &Sources, diagnostics: &mut Diagnostics) -> io::Result<()> {
        self.blocks.check_rest(sources, diagnostics)
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn is_main(&self) -> bool {
        self.main
    }

    fn is_empty(&self) -> bool {
        self.first.is_none()
    }

    fn first_span(&self) -> Span {
        self.first.unwrap_or(Span::start_of(self.file))
    }
}
