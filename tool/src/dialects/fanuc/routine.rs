//! The programs of a file: each begins with its number, `O1234`.

use super::lexer::tokens;
use super::parser::parse_block;
use super::syntax::{Block, Statement, Word};
use super::token::TokenKind;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::blocks::{self, Blocks, Lines};
use crate::dialects::control::Place;
use crate::dialects::expression::ExpressionKind;
use crate::dialects::library;
use crate::dialects::outline::{Notable, notable_lines};
use crate::source::{Sources, Span, Text};
use std::io;
use std::ops::Range;

/// Endings of program files; the last one is none.
pub const EXTENSIONS: [&str; 8] = ["nc", "cnc", "tap", "eia", "prg", "min", "txt", ""];

/// A program or subprogram, ready to run.
#[derive(Debug)]
pub struct Routine {
    /// `O1234`; of a program without a number, the name of its file.
    pub name: String,
    /// The file it was found in.
    pub file: usize,
    /// Its blocks.
    pub blocks: Blocks<Block>,
    loops: Vec<Loop>,
    main: bool,
    start: Span,
    /// The first block that says something, if there is one.
    first: Option<Span>,
}

/// The blocks from DO to END.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Loop {
    /// Index of the block with DO.
    pub first: usize,
    /// Index of the block with END.
    pub last: usize,
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

    /// The loop that begins or ends at this block.
    pub fn loop_at(&self, at: usize) -> Option<Loop> {
        let is_here = |found: &&Loop| found.first == at || found.last == at;
        self.loops.iter().find(is_here).copied()
    }

    /// Whether a jump leads into a loop from outside of it.
    pub fn jumps_into_loop(&self, from: usize, to: usize) -> bool {
        self.loops.iter().any(|found| {
            let inside = found.first + 1..=found.last;
            inside.contains(&to) && !inside.contains(&from) && found.first != from
        })
    }
}

/// The name of a program in the library.
pub fn program_name(number: u32) -> String {
    format!("O{number}")
}

/// The blocks of some lines; the number of a program is none.
fn parse_blocks(text: Text, diagnostics: &mut Diagnostics) -> Vec<Block> {
    let mut blocks = Vec::new();
    let tokens = tokens(text, diagnostics);
    for line in tokens.split_inclusive(|token| token.kind == TokenKind::EndOfLine) {
        let Some((end, mut tokens)) = line.split_last() else {
            continue;
        };
        if let Some(TokenKind::Program(_)) = tokens.first().map(|head| &head.kind) {
            tokens = tokens.get(1..).unwrap_or(&[]);
        }
        blocks.extend(parse_block(text, tokens, end.span, diagnostics));
    }
    blocks
}

/// Whether a line may begin or end a program or a loop: O1234, :1234, %, M30, M2, DO1, END1.
fn is_notable(line: &[u8]) -> bool {
    let is_mark = |byte: &u8| matches!(byte, b'%' | b':' | b'O' | b'o' | b'M' | b'm' | b'E' | b'e');
    line.iter().any(is_mark)
}

/// A program that is being read.
struct Section {
    name: String,
    start: Span,
    /// Its lines; the end is known when the next one begins.
    lines: Range<usize>,
    ends_program: bool,
    /// The blocks that begin or end loops, with their lines.
    bounds: Vec<(usize, Block)>,
}

/// What is known of a file when its lines have been looked at.
struct Outline<'a> {
    file: usize,
    sources: &'a Sources,
    sections: Vec<Section>,
    /// The line behind a % that ends a program.
    over: Option<usize>,
}

impl Outline<'_> {
    fn begin(&mut self, name: String, start: Span, line: usize) {
        self.sections.push(Section {
            name,
            start,
            lines: line..line,
            ends_program: false,
            bounds: Vec::new(),
        });
    }

    /// The section that has begun ends before this line.
    fn end(&mut self, line: usize, diagnostics: &mut Diagnostics) {
        if let Some(section) = self.sections.last_mut() {
            section.lines.end = line;
        }
        let behind = self.over.take().and_then(|over| {
            let blocks = self.blocks(over..line);
            blocks.find(self.sources, diagnostics, says)
        });
        if let Some(block) = behind {
            diagnostics.push(
                Diagnostic::error(
                    block.place.span,
                    "this stands behind the % that ends the program",
                )
                .help("take the % before it out, or begin a program here: O1234"),
            );
        }
    }

    fn line(&mut self, line: usize, text: Text, diagnostics: &mut Diagnostics) {
        if let Some(head) = tokens(text, diagnostics).first()
            && let TokenKind::Program(number) = head.kind
        {
            match number {
                Some(number) => {
                    self.end(line, diagnostics);
                    self.begin(program_name(number), head.span, line);
                }
                None if !self.has_begun(line, diagnostics) => {}
                None => self.over = self.over.or(Some(line + 1)),
            }
        }
        let blocks = parse_blocks(text, diagnostics);
        let Some(section) = self.sections.last_mut() else {
            return;
        };
        for block in blocks {
            section.ends_program |= ends_program(&block);
            if matches!(block.statement, Statement::Loop(..) | Statement::End(_)) {
                section.bounds.push((line, block));
            }
        }
    }

    /// Whether anything stands before this line.
    fn has_begun(&self, line: usize, diagnostics: &mut Diagnostics) -> bool {
        let blocks = self.blocks(0..line);
        self.sections.len() > 1 || blocks.find(self.sources, diagnostics, says).is_some()
    }

    fn blocks(&self, lines: Range<usize>) -> Blocks<Block> {
        let lines = Lines {
            file: self.file,
            ranges: vec![lines],
            ..Lines::default()
        };
        Blocks::new(lines, parse_blocks)
    }

    fn routine(&self, section: &Section, main: bool, diagnostics: &mut Diagnostics) -> Routine {
        let blocks = self.blocks(section.lines.clone());
        let first = blocks.find(self.sources, diagnostics, says);
        Routine {
            name: section.name.clone(),
            file: self.file,
            loops: self.loops(section, &blocks, diagnostics),
            blocks,
            main,
            start: section.start,
            first: first.map(|block| block.place.span),
        }
    }

    /// The loops of a program; those without beginning or end are reported, unless what is missing may be
    /// in a block that was not understood.
    fn loops(
        &self,
        section: &Section,
        blocks: &Blocks<Block>,
        diagnostics: &mut Diagnostics,
    ) -> Vec<Loop> {
        let mut found = Diagnostics::default();
        let bounds = section.bounds.iter();
        let loops = loops(
            bounds.map(|(line, block)| (line - section.lines.start, block)),
            &mut found,
        );
        if found.errors() > 0 && !blocks.has_invalid(self.sources, diagnostics) {
            diagnostics.append(found);
        }
        loops
    }
}

