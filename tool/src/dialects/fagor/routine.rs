//! The main program and the subroutines of a file.

use super::lexer::tokens;
use super::parser::{header, parse_blocks};
use super::syntax::{Block, HighLevel, Statement};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::blocks::{self, Blocks, Lines};
use crate::dialects::control::Place;
use crate::dialects::library;
use crate::dialects::outline::{Notable, notable_lines};
use crate::source::{Sources, Span, Text};
use std::collections::BTreeSet;
use std::io;
use std::ops::Range;

/// Endings of program files.
pub const EXTENSIONS: [&str; 2] = ["pim", "nc"];

/// Statements that lead elsewhere, or to which something leads.
const FLOW: [&str; 5] = ["SUB", "RET", "GOTO", "RPT", "IF"];

/// A program or a subroutine, ready to run.
#[derive(Debug)]
pub struct Routine {
    /// The name of the program, or `SUB 10`.
    pub name: String,
    /// The file it was found in.
    pub file: usize,
    /// Its blocks.
    pub blocks: Blocks<Block>,
    subroutine: bool,
    /// The first block that says something, if there is one.
    first: Option<Span>,
}

impl Routine {
    /// The block with this number: towards the end from the block `at` first, then from the beginning.
    pub fn label(
        &self,
        number: u32,
        at: usize,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) -> Option<usize> {
        let places = self.blocks.numbered(number, sources, diagnostics);
        let after = places.partition_point(|place| *place <= at);
        places.get(after).or(places.first()).copied()
    }
}

/// The name of a subroutine in the library.
pub fn subroutine_name(number: u32) -> String {
    format!("SUB {number}")
}

/// Whether a line is the header, or leads elsewhere. Blanks may be missing: `(IFP1GT3GOTON10)`.
fn is_notable(line: &[u8]) -> bool {
    let text = String::from_utf8_lossy(line).to_ascii_uppercase();
    let code = text.split(';').next().unwrap_or("");
    let statement = code.contains('(') && FLOW.iter().any(|word| code.contains(word));
    statement || code.contains('%')
}

/// What is known of a file when its lines have been looked at.
#[derive(Default)]
struct Outline {
    name: Option<String>,
    /// The lines of the main program, and of each subroutine with its number.
    main: Vec<Range<usize>>,
    subroutines: Vec<(u32, Range<usize>)>,
    /// The subroutine that has begun, and where: its span and its line.
    open: Option<(u32, Span, usize)>,
    /// The first line behind the last subroutine.
    next: usize,
    targets: BTreeSet<u32>,
}

impl Outline {
    fn line(&mut self, line: usize, text: Text, sources: &Sources, diagnostics: &mut Diagnostics) {
        if let Some((name, span)) = header(&tokens(text, diagnostics)) {
            self.header(name, span, line, sources, diagnostics);
            return;
        }
        for block in parse_blocks(text, diagnostics) {
            match (&block.statement, self.open) {
                (Statement::Subroutine(number), None) => {
                    if self.subroutines.iter().any(|(known, _)| known == number) {
                        let name = subroutine_name(*number);
                        diagnostics.push(
                            Diagnostic::error(
                                block.place.span,
                                format!("{name} is in this file twice"),
                            )
                            .help("give one of them another number"),
                        );
                    }
                    self.main.push(self.next..line);
                    self.open = Some((*number, block.place.span, line));
                }
                (Statement::Subroutine(_), Some((_, first, _))) => {
                    let line = sources.line(first);
                    diagnostics.push(
                        Diagnostic::error(
                            block.place.span,
                            "a subroutine begins inside of another",
                        )
                        .help(format!("end the one of line {line} with (RET)")),
                    );
                }
                (Statement::High(HighLevel::Return(_)), Some(_)) => self.close(line + 1),
                (Statement::High(statement), _) => self.add_targets(statement),
                _ => {}
            }
        }
    }

    fn header(
        &mut self,
        name: &str,
        span: Span,
        line: usize,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) {
        let mut before = self.main.clone();
        before.push(self.next..line);
        let lines = Lines {
            file: span.file,
            ranges: before,
            ..Lines::default()
        };
        let before = Blocks::new(lines, parse_blocks);
        let begun = || {
            before
                .find(sources, &mut Diagnostics::default(), says)
                .is_some()
        };
        if self.name.is_some() || !self.subroutines.is_empty() || begun() {
            diagnostics.push(
                Diagnostic::error(span, "a second program begins in the same file")
                    .help("keep one program with its subroutines in the file"),
            );
        }
        self.name = Some(name.to_string());
    }

    fn close(&mut self, behind: usize) {
        if let Some((number, _, begin)) = self.open.take() {
            self.subroutines.push((number, begin + 1..behind));
            self.next = behind;
        }
    }

    fn add_targets(&mut self, statement: &HighLevel) {
        match statement {
            HighLevel::If(_, then, otherwise) => {
                self.add_targets(then);
                otherwise
                    .iter()
                    .for_each(|otherwise| self.add_targets(otherwise));
            }
            HighLevel::Goto(label) => self.targets.extend([label.number]),
            HighLevel::Repeat { first, last, .. } => {
                self.targets.extend([first.number, last.number])
            }
            _ => {}
        }
    }
}

fn says(block: &Block) -> bool {
    block.statement != Statement::Empty
}

/// The routines of a file; see [`library::Read`]. Of a file other than the program itself, the main program is not
/// one.
pub fn routines(
    file: usize,
    stem: &str,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) -> Vec<Routine> {
    let mut outline = Outline::default();
    let notable = Notable {
        is: is_notable,
        among_plain: |_| false,
    };
    let mut visit = |line: usize, text: Text, diagnostics: &mut Diagnostics| {
        outline.line(line, text, sources, diagnostics);
    };
    let lines = notable_lines(file, sources, diagnostics, notable, &mut visit);
    if let Some((_, span, _)) = outline.open {
        diagnostics.push(
            Diagnostic::error(span, "this subroutine does not end")
                .help("put (RET) into a block of its own at its end"),
        );
        outline.close(lines);
    }
    outline.main.push(outline.next..lines);
    let mut routine = |name: String, ranges: Vec<Range<usize>>, subroutine: bool| {
        let lines = Lines {
            file,
            ranges,
            targets: outline.targets.clone(),
            ..Lines::default()
        };
        let blocks = Blocks::new(lines, parse_blocks);
        let first = blocks.find(sources, diagnostics, says);
        Routine {
            name,
            file,
            blocks,
            subroutine,
            first: first.map(|block| block.place.span),
        }
    };
    let mut routines = Vec::new();
    if file == 0 {
        let name = outline.name.unwrap_or(stem.to_string());
        routines.push(routine(name, outline.main, false));
    }
    for (number, lines) in outline.subroutines {
        routines.push(routine(subroutine_name(number), vec![lines], true));
    }
    routines
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

impl blocks::Block for Block {
    fn place(&self) -> &Place {
        &self.place
    }

    fn is_blank(&self) -> bool {
        false
    }

    fn is_invalid(&self) -> bool {
        self.statement == Statement::Invalid
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
        !self.subroutine
    }

    fn is_empty(&self) -> bool {
        self.first.is_none()
    }

    fn first_span(&self) -> Span {
        self.first.unwrap_or(Span::start_of(self.file))
    }
}
