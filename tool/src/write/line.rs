//! Putting the words of a block together, so that LinuxCNC executes them in the order of the program.

use super::comment::comment;
use super::number::push_whole;
use std::io::{self, Write};

/// The longest line, bytes.
const LONGEST: usize = 250;

/// How much is written at once, bytes.
const PORTION: usize = 1 << 15;

/// The highest block number that is written.
const HIGHEST_NUMBER: u32 = 99_999;

/// When LinuxCNC executes a word of a line: words with a lower rank first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rank {
    FeedMode,
    Feed,
    Speed,
    Tool,
    ToolChange,
    Spindle,
    Coolant,
    Dwell,
    Plane,
    Compensation,
    ToolLength,
    WorkOffset,
    PathControl,
    Motion,
    Stop,
}

/// Writes lines, and puts the one together that is being made.
pub struct Lines<'a> {
    out: &'a mut dyn Write,
    error: Option<io::Error>,
    /// Finished lines that are still to be written.
    text: String,
    /// The words of the line that is being made, without blanks between them.
    line: String,
    /// Where they end in it.
    words: Vec<(Rank, usize)>,
    /// Whether F has to stand with its motion (G93): else LinuxCNC stops at the motion.
    feed_with_motion: bool,
    /// F of the block that has not found its motion yet.
    held_feed: Option<String>,
    number: Option<u32>,
    /// How many conditions are written.
    conditions: u32,
    /// The remark of the block, with its parentheses; empty when it has been written.
    remark: String,
}

