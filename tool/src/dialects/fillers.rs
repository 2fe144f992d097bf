//! NULs and other bytes that say nothing. Tapes and serial lines leave them before and behind lines; inside
//! of one they stand where something was lost.

use super::scanner::is_blank;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::{SourceFile, Span, Text};
use std::io;

/// An error for the first NUL inside of each line.
pub fn check(text: Text, diagnostics: &mut Diagnostics) {
    // Nearly all programs have none.
    if !text.text.contains('\0') {
        return;
    }
    let blank = |part: &str| part.chars().all(is_filler);
    let mut start = text.start;
    for line in text.text.split_inclusive('\n') {
        let mut nuls = line.match_indices('\0').map(|(at, _)| at);
        let inside = nuls.find(|at| !blank(&line[..*at]) && !blank(&line[*at..]));
        if let Some(at) = inside {
            let span = Span {
                file: text.file,
                start: start + at,
                end: start + at + 1,
            };
            diagnostics.push(
                Diagnostic::error(
                    span,
                    "a NUL byte stands inside of this block: something was lost",
                )
                .help("transfer or post the program again"),
            );
        }
        start += line.len();
    }
}

/// An error for a file that holds nothing but NULs.
pub fn nothing_but_nul(file: usize) -> Diagnostic {
    Diagnostic::error(
        Span::start_of(file),
        "this file holds nothing but NUL bytes",
    )
    .help("transfer or post the program again")
}

/// Whether a file holds nothing but NULs and blanks. It is read as far as that goes on.
///
/// # Errors
///
/// When it cannot be read.
pub fn is_nul(file: &SourceFile) -> io::Result<bool> {
    let mut nul = false;
    for index in 0.. {
        let Some(page) = file.page(index)? else {
            break;
        };
        if !page.text().chars().all(is_filler) {
            return Ok(false);
        }
        nul |= page.text().contains('\0');
    }
    Ok(nul)
}

/// Whether there is nothing in a file, not even NUL.
pub fn is_empty(file: &SourceFile) -> io::Result<bool> {
    for index in 0.. {
        let Some(page) = file.page(index)? else {
            break;
        };
        if page.text().contains('\0') || !page.text().chars().all(is_filler) {
            return Ok(false);
        }
    }
    Ok(true)
}

fn is_filler(c: char) -> bool {
    is_blank(c) || c.is_whitespace()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nul_inside_of_a_line_has_a_place() {
        for (text, place) in [
            ("G0 X1\nX1\x000\n", vec![8]),
            ("X\x001", vec![1]),
            ("G0\0\0 X1", vec![2]),
            ("X\x001\nX\x002\0\n", vec![1, 5]),
            ("\0\0%\nX1\0\0\n\0\n", vec![]),
            ("", vec![]),
            ("\0\0\0", vec![]),
        ] {
            let mut diagnostics = Diagnostics::default();
            check(Text::from(text), &mut diagnostics);
            let found: Vec<usize> = diagnostics.iter().map(|error| error.span.start).collect();
            assert_eq!(found, place, "{text:?}");
        }
    }
}
