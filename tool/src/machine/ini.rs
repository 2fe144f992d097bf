//! Reads LinuxCNC's INI files: `[SECTION]`, `KEY = value`, comments from `#` or `;`, `#INCLUDE FILE`.
//!
//! The general INI crates treat a backslash or a repeated key differently from LinuxCNC, where
//! `HALFILE` may come many times, the first of several equal keys counts, and so does the first of
//! several equal sections.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::error::IniError;
use super::include;
use super::ini_lines::{self, BLANKS};
use super::numbers::{self, Form};
use super::place::Place;
use super::text_file;

/// One `KEY = value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Where it stands.
    pub section: String,
    /// Left of the equal sign.
    pub key: String,
    /// Right of it, without a comment behind it.
    pub value: String,
    /// The same as HAL files and LinuxCNC's programs get it: with the comment.
    pub raw: String,
    /// The place of the key.
    pub place: Place,
    /// Whether LinuxCNC reads it: not in the second section of the same name.
    pub is_read: bool,
}

/// One `[SECTION]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Heading {
    /// What stands between the brackets.
    pub name: String,
    /// The place of the bracket.
    pub place: Place,
    /// The place of the first section of this name, if this is another one: then LinuxCNC does not read this one.
    pub first: Option<Place>,
}

/// The content of an INI file and of those that it includes, in the order in which LinuxCNC reads them.
#[derive(Debug)]
pub struct Ini {
    file: PathBuf,
    entries: Vec<Entry>,
    headings: Vec<Heading>,
    passed_over: Vec<String>,
    expanded: Option<String>,
}

impl Ini {
    /// Reads a file as LinuxCNC does: [`Ini::passed_over`] has the lines that are nothing to it.
    ///
    /// # Errors
    /// [`IniError::Read`], [`IniError::Unread`] and [`IniError::Refused`].
    pub fn read(file: &Path) -> Result<Ini, IniError> {
        let (mut ini, problems) = Ini::read_all(file)?;
        for problem in problems {
            match problem {
                IniError::Line { .. } => ini
                    .passed_over
                    .push(format!("{problem}: LinuxCNC passes over this line")),
                unread => return Err(unread),
            }
        }
        Ok(ini)
    }

    /// Reads `text`; `file` is its name in messages, and its folder that of the files that it includes.
    ///
    /// # Errors
    /// [`IniError::Line`] for a line that is no section, no key and no comment, for a key
    /// before the first section, and for an `#INCLUDE` of what cannot be read.
    #[cfg(test)]
    pub fn parse(file: &Path, text: &str) -> Result<Ini, IniError> {
        let (ini, problems) = Ini::parse_all(file, text);
        problems.into_iter().next().map_or(Ok(ini), Err)
    }

    /// Reads a file as LinuxCNC does, which passes over lines that are nothing; these are told beside it.
    ///
    /// # Errors
    /// [`IniError::Read`].
    pub fn read_all(file: &Path) -> Result<(Ini, Vec<IniError>), IniError> {
        let text = text_file::read(file).map_err(|source| IniError::Read {
            file: file.to_owned(),
            source,
        })?;
        Ok(Ini::parse_all(file, &text))
    }

    /// The same with a text; see [`Ini::parse`].
    pub fn parse_all(file: &Path, text: &str) -> (Ini, Vec<IniError>) {
        let mut reader = Reader {
            ini: Ini {
                file: file.to_owned(),
                entries: Vec::new(),
                headings: Vec::new(),
                passed_over: Vec::new(),
                expanded: None,
            },
            problems: Vec::new(),
            section: None,
        };
        reader.take(&Arc::from(file), text);
        (reader.ini, reader.problems)
    }

    /// The file itself.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The lines that LinuxCNC passes over: for the user to be told.
    pub fn passed_over(&self) -> &[String] {
        &self.passed_over
    }

    /// The text with that of the files that it includes, which LinuxCNC's programs get in place of the file; `None` if it includes
    /// none, and they get the file itself.
    pub fn expanded(&self) -> Option<&str> {
        self.expanded.as_deref()
    }

