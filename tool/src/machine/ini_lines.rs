//! The lines of an INI file as LinuxCNC's own reader cuts them: they end with a line feed, a backslash before it joins a line with the
//! next one, and a carriage return stands nowhere but at the end. Its blanks are those of ASCII.

use super::error::IniError;
use super::place::Place;
use std::path::Path;
use std::sync::Arc;

/// What LinuxCNC passes over around a key and its value; another blank is a letter to it.
pub(super) const BLANKS: [char; 4] = [' ', '\t', '\r', '\n'];

/// How many lines LinuxCNC joins with one, at most.
const MOST_JOINED: usize = 20;

/// A line of a file.
pub(super) struct Line {
    /// The place of its first character.
    pub place: Place,
    /// With its line feed, where it has one.
    pub text: String,
}

/// The lines of a file that is read as it stands.
pub(super) fn of_file(file: &Arc<Path>, text: &str) -> Vec<Line> {
    let numbered = text.split_inclusive('\n').enumerate();
    let line = |(index, text): (usize, &str)| Line {
        place: Place::new(file, index + 1, 1),
        text: text.to_owned(),
    };
    numbered.map(line).collect()
}

/// The lines with those joined that continue another one, without their ends, and what LinuxCNC does not read in them.
pub(super) fn joined(lines: &[Line]) -> (Vec<Line>, Vec<IniError>) {
    let mut joined: Vec<Line> = Vec::new();
    let mut problems = Vec::new();
    // How many lines the last one has been joined of, while it goes on.
    let mut count = 0;
    for line in lines {
        if has_lone_return(&line.text) {
            problems.push(refused(
                &line.place,
                "LinuxCNC refuses the file: a carriage return stands elsewhere than at the end of a line",
                "write lines that end in a line feed alone, as dos2unix does",
            ));
            return (joined, problems);
        }
        let content = line.text.strip_suffix('\n');
        let goes_on = content.and_then(|content| content.strip_suffix('\\'));
        let text = goes_on.or(content).unwrap_or(&line.text);
        match joined.last_mut().filter(|_| count > 0) {
            Some(begun) => begun.text.push_str(text),
            None => joined.push(Line {
                place: line.place.clone(),
                text: text.to_owned(),
            }),
        }
        if count > 0 && content.is_none() {
            let problem = "LinuxCNC loses the last character of this line, which continues another one and has no line feed";
            problems.push(refused(&line.place, problem, "end it with a line feed"));
        }
        count = if goes_on.is_some() { count + 1 } else { 0 };
        if count > MOST_JOINED {
            let problem = format!(
                "LinuxCNC joins no more than {MOST_JOINED} lines with one, and reads nothing behind"
            );
            problems.push(refused(&line.place, &problem, "write longer lines"));
            return (joined, problems);
        }
    }
    (joined, problems)
}

/// Whether it has a carriage return anywhere but at its end.
fn has_lone_return(line: &str) -> bool {
    let content = line.strip_suffix('\n').unwrap_or(line);
    content.strip_suffix('\r').unwrap_or(content).contains('\r')
}

/// The error for a line of a file that LinuxCNC does not read as anybody means it.
pub(super) fn refused(place: &Place, problem: &str, remedy: &str) -> IniError {
    IniError::Refused {
        file: place.file.to_path_buf(),
        line: place.line,
        problem: problem.to_owned(),
        remedy: remedy.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::ini::Ini;
    use std::path::Path;

    fn read(text: &str) -> (Option<String>, Vec<String>) {
        let (ini, problems) = Ini::parse_all(Path::new("mill.ini"), text);
        let value = ini.entry("A", "X").map(|entry| entry.raw.clone());
        (value, problems.iter().map(ToString::to_string).collect())
    }

    /// As the program `inivar` of LinuxCNC 2.9 answers.
    #[test]
    fn lines_are_read_as_linuxcnc_reads_them() {
        for (text, value) in [
            ("[A]\nX Y = 5\n", Some("5")),
            ("[A]\nXY = 4\nX\t=\t5\n", Some("5")),
            ("[A]\nX = 1\\ \n00\n", Some("1\\")),
            ("[A]\nX = 1\\\n00\n", Some("100")),
            ("[A]\r\nX = 5\\\r\n6\r\n", Some("5\\")),
            ("[A]\n\u{a0}X = 5\n", None),
            ("[A]\n\u{b}X = 5\n", None),
            ("[A]\nX 5\nX = 6\n", Some("")),
        ] {
            assert_eq!(read(text).0.as_deref(), value, "{text:?}");
        }
    }

    #[test]
    fn what_linuxcnc_does_not_read_is_refused() {
        let long = format!("[A]\nY = {}\nX = 5\n", "1\\\n".repeat(21));
        for (text, line) in [
            ("[A]\nY = a\rb\nX = 5\n", 2),
            ("[A]\nX = 5\r\r\n", 2),
            ("[A]\nX = \\\n100", 3),
            (long.as_str(), 22),
        ] {
            let problems = read(text).1;
            let place = format!("mill.ini:{line}: LinuxCNC ");
            assert!(
                problems.len() == 1 && problems[0].starts_with(&place),
                "{text:?}: {problems:?}"
            );
        }
        assert!(read("[A]\r\nX = 5\r\nY = 1\\\n2\n").1.is_empty());
    }
}
