//! Taking comments and continued lines out of a text, so that the parser sees blocks only.
//!
//! Everything that is taken out becomes blanks, byte for byte: places in the cleaned text are places
//! in the program.

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::{Span, Text};

/// A program without its comments.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clean {
    /// The text; each of its lines is one block.
    pub text: String,
    /// Where each comment began, and what it said.
    pub comments: Vec<(usize, String)>,
}

/// Cleans the lines of a file: comments in parentheses, which may hold others and
/// end with the line, comments after a semicolon, the lines from `#COMMENT BEGIN` to `#COMMENT END`,
/// and line ends after a backslash.
pub fn clean(lines: Text, diagnostics: &mut Diagnostics) -> Clean {
    let text = lines.text;
    let mut cleaner = Cleaner {
        offset: lines.start,
        bytes: text.as_bytes().to_vec(),
        comments: Vec::new(),
    };
    let mut in_comment: Option<Span> = None;
    let mut continued = false;
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let end = start + line.trim_end_matches('\n').len();
        let code = &text[start..end];
        let span = Span {
            file: lines.file,
            start: lines.start + start,
            end: lines.start + end,
        };
        match (block_comment(code), in_comment) {
            (Some(begins), before) => {
                if begins && before.is_none() {
                    in_comment = Some(span);
                } else if !begins && before.is_some() {
                    in_comment = None;
                } else if !begins {
                    diagnostics.push(
                        Diagnostic::error(span, "#COMMENT END without a #COMMENT BEGIN")
                            .help("take it out"),
                    );
                }
                cleaner.blank(start, end);
            }
            (None, Some(_)) => cleaner.blank(start, end),
            (None, None) => {
                if continued {
                    cleaner.blank_number(code, start);
                }
                continued = cleaner.line(code, start, end, line.ends_with('\n'));
            }
        }
        start += line.len();
    }
    if let Some(span) = in_comment {
        diagnostics.push(
            Diagnostic::error(span, "the #COMMENT END that belongs to this is missing")
                .help("the control would not run what follows"),
        );
    }
    Clean {
        // Only whole characters were replaced, by blanks.
        text: String::from_utf8(cleaner.bytes).unwrap_or_default(),
        comments: cleaner.comments,
    }
}

/// Whether the next line belongs to this one.
pub fn is_continued(line: &str) -> bool {
    let mut cleaner = Cleaner {
        offset: 0,
        bytes: line.as_bytes().to_vec(),
        comments: Vec::new(),
    };
    cleaner.line(line, 0, line.len(), true)
}

/// Whether a line is `#COMMENT BEGIN` (`Some(true)`) or `#COMMENT END` (`Some(false)`).
pub fn block_comment(line: &str) -> Option<bool> {
    let line = line.trim_start();
    let line = match line.strip_prefix(['N', 'n']) {
        Some(rest) => rest
            .trim_start_matches(|c: char| c.is_ascii_digit())
            .trim_start(),
        None => line,
    };
    let mut words = line.split_whitespace();
    if !words.next()?.eq_ignore_ascii_case("#COMMENT") {
        return None;
    }
    let which = words.next()?;
    match () {
        () if which.eq_ignore_ascii_case("BEGIN") => Some(true),
        () if which.eq_ignore_ascii_case("END") => Some(false),
        () => None,
    }
}

struct Cleaner {
    /// The position of the first byte in its file.
    offset: usize,
    bytes: Vec<u8>,
    comments: Vec<(usize, String)>,
}

impl Cleaner {
    fn blank(&mut self, start: usize, end: usize) {
        for byte in self.bytes.iter_mut().take(end).skip(start) {
            if *byte != b'\n' {
                *byte = b' ';
            }
        }
    }