    /// All keys, also those that LinuxCNC does not read.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// All sections, also those that LinuxCNC does not read.
    pub fn headings(&self) -> &[Heading] {
        &self.headings
    }

    /// The keys of this name that LinuxCNC reads, in their order.
    pub fn all(&self, section: &str, key: &str) -> Vec<&Entry> {
        let named = |entry: &&Entry| entry.is_read && entry.section == section && entry.key == key;
        self.entries.iter().filter(named).collect()
    }

    /// The key that counts.
    pub fn entry(&self, section: &str, key: &str) -> Option<&Entry> {
        self.entries
            .iter()
            .find(|entry| entry.is_read && entry.section == section && entry.key == key)
    }

    /// Whether the section has at least one key.
    pub fn has_section(&self, section: &str) -> bool {
        let named = |entry: &Entry| entry.is_read && entry.section == section;
        self.entries.iter().any(named)
    }

    /// The text of a key, if it is there.
    pub fn text(&self, section: &str, key: &str) -> Option<&str> {
        self.entry(section, key).map(|entry| entry.value.as_str())
    }

    /// The text of a key.
    ///
    /// # Errors
    /// [`IniError::Missing`] with `remedy` if it is not there.
    pub fn required_text(&self, section: &str, key: &str, remedy: &str) -> Result<&str, IniError> {
        self.text(section, key)
            .ok_or_else(|| self.missing(section, key, remedy))
    }

    /// The number of a key, if the key is there: finite, unit as in the file.
    ///
    /// # Errors
    /// [`IniError::Value`] if it is no finite number.
    pub fn number(&self, section: &str, key: &str) -> Result<Option<f64>, IniError> {
        match self.limit(section, key)? {
            Some(number) if number.is_infinite() => Err(self.no_number(section, key)),
            number => Ok(number),
        }
    }

    /// The number of a key that is a limit, if the key is there; LinuxCNC takes `inf` for one.
    fn limit(&self, section: &str, key: &str) -> Result<Option<f64>, IniError> {
        let Some(entry) = self.entry(section, key) else {
            return Ok(None);
        };
        match numbers::number(entry) {
            Some(number) if !number.is_nan() => Ok(Some(number)),
            _ => Err(self.no_number(section, key)),
        }
    }

    fn no_number(&self, section: &str, key: &str) -> IniError {
        let problem = match numbers::form(section, key) {
            Form::Other => "a number is needed here, for example 100.0",
            Form::Number => {
                "LinuxCNC needs a number alone here, for example 100.5, none above 1.8e308, and no comment in this line"
            }
            Form::Whole => {
                "LinuxCNC needs a whole number alone here, without a point, and no comment in this line"
            }
            Form::OfModule => {
                "LinuxCNC needs a whole number of nanoseconds alone here, and no comment in this line"
            }
        };
        self.bad_value(section, key, problem)
    }

    /// The number of a key, above 0; it may be infinite.
    ///
    /// # Errors
    /// [`IniError::Missing`] with `remedy`, or [`IniError::Value`].
    pub fn required_positive(
        &self,
        section: &str,
        key: &str,
        remedy: &str,
    ) -> Result<f64, IniError> {
        let number = self
            .limit(section, key)?
            .ok_or_else(|| self.missing(section, key, remedy))?;
        if number > 0.0 {
            Ok(number)
        } else {
            Err(self.bad_value(section, key, "this has to be above 0"))
        }
    }

    /// The number of a key that may be missing; 0, `inf` and missing all mean "not limited".
    ///
    /// # Errors
    /// [`IniError::Value`] if it is no number or below 0.
    pub fn optional_limit(&self, section: &str, key: &str) -> Result<Option<f64>, IniError> {
        match self.limit(section, key)? {
            Some(number) if number < 0.0 => {
                Err(self.bad_value(section, key, "a limit is not negative; 0 means not limited"))
            }
            Some(number) if number > 0.0 && number.is_finite() => Ok(Some(number)),
            _ => Ok(None),
        }
    }

