//! Lines of HAL files: continuations, comments, what variables stand for, words and quotes.

use super::variables::{Missing, resolve};
use super::{Statement, Word};
use crate::machine::ini::Ini;
use crate::machine::place::Place;
use std::path::Path;
use std::sync::Arc;

/// Why a line is refused, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    pub place: Place,
    pub reason: Reason,
}

/// Why a line is refused.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// A quotation mark without its other one.
    OpenQuote,
    /// A variable without a value.
    Variable(Missing),
    /// More bytes than `halcmd` reads at once, [`LONGEST`]: the rest is another line to it.
    Long,
    /// A carriage return elsewhere than at the end of a line.
    Return,
}

/// The longest line that `halcmd` reads as one, bytes without the line feed; joined ones may be longer.
pub const LONGEST: usize = 1023;

/// A character and where it stands: line and column, from 1.
type Placed = (char, usize, usize);

/// The lines of a file, those that end in a backslash joined with the next ones; a carriage return behind it keeps them apart.
pub fn joined(text: &str) -> Vec<Vec<Placed>> {
    let mut lines: Vec<Vec<Placed>> = Vec::new();
    let mut goes_on = false;
    for (index, line) in text.split_terminator('\n').enumerate() {
        let content = line.strip_suffix('\\');
        let characters = content.unwrap_or(line).chars().enumerate();
        let placed = characters.map(|(column, c)| (c, index + 1, column + 1));
        match lines.last_mut() {
            Some(begun) if goes_on => begun.extend(placed),
            _ => lines.push(placed.collect()),
        }
        goes_on = content.is_some();
    }
    lines
}

/// The statement in a line; `None` if there is none.
pub fn statement(
    file: &Arc<Path>,
    line: &[Placed],
    ini: &Ini,
) -> Result<Option<Statement>, Refusal> {
    within_limit(file, line)?;
    let line = without_comment(file, line)?;
    let text: String = line.iter().map(|(c, ..)| c).collect();
    let words = words(file, &replaced(file, line, ini)?);
    let Some(first) = words.first() else {
        return Ok(None);
    };
    let place = first.place.clone();
    Ok(Some(Statement {
        words,
        text: text.trim().to_owned(),
        place,
    }))
}

/// Refuses a line of the file that is cut.
fn within_limit(file: &Arc<Path>, line: &[Placed]) -> Result<(), Refusal> {
    let mut length = 0;
    let mut number = 0;
    for &placed in line {
        let (character, row, _) = placed;
        length = character.len_utf8() + if row == number { length } else { 0 };
        number = row;
        if length > LONGEST && character != '\r' {
            return Err(refused(file, placed, Reason::Long));
        }
    }
    Ok(())
}

/// Up to the `#` that is in no quotes, without the carriage return of the line's end.
fn without_comment<'a>(file: &Arc<Path>, line: &'a [Placed]) -> Result<&'a [Placed], Refusal> {
    let mut quote: Option<Placed> = None;
    for (index, &placed) in line.iter().enumerate() {
        match (placed.0, quote) {
            ('\r', _) if index + 1 == line.len() => return closed(file, &line[..index], quote),
            ('\r', _) => return Err(refused(file, placed, Reason::Return)),
            ('#', None) => return Ok(&line[..index]),
            (mark @ ('"' | '\''), Some((open, ..))) if mark == open => quote = None,
            ('"' | '\'', None) => quote = Some(placed),
            _ => {}
        }
    }
    closed(file, line, quote)
}

/// The line, unless a quotation mark is open at its end.
fn closed<'a>(
    file: &Arc<Path>,
    line: &'a [Placed],
    quote: Option<Placed>,
) -> Result<&'a [Placed], Refusal> {
    match quote {
        None => Ok(line),
        Some(open) => Err(refused(file, open, Reason::OpenQuote)),
    }
}

fn refused(file: &Arc<Path>, (_, row, column): Placed, reason: Reason) -> Refusal {
    Refusal {
        place: Place::new(file, row, column),
        reason,
    }
}

