//! The file of numbered parameters ([RS274NGC]PARAMETER_FILE), of which the interpreter says neither name nor line when it
//! refuses it.

use std::path::{Path, PathBuf};

/// A row that the interpreter refuses, or cannot work with.
#[derive(Debug, thiserror::Error)]
#[error("{}:{line}: {problem}\n    {text}", file.display())]
pub struct ParameterError {
    /// The file of parameters.
    file: PathBuf,
    /// Number of the line, from 1.
    line: usize,
    /// What is wrong with it, and what to write.
    problem: String,
    /// The line itself.
    text: String,
}

/// A row of the file: the number of a parameter and its value.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    line: usize,
    text: String,
    number: i64,
    value: f64,
}

impl Row {
    /// `None` for a line that the interpreter passes over: it wants a whole number and a number at its beginning.
    fn read(line: usize, text: &str) -> Option<Row> {
        let trimmed = text.trim_start();
        let unsigned = trimmed.trim_start_matches(['+', '-']);
        let digits = unsigned.len()
            - unsigned
                .trim_start_matches(|c: char| c.is_ascii_digit())
                .len();
        let (number, rest) = trimmed.split_at_checked(trimmed.len() - unsigned.len() + digits)?;
        let word = rest.split_whitespace().next()?;
        // What stands right behind the value does not matter.
        let beginnings = (1..=word.len()).rev().filter_map(|end| word.get(..end));
        Some(Row {
            line,
            text: text.trim().to_owned(),
            number: number.parse().ok()?,
            value: beginnings.filter_map(|text| text.parse().ok()).next()?,
        })
    }

    fn refused(self, file: &Path, problem: String) -> ParameterError {
        ParameterError {
            file: file.to_owned(),
            line: self.line,
            problem,
            text: self.text,
        }
    }
}

/// The rows of a file; none where it cannot be read, which whoever copies it says.
fn rows(file: &Path) -> Vec<Row> {
    let content = std::fs::read(file).unwrap_or_default();
    let text = String::from_utf8_lossy(&content);
    let lines = text.lines().enumerate();
    lines
        .filter_map(|(index, line)| Row::read(index + 1, line))
        .collect()
}

/// # Errors
/// The first row whose number is below 1 or does not rise, which the interpreter refuses, or whose value is not finite, with
/// which it would move to nowhere.
pub(super) fn check(file: &Path) -> Result<(), ParameterError> {
    let mut before = 0;
    for row in rows(file) {
        let (number, value) = (row.number, row.value);
        let problem = if number < 1 {
            format!("there is no parameter {number}, the first is 1: take the line away")
        } else if number <= before {
            format!(
                "parameter {number} stands behind parameter {before}: each has one line, and their numbers rise from line to line"
            )
        } else if !value.is_finite() {
            format!("parameter {number} is {value}: write a number")
        } else {
            before = number;
            continue;
        };
        return Err(row.refused(file, problem));
    }
    Ok(())
}

/// The row that stands for those whose numbers are above all that this LinuxCNC has: the last.
pub(super) fn too_high(file: &Path) -> Option<ParameterError> {
    let row = rows(file).pop()?;
    let problem = format!(
        "LinuxCNC has no parameter {}: take the line away",
        row.number
    );
    Some(row.refused(file, problem))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(text: &str) -> Option<String> {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("part.var");
        std::fs::write(&file, text).expect("written");
        let error = check(&file).err()?.to_string();
        error
            .rsplit_once("part.var:")
            .map(|(_, said)| said.to_owned())
    }

    #[test]
    fn rows_as_the_interpreter_reads_them() {
        for good in [
            "",
            "5161\t0.000000\n5221 1e3\n 5222 -.5 mm\n",
            "5221 1\nabc\n; 5161 2\n5161\n5222 2\n",
        ] {
            assert_eq!(said(good), None, "{good}");
        }
        for (bad, expected) in [
            (
                "5221 1\n\n5161 2\n",
                "3: parameter 5161 stands behind parameter 5221",
            ),
            ("5221 1\n5221 1\n", "2: parameter 5221 stands behind"),
            ("0 1\n", "1: there is no parameter 0"),
            ("-3 1\n", "1: there is no parameter -3"),
            ("5221 nan\n", "1: parameter 5221 is NaN"),
            ("5220 1\n5221 1e999\n", "2: parameter 5221 is inf"),
        ] {
            let said = said(bad).expect("refused");
            assert!(said.starts_with(expected), "{said}");
        }
    }
}
