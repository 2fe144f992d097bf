//! `#INCLUDE FILE` in INI files, which the script `linuxcnc` replaces by the file before anything reads it.

use super::error::IniError;
use super::ini_lines::{self, BLANKS, Line, refused};
use super::place::Place;
use super::text_file;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What the line begins with.
const WORD: &str = "#INCLUDE";

/// The lines of a file with those of the files that it includes, as the script writes them into `NAME.ini.expanded`.
pub(super) struct Expansion {
    pub lines: Vec<Line>,
    pub problems: Vec<IniError>,
}

/// Puts in the files that `text` includes; `None` where LinuxCNC reads it as it stands: no line begins with `#INCLUDE`.
///
/// The script reads each line with the shell's `read`, which cuts it into two words, joins lines at a backslash, takes other
/// backslashes away, and leaves out a last line without a line feed. Included files are copied as they are.
pub(super) fn expand(file: &Arc<Path>, text: &str) -> Option<Expansion> {
    if !text.split('\n').any(|line| line.starts_with(WORD)) {
        return None;
    }
    let mut expansion = Expansion {
        lines: Vec::new(),
        problems: Vec::new(),
    };
    for line in shell_lines(file, text) {
        if !line.ends {
            expansion.leave_out(&line);
        } else if line.first == WORD {
            expansion.include(file, &line);
        } else {
            expansion.lines.push(line.written());
        }
    }
    Some(expansion)
}

impl Expansion {
    /// A last line without a line feed.
    fn leave_out(&mut self, line: &ShellLine) {
        let is_comment = line.first.starts_with(['#', ';']) && line.first != WORD;
        if !line.first.is_empty() && !is_comment {
            let problem = "it is the last one, has no line feed behind it, and the file has #INCLUDE: end it with a line feed";
            self.passed_over(&line.place, problem.to_owned());
        }
    }

    fn include(&mut self, ini: &Path, line: &ShellLine) {
        let name = line.rest.as_str();
        match read(ini, name) {
            Ok((path, text)) => self.copy(&line.place, &Arc::from(path), &text),
            Err(NotIncluded::Missing(problem)) => {
                self.passed_over(&line.place, format!("#INCLUDE {name}: {problem}"));
                let text = format!("# {WORD} {name}\n");
                let place = line.place.clone();
                self.lines.push(Line { place, text });
            }
            Err(NotIncluded::NotExpanded(problem)) => self.problems.push(IniError::Unread {
                file: line.place.file.to_path_buf(),
                line: line.place.line,
                problem: format!("#INCLUDE {name}: {problem}"),
            }),
        }
    }

    /// The script writes comments before and behind the file; the second one gets into a last line that does not end.
    fn copy(&mut self, place: &Place, file: &Arc<Path>, text: &str) {
        let mut lines = ini_lines::of_file(file, text);
        for line in lines.iter_mut().filter(|line| is_include(&line.text)) {
            let problem = "#INCLUDE in a file that is included itself is a comment for LinuxCNC: put it into the first file";
            self.passed_over(&line.place, problem.to_owned());
            // Nor is it to include a file where `configure` writes the lines into an INI file.
            line.text.insert_str(0, "# ");
        }
        let comment = |word| Line {
            place: place.clone(),
            text: format!("#*** {word} #INCLUDE file: {}\n", file.display()),
        };
        self.lines.push(comment("Begin"));
        let end = comment("End  ");
        match lines.last_mut().filter(|last| !last.text.ends_with('\n')) {
            Some(last) => {
                let content = last.text.trim_start_matches(BLANKS);
                if content.contains('=') && !content.starts_with(['#', ';', '[']) {
                    let problem = "LinuxCNC reads `#*** End` behind this value: the included file does not end with a line feed";
                    let remedy = "end its last line with a line feed";
                    self.problems.push(refused(&last.place, problem, remedy));
                }
                last.text.push_str(&end.text);
            }
            None => lines.push(end),
        }
        self.lines.append(&mut lines);
    }

