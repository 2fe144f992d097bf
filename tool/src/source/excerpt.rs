//! Lines of a file as they are shown beside a message.

use std::ops::Range;

/// The longest lines that are shown as a whole, bytes.
const LONGEST: usize = 400;

/// How much of a longer one is shown before and behind the marked piece, and of that itself, bytes.
const AROUND: usize = 60;

/// Stands for what is left out.
const ELLIPSIS: &str = "...";

/// Lines of a file with a piece of them marked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// What the file is called.
    pub name: String,
    /// The lines, or a part of one that is very long.
    pub text: String,
    /// The number of the first line.
    pub line: u32,
    /// The marked piece, byte positions in the text.
    pub marked: Range<usize>,
    /// How many characters less than the line the text has before the marked piece.
    pub left_out: usize,
}

impl Excerpt {
    /// Of whole lines, of which the first has this number.
    pub fn new(name: &str, text: &str, line: u32, marked: Range<usize>) -> Excerpt {
        let whole = Excerpt {
            name: name.to_string(),
            text: text.to_string(),
            line,
            marked,
            left_out: 0,
        };
        match text.lines().any(|line| line.len() > LONGEST) {
            true => whole.cut(),
            false => whole,
        }
    }

    /// A window round the beginning of the marked piece.
    fn cut(self) -> Excerpt {
        let text = &self.text;
        let at = self.marked.start;
        let line = text.get(at..).and_then(|rest| rest.find('\n'));
        let line_end = line.map_or(text.len(), |length| at + length);
        let marked_end = self.marked.end.min(at + AROUND).min(line_end);
        let line_start = text
            .get(..at)
            .and_then(|before| before.rfind('\n'))
            .map_or(0, |at| at + 1);
        let start = boundary(text, line_start.max(at.saturating_sub(AROUND)));
        let end = boundary(text, line_end.min(marked_end + AROUND));
        let marked_end = boundary(text, marked_end).max(at);
        let before = if start > line_start { ELLIPSIS } else { "" };
        let behind = if end < line_end { ELLIPSIS } else { "" };
        let shown = text.get(start..end).unwrap_or("");
        let skipped = text
            .get(line_start..start)
            .map_or(0, |skipped| skipped.chars().count());
        let first = text
            .get(..line_start)
            .map_or(0, |lines| lines.matches('\n').count());
        Excerpt {
            line: self.line + u32::try_from(first).unwrap_or(0),
            left_out: skipped.saturating_sub(before.len()),
            marked: at - start + before.len()..marked_end - start + before.len(),
            text: format!("{before}{shown}{behind}"),
            name: self.name,
        }
    }
}

/// The last beginning of a character up to a position.
fn boundary(text: &str, position: usize) -> usize {
    let mut position = position.min(text.len());
    while !text.is_char_boundary(position) {
        position -= 1;
    }
    position
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_line_is_shown_round_the_marked_piece() {
        let line = format!("{}HERE{}", "ñ".repeat(1000), "x".repeat(1000));
        for (text, number) in [(line.clone(), 5), (format!("G0\n{line}"), 6)] {
            let at = text.find("HERE").unwrap_or(0);
            let excerpt = Excerpt::new("a", &text, 5, at..at + 4);
            assert_eq!(&excerpt.text[excerpt.marked.clone()], "HERE");
            assert_eq!(excerpt.line, number);
            let before = excerpt.text[..excerpt.marked.start].chars().count();
            assert_eq!(before + excerpt.left_out, 1000);
            assert!(excerpt.text.starts_with("...ñ") && excerpt.text.ends_with("x..."));
            assert!(excerpt.text.len() < 200);
        }
    }
}
