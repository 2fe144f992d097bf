//! Reads LinuxCNC's INI files: `[SECTION]`, `KEY = value`, comments from `#` or `;`.
//!
//! The general INI crates treat a backslash or a repeated key differently from LinuxCNC, where
//! `HALFILE` may come many times and the first of several equal keys counts.

use std::path::{Path, PathBuf};

use super::error::IniError;

/// One `KEY = value`.
#[derive(Debug, PartialEq)]
struct Entry {
    section: String,
    key: String,
    value: String,
    line: usize,
}

/// The content of an INI file, in the order of the file.
#[derive(Debug)]
pub struct Ini {
    file: PathBuf,
    entries: Vec<Entry>,
}

impl Ini {
    /// Reads a file.
    ///
    /// # Errors
    /// [`IniError::Read`] or the errors of [`Ini::parse`].
    pub fn read(file: &Path) -> Result<Ini, IniError> {
        let bytes = std::fs::read(file).map_err(|source| IniError::Read {
            file: file.to_owned(),
            source,
        })?;
        Ini::parse(file, &String::from_utf8_lossy(&bytes))
    }

    /// Reads `text`; `file` is its name in messages.
    ///
    /// # Errors
    /// [`IniError::Line`] for a line that is no section, no key and no comment, for a key
    /// before the first section, and for `#INCLUDE`.
    pub fn parse(file: &Path, text: &str) -> Result<Ini, IniError> {
        let mut entries = Vec::new();
        let mut section: Option<String> = None;
        for (line, content) in joined_lines(text) {
            let fail = |problem: String| IniError::Line {
                file: file.to_owned(),
                line,
                problem,
            };
            let content = content.trim();
            if content.starts_with("#INCLUDE") {
                return Err(fail(
                    "#INCLUDE is not followed: put the sections EMCMOT, KINS, TRAJ, JOINT_n and \
                     AXIS_L into one file, or write one with `inifile` or by hand"
                        .to_owned(),
                ));
            }
            if content.is_empty() || content.starts_with(['#', ';']) {
                continue;
            }
            if let Some(rest) = content.strip_prefix('[') {
                let Some((name, _)) = rest.split_once(']') else {
                    return Err(fail(format!("the bracket of `{content}` is not closed")));
                };
                section = Some(name.trim().to_owned());
                continue;
            }
            let Some((key, value)) = content.split_once('=') else {
                return Err(fail(format!(
                    "`{content}` is neither a [SECTION] nor KEY = value nor a comment"
                )));
            };
            let Some(section) = &section else {
                return Err(fail(format!(
                    "`{}` stands before the first [SECTION]",
                    key.trim()
                )));
            };
            entries.push(Entry {
                section: section.clone(),
                key: key.trim().to_owned(),
                value: without_comment(value).to_owned(),
                line,
            });
        }
        Ok(Ini {
            file: file.to_owned(),
            entries,
        })
    }

    fn entry(&self, section: &str, key: &str) -> Option<&Entry> {
        self.entries
            .iter()
            .find(|entry| entry.section == section && entry.key == key)
    }

    /// Whether the section has at least one key.
    pub fn has_section(&self, section: &str) -> bool {
        self.entries.iter().any(|entry| entry.section == section)
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
        let Some(entry) = self.entry(section, key) else {
            return Ok(None);
        };
        match entry.value.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(Some(number)),
            _ => Err(self.bad_value(section, key, "a number is needed here, for example 100.0")),
        }
    }

    /// The number of a key, above 0.
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
            .number(section, key)?
            .ok_or_else(|| self.missing(section, key, remedy))?;
        if number > 0.0 {
            Ok(number)
        } else {
            Err(self.bad_value(section, key, "this has to be above 0"))
        }
    }

    /// The number of a key that may be missing; 0 and missing both mean "not limited".
    ///
    /// # Errors
    /// [`IniError::Value`] if it is no number or below 0.
    pub fn optional_limit(&self, section: &str, key: &str) -> Result<Option<f64>, IniError> {
        match self.number(section, key)? {
            Some(number) if number < 0.0 => {
                Err(self.bad_value(section, key, "a limit is not negative; 0 means not limited"))
            }
            Some(number) if number > 0.0 => Ok(Some(number)),
            _ => Ok(None),
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
        let (value, line) = self
            .entry(section, key)
            .map_or(("", 0), |entry| (entry.value.as_str(), entry.line));
        IniError::Value {
            file: self.file.clone(),
            line,
            entry: format!("[{section}]{key} = {value}"),
            problem: problem.to_owned(),
        }
    }
}

/// Lines with their numbers; a line that ends in a backslash goes on in the next.
fn joined_lines(text: &str) -> Vec<(usize, String)> {
    let mut joined: Vec<(usize, String)> = Vec::new();
    let mut continues = false;
    for (index, line) in text.lines().enumerate() {
        let (content, goes_on) = match line.trim_end().strip_suffix('\\') {
            Some(content) => (content, true),
            None => (line, false),
        };
        match joined.last_mut() {
            Some((_, start)) if continues => start.push_str(content),
            _ => joined.push((index + 1, content.to_owned())),
        }
        continues = goes_on;
    }
    joined
}

/// The value without the blanks around it and without a comment after it.
///
/// A comment has to be set off by a blank, since `#` and `;` occur inside values.
fn without_comment(value: &str) -> &str {
    let end = value
        .char_indices()
        .zip(value.chars().skip(1))
        .find(|((_, before), mark)| before.is_whitespace() && matches!(mark, '#' | ';'))
        .map_or(value.len(), |((index, _), _)| index);
    value[..end].trim()
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
        assert_eq!(
            ini.number("AXIS_X", "MAX_VELOCITY").expect("a number"),
            Some(100.5)
        );
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
