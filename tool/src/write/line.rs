//! Putting the words of a block together, so that LinuxCNC executes them in the order of the program.

use super::comment::comment;

/// The longest line, bytes.
const LONGEST: usize = 250;

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

/// The finished lines and the one that is being made.
#[derive(Debug, Default)]
pub struct Lines {
    text: String,
    words: Vec<(Rank, String)>,
    number: Option<u32>,
    remark: Option<String>,
}

impl Lines {
    /// A block of the source begins: its number and its remark go to the next line.
    pub fn begin_block(&mut self, number: Option<u32>, remark: Option<String>) {
        self.flush();
        self.number = number.filter(|number| *number <= HIGHEST_NUMBER);
        self.remark = remark;
    }

    /// The block ends. A remark that found no line gets its own.
    pub fn end_block(&mut self) {
        self.flush();
        if self.remark.is_some() {
            self.line("");
        }
        self.number = None;
    }

    /// Adds words to the line; begins a new line when LinuxCNC would otherwise execute them too early.
    pub fn add(&mut self, rank: Rank, words: impl Into<String>) {
        let too_late = self.words.last().is_some_and(|(last, _)| *last >= rank);
        if too_late {
            self.flush();
        }
        self.words.push((rank, words.into()));
    }

    /// Ends the line that is being made.
    pub fn flush(&mut self) {
        if self.words.is_empty() {
            return;
        }
        let mut words = std::mem::take(&mut self.words);
        // For the reader: G functions, then the motion, then F, S, T and M.
        words.sort_by_key(|(rank, _)| reading_order(*rank));
        let words: Vec<String> = words.into_iter().map(|(_, words)| words).collect();
        self.line(&words.join(" "));
    }

    /// A line of its own, with the number and the remark of the block if they are still to be written.
    pub fn line(&mut self, words: &str) {
        let number = self.number.take().map(|number| format!("N{number}"));
        let remark = self.remark.take().map(|remark| comment(&remark));
        let mut parts: Vec<&str> = Vec::new();
        parts.extend(number.as_deref());
        if !words.is_empty() {
            parts.push(words);
        }
        if let Some(remark) = &remark {
            let length: usize = parts.iter().map(|part| part.len() + 1).sum();
            if length + remark.len() > LONGEST {
                self.raw(remark);
            } else {
                parts.push(remark);
            }
        }
        let line = parts.join(" ");
        self.raw(&line);
    }

    /// A line without number and remark.
    pub fn raw(&mut self, line: &str) {
        debug_assert!(self.words.is_empty(), "a line is being made");
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// All lines.
    pub fn finish(mut self) -> String {
        self.flush();
        self.text
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
