//! LinuxCNC's tool table: a line for each tool, words of a letter and a number, comments from `;`.
//!
//! Read as `tooldata_read_entry` of LinuxCNC 2.9 does (src/emc/tooldata/tooldata_common.cc). A line with a word that it does
//! not know is skipped there with no more than a line in a terminal, as all are of a table with columns, the form of
//! old versions; of a word it takes the number that it begins with. Both are told. A tool that it then holds where it
//! does not find it is refused: the plan would be for another machine than the one that runs.

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
    /// LinuxCNC takes the word, and no machine can use it.
    #[error(
        "{}:{line}: `{word}` is no word of a tool table: T, P, D, I, J, Q or the letter of an axis, \
         and a decimal number",
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

/// What a tool table holds.
#[derive(Debug, Default)]
pub struct ToolTable {
    /// In the order of the file.
    pub tools: Vec<Tool>,
    /// What LinuxCNC skips, or reads otherwise than it stands there; each with file and line.
    pub warnings: Vec<String>,
}

/// Reads a tool table. T0 is no tool in LinuxCNC: whatever its line says, `T0 M6` empties the spindle.
///
/// # Errors
/// A file that cannot be read, a tool that LinuxCNC would not find.
pub fn read_tool_table(file: &Path) -> Result<ToolTable, ToolTableError> {
    let bytes = std::fs::read(file).map_err(|source| ToolTableError::Read {
        file: file.to_owned(),
        source,
    })?;
    let mut table = ToolTable::default();
    let mut skipped: Vec<(usize, String)> = Vec::new();
    // The carriage return of CR LF stays, as it does for LinuxCNC.
    for (index, line) in String::from_utf8_lossy(&bytes).split('\n').enumerate() {
        let words = line.split(';').next().unwrap_or("");
        if words.trim().is_empty() {
            continue;
        }
        let number = index + 1;
        let read = match Line::read(words) {
            Ok(read) => read,
            Err(reason) => {
                skipped.push((number, reason));
                continue;
            }
        };
        if let Some(word) = read.odd {
            return Err(ToolTableError::Word {
                file: file.to_owned(),
                line: number,
                word,
            });
        }
        for cut in &read.cut {
            let place = format!("{}:{number}", file.display());
            table.warnings.push(format!("{place}: {cut}"));
        }
        let tool = read.tool().map_err(|problem| ToolTableError::Lost {
            file: file.to_owned(),
            line: number,
            problem,
        })?;
        table
            .tools
            .extend(Some(tool).filter(|tool| tool.number != 0));
        if table.tools.len() > MOST_TOOLS {
            return Err(ToolTableError::Lost {
                file: file.to_owned(),
                line: number,
                problem: "the table has more than 1000 tools",
            });
        }
    }
    table.warnings.extend(warning(file, &skipped));
    Ok(table)
}

/// The lines that LinuxCNC skips: why the first, and which the others are.
fn warning(file: &Path, skipped: &[(usize, String)]) -> Option<String> {
    let ((first, reason), others) = skipped.split_first()?;
    let numbers: Vec<String> = others
        .iter()
        .take(MOST_NAMED)
        .map(|(line, _)| line.to_string())
        .collect();
    let rest = match others.len() {
        0 => String::new(),
        count if count > MOST_NAMED => {
            format!(", and {count} others, as lines {}", numbers.join(", "))
        }
        1 => format!(", and line {}", numbers.join("")),
        _ => format!(", and lines {}", numbers.join(", ")),
    };
    Some(format!(
        "{}:{first}: LinuxCNC skips this line{rest}: {reason}; the tools of these lines are not there",
        file.display()
    ))
}

const BLANKS: &str = "words are parted by blanks; a tab or a carriage return stands among them";

/// LinuxCNC's CANON_POCKETS_MAX, without the spindle.
const MOST_TOOLS: usize = 1000;

/// So many of the lines that are skipped are named.
const MOST_NAMED: usize = 5;

/// The words of a line; what has none is 0.
#[derive(Default)]
struct Line {
    number: Option<i32>,
    pocket: Option<i32>,
    others: Tool,
    /// Words that LinuxCNC reads a part of.
    cut: Vec<String>,
    /// A word whose number is none for a machine.
    odd: Option<String>,
    /// Whether a word is hidden behind a tab or a carriage return in another one.
    hides: bool,
}