    /// The greatest speed along the path, `[TRAJ]MAX_LINEAR_VELOCITY`; missing means "not limited".
    ///
    /// # Errors
    /// [`IniError::Value`] if it is no number above 0: LinuxCNC moves nothing with 0.
    #[cfg(feature = "linuxcnc")]
    pub fn path_velocity(&self) -> Result<Option<f64>, IniError> {
        let (section, key) = ("TRAJ", "MAX_LINEAR_VELOCITY");
        match self.limit(section, key)? {
            Some(number) if number <= 0.0 => {
                let problem = "nothing moves with it; leave the line out where the axes alone limit the speed";
                Err(self.bad_value(section, key, problem))
            }
            other => Ok(other.filter(|number| number.is_finite())),
        }
    }

    /// The error for a key that is not there.
    pub fn missing(&self, section: &str, key: &str, remedy: &str) -> IniError {
        IniError::Missing {
            file: self.file.clone(),
            entry: format!("[{section}]{key}"),
            remedy: remedy.to_owned(),
        }
    }

    /// The error for a key whose value cannot be used.
    pub fn bad_value(&self, section: &str, key: &str, problem: &str) -> IniError {
        let entry = self.entry(section, key);
        // Of a number the comment behind it may be what is wrong.
        let value = match (entry, numbers::form(section, key)) {
            (None, _) => "",
            (Some(entry), Form::Other) => entry.value.as_str(),
            (Some(entry), _) => entry.raw.as_str(),
        };
        IniError::Value {
            file: entry.map_or(self.file.clone(), |entry| entry.place.file.to_path_buf()),
            line: entry.map_or(0, |entry| entry.place.line),
            entry: format!("[{section}]{key} = {value}"),
            problem: problem.to_owned(),
        }
    }
}

/// What is read so far.
struct Reader {
    ini: Ini,
    problems: Vec<IniError>,
    /// The section, and whether LinuxCNC reads it.
    section: Option<(String, bool)>,
}

impl Reader {
    fn take(&mut self, file: &Arc<Path>, text: &str) {
        let lines = match include::expand(file, text) {
            Some(expansion) => {
                self.problems.extend(expansion.problems);
                let texts = expansion.lines.iter().map(|line| line.text.as_str());
                self.ini.expanded = Some(texts.collect());
                expansion.lines
            }
            None => {
                let lines = ini_lines::of_file(file, text);
                for line in lines.iter().filter(|line| include::is_include(&line.text)) {
                    self.refuse(
                        &line.place,
                        "an indented #INCLUDE is a comment where no other begins its line: remove the blanks before it",
                    );
                }
                lines
            }
        };
        let (lines, problems) = ini_lines::joined(&lines);
        self.problems.extend(problems);
        for mut line in lines {
            let content = line.text.trim_start_matches(BLANKS);
            let indent = line.text[..line.text.len() - content.len()].chars().count();
            line.place.column += indent;
            let content = content.trim_end_matches(BLANKS);
            if !content.is_empty() && !content.starts_with(['#', ';']) {
                self.take_line(line.place, content);
            }
        }
    }

    fn take_line(&mut self, place: Place, content: &str) {
        if let Some(rest) = content.strip_prefix('[') {
            let Some((name, _)) = rest.split_once(']') else {
                return self.refuse(&place, &format!("the bracket of `{content}` is not closed"));
            };
            return self.begin_section(place, name);
        }
        // A key ends at the first blank, whatever stands before the equal sign; without one LinuxCNC ends its search here.
        let key = content.split(BLANKS).next().unwrap_or("");
        let key = key.split('=').next().unwrap_or("");
        let (_, value) = content.split_once('=').unwrap_or_else(|| {
            let problem =
                format!("`{content}` is neither a [SECTION] nor KEY = value nor a comment");
            self.refuse(&place, &problem);
            ("", "")
        });
        let Some((section, is_read)) = self.section.clone() else {
            if content.contains('=') {
                let problem = format!("`{key}` stands before the first [SECTION]");
                self.refuse(&place, &problem);
            }
            return;
        };
        self.ini.entries.push(Entry {
            section,
            key: key.to_owned(),
            value: without_comment(value).to_owned(),
            raw: value.trim_matches(BLANKS).to_owned(),
            place,
            is_read,
        });
    }

