//! The blocks of a program or subprogram, parsed when they run.
//!
//! A block has the index of its line among the lines of its routine. Of a parsed block nothing is kept but what
//! ran last, so that a program takes no more memory for its length, whatever leads through it.

use super::control::Place;
use super::control::plain::PlainBlock;
use super::fillers;
use super::outline::block_number;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::{Page, Sources, Span, Text};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::io;
use std::ops::Range;
use std::rc::Rc;

/// How many lines are parsed at once.
const BATCH: usize = 64;

/// How many lines are kept parsed.
const KEPT: usize = 4096;

/// A block of a dialect.
pub trait Block {
    /// Its text, number and comment.
    fn place(&self) -> &Place;
    /// Whether it holds nothing at all.
    fn is_blank(&self) -> bool;
    /// Whether it was not understood.
    fn is_invalid(&self) -> bool;
}

/// Parses lines, which begin and end where blocks do. A line may hold no block.
pub type ParseBlocks<B> = fn(Text, &mut Diagnostics) -> Vec<B>;

/// What is known of the lines of a routine before they are parsed.
#[derive(Clone, Debug, Default)]
pub struct Lines {
    /// Index of the file.
    pub file: usize,
    /// The lines of the file that are the routine's, in their order; 0 is the first of the file.
    pub ranges: Vec<Range<usize>>,
    /// Lines that must be parsed together, in their order.
    pub joined: Rc<[Range<usize>]>,
    /// Block numbers that jumps name.
    pub targets: BTreeSet<u32>,
}

/// The blocks of a routine.
#[derive(Debug)]
pub struct Blocks<B> {
    lines: Lines,
    /// The index of the first line of each range.
    firsts: Vec<usize>,
    parse: ParseBlocks<B>,
    parsed: RefCell<HashMap<usize, Option<Rc<B>>>>,
    seen: RefCell<Seen>,
    /// Where the block numbers stand that jumps name.
    numbers: RefCell<Option<HashMap<u32, Rc<[usize]>>>>,
}

/// Lines that have been parsed, or need not be.
#[derive(Clone, Debug, Default)]
struct Seen(BTreeMap<usize, usize>);

impl Seen {
    fn add(&mut self, mut range: Range<usize>) {
        if let Some((&start, &end)) = self.0.range(..=range.start).next_back()
            && end >= range.start
        {
            range = start..end.max(range.end);
        }
        while let Some((&start, &end)) = self.0.range(range.start..=range.end).next() {
            self.0.remove(&start);
            range.end = range.end.max(end);
        }
        self.0.insert(range.start, range.end);
    }

    /// The lines from `at` on that have not been seen, up to the next that has.
    fn gap(&self, at: usize, end: usize) -> Option<Range<usize>> {
        let before = self.0.range(..=at).next_back();
        let start = before.map_or(at, |(_, &end)| end.max(at));
        let next = self.0.range(start..).next().map_or(end, |(&next, _)| next);
        (start < end).then_some(start..next.min(end))
    }
}

impl<B: Block> Blocks<B> {
    /// The blocks of these lines.
    pub fn new(lines: Lines, parse: ParseBlocks<B>) -> Blocks<B> {
        let mut next = 0;
        let mut firsts = Vec::with_capacity(lines.ranges.len());
        for range in &lines.ranges {
            firsts.push(next);
            next += range.len();
        }
        Blocks {
            lines,
            firsts,
            parse,
            parsed: RefCell::default(),
            seen: RefCell::default(),
            numbers: RefCell::default(),
        }
    }

    /// Index of the file.
    pub fn file(&self) -> usize {
        self.lines.file
    }

    /// The index behind the last line.
    pub fn len(&self) -> usize {
        let last = self.firsts.last().zip(self.lines.ranges.last());
        last.map_or(0, |(first, range)| first + range.len())
    }

    /// Whether there is no line.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The line with an index, and the lines of the routine round it without a gap.
    fn place(&self, at: usize) -> Option<(usize, &Range<usize>)> {
        let index = self
            .firsts
            .partition_point(|first| *first <= at)
            .checked_sub(1)?;
        let (range, first) = (self.lines.ranges.get(index)?, self.firsts.get(index)?);
        let line = range.start + (at - first);
        (line < range.end).then_some((line, range))
    }

    /// The lines of the file from that with an index on, as far as they are the routine's without a gap.
    pub fn stretch(&self, at: usize) -> Option<Range<usize>> {
        self.place(at).map(|(line, range)| line..range.end)
    }

    /// The index of a line of the file.
    pub fn index(&self, line: usize) -> Option<usize> {
        let before = |range: &Range<usize>| range.start <= line;
        let index = self.lines.ranges.partition_point(before).checked_sub(1)?;
        let (range, first) = (self.lines.ranges.get(index)?, self.firsts.get(index)?);
        (line < range.end).then_some(first + (line - range.start))
    }

