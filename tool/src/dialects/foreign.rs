//! Programs of controls whose languages are not translated: they are told by name, since each of their lines would
//! be refused by words that say nothing of that.

use super::Dialect;
use crate::diagnostics::Diagnostic;
use crate::source::Span;

/// How many lines are looked at.
const LINES: usize = 400;

/// The first words of lines behind their numbers, in the language of Heidenhain.
const HEIDENHAIN: [[&str; 2]; 6] = [
    ["BEGIN", "PGM"],
    ["END", "PGM"],
    ["BLK", "FORM"],
    ["TOOL", "CALL"],
    ["TOOL", "DEF"],
    ["CYCL", "DEF"],
];

/// The error for a program, or the beginning of one, in file 0 that is in such a language; `None` for any other.
pub fn refusal(text: &str) -> Option<Diagnostic> {
    let mut start = 0;
    let mut is_first = true;
    for line in text.split_inclusive('\n').take(LINES) {
        let code = line.trim().to_ascii_uppercase();
        if is_conversational(&code) || is_first && begins_iso(&code) {
            let first = start + (line.len() - line.trim_start().len());
            let span = Span {
                file: 0,
                start: first,
                end: first + line.trim().len(),
            };
            return Some(heidenhain(span));
        }
        is_first &= code.is_empty();
        start += line.len();
    }
    None
}

/// `4 TOOL CALL 1 Z S1910`; the number may be missing before BEGIN PGM.
fn is_conversational(code: &str) -> bool {
    let mut words = code.split_ascii_whitespace().peekable();
    let is_number = |word: &&str| word.bytes().all(|byte| byte.is_ascii_digit());
    let numbered = words.next_if(is_number).is_some();
    match (words.next(), words.next()) {
        (Some("BEGIN"), Some("PGM")) => true,
        (Some(first), Some(second)) => numbered && HEIDENHAIN.contains(&[first, second]),
        _ => false,
    }
}

/// `%PART G71 *`: their programs of G functions.
fn begins_iso(code: &str) -> bool {
    let head = code
        .strip_prefix('%')
        .and_then(|rest| rest.strip_suffix('*'));
    let mut words = head.unwrap_or("").split_ascii_whitespace();
    words.any(|word| matches!(word, "G70" | "G71"))
}

fn heidenhain(span: Span) -> Diagnostic {
    let names: Vec<&str> = Dialect::ALL.iter().map(|dialect| dialect.name()).collect();
    Diagnostic::error(
        span,
        "this is a program of a Heidenhain control, whose language is not translated",
    )
    .help(format!(
        "post it for LinuxCNC, or for a control whose language is: {}",
        names.join(", ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_programs_of_heidenhain_are_foreign() {
        for (text, foreign) in [
            ("0 BEGIN PGM PART MM\n1 L X+0\n", true),
            ("begin pgm part inch\n", true),
            ("; a part\r\n\r\n4  TOOL CALL 1 Z S1910\r\n", true),
            ("\n%1000 G71 *\nN10 G30 G17 X+0*\n", true),
            ("%PART G70*\n", true),
            ("G0 X1\n%PART G71 *\n", false),
            ("%PART,MX--,\nN10 G71\n", false),
            ("%\nO1 (TOOL CALL 1)\nG71\n", false),
            ("; 4 TOOL CALL 1\nTOOL CALL\n", false),
        ] {
            assert_eq!(refusal(text).is_some(), foreign, "{text}");
        }
    }
}