    fn begin_section(&mut self, place: Place, name: &str) {
        let headings = &mut self.ini.headings;
        let first = headings.iter().find(|heading| heading.name == name);
        let first = first.map(|heading| heading.place.clone());
        self.section = Some((name.to_owned(), first.is_none()));
        headings.push(Heading {
            name: name.to_owned(),
            place,
            first,
        });
    }

    fn refuse(&mut self, place: &Place, problem: &str) {
        self.problems.push(IniError::Line {
            file: place.file.to_path_buf(),
            line: place.line,
            problem: problem.to_owned(),
        });
    }
}

/// The value without the blanks around it and without a comment after it.
///
/// A comment has to be set off by a blank, since `#` and `;` occur inside values.
fn without_comment(value: &str) -> &str {
    let end = value
        .char_indices()
        .zip(value.chars().skip(1))
        .find(|((_, before), mark)| BLANKS.contains(before) && matches!(mark, '#' | ';'))
        .map_or(value.len(), |((index, _), _)| index);
    value[..end].trim_matches(BLANKS)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Ini, IniError> {
        Ini::parse(Path::new("mill.ini"), text)
    }

    #[test]
    fn reads_sections_comments_continuations_and_the_first_of_equal_keys() {
        let ini = parse(
            "# mill\n[HAL]\nHALFILE = a.hal\nHALFILE=b.hal\n[AXIS_X] ; comment\r\n\
             MAX_VELOCITY = 100.5 # mm/s\r\nMAX_JERK=0\n[KINS]\nKINEMATICS = framekins \\\n  coordinates=XYZ\n",
        )
        .expect("a valid file");
        assert_eq!(ini.text("HAL", "HALFILE"), Some("a.hal"));
        assert_eq!(ini.text("AXIS_X", "MAX_VELOCITY"), Some("100.5"));
        assert_eq!(
            ini.optional_limit("AXIS_X", "MAX_JERK").expect("a limit"),
            None
        );
        let kinematics = ini.text("KINS", "KINEMATICS").expect("there");
        assert!(
            kinematics
                .split_whitespace()
                .eq(["framekins", "coordinates=XYZ"])
        );
        assert!(ini.has_section("KINS") && !ini.has_section("AXIS_Y"));
    }

    #[test]
    fn errors_name_file_line_section_key_and_remedy() {
        let text = |result: Result<Ini, IniError>| result.expect_err("an error").to_string();
        assert!(text(parse("[A]\n#INCLUDE x.inc\n")).starts_with("mill.ini:2: #INCLUDE"));
        assert!(text(parse("[A]\nrubbish\n")).starts_with("mill.ini:2: `rubbish`"));
        assert!(text(parse("[A\n")).starts_with("mill.ini:1: the bracket"));
        assert!(text(parse("X = 1\n")).contains("before the first"));

        let ini = parse("[JOINT_0]\nMAX_VELOCITY = fast\nMAX_JERK = -1\nMAX_ACCELERATION = 0\n")
            .expect("a valid file");
        let message = ini
            .required_positive("JOINT_0", "MAX_VELOCITY", "add it")
            .expect_err("no number")
            .to_string();
        assert!(
            message.starts_with("mill.ini:2: [JOINT_0]MAX_VELOCITY = fast:"),
            "{message}"
        );
        let message = ini
            .required_positive("JOINT_1", "MAX_VELOCITY", "add it")
            .expect_err("missing")
            .to_string();
        assert_eq!(
            message,
            "mill.ini: [JOINT_1]MAX_VELOCITY is missing: add it"
        );
        assert!(ini.optional_limit("JOINT_0", "MAX_JERK").is_err());
        assert!(
            ini.required_positive("JOINT_0", "MAX_ACCELERATION", "")
                .is_err()
        );
    }
}