    fn passed_over(&mut self, place: &Place, problem: String) {
        self.problems.push(IniError::Line {
            file: place.file.to_path_buf(),
            line: place.line,
            problem,
        });
    }
}

/// Whether a line is meant to include a file.
pub(super) fn is_include(line: &str) -> bool {
    let rest = line.trim_start_matches(BLANKS).strip_prefix(WORD);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(BLANKS))
}

/// A line as the shell's `read` cuts it into two words.
struct ShellLine {
    /// The place of the first word.
    place: Place,
    first: String,
    rest: String,
    /// Whether it has a line feed.
    ends: bool,
}

impl ShellLine {
    /// As the script writes it, without the blank that it ends a single word with, unless that keeps a backslash or a carriage return from
    /// the end.
    fn written(self) -> Line {
        let separator = match self.rest.is_empty() && !self.first.ends_with(['\\', '\r']) {
            true => "",
            false => " ",
        };
        Line {
            place: self.place,
            text: format!("{}{separator}{}\n", self.first, self.rest),
        }
    }
}

fn shell_lines(file: &Arc<Path>, text: &str) -> Vec<ShellLine> {
    let mut lines = Vec::new();
    let mut characters = text.chars().peekable();
    let mut number = 1;
    while characters.peek().is_some() {
        let start = number;
        // What stands behind a backslash separates no words.
        let mut line: Vec<(char, bool)> = Vec::new();
        let mut ends = false;
        while let Some(character) = characters.next() {
            match character {
                '\n' => ends = true,
                '\\' => match characters.next() {
                    Some('\n') => number += 1,
                    Some(escaped) => line.push((escaped, false)),
                    None => {}
                },
                plain => line.push((plain, matches!(plain, ' ' | '\t'))),
            }
            if ends {
                number += 1;
                break;
            }
        }
        lines.push(cut(file, start, &line, ends));
    }
    lines
}

/// The words of a line of characters, with whether each is a blank between words.
fn cut(file: &Arc<Path>, number: usize, line: &[(char, bool)], ends: bool) -> ShellLine {
    let is_blank = |(_, blank): &(char, bool)| *blank;
    let text = |part: &[(char, bool)]| part.iter().map(|(c, _)| c).collect::<String>();
    let indent = line.iter().take_while(|c| is_blank(c)).count();
    let length = line.len() - line.iter().rev().take_while(|c| is_blank(c)).count();
    let words = line.get(indent..length).unwrap_or_default();
    let first = words.iter().take_while(|c| !is_blank(c)).count();
    let between = words[first..].iter().take_while(|c| is_blank(c)).count();
    ShellLine {
        place: Place::new(file, number, indent + 1),
        first: text(&words[..first]),
        rest: text(&words[first + between..]),
        ends,
    }
}

/// Why a file is not there.
enum NotIncluded {
    /// For LinuxCNC neither.
    Missing(String),
    /// LinuxCNC may well read it.
    NotExpanded(String),
}

/// The file that `name` stands for in the INI file `ini`, and its text.
fn read(ini: &Path, name: &str) -> Result<(PathBuf, String), NotIncluded> {
    let name = name
        .split(" #")
        .next()
        .unwrap_or("")
        .trim_matches([' ', '\t']);
    if name.ends_with('\r') {
        let problem = "a carriage return ends the name: write lines that end in a line feed, as dos2unix does";
        return Err(NotIncluded::Missing(problem.to_owned()));
    }
    let name = name.trim_matches(['"', '\'']);
    if name.is_empty() {
        let problem = "the name of a file is missing";
        return Err(NotIncluded::Missing(problem.to_owned()));
    }
    let path = expanded(name).map_err(NotIncluded::NotExpanded)?;
    let path = ini.parent().unwrap_or(Path::new("")).join(path);
    match text_file::read(&path) {
        Ok(text) => Ok((path, text)),
        Err(error) => {
            let problem = format!("{} cannot be read: {error}", path.display());
            Err(NotIncluded::Missing(problem))
        }
    }
}