    /// The block with an index; `None` where the line holds none, or cannot be read, which is said.
    pub fn get(
        &self,
        at: usize,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) -> Option<Rc<B>> {
        let found = self.read(at, sources, diagnostics);
        found.unwrap_or_else(|error| {
            diagnostics.push(unreadable(self.file(), &error));
            None
        })
    }

    /// The same, for one who must know that the line cannot be read.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read.
    pub fn read(
        &self,
        at: usize,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) -> io::Result<Option<Rc<B>>> {
        if let Some(known) = self.known(at) {
            return Ok(known);
        }
        self.parse_from(at, sources, diagnostics)?;
        Ok(self.known(at).flatten())
    }

    /// Whether a line is kept parsed.
    pub fn is_parsed(&self, at: usize) -> bool {
        self.parsed.borrow().contains_key(&at)
    }

    /// Whether a line must be parsed together with others.
    pub fn is_joined(&self, at: usize) -> bool {
        let line = self.stretch(at).map_or(0, |stretch| stretch.start);
        let next = self
            .lines
            .joined
            .partition_point(|joined| joined.end <= line);
        let joined = self.lines.joined.get(next);
        joined.is_some_and(|joined| joined.start <= line)
    }

    fn known(&self, at: usize) -> Option<Option<Rc<B>>> {
        self.parsed.borrow().get(&at).cloned()
    }

    /// Parses the line with an index and some behind it; the index behind them.
    fn parse_from(
        &self,
        at: usize,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) -> io::Result<usize> {
        let Some((line, range)) = self.place(at) else {
            return Ok(at + 1);
        };
        let next = self
            .lines
            .joined
            .partition_point(|joined| joined.end <= line);
        let joined = self.lines.joined.get(next).cloned();
        let (page, lines) = match joined {
            Some(joined) if joined.start <= line => {
                // What belongs together may go on in another routine, which is an error.
                let joined = joined.start.max(range.start)..joined.end.min(range.end);
                (sources.lines(self.file(), joined.clone())?, joined)
            }
            next => {
                let page = sources.lines(self.file(), line..line + 1)?;
                let end = range.end.min(page.first_line() + page.lines());
                let end = next.map_or(end, |next| end.min(next.start));
                let windowed = sources.file(self.file()).is_windowed();
                (
                    Rc::clone(&page),
                    line..batch_end(&page, line, end, windowed),
                )
            }
        };
        let [start, end] = bounds(&page, &lines);
        let text = Text {
            file: self.file(),
            text: page.slice(start, end),
            start,
        };
        fillers::check(text, diagnostics);
        let blocks = (self.parse)(text, diagnostics);
        let mut parsed = self.parsed.borrow_mut();
        if parsed.len() > KEPT {
            parsed.clear();
        }
        let indices = lines.clone().filter_map(|line| self.index(line));
        parsed.extend(indices.map(|index| (index, None)));
        for block in blocks {
            if let Some(index) = self.index(page.line_of(block.place().span.start)) {
                parsed.insert(index, Some(Rc::new(block)));
            }
        }
        let [first, behind] = [at - (line - lines.start), at + (lines.end - line)];
        self.saw(first..behind);
        Ok(behind)
    }

    /// These lines have been looked at.
    pub fn saw(&self, indices: Range<usize>) {
        self.seen.borrow_mut().add(indices);
    }

    /// Parses all blocks that did not run, for the errors in them.
    pub fn check_rest(&self, sources: &Sources, diagnostics: &mut Diagnostics) -> io::Result<()> {
        let mut at = 0;
        loop {
            let gap = self.seen.borrow().gap(at, self.len());
            let Some(gap) = gap else {
                return Ok(());
            };
            let end = gap.end;
            at = self.skip_plain(gap, sources)?;
            if at < end {
                at = match self.is_parsed(at) {
                    true => at + 1,
                    false => self.parse_from(at, sources, diagnostics)?,
                };
            }
        }
    }

    /// The index of the first of these lines that is not a plain motion, or that behind them.
    fn skip_plain(&self, indices: Range<usize>, sources: &Sources) -> io::Result<usize> {
        let mut at = indices.start;
        while at < indices.end {
            let Some(stretch) = self.stretch(at) else {
                break;
            };
            let page = sources.lines(self.file(), stretch.start..stretch.start + 1)?;
            let range = page.line_range(stretch.start);
            let line = range.map_or("", |[start, end]| page.slice(start, end));
            if PlainBlock::read(line.as_bytes()).is_none() {
                break;
            }
            at += 1;
        }
        if at > indices.start {
            self.saw(indices.start..at);
        }
        Ok(at)
    }

