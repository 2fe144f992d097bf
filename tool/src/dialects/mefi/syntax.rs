//! The blocks and subprograms of a MEFI part program.

use crate::dialects::library;
use crate::source::Span;

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
    /// The text without its comment.
    pub span: Span,
    /// `N10`.
    pub number: Option<u32>,
    /// Whether it begins with `/`.
    pub skip: bool,
    /// The words after the number.
    pub words: Vec<Word>,
    /// Whether something in it was not understood; that has been reported.
    pub invalid: bool,
    /// The comment after a quotation mark.
    pub comment: Option<String>,
}

impl Block {
    /// Whether it does nothing.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty() && !self.invalid
    }

    /// Whether its line holds nothing.
    pub fn is_blank(&self) -> bool {
        self.is_empty() && self.number.is_none() && self.comment.is_none()
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
#[derive(Clone, Debug, PartialEq)]
pub struct Routine {
    /// `L100`; of a program, the name of its file.
    pub name: String,
    /// Whether it is a program.
    pub main: bool,
    /// Index of its file.
    pub file: usize,
    /// Its blocks.
    pub blocks: Vec<Block>,
}

impl library::Routine for Routine {
    fn name(&self) -> &str {
        &self.name
    }

    fn is_main(&self) -> bool {
        self.main
    }

    fn is_empty(&self) -> bool {
        self.blocks.iter().all(Block::is_empty)
    }

    fn first_span(&self) -> Span {
        let first = self.blocks.iter().find(|block| !block.is_empty());
        first.map_or(Span::start_of(self.file), |block| block.span)
    }
}
