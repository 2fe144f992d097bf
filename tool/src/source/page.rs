//! Some whole lines of a file, and the places of its lines.

use super::{Excerpt, Span};

/// Whole lines of a file that are held.
#[derive(Debug)]
pub struct Page {
    text: String,
    /// The position of the first byte of the text in the file.
    start: usize,
    /// How many lines of the file come before.
    first_line: usize,
    /// The positions in the file at which lines begin; the last one may begin at the end of the text.
    line_starts: Vec<usize>,
}

impl Page {
    /// The lines of `text`, whose first byte is at `start` in its file, behind `first_line` other lines.
    pub fn new(text: String, start: usize, first_line: usize) -> Page {
        let mut line_starts = Vec::with_capacity(1 + text.len() / 16);
        line_starts.push(start);
        let ends = text.match_indices('\n');
        line_starts.extend(ends.map(|(at, _)| start + at + 1));
        Page {
            text,
            start,
            first_line,
            line_starts,
        }
    }

    /// The lines.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The position of the first byte in the file.
    pub fn start(&self) -> usize {
        self.start
    }

    /// The position behind the last byte.
    pub fn end(&self) -> usize {
        self.start + self.text.len()
    }

    /// How many lines of the file come before.
    pub fn first_line(&self) -> usize {
        self.first_line
    }

    /// How many line ends there are.
    pub fn line_ends(&self) -> usize {
        self.line_starts.len() - 1
    }

    /// How many lines there are; what stands behind the last line end is one if it is not empty.
    pub fn lines(&self) -> usize {
        let rest = self
            .line_starts
            .last()
            .is_some_and(|last| *last < self.end());
        self.line_ends() + usize::from(rest)
    }

    /// The index in the file of the line at a position, which must be one of this page or its end.
    pub fn line_of(&self, position: usize) -> usize {
        let ahead = self.line_starts.partition_point(|&start| start <= position);
        self.first_line + ahead.saturating_sub(1)
    }

    /// Where a line of the file begins, and where its line end stands; `None` for one of another page.
    pub fn line_range(&self, line: usize) -> Option<[usize; 2]> {
        let at = line.checked_sub(self.first_line)?;
        let start = *self.line_starts.get(at)?;
        let next = self.line_starts.get(at + 1);
        Some([start, next.map_or(self.end(), |next| next - 1)])
    }

    /// What stands in these lines between two positions in the file.
    pub fn slice(&self, start: usize, end: usize) -> &str {
        let end = end.min(self.end());
        let local = start
            .checked_sub(self.start)
            .zip(end.checked_sub(self.start));
        local
            .and_then(|(start, end)| self.text.get(start..end))
            .unwrap_or("")
    }

    /// The line or the lines of a span; `None` where it does not begin here.
    pub fn excerpt(&self, name: &str, span: Span) -> Option<Excerpt> {
        if !(self.start..=self.end()).contains(&span.start) {
            return None;
        }
        let line = self.line_of(span.start);
        let [first, mut end] = self.line_range(line)?;
        if span.end > end {
            let last = self.line_of((span.end - 1).min(self.end()));
            end = self.line_range(last)?[1];
        }
        let text = self.text.get(first - self.start..end - self.start)?;
        Some(Excerpt::new(
            name,
            text,
            u32::try_from(line + 1).unwrap_or(u32::MAX),
            span.start - first..span.end.clamp(span.start, end) - first,
        ))
    }
}
