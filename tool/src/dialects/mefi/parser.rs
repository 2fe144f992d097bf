//! From the text of a MEFI part program to blocks.

use super::syntax::{Block, Word};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::Place;
use crate::dialects::scanner::{Scanner, is_blank};
use crate::source::{Span, Text};

/// Marks that begin a comment: the quotation mark of the control, and what word processors make of it.
const COMMENT: [char; 9] = ['"', '“', '”', '„', '‟', '«', '»', '″', '‶'];

/// Letters that begin a word.
const ADDRESSES: &str = "ABCDFGIJKLMNPQRSTUVWXYZ";

/// The blocks of some lines; those that begin a program or a subprogram are none.
pub fn parse_blocks(text: Text, diagnostics: &mut Diagnostics) -> Vec<Block> {
    let lines = lines(text, diagnostics).into_iter();
    let blocks = lines.filter_map(|line| match line {
        Line::Block(block) if block.function('G', 79.0).is_none() => Some(block),
        _ => None,
    });
    blocks.collect()
}

/// What some lines say.
pub(super) fn lines(text: Text, diagnostics: &mut Diagnostics) -> Vec<Line> {
    let mut reader = Reader {
        scanner: Scanner::new(text),
    };
    let mut lines = Vec::new();
    while reader.scanner.peek().is_some() {
        lines.push(reader.line(diagnostics));
    }
    lines
}

/// One line.
pub(super) enum Line {
    /// `%1`: a program begins.
    Program,
    /// Any other.
    Block(Block),
}

struct Reader<'a> {
    scanner: Scanner<'a>,
}

impl Reader<'_> {
    fn line(&mut self, diagnostics: &mut Diagnostics) -> Line {
        self.blanks();
        let start = self.scanner.position();
        let empty = self.scanner.span_from(start);
        let mut block = Block {
            place: Place {
                span: empty,
                number: None,
                comment: None,
            },
            skip: false,
            words: Vec::new(),
            invalid: false,
        };
        if self.scanner.peek() == Some('%') {
            self.finish_line();
            return Line::Program;
        }
        block.skip = self.scanner.take("/");
        let mut end = self.scanner.position();
        loop {
            self.blanks();
            let Some(next) = self.scanner.peek().filter(|next| *next != '\n') else {
                break;
            };
            if COMMENT.contains(&next) {
                block.place.comment = Some(self.comment());
                break;
            }
            match self.word(next) {
                Ok(word) => add(&mut block, word, diagnostics),
                Err(diagnostic) => {
                    diagnostics.push(diagnostic);
                    block.invalid = true;
                    self.scanner.take_while(|c| c != '\n');
                    end = self.scanner.position();
                    break;
                }
            }
            end = self.scanner.position();
        }
        self.finish_line();
        block.place.span = Span { end, ..empty };
        Line::Block(block)
    }

    fn finish_line(&mut self) {
        self.scanner.take_while(|c| c != '\n');
        self.scanner.take("\n");
    }

    fn blanks(&mut self) {
        self.scanner.take_while(is_blank);
    }

    /// The comment, without the marks at its beginning and its end.
    fn comment(&mut self) -> String {
        let text = self.scanner.take_while(|c| c != '\n');
        let mark = |c: char| COMMENT.contains(&c) || c.is_whitespace();
        text.trim_matches(mark).to_string()
    }

    fn word(&mut self, first: char) -> Result<Word, Diagnostic> {
        let start = self.scanner.position();
        let letter = first.to_ascii_uppercase();
        let is_letter = |c: char| c.is_ascii_alphabetic();
        let letters = self.scanner.rest().chars().take_while(|c| is_letter(*c));
        if letters.count() > 1 {
            let name = self.scanner.take_while(is_letter);
            return Err(Diagnostic::error(
                self.scanner.span_from(start),
                format!("`{name}` is not a word of this dialect"),
            )
            .help(
                "a word is one letter and a number (G1 X10); G35 mirrors, G36 scales, G37 shifts, \
                     G71 L100 calls, comments begin with \"",
            ));
        }
        self.scanner.advance();
        if !ADDRESSES.contains(letter) {
            return Err(self.unknown(start, first));
        }
        self.blanks();
        let sign = match (self.scanner.take("-"), self.scanner.take("+")) {
            (true, _) => -1.0,
            _ => 1.0,
        };
        let number = self
            .scanner
            .decimal()
            .and_then(|text| text.parse::<f64>().ok());
        let span = self.scanner.span_from(start);
        let Some(number) = number.filter(|number| number.is_finite()) else {
            return Err(Diagnostic::error(
                span,
                format!("the value of {letter} is missing or not a number"),
            )
            .help(format!("write {letter}10")));
        };
        if self.scanner.peek() == Some('.') {
            return Err(Diagnostic::error(span, "a number with two decimal points"));
        }
        Ok(Word {
            letter,
            value: sign * number,
            span,
        })
    }

    fn unknown(&self, start: usize, character: char) -> Diagnostic {
        let span = self.scanner.span_from(start);
        match character {
            '(' | ';' => Diagnostic::error(span, "comments do not begin like this in this dialect")
                .help("comments begin with a quotation mark: \""),
            'A'..='Z' | 'a'..='z' => {
                Diagnostic::error(span, format!("the address {character} is not supported"))
                    .help("axes are X Y Z A B C U V W")
            }
            _ => Diagnostic::error(
                span,
                format!(
                    "the character `{}` has no meaning in a part program",
                    character.escape_default()
                ),
            )
            .help("a block consists of words such as G1 or X10; comments begin with \""),
        }
    }
}

fn add(block: &mut Block, word: Word, diagnostics: &mut Diagnostics) {
    if word.letter != 'N' {
        block.words.push(word);
        return;
    }
    let whole = word.value.fract() == 0.0 && (0.0..=9_999_999.0).contains(&word.value);
    if block.place.number.is_some() || !block.words.is_empty() || !whole {
        diagnostics.push(Diagnostic::error(
            word.span,
            "a whole block number stands once, at the beginning of the block",
        ));
        block.invalid = true;
        return;
    }
    block.place.number = Some(word.value as u32);
}