    /// The first block for which `wanted` holds; each is parsed by itself.
    pub fn find(
        &self,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
        wanted: impl Fn(&B) -> bool,
    ) -> Option<Rc<B>> {
        let indices = 0..self.len();
        let mut blocks = indices.filter_map(|at| self.get(at, sources, diagnostics));
        blocks.find(|block| wanted(block))
    }

    /// The last block that is not blank.
    pub fn last(&self, sources: &Sources, diagnostics: &mut Diagnostics) -> Option<Rc<B>> {
        for at in (0..self.len()).rev() {
            let line = self.stretch(at)?.start;
            let page = sources.lines(self.file(), line..line + 1).ok()?;
            let [start, end] = page.line_range(line)?;
            if page.slice(start, end).trim().is_empty() {
                continue;
            }
            let block = self.get(at, sources, diagnostics);
            if block.as_ref().is_some_and(|block| !block.is_blank()) {
                return block;
            }
        }
        None
    }

    /// Whether any block is not understood, which is said.
    pub fn has_invalid(&self, sources: &Sources, diagnostics: &mut Diagnostics) -> bool {
        let mut at = 0;
        while at < self.len() {
            let Ok(next) = self.parse_from(at, sources, diagnostics) else {
                return true;
            };
            let parsed = self.parsed.borrow();
            let blocks = (at..next).filter_map(|at| parsed.get(&at)?.as_ref());
            if blocks.into_iter().any(|block| block.is_invalid()) {
                return true;
            }
            at = next;
        }
        false
    }

    /// The indices of the blocks with this number, in their order.
    pub fn numbered(
        &self,
        number: u32,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) -> Rc<[usize]> {
        let known = self
            .numbers
            .borrow()
            .as_ref()
            .and_then(|all| all.get(&number).cloned());
        if let Some(known) = known {
            return known;
        }
        let mut wanted = BTreeSet::from([number]);
        if self.numbers.borrow().is_none() {
            wanted.extend(&self.lines.targets);
        }
        let found = self.look_for(&wanted, sources, diagnostics);
        let mut numbers = self.numbers.borrow_mut();
        let numbers = numbers.get_or_insert_default();
        numbers.extend(found);
        numbers.get(&number).cloned().unwrap_or_default()
    }

    /// Where blocks with these numbers stand.
    fn look_for(
        &self,
        wanted: &BTreeSet<u32>,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) -> HashMap<u32, Rc<[usize]>> {
        let mut found: HashMap<u32, Vec<usize>> =
            wanted.iter().map(|one| (*one, Vec::new())).collect();
        let mut at = 0;
        while let Some(stretch) = self.stretch(at) {
            let Ok(page) = sources.lines(self.file(), stretch.start..stretch.start + 1) else {
                break;
            };
            let end = stretch.end.min(page.first_line() + page.lines());
            for line in stretch.start..end {
                let text = page
                    .line_range(line)
                    .map(|[start, end]| page.slice(start, end));
                let number = text.and_then(|text| block_number(text.as_bytes()));
                let places = number.and_then(|number| found.get_mut(&number));
                if let (Some(places), Some(text)) = (places, text) {
                    // A motion is what it seems; a comment may look like a block.
                    let is_motion = PlainBlock::read(text.as_bytes()).is_some();
                    let is_wanted = is_motion && !self.is_joined(at)
                        || self
                            .get(at, sources, diagnostics)
                            .is_some_and(|block| block.place().number == number);
                    places.extend(is_wanted.then_some(at));
                }
                at += 1;
            }
            if end == stretch.start {
                break;
            }
        }
        let found = found.into_iter();
        found
            .map(|(number, places)| (number, Rc::from(places)))
            .collect()
    }
}

/// Where a batch ends that begins with a line: where plain motions begin that need no parser, unless this is one
/// that did.
fn batch_end(page: &Page, line: usize, end: usize, windowed: bool) -> usize {
    let end = end.min(line + BATCH);
    let plain = |line: &usize| {
        let range = page.line_range(*line);
        range.is_some_and(|[start, end]| {
            PlainBlock::read(page.slice(start, end).as_bytes()).is_some()
        })
    };
    if !windowed || plain(&line) {
        return end.max(line + 1);
    }
    (line + 1..end).find(plain).unwrap_or(end.max(line + 1))
}

/// Where lines begin and end in the file, with the last line end.
fn bounds(page: &Page, lines: &Range<usize>) -> [usize; 2] {
    let start = page
        .line_range(lines.start)
        .map_or(page.end(), |[start, _]| start);
    let end = page
        .line_range(lines.end)
        .map_or(page.end(), |[next, _]| next);
    [start, end]
}

/// A file cannot be read any further.
pub fn unreadable(file: usize, error: &io::Error) -> Diagnostic {
    Diagnostic::error(
        Span::start_of(file),
        format!("the program cannot be read: {error}"),
    )
}
