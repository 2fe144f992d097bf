//! Which language a part program is written in: by the ending of its file and by words that only one
//! language has.

use super::Dialect;
use crate::diagnostics::Diagnostic;
use crate::source::Span;
use std::path::Path;

/// How many lines are looked at.
const LINES: usize = 400;

/// How sure a guess must be.
const LEAST: u32 = 10;

/// How sure one must be that nobody has asked for.
const SURE: u32 = 50;

/// A guess.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Guess {
    /// The language.
    pub dialect: Dialect,
    /// The first line, 1 for the first, with a word that speaks for it; `None` where the ending of the
    /// file decided.
    pub line: Option<usize>,
    /// Other controls that have all of these words too; see [`Evidence::share`].
    pub shared: Option<&'static str>,
    /// How much speaks for it.
    score: u32,
}

/// What speaks for a dialect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Evidence {
    score: u32,
    line: Option<usize>,
    shared: Option<&'static str>,
}

impl Evidence {
    /// Something in this line, counted from 0, speaks for the dialect with this weight: 100 for what
    /// no other dialect could have.
    pub fn add(&mut self, weight: u32, line: usize) {
        self.score = self.score.saturating_add(weight);
        if weight > 0 {
            self.line.get_or_insert(line + 1);
        }
    }

    /// All that speaks for the dialect speaks for these controls as much, whose language is none of those that are
    /// read. Which of them is meant is for the user to say.
    pub fn share(&mut self, others: &'static str) {
        self.shared = Some(others);
    }

    /// The ending of the file speaks for the dialect.
    pub fn add_extension(&mut self, weight: u32) {
        self.score = self.score.saturating_add(weight);
    }
}

/// A line without what stands in parentheses, which is a comment to most controls. `is_code` says of the text before a parenthesis
/// that this one is none: then it stays.
pub fn without_comments(line: &str, is_code: impl Fn(&str) -> bool) -> String {
    let mut code = String::with_capacity(line.len());
    let mut inside = false;
    for character in line.chars() {
        match character {
            ')' if inside => inside = false,
            _ if inside => {}
            '(' if !is_code(&code) => inside = true,
            _ => code.push(character),
        }
    }
    code
}

/// The dialect that most speaks for; `None` where nothing speaks for one, or as much for two.
pub fn guess(path: &Path, text: &str) -> Option<Guess> {
    let lines: Vec<String> = text
        .lines()
        .take(LINES)
        .map(|line| line.trim().to_ascii_uppercase())
        .collect();
    let extension = path.extension().unwrap_or_default();
    let extension = extension.to_string_lossy().to_ascii_lowercase();
    let look = |dialect: &Dialect| {
        let language = dialect.language()?;
        Some((language.evidence(&lines, &extension), *dialect))
    };
    let mut found: Vec<(Evidence, Dialect)> = Dialect::ALL.iter().filter_map(look).collect();
    found.sort_by_key(|(evidence, _)| std::cmp::Reverse(evidence.score));
    match found[..] {
        [(first, _), (second, _), ..] if first.score == second.score => None,
        [(first, dialect), ..] if first.score >= LEAST => Some(Guess {
            dialect,
            line: first.line,
            shared: first.shared,
            score: first.score,
        }),
        _ => None,
    }
}

/// The guess for a program that is to be run.
///
/// # Errors
///
/// Where no guess can be made, or controls whose languages are not read have the same words.
pub fn decide(path: &Path, text: &str) -> Result<Guess, Diagnostic> {
    let guess = guess(path, text).ok_or_else(undecided)?;
    match guess.shared {
        Some(others) => Err(shared(guess, others, text)),
        None => Ok(guess),
    }
}

/// The dialect of a program that is surely none of LinuxCNC's, which has most words of Fanuc-like controls itself.
pub fn surely(path: &Path, text: &str) -> Option<Dialect> {
    let guess = guess(path, text)?;
    let is_sure = guess.score >= SURE && guess.dialect != Dialect::Fanuc;
    is_sure.then_some(guess.dialect)
}

/// The error where other controls have the same words, at the first of them.
fn shared(guess: Guess, others: &str, text: &str) -> Diagnostic {
    let mut lines = text.split_inclusive('\n');
    let before = guess.line.unwrap_or(1).saturating_sub(1);
    let start = lines.by_ref().take(before).map(str::len).sum();
    let line = lines.next().unwrap_or("").trim_end();
    let span = Span {
        file: 0,
        start,
        end: start + line.len(),
    };
    let name = guess.dialect.name();
    Diagnostic::error(
        span,
        format!("{others} have this word and all others that speak for {name}, and to them some mean something else"),
    )
    .help(format!(
        "give --dialect {name} where the program is none of theirs; theirs are not translated: post it for LinuxCNC"
    ))
}

/// The error where no guess can be made.
fn undecided() -> Diagnostic {
    let start = Span::start_of(0);
    let names: Vec<&str> = Dialect::ALL.iter().map(|dialect| dialect.name()).collect();
    Diagnostic::error(
        start,
        "nothing in this program tells in which language it is written",
    )
    .help(format!("give --dialect {}", names.join(" or ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guessed(name: &str, text: &str) -> Option<Dialect> {
        guess(Path::new(name), text).map(|guess| guess.dialect)
    }

    #[test]
    fn words_of_one_language_decide() {
        for (text, dialect) in [
            ("G0 X1\nTRANS X10\n", Dialect::Sinumerik),
            ("%_N_PART_MPF\nG0\n", Dialect::Sinumerik),
            ("G90\n(RPT N10,20)\n", Dialect::Fagor),
            ("%PART,MX--,\nG0 X1\n", Dialect::Fagor),
            ("(P1 = 3)\n", Dialect::Fagor),
        ] {
            assert_eq!(guessed("part.nc", text), Some(dialect), "{text}");
        }
    }

    #[test]
    fn endings_decide_where_words_do_not() {
        assert_eq!(guessed("part.MPF", "G0 X1\n"), Some(Dialect::Sinumerik));
        assert_eq!(guessed("part.pim", "G0 X1\n"), Some(Dialect::Fagor));
        assert_eq!(guessed("part.nc", "G0 X1\nM30\n"), None);
    }
}
