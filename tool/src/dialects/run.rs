//! Running the main program, as a whole or piece by piece.
//!
//! A program without jumps, loops and subprograms of its own can be run while it is read. Its text,
//! its blocks and what they do are then held for a window of the file only, so that a program may be
//! longer than the memory.

use super::control::plain::PlainBlock;
use super::control::{Control, Done};
use super::library::{Library, Parse, Routine};
use crate::diagnostics::Diagnostic;
use crate::source::{Span, Text};
use std::ops::Range;
use std::rc::Rc;

/// Where the flow goes after a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// To the block with this index.
    Block(usize),
    /// Out of the routine.
    Return,
    /// The program is at its end.
    End,
    /// Nowhere: what follows cannot be known after an error.
    Abort,
}

/// The interpreter of a dialect.
pub trait Interpret<'a> {
    /// Its programs and subprograms.
    type Routine: Routine;

    /// The control that it imitates.
    fn control(&mut self) -> &mut Control<'a>;

    /// The programs that it knows.
    fn library(&self) -> &Library<Self::Routine>;

    /// Runs the blocks of the main program, or of a piece of it; `false` when nothing can follow.
    fn run_main(&mut self, main: &Rc<Self::Routine>) -> bool;

    /// The main program has come to its end without M30. `last`: the program or its last piece.
    fn end_is_missing(&mut self, last: &Rc<Self::Routine>);

    /// Whether a straight motion means to this dialect, in its present state, what it means to all.
    fn takes(&self, block: &PlainBlock) -> bool;
}

/// A block that is repeated jumps to one that is not.
pub fn jump_out_of_repetition(span: Span) -> Diagnostic {
    Diagnostic::error(span, "this jump leaves the blocks that are repeated")
        .help("let the repetition end before the jump")
}

/// Runs the main program to its end.
pub fn run<'a, I: Interpret<'a>>(interpreter: &mut I) {
    if interpreter.control().sources.file(0).is_windowed() {
        if let Err(diagnostic) = run_pieces(interpreter) {
            interpreter.control().diagnostics.push(*diagnostic);
        }
    } else if let Some(main) = interpreter.library().main() {
        interpreter.control().begin_main(main.title());
        if interpreter.run_main(&main) {
            interpreter.end_is_missing(&main);
        }
    }
    interpreter.control().finish();
}

fn run_pieces<'a, I: Interpret<'a>>(interpreter: &mut I) -> Done {
    let stem = interpreter.library().stem().to_string();
    interpreter.control().begin_main(&stem);
    let mut last = None;
    let mut goes_on = true;
    while advance(interpreter.control())? {
        let (text, start) = interpreter.control().sources.file(0).shared_text();
        let window = Window { text, start };
        // What stands behind the end of the program is parsed all the same: it may be its rest, and the
        // end a slip.
        goes_on = window.run(interpreter, goes_on);
        if let Some(line) = window.last_line() {
            last = Some((
                window.part(line.clone()).to_string(),
                window.start + line.start,
            ));
        }
    }
    if !goes_on {
        return Ok(());
    }
    let (last, start) = last.unwrap_or_default();
    let text = Text {
        file: 0,
        text: &last,
        start,
    };
    for piece in parse(interpreter, text) {
        interpreter.end_is_missing(&piece);
    }
    Ok(())
}

fn advance(control: &mut Control) -> Result<bool, Box<Diagnostic>> {
    control.sources.advance(0).map_err(|error| {
        let message = format!("the program cannot be read: {error}");
        Box::new(Diagnostic::error(Span::start_of(0), message))
    })
}

/// The main program in some of its lines.
fn parse<'a, I: Interpret<'a>>(interpreter: &mut I, text: Text) -> Vec<Rc<I::Routine>> {
    let parse: Parse<I::Routine> = interpreter.library().parser();
    let stem = interpreter.library().stem().to_string();
    let control = interpreter.control();
    let pieces = parse(text, &stem, control.sources, control.diagnostics);
    let main = pieces.into_iter().filter(Routine::is_main);
    main.map(Rc::new).collect()
}

/// The lines of the program that are held.
struct Window {
    text: Rc<str>,
    start: usize,
}

impl Window {
    fn part(&self, lines: Range<usize>) -> &str {
        self.text.get(lines).unwrap_or("")
    }

    /// Runs all blocks, or only parses them where the program does not go on so far; whether it goes on
    /// behind them.
    fn run<'a, I: Interpret<'a>>(&self, interpreter: &mut I, mut goes_on: bool) -> bool {
        let bytes = self.text.as_bytes();
        // Lines from `waiting` on are left to the parser of the dialect.
        let (mut waiting, mut at) = (0, 0);
        while at < bytes.len() {
            let rest = bytes.get(at..).unwrap_or(&[]);
            let length = rest
                .iter()
                .position(|byte| *byte == b'\n')
                .unwrap_or(rest.len());
            let line = rest.get(..length).unwrap_or(&[]);
            let next = at + length + 1;
            let plain = PlainBlock::read(line).filter(|block| interpreter.takes(block));
            if let Some(block) = plain {
                if waiting < at {
                    goes_on = self.run_lines(interpreter, waiting..at, goes_on);
                }
                waiting = at;
                // What the lines before have changed may ask for the parser after all.
                let [first, end] = block.range.map(|place| self.start + at + place);
                let span = Span {
                    file: 0,
                    start: first,
                    end,
                };
                let taken = goes_on
                    && interpreter.takes(&block)
                    && interpreter.control().plain_motion(&block, span);
                if taken {
                    goes_on = interpreter.control().count_block(span);
                    waiting = next;
                }
            }
            at = next;
        }
        match waiting < bytes.len() {
            true => self.run_lines(interpreter, waiting..bytes.len(), goes_on),
            false => goes_on,
        }
    }

    fn run_lines<'a, I: Interpret<'a>>(
        &self,
        interpreter: &mut I,
        lines: Range<usize>,
        goes_on: bool,
    ) -> bool {
        let text = Text {
            file: 0,
            start: self.start + lines.start,
            text: self.part(lines),
        };
        let pieces = parse(interpreter, text);
        goes_on && pieces.iter().all(|piece| interpreter.run_main(piece))
    }

    /// The last line that holds something and is not the mark of an end.
    fn last_line(&self) -> Option<Range<usize>> {
        let mut end = self.text.len();
        loop {
            end = self.text.get(..end)?.trim_end().len();
            let start = self
                .text
                .get(..end)?
                .rfind('\n')
                .map_or(0, |before| before + 1);
            match self.text.get(start..end)?.trim_start() {
                "" => return None,
                line if line.starts_with('%') => end = start,
                _ => return Some(start..end),
            }
        }
    }
}