impl Line {
    /// `Err` says why LinuxCNC skips the line.
    fn read(words: &str) -> Result<Line, String> {
        let mut line = Line::default();
        for word in words.split(' ').filter(|word| !word.is_empty()) {
            line.take(word)?;
        }
        Ok(line)
    }

    fn tool(&self) -> Result<Tool, &'static str> {
        if self.hides {
            return Err(BLANKS);
        }
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

    fn take(&mut self, word: &str) -> Result<(), String> {
        let unknown = || match word.trim() {
            "" => BLANKS.to_owned(),
            shown if word.starts_with(char::is_whitespace) => format!("{BLANKS}, before `{shown}`"),
            shown => format!(
                "`{shown}` is no word of a tool table: T, P, D, I, J, Q or the letter of an axis, and a number"
            ),
        };
        if is_odd(word) {
            self.odd = Some(word.trim().to_owned());
            return Ok(());
        }
        let mut characters = word.chars();
        let letter = characters.next().unwrap_or(' ').to_ascii_uppercase();
        let is_whole = "TPQ".contains(letter);
        let (number, rest) = leading_number(characters.as_str(), is_whole).ok_or_else(unknown)?;
        match letter {
            'T' => self.number = Some(number as i32),
            'P' => self.pocket = Some(number as i32),
            'Q' => self.others.orientation = number as i32,
            'D' => self.others.diameter = number,
            'I' => self.others.front_angle = number,
            'J' => self.others.back_angle = number,
            _ => {
                let axis = "XYZABCUVW".find(letter).ok_or_else(unknown)?;
                self.others.offset[axis] = number;
            }
        }
        let rest = rest.trim_end();
        if rest.contains(char::is_whitespace) {
            self.hides = true;
        } else if !rest.is_empty() {
            self.cut.push(format!(
                "LinuxCNC reads `{}` as {letter}{number}",
                word.trim_end()
            ));
        }
        Ok(())
    }
}

/// What `sscanf` takes for a number, and is none for a machine: infinity, nothing, and hexadecimal ones.
fn is_odd(word: &str) -> bool {
    let word = word.to_ascii_uppercase();
    let Some(number) = word.strip_prefix(|letter| "DIJXYZABCUVW".contains(letter)) else {
        return false;
    };
    let number = number.trim_start_matches(['+', '-']);
    ["INF", "NAN", "0X"]
        .iter()
        .any(|odd| number.starts_with(odd))
}

