//! LinuxCNC's tool table: a line for each tool, words of a letter and a number, comments from `;`.
//!
//! What LinuxCNC 2.9 reads without finding a tool in it, or skips with no more than a line in a
//! terminal, is refused here: the plan would be for another machine than the one that runs.

use crate::path::Position;
use std::path::{Path, PathBuf};

/// A tool, in machine units and degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tool {
    /// T.
    pub number: i32,
    /// P.
    pub pocket: i32,
    /// X Y Z A B C U V W.
    pub offset: Position,
    /// D.
    pub diameter: f64,
    /// I, degrees.
    pub front_angle: f64,
    /// J, degrees.
    pub back_angle: f64,
    /// Q.
    pub orientation: i32,
}

/// Why a tool table cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ToolTableError {
    /// The file cannot be opened.
    #[error("{}: the tool table cannot be read: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A line is not understood.
    #[error(
        "{}:{line}: `{word}` is no word of a tool table: T, P, D, I, J, Q or the letter of an axis, \
         and a number",
        file.display()
    )]
    Word {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What was found.
        word: String,
    },
    /// A line is understood, but LinuxCNC would not find its tool.
    #[error("{}:{line}: LinuxCNC does not find this tool: {problem}", file.display())]
    Lost {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Why, and what to write.
        problem: &'static str,
    },
}

/// Reads a tool table. T0 is no tool in LinuxCNC: whatever its line says, `T0 M6` empties the spindle.
///
/// # Errors
/// A file that cannot be read, a word that is not understood, a tool that LinuxCNC would not find.
pub fn read_tool_table(file: &Path) -> Result<Vec<Tool>, ToolTableError> {
    let bytes = std::fs::read(file).map_err(|source| ToolTableError::Read {
        file: file.to_owned(),
        source,
    })?;
    let mut tools = Vec::new();
    // The carriage return of CR LF stays, as it does for LinuxCNC.
    for (index, line) in String::from_utf8_lossy(&bytes).split('\n').enumerate() {
        let words = line.split(';').next().unwrap_or("");
        let lost = |problem| ToolTableError::Lost {
            file: file.to_owned(),
            line: index + 1,
            problem,
        };
        let mut read = Line::default();
        for word in words.split_whitespace() {
            read.take(word).ok_or_else(|| ToolTableError::Word {
                file: file.to_owned(),
                line: index + 1,
                word: word.to_owned(),
            })?;
        }
        if words.trim().is_empty() {
            continue;
        }
        // Such a character at the end of a word does no harm.
        let mut parts = words.split(' ').filter(|part| !part.is_empty());
        if parts
            .any(|part| part.trim_end().is_empty() || part.trim_end().contains(char::is_whitespace))
        {
            return Err(lost(BLANKS));
        }
        let tool = read.tool().map_err(lost)?;
        if tool.number != 0 {
            tools.push(tool);
        }
        if tools.len() > MOST_TOOLS {
            return Err(lost("the table has more than 1000 tools"));
        }
    }
    Ok(tools)
}

const BLANKS: &str = "words are parted by blanks; a tab or a carriage return stands among them";

/// LinuxCNC's CANON_POCKETS_MAX, without the spindle.
const MOST_TOOLS: usize = 1000;

/// The words of a line; what has none is 0.
#[derive(Default)]
struct Line {
    number: Option<i32>,
    pocket: Option<i32>,
    others: Tool,
}

impl Line {
    fn tool(&self) -> Result<Tool, &'static str> {
        let number = self.number.ok_or("the line has no T")?;
        let pocket = self.pocket.ok_or("the line has no P")?;
        if number < 0 {
            return Err("T is below 0");
        }
        Ok(Tool {
            number,
            pocket,
            ..self.others
        })
    }

    /// `None` for what is no word.
    fn take(&mut self, word: &str) -> Option<()> {
        let mut characters = word.chars();
        let letter = characters.next()?.to_ascii_uppercase();
        let number = characters.as_str();
        let whole = || number.parse::<i32>().ok();
        let real = || number.parse::<f64>().ok().filter(|n| n.is_finite());
        match letter {
            'T' => self.number = Some(whole()?),
            'P' => self.pocket = Some(whole()?),
            'Q' => self.others.orientation = real()? as i32,
            'D' => self.others.diameter = real()?,
            'I' => self.others.front_angle = real()?,
            'J' => self.others.back_angle = real()?,
            _ => {
                let axis = "XYZABCUVW".find(letter)?;
                self.others.offset[axis] = real()?;
            }
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_comments() {
        let mut line = Line::default();
        for word in ["T3", "P7", "z+12.5", "D6", "Q2", "W-1"] {
            assert!(line.take(word).is_some(), "{word}");
        }
        let tool = line.tool().expect("a tool");
        assert_eq!((tool.number, tool.pocket, tool.orientation), (3, 7, 2));
        assert_eq!((tool.offset[2], tool.offset[8]), (12.5, -1.0));
        for word in ["T", "K1", "Zx", "Znan"] {
            assert!(line.take(word).is_none(), "{word}");
        }
    }

    fn read(text: &str) -> Result<Vec<Tool>, String> {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("tools.tbl");
        std::fs::write(&file, text).expect("written");
        read_tool_table(&file).map_err(|error| {
            let said = error.to_string();
            let file = format!("{}:", file.display());
            said.strip_prefix(&file).expect("the file").to_owned()
        })
    }

    #[test]
    fn lines_without_a_tool_are_passed_over() {
        let tools = read(";head\n\n  \n\t; c\nT0 P0 Z9 ;no tool\nT5 P0 Z1\t; c\r\nT6 P1\r\n");
        let numbers = tools.expect("tools");
        let numbers: Vec<i32> = numbers.iter().map(|tool| tool.number).collect();
        assert_eq!(numbers, [5, 6]);
    }

    /// With LinuxCNC's libtooldata 2.9 none of these tools is found by its number.
    #[test]
    fn a_tool_that_linuxcnc_would_not_find_is_refused() {
        for (line, problem) in [
            ("P3 Z3 ;no T", "the line has no T"),
            ("Z3", "the line has no T"),
            ("T2 Z2", "the line has no P"),
            ("T-3 P9 Z10", "T is below 0"),
            ("T3\tP3 Z5", BLANKS),
            ("T3 P3\tZ5", BLANKS),
            ("T3 P3 Z5 \t; two blanks", BLANKS),
            ("\tT3 P3", BLANKS),
            ("T3 P3 \r", BLANKS),
        ] {
            let refused = read(&format!("T1 P1\n{line}\n")).expect_err(line);
            assert_eq!(
                refused,
                format!("2: LinuxCNC does not find this tool: {problem}")
            );
        }
        let many =
            |count: usize| -> String { (1..=count).map(|t| format!("T{t} P{t}\n")).collect() };
        assert_eq!(read(&many(1000)).expect("tools").len(), 1000);
        let refused = read(&many(1001)).expect_err("too many");
        assert!(refused.starts_with("1001: "), "{refused}");
    }
}