impl<'a> Lines<'a> {
    /// No lines yet.
    pub fn new(out: &'a mut dyn Write) -> Lines<'a> {
        Lines {
            out,
            error: None,
            text: String::with_capacity(2 * PORTION),
            line: String::new(),
            words: Vec::new(),
            feed_with_motion: false,
            held_feed: None,
            number: None,
            conditions: 0,
            remark: String::new(),
        }
    }

    /// The number of the next condition: each needs one of its own.
    pub fn condition(&mut self) -> u32 {
        self.conditions += 1;
        self.conditions
    }

    /// Whether F from here on is the time of the motion in its line (G93).
    pub fn feed_goes_with_motion(&mut self, with_motion: bool) {
        self.feed_with_motion = with_motion;
    }

    /// A block of the source begins: its number and the line it stands in go to the next line, with
    /// what `remark` says about it.
    pub fn begin_block(&mut self, number: Option<u32>, line: u32, remark: &str) {
        self.end_words();
        self.number = number.filter(|number| *number <= HIGHEST_NUMBER);
        self.remark.clear();
        if remark.is_empty() {
            self.remark.push_str("(line ");
            push_whole(&mut self.remark, line);
            self.remark.push(')');
        } else {
            self.remark
                .push_str(&comment(&format!("line {line}{remark}")));
        }
    }

    /// The block ends. A remark that found no line gets its own.
    pub fn end_block(&mut self) {
        self.end_words();
        if !self.remark.is_empty() {
            self.line("");
        }
        self.number = None;
    }

    /// Adds words to the line; begins a new line when LinuxCNC would otherwise execute them too early.
    pub fn add(&mut self, rank: Rank, words: impl AsRef<str>) {
        self.add_with(rank, |line| line.push_str(words.as_ref()));
    }

    /// The same, with words that are put together behind the others.
    pub fn add_with(&mut self, rank: Rank, words: impl FnOnce(&mut String)) {
        let too_late = self.words.last().is_some_and(|(last, _)| *last >= rank);
        if too_late {
            self.flush();
        }
        let start = self.line.len();
        words(&mut self.line);
        if start > 0 && (self.shares_numbers(start) || self.reads_too_early(start)) {
            let later = self.line.split_off(start);
            self.flush();
            self.line.push_str(&later);
        }
        self.words.push((rank, self.line.len()));
        if rank == Rank::Motion {
            self.take_held_feed();
        }
    }

    fn take_held_feed(&mut self) {
        if let Some(feed) = self.held_feed.take() {
            self.line.push_str(&feed);
            self.words.push((Rank::Motion, self.line.len()));
        }
    }

    /// Takes F out of a line without motion, where it has to stand with one.
    fn hold_feed(&mut self) {
        let is = |wanted: Rank| move |(rank, _): &(Rank, usize)| *rank == wanted;
        if !self.feed_with_motion || self.words.iter().any(is(Rank::Motion)) {
            return;
        }
        let Some(at) = self.words.iter().position(is(Rank::Feed)) else {
            return;
        };
        let (_, end) = self.words.remove(at);
        let start = at.checked_sub(1).map_or(0, |before| self.words[before].1);
        self.held_feed = Some(self.line.drain(start..end).collect());
        for (_, later) in &mut self.words[at..] {
            *later -= end - start;
        }
    }

    /// Ends the line that is being made, and the block with it: F that has found no motion stays in it.
    fn end_words(&mut self) {
        self.take_held_feed();
        self.write_words();
    }

    /// Whether LinuxCNC would give numbers of the words from `start` on to others of the line, or the
    /// other way round.
    fn shares_numbers(&self, start: usize) -> bool {
        let later = taken_letters(self.line.get(start..).unwrap_or(""));
        if later.is_empty() {
            return false;
        }
        let mut begin = 0;
        self.words.iter().any(|&(_, end)| {
            let letters = taken_letters(self.line.get(begin..end).unwrap_or(""));
            begin = end;
            letters
                .bytes()
                .any(|letter| later.as_bytes().contains(&letter))
        })
    }

    /// Whether the words from `start` on read a parameter that others of the line change: LinuxCNC works out
    /// all expressions of a line before it executes the first of its words.
    fn reads_too_early(&self, start: usize) -> bool {
        let changes = |(rank, _): &(Rank, usize)| {
            matches!(rank, Rank::ToolChange | Rank::ToolLength | Rank::WorkOffset)
        };
        let later = self.line.get(start..).unwrap_or("");
        self.words.iter().any(changes) && later.contains('#')
    }

    /// Ends the line that is being made. The words of the block that follow get another.
    pub fn flush(&mut self) {
        self.hold_feed();
        self.write_words();
    }

    fn write_words(&mut self) {
        if self.words.is_empty() {
            return;
        }
        let line = std::mem::take(&mut self.line);
        let mut words = std::mem::take(&mut self.words);
        match words[..] {
            [_] => self.line(&line),
            _ => {
                // For the reader: G functions, then the motion, then F, S, T and M.
                let mut start = 0;
                let mut parts: Vec<(u8, &str)> = Vec::with_capacity(words.len());
                for (rank, end) in &words {
                    parts.push((reading_order(*rank), line.get(start..*end).unwrap_or("")));
                    start = *end;
                }
                parts.sort_by_key(|(order, _)| *order);
                let mut ordered = String::with_capacity(line.len() + words.len());
                for (_, part) in parts {
                    if !ordered.is_empty() {
                        ordered.push(' ');
                    }
                    ordered.push_str(part);
                }
                self.line(&ordered);
            }
        }
        // Their memory serves the next line.
        self.line = line;
        self.line.clear();
        words.clear();
        self.words = words;
    }

    /// A line of its own, with the number and the remark of the block if they are still to be written.
    pub fn line(&mut self, words: &str) {
        let start = self.text.len();
        if let Some(number) = self.number.take() {
            self.text.push('N');
            push_whole(&mut self.text, number);
        }
        for part in [words, self.remark.as_str()] {
            if part.is_empty() {
                continue;
            }
            if self.text.len() > start {
                self.text.push(' ');
            }
            self.text.push_str(part);
        }
        if self.text.len() - start > LONGEST && !self.remark.is_empty() {
            // The remark gets a line of its own before the words.
            let words = self.text.len() - self.remark.len();
            self.text.truncate(words.saturating_sub(1));
            self.text.insert(start, '\n');
            self.text.insert_str(start, &self.remark);
        }
        self.remark.clear();
        self.end_line();
    }

    /// A line without number and remark.
    pub fn raw(&mut self, line: &str) {
        debug_assert!(self.words.is_empty(), "a line is being made");
        self.text.push_str(line);
        self.end_line();
    }

    fn end_line(&mut self) {
        self.text.push('\n');
        if self.text.len() >= PORTION {
            self.write_out();
        }
    }

    fn write_out(&mut self) {
        if self.error.is_none()
            && let Err(error) = self.out.write_all(self.text.as_bytes())
        {
            self.error = Some(error);
        }
        self.text.clear();
    }

    /// Ends the last line.
    ///
    /// # Errors
    ///
    /// The first that occurred while the lines were written.
    pub fn finish(mut self) -> io::Result<()> {
        self.end_words();
        self.write_out();
        self.error.map_or(Ok(()), Err)
    }
}

/// The letters of numbers that LinuxCNC takes for these words, as far as others take them too. There is one
/// of each letter in a line, and all take it: beside an arc P of G64 is a number of turns.
fn taken_letters(words: &str) -> &'static str {
    let code = words.split(' ').next().unwrap_or("");
    match code {
        // Turns, radius; direction, angle.
        "G2" | "G3" | "M19" => "PR",
        "G64" => "P",
        // Speed at most; row or diameter.
        "G96" | "G41" | "G42" | "G41.1" | "G42.1" => "D",
        _ => match code.as_bytes() {
            // M functions of the user, and those that a number switches.
            [b'M', b'1', _, _] | [b'M', b'5' | b'6', _] => "P",
            _ => "",
        },
    }
}

fn reading_order(rank: Rank) -> u8 {
    match rank {
        Rank::FeedMode => 1,
        Rank::Feed => 4,
        Rank::Speed => 5,
        Rank::Tool | Rank::ToolChange => 6,
        Rank::Spindle | Rank::Coolant => 7,
        Rank::ToolLength => 8,
        Rank::Motion | Rank::Dwell => 3,
        Rank::Plane | Rank::Compensation | Rank::WorkOffset | Rank::PathControl => 2,
        Rank::Stop => 9,
    }
}