/// The shell reads the name. Variables and the home folder are put in here, nothing is run.
fn expanded(name: &str) -> Result<String, String> {
    let name = match name.strip_prefix("~/") {
        Some(rest) => format!("$HOME/{rest}"),
        None => name.to_owned(),
    };
    let mut text = String::new();
    let mut parts = name.split('$');
    text.push_str(parts.next().unwrap_or(""));
    for part in parts {
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let (variable, rest) = match part.strip_prefix('{').and_then(|part| part.split_once('}')) {
            Some(pair) => pair,
            None => part.split_at(part.find(|c| !is_part(c)).unwrap_or(part.len())),
        };
        let value = std::env::var(variable)
            .map_err(|_| format!("the variable {variable} of the environment is not set here"))?;
        text.push_str(&value);
        text.push_str(rest);
    }
    match text.find(['`', '(', ')', '*', '?', ';', '|', '&', '<', '>', '\0']) {
        Some(_) => {
            Err("this is run by a shell and not read here: write the name itself".to_owned())
        }
        None => Ok(text),
    }
}

#[cfg(test)]
mod tests {
    use super::super::ini::Ini;

    /// The value of `[A]X`, what is said, and the expanded text.
    fn read(text: &str, included: &str) -> (Option<String>, String, Option<String>) {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("x.inc"), included).expect("written");
        let (ini, problems) = Ini::parse_all(&folder.path().join("mill.ini"), text);
        let said: Vec<String> = problems.iter().map(ToString::to_string).collect();
        let value = ini.entry("A", "X").map(|entry| entry.raw.clone());
        (value, said.join("\n"), ini.expanded().map(str::to_owned))
    }

    /// As the script `linuxcnc` of 2.9 expands them.
    #[test]
    fn files_are_included_as_the_script_includes_them() {
        let included = "[A]\nX = 5\n";
        for (text, value, words) in [
            ("#INCLUDE x.inc\n", Some("5"), ""),
            ("#INCLUDE x.inc\n  #INCLUDE x.inc\n", Some("5"), ""),
            ("  #INCLUDE x.inc\n", None, "indented #INCLUDE"),
            ("[B]\n#INCLUDE x.inc", None, "has no line feed behind it"),
            (
                "#INCLUDE x.inc\r\n",
                None,
                "a carriage return ends the name",
            ),
            ("[B]\r\n#INCLUDE x.inc\n", None, "LinuxCNC refuses the file"),
            ("[A]\nX = a\\b  c \n#INCLUDE x.inc\n", Some("ab  c"), ""),
            ("[A]\nX = 1\\\n2\n#INCLUDE x.inc\n", Some("12"), ""),
        ] {
            let (found, said, _) = read(text, included);
            assert_eq!(found.as_deref(), value, "{text:?}: {said}");
            assert!(
                said.contains(words) && said.is_empty() == words.is_empty(),
                "{text:?}: {said}"
            );
        }
        let (value, said, _) = read("#INCLUDE x.inc\n", "[A]\nX = 5");
        assert!(value.is_some_and(|value| value.starts_with("5#*** End")));
        assert!(
            said.contains("x.inc:2: LinuxCNC reads `#*** End`"),
            "{said}"
        );
    }

    #[test]
    fn the_expanded_text_is_that_of_all_files() {
        let (_, _, expanded) = read("[B]\n#INCLUDE x.inc\nY = 6\n", "[A]\nX = 5\n");
        let expanded = expanded.expect("a file is included");
        assert!(
            expanded.starts_with("[B]\n#*** Begin #INCLUDE file: "),
            "{expanded}"
        );
        assert!(
            expanded.contains("x.inc\n[A]\nX = 5\n#*** End") && expanded.ends_with("Y = 6\n"),
            "{expanded}"
        );
        assert_eq!(read("[A]\n", "").2, None);
    }
}