/// With what variables stand for, at the places of the variables.
fn replaced(file: &Arc<Path>, line: &[Placed], ini: &Ini) -> Result<Vec<Placed>, Refusal> {
    let characters: Vec<char> = line.iter().map(|(c, ..)| *c).collect();
    let mut found = Vec::with_capacity(line.len());
    let mut at = 0;
    while let Some(&(character, row, column)) = line.get(at) {
        if !matches!(character, '[' | '$') {
            found.push((character, row, column));
            at += 1;
            continue;
        }
        let (length, value) = resolve(&characters[at..], ini).map_err(|missing| {
            refused(file, (character, row, column), Reason::Variable(missing))
        })?;
        found.extend(value.chars().map(|c| (c, row, column)));
        at += length;
    }
    Ok(found)
}

/// Cut at the blanks of ASCII that are in no quotes; the quotes stay.
fn words(file: &Arc<Path>, line: &[Placed]) -> Vec<Word> {
    let mut words: Vec<Word> = Vec::new();
    let mut in_word = false;
    let mut quote = None;
    for &(character, row, column) in line {
        if quote.is_none() && matches!(character, ' ' | '\t' | '\x0b' | '\x0c') {
            in_word = false;
            continue;
        }
        if !in_word {
            in_word = true;
            words.push(Word {
                text: String::new(),
                place: Place::new(file, row, column),
            });
        }
        if quote == Some(character) {
            quote = None;
        } else if quote.is_none() && matches!(character, '"' | '\'') {
            quote = Some(character);
        }
        if let Some(word) = words.last_mut() {
            word.text.push(character);
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<Vec<String>>, Refusal> {
        let (ini, _) = Ini::parse_all(
            Path::new("m.ini"),
            "[AXIS_X]\nMAX_JERK = 20 # much\nV=5\n[KINS]\nKINEMATICS = trivkins coordinates=XZ\n",
        );
        let file = Arc::from(Path::new("m.hal"));
        let mut found = Vec::new();
        for line in joined(text) {
            let statement = statement(&file, &line, &ini)?;
            found.extend(statement.map(|s| s.words.into_iter().map(|w| w.text).collect()));
        }
        Ok(found)
    }

    #[test]
    fn lines_are_cut_as_halcmd_cuts_them() {
        let found = read(
            "# nothing\nloadrt [KINS]KINEMATICS # kinematics\nsetp a [AXIS_X](V)\\\n 5\nx 'a b'\"#\"\n",
        );
        let found = found.expect("valid");
        assert_eq!(found[0], ["loadrt", "trivkins", "coordinates=XZ"]);
        assert_eq!(found[1], ["setp", "a", "5", "5"]);
        assert_eq!(found[2], ["x", "'a b'\"#\""]);
    }

    #[test]
    fn a_comment_in_the_ini_file_gets_into_the_line() {
        let found = read("setp a [AXIS_X]MAX_JERK").expect("valid");
        assert_eq!(found[0], ["setp", "a", "20", "#", "much"]);
    }

    /// As halcmd of LinuxCNC 2.9 takes them.
    #[test]
    fn blanks_and_ends_of_lines_are_those_of_halcmd() {
        let longest = format!("#{}\nsetp a 5", "x".repeat(LONGEST - 1));
        for (text, words) in [
            ("setp\ta\x0b5\x0c\r\n", vec!["setp", "a", "5"]),
            ("setp\u{a0}a 5", vec!["setp\u{a0}a", "5"]),
            ("setp a \"5\"", vec!["setp", "a", "\"5\""]),
            ("setp a \\\r\n5\r\n", vec!["setp", "a", "\\"]),
            ("# \rsetp b 6\nsetp a 5", vec!["setp", "a", "5"]),
            (&longest, vec!["setp", "a", "5"]),
        ] {
            assert_eq!(read(text).expect("taken")[0], words, "{text:?}");
        }
        let reason = |text: &str| read(text).expect_err("refused").reason;
        assert_eq!(reason(&format!("# {}", "x".repeat(LONGEST))), Reason::Long);
        assert_eq!(reason("setp a\r5"), Reason::Return);
        assert_eq!(reason("echo \"a\r\n"), Reason::OpenQuote);
    }

    #[test]
    fn what_is_not_there_is_refused_at_its_place() {
        let refused = read("\n setp a [AXIS_Y]V").expect_err("refused");
        assert_eq!((refused.place.line, refused.place.column), (2, 9));
        assert!(matches!(
            refused.reason,
            Reason::Variable(Missing::Key { .. })
        ));
        assert_eq!(
            read("echo \"a").expect_err("refused").reason,
            Reason::OpenQuote
        );
        for text in ["[", "[A", "[A](", "$", "$(", "$()", "[]x", "[A]"] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