/// The number that a text begins with, as `sscanf` takes it, and what stands behind it.
fn leading_number(text: &str, is_whole: bool) -> Option<(f64, &str)> {
    let text = text.trim_start();
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let sign = usize::from(text.starts_with(['+', '-']));
    let mut end = sign + digits(sign);
    let mut count = end - sign;
    if !is_whole && text[end..].starts_with('.') {
        let places = digits(end + 1);
        count += places;
        end += 1 + places;
    }
    if count == 0 {
        return None;
    }
    if !is_whole && text[end..].starts_with(['e', 'E']) {
        let signed = end + 1 + usize::from(text[end + 1..].starts_with(['+', '-']));
        let power = digits(signed);
        if power > 0 {
            end = signed + power;
        }
    }
    let number: f64 = text[..end].parse().ok()?;
    number.is_finite().then_some((number, &text[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_comments() {
        let line = Line::read("T3 P7 z+12.5 D.5 Q2 W-1 A1e1").expect("a line");
        let tool = line.tool().expect("a tool");
        assert_eq!((tool.number, tool.pocket, tool.orientation), (3, 7, 2));
        let offset = [2, 3, 8].map(|axis| tool.offset[axis]);
        assert_eq!((offset, tool.diameter), ([12.5, 10.0, -1.0], 0.5));
        assert!(line.cut.is_empty());
        for word in ["T", "K1", "Zx", "Z.", "TOOLNO", "1", "+0.5", "Anandamide K"] {
            assert!(Line::read(word).is_err(), "{word}");
        }
    }

    fn read(text: &str) -> Result<ToolTable, String> {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("tools.tbl");
        std::fs::write(&file, text).expect("written");
        let start = format!("{}:", file.display());
        let named = |said: String| said.strip_prefix(&start).expect("the file").to_owned();
        let table = read_tool_table(&file).map_err(|error| named(error.to_string()))?;
        let warnings = table.warnings.into_iter().map(named).collect();
        Ok(ToolTable { warnings, ..table })
    }

    fn numbers(table: &ToolTable) -> Vec<i32> {
        table.tools.iter().map(|tool| tool.number).collect()
    }

    #[test]
    fn lines_without_a_tool_are_passed_over() {
        let table = read(";head\n\n  \n\t; c\nT0 P0 Z9 ;no tool\nT5 P0 Z1\t; c\r\nT6 P1\r\n\r\n");
        let table = table.expect("tools");
        assert_eq!((numbers(&table), table.warnings), (vec![5, 6], Vec::new()));
    }

    /// LinuxCNC's libtooldata 2.9 prints `Unrecognized line skipped` for these, and has the tools of the others.
    #[test]
    fn lines_that_linuxcnc_skips_are_told() {
        let columns = "TOOLNO POCKET       LENGTH    DIAMETER  COMMENT\n\n     1      1    +0.511000    0.125000  1/8 end mill\n";
        let table = read(&format!("{columns}T2 P2 Z1\n")).expect("tools");
        assert_eq!(numbers(&table), [2]);
        let word =
            "is no word of a tool table: T, P, D, I, J, Q or the letter of an axis, and a number";
        let gone = "the tools of these lines are not there";
        assert_eq!(
            table.warnings,
            [format!(
                "1: LinuxCNC skips this line, and line 3: `TOOLNO` {word}; {gone}"
            )]
        );
        for (line, reason) in [
            ("T3 P3 Z5 \t; two blanks", BLANKS.to_owned()),
            ("\tT3 P3", format!("{BLANKS}, before `T3`")),
            ("T3 P3 \r", BLANKS.to_owned()),
            ("T3 P3 Zx", format!("`Zx` {word}")),
        ] {
            let table = read(&format!("T1 P1\n{line}\n")).expect("tools");
            assert_eq!(numbers(&table), [1], "{line}");
            assert_eq!(
                table.warnings,
                [format!("2: LinuxCNC skips this line: {reason}; {gone}")]
            );
        }
        let many = read(&"1 1 0\n".repeat(9)).expect("no tools");
        assert!(
            many.warnings[0].contains(
                "1: LinuxCNC skips this line, and 8 others, as lines 2, 3, 4, 5, 6: `1` "
            )
        );
    }

    #[test]
    fn words_that_linuxcnc_reads_in_part_are_told() {
        let table = read("T1 P1 Z1,5 D2mm\nT2.5 P2\n").expect("tools");
        assert_eq!(
            (table.tools[0].offset[2], table.tools[0].diameter),
            (1.0, 2.0)
        );
        let said = [
            "1: LinuxCNC reads `Z1,5` as Z1",
            "1: LinuxCNC reads `D2mm` as D2",
            "2: LinuxCNC reads `T2.5` as T2",
        ];
        assert_eq!(table.warnings, said);
    }

    #[test]
    fn numbers_that_no_machine_can_use_are_refused() {
        for word in ["Znan", "Z-inf", "D0x10"] {
            let refused = read(&format!("T1 P1 {word}\n")).expect_err(word);
            let start = format!("1: `{word}` is no word of a tool table");
            assert!(refused.starts_with(&start), "{refused}");
        }
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
        ] {
            let refused = read(&format!("T1 P1\n{line}\n")).expect_err(line);
            assert_eq!(
                refused,
                format!("2: LinuxCNC does not find this tool: {problem}")
            );
        }
        let many =
            |count: usize| -> String { (1..=count).map(|t| format!("T{t} P{t}\n")).collect() };
        assert_eq!(read(&many(1000)).expect("tools").tools.len(), 1000);
        let refused = read(&many(1001)).expect_err("too many");
        assert!(refused.starts_with("1001: "), "{refused}");
    }
}