    /// One line; whether the next one continues it.
    fn line(&mut self, code: &str, start: usize, end: usize, has_next: bool) -> bool {
        let mut depth = 0_usize;
        let mut quoted = false;
        let mut comment = start;
        let mut last = None;
        for (at, character) in code.char_indices() {
            match character {
                '"' if depth == 0 => quoted = !quoted,
                '(' if !quoted => {
                    if depth == 0 {
                        comment = start + at;
                    }
                    depth += 1;
                    continue;
                }
                ')' if depth > 0 => {
                    depth -= 1;
                    if depth == 0 {
                        self.comment(code, start, comment, start + at + 1);
                    }
                    continue;
                }
                ';' if depth == 0 && !quoted => {
                    self.comment(code, start, start + at, end);
                    return self.continuation(last, end, has_next);
                }
                _ => {}
            }
            if depth == 0 && !character.is_whitespace() {
                last = Some((start + at, character));
            }
        }
        if depth > 0 {
            self.comment(code, start, comment, end);
        }
        self.continuation(last, end, has_next)
    }

    /// A backslash at the end joins the next line to this one.
    fn continuation(&mut self, last: Option<(usize, char)>, end: usize, has_next: bool) -> bool {
        let Some((at, '\\')) = last else {
            return false;
        };
        if !has_next {
            return false;
        }
        self.blank(at, end);
        if let Some(byte) = self.bytes.get_mut(end) {
            *byte = b' ';
        }
        true
    }

    /// A continued line may have a block number of its own.
    fn blank_number(&mut self, code: &str, start: usize) {
        let indent = code.len() - code.trim_start().len();
        let rest = &code[indent..];
        let digits = rest
            .get(1..)
            .unwrap_or("")
            .bytes()
            .take_while(u8::is_ascii_digit)
            .count();
        if rest.starts_with(['N', 'n']) && digits > 0 {
            self.blank(start + indent, start + indent + 1 + digits);
        }
    }

    fn comment(&mut self, code: &str, line: usize, start: usize, end: usize) {
        let text = &code[start - line..end - line];
        let text = text.trim_start_matches([';', '(']).trim();
        let text = text.strip_suffix(')').unwrap_or(text).trim();
        self.comments.push((self.offset + start, text.to_string()));
        self.blank(start, end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cleaned(text: &str) -> (String, Vec<String>, usize) {
        let mut diagnostics = Diagnostics::default();
        let clean = clean(Text::from(text), &mut diagnostics);
        let comments = clean.comments.into_iter().map(|(_, text)| text).collect();
        (clean.text, comments, diagnostics.errors())
    }

    #[test]
    fn comments_become_blanks() {
        let (text, comments, _) = cleaned("G1 (a (b) c) X10 ; end\nY1 (open\nZ1");
        assert_eq!(text, "G1           X10      \nY1      \nZ1");
        assert_eq!(comments, ["a (b) c", "end", "open"]);
    }

    #[test]
    fn texts_may_hold_what_begins_a_comment_elsewhere() {
        let (text, comments, _) = cleaned("#MSG [\"a (b); c\"] ; d");
        assert_eq!(text, "#MSG [\"a (b); c\"]    ");
        assert_eq!(comments, ["d"]);
    }

    #[test]
    fn continued_lines_become_one() {
        let (text, ..) = cleaned("N10 G60 \\ ; x\nN20 X1\nN30 Y1\n");
        assert_eq!(text, "N10 G60           X1\nN30 Y1\n");
    }

    #[test]
    fn block_comments_are_left_out() {
        let (text, _, errors) = cleaned("X1\nN5 #COMMENT BEGIN\nG99 ?\n#comment end\nX2\n");
        assert_eq!(text.replace(' ', ""), "X1\n\n\n\nX2\n");
        assert_eq!(errors, 0);
        assert_eq!(cleaned("#COMMENT BEGIN\nX1\n").2, 1);
        assert_eq!(cleaned("#COMMENT END\nX1\n").2, 1);
    }

    proptest! {
        #[test]
        fn places_are_kept(text in "[ -~ñ“\n\\\\();\"]*") {
            let (cleaned, ..) = cleaned(&text);
            prop_assert_eq!(cleaned.len(), text.len());
        }
    }
}