fn says(block: &Block) -> bool {
    block.statement != Statement::Empty
}

/// The programs of a file; see [`library::Read`]. The first that ends with M30 or M2 is the main program, else the
/// first.
pub fn routines(
    file: usize,
    stem: &str,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) -> Vec<Routine> {
    let mut outline = Outline {
        file,
        sources,
        sections: Vec::new(),
        over: None,
    };
    outline.begin(name_of_file(stem), Span::start_of(file), 0);
    let notable = Notable {
        is: is_notable,
        among_plain: |_| true,
    };
    let mut visit = |line: usize, text: Text, diagnostics: &mut Diagnostics| {
        outline.line(line, text, diagnostics)
    };
    let lines = notable_lines(file, sources, diagnostics, notable, &mut visit);
    outline.end(lines, diagnostics);
    // What stands before the first number is a program only if it does something, or if there is no number.
    let headless = outline.sections.first().is_some_and(|first| {
        let blocks = outline.blocks(first.lines.clone());
        outline.sections.len() == 1 || blocks.find(sources, diagnostics, says).is_some()
    });
    let sections = outline
        .sections
        .get(usize::from(!headless)..)
        .unwrap_or(&[]);
    let main = sections
        .iter()
        .position(|section| section.ends_program)
        .unwrap_or(0);
    let mut list: Vec<Routine> = Vec::with_capacity(sections.len());
    for (index, section) in sections.iter().enumerate() {
        if list.iter().any(|known| known.name == section.name) {
            diagnostics.push(
                Diagnostic::error(
                    section.start,
                    format!("{} is in this file twice", section.name),
                )
                .help("give each program a number of its own"),
            );
        }
        let is_main = file == 0 && index == main;
        list.push(outline.routine(section, is_main, diagnostics));
    }
    list
}

/// `1234` and `O1234` are the names of a file with the program O1234.
fn name_of_file(stem: &str) -> String {
    let digits = stem.strip_prefix('O').unwrap_or(stem);
    match digits.parse() {
        Ok(number) if digits.len() <= 8 && digits.bytes().all(|byte| byte.is_ascii_digit()) => {
            program_name(number)
        }
        _ => stem.to_string(),
    }
}

/// Whether a block has M30 or M2.
fn ends_program(block: &Block) -> bool {
    let is_end = |word: &Word| {
        let number = match word.value.kind {
            ExpressionKind::Number(number) => number,
            _ => return false,
        };
        word.letter == 'M' && [2.0, 30.0].contains(&number)
    };
    matches!(&block.statement, Statement::Words(words) if words.iter().any(is_end))
}

/// The loops that these blocks begin and end; each has its index.
fn loops<'a>(
    bounds: impl Iterator<Item = (usize, &'a Block)>,
    diagnostics: &mut Diagnostics,
) -> Vec<Loop> {
    let mut open: Vec<(u32, usize, &Block)> = Vec::new();
    let mut list = Vec::new();
    for (index, block) in bounds {
        match &block.statement {
            Statement::Loop(_, number) => {
                if open.iter().any(|(other, ..)| other == number) {
                    diagnostics.push(
                        Diagnostic::error(
                            block.place.span,
                            format!("DO{number} inside of DO{number}"),
                        )
                        .help("loops inside each other have different numbers, 1 to 3"),
                    );
                }
                open.push((*number, index, block));
            }
            Statement::End(number) => match open.pop() {
                Some((other, first, _)) if other == *number => {
                    list.push(Loop { first, last: index })
                }
                Some((other, first, begin)) => {
                    diagnostics.push(
                        Diagnostic::error(
                            block.place.span,
                            format!("END{number} inside of DO{other}"),
                        )
                        .help(format!("end the loop with END{other} before")),
                    );
                    open.retain(|(open, ..)| open != number);
                    open.push((other, first, begin));
                }
                None => diagnostics.push(
                    Diagnostic::error(
                        block.place.span,
                        format!("END{number} without a DO{number}"),
                    )
                    .help("a loop begins with WHILE[..]DO1"),
                ),
            },
            _ => {}
        }
    }
    for (number, _, block) in open {
        diagnostics.push(
            Diagnostic::error(
                block.place.span,
                format!("this loop does not end: END{number} is missing"),
            )
            .help(format!("put END{number} behind its last block")),
        );
    }
    list
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
        self.main
    }

    fn is_empty(&self) -> bool {
        self.first.is_none()
    }

    fn first_span(&self) -> Span {
        self.first.unwrap_or(self.start)
    }
}
