//! A first look through a file: what leads through its blocks, without parsing those that only move.

use crate::diagnostics::Diagnostics;
use crate::dialects::blocks::unreadable;
use crate::source::{Sources, Text};

/// Which lines of a program say how its blocks follow each other.
#[derive(Clone, Copy, Debug)]
pub struct Notable {
    /// Whether a line does. It may say so of others too.
    pub is: fn(&[u8]) -> bool,
    /// Whether that can be this line of nothing but letters that begin ordinary words, digits, points and signs.
    pub among_plain: fn(&[u8]) -> bool,
}

/// Goes through the lines of a file and shows those that are `notable`, with their indices; returns how many
/// lines there are.
pub fn notable_lines(
    file: usize,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
    notable: Notable,
    visit: &mut dyn FnMut(usize, Text, &mut Diagnostics),
) -> usize {
    let mut lines = 0;
    for index in 0.. {
        let page = match sources.file(file).page(index) {
            Ok(Some(page)) => page,
            Ok(None) => break,
            Err(error) => {
                diagnostics.push(unreadable(file, &error));
                break;
            }
        };
        let mut at = 0;
        let text = page.text();
        let bytes = text.as_bytes();
        for line in page.first_line()..page.first_line() + page.lines() {
            let rest = bytes.get(at..).unwrap_or(&[]);
            let (length, plain) = measure(rest);
            let line_bytes = rest.get(..length).unwrap_or(&[]);
            if (!plain || (notable.among_plain)(line_bytes)) && (notable.is)(line_bytes) {
                let text = Text {
                    file,
                    text: text.get(at..at + length).unwrap_or(""),
                    start: page.start() + at,
                };
                visit(line, text, diagnostics);
            }
            at += length + 1;
        }
        lines = page.first_line() + page.lines();
    }
    lines
}

/// The length of the first line, and whether it has only bytes of motions that all dialects read alike.
fn measure(bytes: &[u8]) -> (usize, bool) {
    let mut classes = 0;
    for (at, byte) in bytes.iter().enumerate() {
        let class = CLASSES[usize::from(*byte)];
        if class == END {
            return (at, classes == 0);
        }
        classes |= class;
    }
    (bytes.len(), classes == 0)
}

const END: u8 = 2;

/// 0: bytes of ordinary words. L names subprograms.
const CLASSES: [u8; 256] = {
    let mut classes = [1; 256];
    let bytes = b" \t.+-0123456789NGXYZABCUVWIJKFSTDMngxyzabcuvwijkfstdm";
    let mut at = 0;
    while at < bytes.len() {
        classes[bytes[at] as usize] = 0;
        at += 1;
    }
    classes[b'\n' as usize] = END;
    classes
};

/// The number with which a line seems to begin: `N10`, `/N10`, `:10`.
pub fn block_number(line: &[u8]) -> Option<u32> {
    let mut rest = trim(line);
    if let Some(behind) = rest.strip_prefix(b"/") {
        rest = trim(behind);
        let level = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
        rest = trim(rest.get(level..)?);
    }
    let rest = match rest.split_first()? {
        (b'N' | b'n' | b':', behind) => trim(behind),
        _ => return None,
    };
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit());
    let mut number = None;
    for digit in digits {
        let before: u32 = number.unwrap_or(0);
        number = Some(
            before
                .checked_mul(10)?
                .checked_add(u32::from(digit - b'0'))?,
        );
    }
    number
}

fn trim(bytes: &[u8]) -> &[u8] {
    let blank = |byte: &u8| matches!(byte, b' ' | b'\t' | 0 | 0x1a | 0x11 | 0x13);
    let blanks = bytes.iter().take_while(|byte| blank(byte)).count();
    bytes.get(blanks..).unwrap_or(&[])
}

/// Whether a line has one of these words, in upper case; the number of the block may stand right before it:
/// `N10GOTOF END`.
pub fn has_word(line: &str, words: &[&str]) -> bool {
    let mut found = line.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    found.any(|word| words.iter().any(|known| ends_with(word, known)))
}

/// Whether a word is a name, or a number with the name behind it.
fn ends_with(word: &str, name: &str) -> bool {
    let before = word.strip_suffix(name);
    before.is_some_and(|before| before.is_empty() || before.ends_with(|c: char| c.is_ascii_digit()))
}
