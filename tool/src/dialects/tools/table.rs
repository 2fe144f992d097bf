//! LinuxCNC's tool table: `T3 P3 D6 ;MILL_6 four teeth`. The comment names the tool, as a whole and by its
//! first word.

use super::{MOST, Tools, lines};
use crate::diagnostics::Diagnostic;
use crate::source::{Span, Text};

/// The letters of its words.
const LETTERS: &str = "TPDIJQXYZABCUVW";

/// The tools of the table.
pub(super) fn parse(text: Text) -> Result<Tools, Diagnostic> {
    let mut tools = Tools::default();
    for (start, line) in lines(text.text) {
        let (words, comment) = line.split_once(';').unwrap_or((line, ""));
        if words.trim().is_empty() {
            continue;
        }
        let place = |from: usize, to: usize| Span {
            file: text.file,
            start: start + from,
            end: start + to,
        };
        let mut number = None;
        let mut diameter = None;
        for word in words.split_whitespace() {
            // A word is a part of its line.
            let at = word.as_ptr() as usize - line.as_ptr() as usize;
            let (letter, value) = word_of(word).ok_or_else(|| {
                let span = place(at, at + word.len());
                Diagnostic::error(span, format!("`{word}` is no word of a tool table"))
                    .help("words are T, P, D, I, J, Q or the letter of an axis, and a number")
            })?;
            match letter {
                'T' => number = Some(value),
                'D' => diameter = Some(value),
                'X' | 'Y' | 'A' | 'B' | 'C' | 'U' | 'V' | 'W' => tools.aside |= value != 0.0,
                _ => {}
            }
        }
        let whole = number.filter(|n| n.fract() == 0.0 && (0.0..=f64::from(MOST)).contains(n));
        let Some(number) = whole.map(|number| number as u32) else {
            let span = place(0, words.trim_end().len());
            return Err(
                Diagnostic::error(span, "this line of the tool table has no tool number")
                    .help("write T3 P3 at its beginning"),
            );
        };
        // T0 is no tool.
        if number == 0 {
            continue;
        }
        if let Some(diameter) = diameter {
            tools.diameters.insert(number, diameter);
        }
        let comment = comment.trim();
        let first = comment.split_whitespace().next();
        for name in [Some(comment), first].into_iter().flatten() {
            if !name.is_empty() {
                tools.add(name, number);
            }
        }
    }
    Ok(tools)
}

fn word_of(word: &str) -> Option<(char, f64)> {
    let letter = word.chars().next()?.to_ascii_uppercase();
    let value: f64 = word.get(1..)?.parse().ok()?;
    (LETTERS.contains(letter) && value.is_finite()).then_some((letter, value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_name_tools() {
        let text = ";T P D\nT1 P1 D10 Z1 ;UGT0201_085 end mill\nT2 P2 Z+3.5;drill 5\r\nT3 P3 ;drill 8\n\
                    T0 P0 ;none\nT4 P4\n";
        let tools = parse(Text::from(text)).expect("a table");
        let of = |name: &str| tools.numbers.get(name).map(Vec::as_slice);
        assert_eq!(of("UGT0201_085"), Some(&[1][..]));
        assert_eq!(of("UGT0201_085 END MILL"), Some(&[1][..]));
        assert_eq!(of("DRILL 5"), Some(&[2][..]));
        assert_eq!(of("DRILL"), Some(&[2, 3][..]));
        assert_eq!(of("NONE"), None);
        assert_eq!(tools.diameters.get(&1), Some(&10.0));
        assert_eq!(tools.diameters.len(), 1);
    }

    #[test]
    fn what_is_no_line_of_it_is_refused_at_its_place() {
        for (text, place) in [
            ("T1 P1\nT2 K3\n", 9..11),
            ("T1 P1 D\n", 6..7),
            ("P1 Z3 ;x\n", 0..5),
            ("T1.5 P1\n", 0..7),
        ] {
            let error = parse(Text::from(text)).expect_err(text);
            assert_eq!(error.span.start..error.span.end, place, "{text}");
        }
    }
}
