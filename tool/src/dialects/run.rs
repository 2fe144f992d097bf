//! Running the main program.
//!
//! Of a long one, the text, the blocks and what they do are held for a few pages of the file only, so that it may
//! be longer than the memory.

use super::blocks::{Block, Blocks, unreadable};
use super::control::plain::PlainBlock;
use super::control::{About, Control};
use super::library::{Library, Read, Routine};
use super::settings::Settings;
use crate::diagnostics::Diagnostic;
use crate::source::Span;
use std::io;
use std::path::Path;
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

    /// Both.
    fn parts(&mut self) -> (&Library<Self::Routine>, &mut Control<'a>);

    /// Runs the blocks of the main program; `false` when nothing can follow.
    fn run_main(&mut self, main: &Rc<Self::Routine>) -> bool;

    /// The main program has come to its end without M30.
    fn end_is_missing(&mut self, main: &Rc<Self::Routine>);

    /// Whether a straight motion means to this dialect, in its present state, what it means to all.
    fn takes(&self, block: &PlainBlock) -> bool;
}

/// A block that is repeated jumps to one that is not.
pub fn jump_out_of_repetition(span: Span) -> Diagnostic {
    Diagnostic::error(span, "this jump leaves the blocks that are repeated")
        .help("let the repetition end before the jump")
}

/// How a dialect reads its programs: the endings of their files, and what finds the routines in them.
pub struct Files<R> {
    /// Endings of subprogram files; where several files have the same name, the earlier ending counts.
    pub extensions: &'static [&'static str],
    /// Finds the routines of a file.
    pub read: Read<R>,
}

/// Runs the program in file 0 of the sources, which lies at `path`, by an interpreter that `new` makes.
pub fn run_file<'a, I: Interpret<'a>>(
    path: &Path,
    files: Files<I::Routine>,
    settings: &'a Settings,
    about: About<'a>,
    new: fn(&'a Settings, Library<I::Routine>, About<'a>) -> I,
) {
    let Files { extensions, read } = files;
    let (sources, diagnostics) = (&*about.sources, &mut *about.diagnostics);
    let library = Library::new(path, extensions, settings, sources, diagnostics, read);
    run(&mut new(settings, library, about));
}

/// Runs the main program to its end.
fn run<'a, I: Interpret<'a>>(interpreter: &mut I) {
    if let Some(main) = interpreter.library().main() {
        interpreter.control().begin_main(main.title());
        if interpreter.run_main(&main) {
            interpreter.end_is_missing(&main);
        }
    }
    // What stands behind the end of the program is parsed all the same: it may be its rest, and the end a slip.
    let (library, control) = interpreter.parts();
    if let Err(error) = library.check_rest(control.sources, control.diagnostics) {
        control.diagnostics.push(unreadable(0, &error));
    }
    control.finish();
}

/// What comes next in a routine.
pub enum Reached<B> {
    /// A block.
    Block(Rc<B>),
    /// Its end, or that of the part that runs.
    End,
    /// Nothing: the program must not go on.
    Abort,
}

/// The block at an index before `end`, or the first one behind it that is more than a straight motion: those of a
/// long program are run here.
pub fn reach<'a, I: Interpret<'a>, B: Block>(
    interpreter: &mut I,
    blocks: &Blocks<B>,
    at: &mut usize,
    end: usize,
) -> Reached<B> {
    let windowed = interpreter
        .control()
        .sources
        .file(blocks.file())
        .is_windowed();
    while *at < end {
        if windowed && !blocks.is_parsed(*at) {
            match run_motions(interpreter, blocks, *at, end) {
                Ok(Some(next)) if next > *at => {
                    *at = next;
                    continue;
                }
                Ok(Some(_)) => {}
                Ok(None) => return Reached::Abort,
                Err(error) => return unread(interpreter, blocks.file(), &error),
            }
        }
        let control = interpreter.control();
        match blocks.read(*at, control.sources, control.diagnostics) {
            Ok(Some(block)) => {
                return match control.count_block(block.place().span) {
                    true => Reached::Block(block),
                    false => Reached::Abort,
                };
            }
            Ok(None) => *at += 1,
            Err(error) => return unread(interpreter, blocks.file(), &error),
        }
    }
    Reached::End
}

fn unread<'a, I: Interpret<'a>, B>(
    interpreter: &mut I,
    file: usize,
    error: &io::Error,
) -> Reached<B> {
    interpreter
        .control()
        .diagnostics
        .push(unreadable(file, error));
    Reached::Abort
}

/// Runs the lines of a page from an index on that are straight motions; the index behind them, or `None` where the
/// program must not go on.
fn run_motions<'a, I: Interpret<'a>, B: Block>(
    interpreter: &mut I,
    blocks: &Blocks<B>,
    at: usize,
    end: usize,
) -> io::Result<Option<usize>> {
    let Some(stretch) = blocks.stretch(at).filter(|_| !blocks.is_joined(at)) else {
        return Ok(Some(at));
    };
    let line = stretch.start;
    let page = interpreter
        .control()
        .sources
        .lines(blocks.file(), line..line + 1)?;
    let last = stretch
        .end
        .min(page.first_line() + page.lines())
        .min(line + (end - at));
    let mut next = line;
    while next < last {
        let Some([start, end]) = page.line_range(next) else {
            break;
        };
        let text = page.slice(start, end).as_bytes();
        let Some(block) = PlainBlock::read(text).filter(|block| interpreter.takes(block)) else {
            break;
        };
        let [first, end] = block.range.map(|place| start + place);
        let span = Span {
            file: blocks.file(),
            start: first,
            end,
        };
        let control = interpreter.control();
        if !control.plain_motion(&block, span) {
            break;
        }
        if !control.count_block(span) {
            return Ok(None);
        }
        next += 1;
    }
    blocks.saw(at..at + (next - line));
    Ok(Some(at + (next - line)))
}
