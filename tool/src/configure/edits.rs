//! Changes of an INI file, line by line, and the lines of the new HAL file.

use super::error::{ConfigureError, Refusal};
use crate::machine::IniError;
use crate::machine::ini::{Entry, Ini};
use crate::machine::place::Place;
use crate::machine::text_file;
use std::collections::BTreeMap;
use std::path::Path;

/// Begins the HAL file.
const HEAD: &str = "# What blendtp and framekins need of HAL, behind the other HAL files. Written by framepath configure.\n";
/// Begins the HAL file that comes first.
const FIRST_HEAD: &str =
    "# framekins, before the kinematics and motmod. Written by framepath configure.\n";

/// The text of the INI file as it is; what is no UTF-8 would be written as something else.
pub fn original(file: &Path) -> Result<String, IniError> {
    let unreadable = |source| IniError::Read {
        file: file.to_owned(),
        source,
    };
    let bytes = std::fs::read(file).map_err(unreadable)?;
    String::from_utf8(bytes).map_err(|error| {
        let line = 1 + error.as_bytes()[..error.utf8_error().valid_up_to()]
            .iter()
            .filter(|&&b| b == b'\n')
            .count();
        IniError::Line {
            file: file.to_owned(),
            line,
            problem: "a character here is no UTF-8: save the file as UTF-8".to_owned(),
        }
    })
}

/// What is to be changed.
pub struct Edits<'a> {
    ini: &'a Ini,
    lines: Vec<&'a str>,
    /// In place of lines of the file, by their numbers from 1.
    replaced: BTreeMap<usize, String>,
    /// Behind lines of the file; 0: at its end, in sections that are not there.
    added: BTreeMap<usize, Vec<String>>,
    new_sections: Vec<(String, Vec<String>)>,
    hal: Vec<String>,
    /// Of a HAL file that comes before all others.
    first_hal: Vec<String>,
    refusals: Vec<Refusal>,
    warnings: Vec<String>,
    /// Whether a line that comes from an included file would change.
    changes_included: bool,
}

/// What is to be written.
pub struct Written {
    /// The INI file, but for the HAL files of ours.
    pub ini: String,
    /// The HAL file behind the others.
    pub hal: String,
    /// The one before the others.
    pub first_hal: Option<String>,
    /// What the user is told.
    pub warnings: Vec<String>,
}

impl<'a> Edits<'a> {
    /// None yet.
    pub fn new(ini: &'a Ini, text: &'a str) -> Edits<'a> {
        Edits {
            ini,
            // With the carriage returns that some lines end with.
            lines: text.split_terminator('\n').collect(),
            replaced: BTreeMap::new(),
            added: BTreeMap::new(),
            new_sections: Vec::new(),
            hal: Vec::new(),
            first_hal: Vec::new(),
            refusals: Vec::new(),
            warnings: Vec::new(),
            changes_included: false,
        }
    }

    /// Something is in the way.
    pub fn refuse(&mut self, place: &Place, found: impl Into<String>, help: impl Into<String>) {
        self.refusals.push(Refusal {
            place: place.clone(),
            found: found.into(),
            help: help.into(),
        });
    }

    /// Something is taken that the configuration does not say.
    pub fn warn(&mut self, text: String) {
        self.warnings.push(text);
    }

    /// A line of the HAL file.
    pub fn add_hal(&mut self, line: impl Into<String>) {
        self.hal.push(line.into());
    }

    /// A line of the HAL file that comes first.
    pub fn first_hal(&mut self, line: impl Into<String>) {
        self.first_hal.push(line.into());
    }

    /// Names that file in the INI file, if it is needed.
    pub fn name_first_hal(&mut self, name: &str) {
        let Some(entry) = self.ini.entry("HAL", "HALFILE") else {
            return self.add_last("HAL", "HALFILE", name);
        };
        if !self.first_hal.is_empty() {
            let line = format!("HALFILE = {name}\nHALFILE = {}", entry.value);
            self.replace(entry, &line);
        }
    }

    /// Another value for one of several keys of a name.
    pub fn set_entry(&mut self, entry: &Entry, value: &str) {
        self.replace(entry, &format!("{} = {value}", entry.key));
    }

    /// Sets a key, in place of its line if it is there.
    pub fn set(&mut self, section: &str, key: &str, value: &str) {
        match self.ini.entry(section, key) {
            Some(entry) => self.replace(entry, &format!("{key} = {value}")),
            None => self.add_last(section, key, value),
        }
    }

    fn replace(&mut self, entry: &Entry, line: &str) {
        let place = &entry.place;
        if self.goes_on(place) {
            let found = format!("{} goes on in the next line", entry.key);
            self.refuse(place, found, "write it in one line");
        } else if &*place.file != self.ini.file() {
            self.changes_included = true;
        } else {
            self.replaced.insert(place.line, line.to_owned());
        }
    }

    /// Whether the line at this place ends in a backslash.
    fn goes_on(&self, place: &Place) -> bool {
        let index = place.line.saturating_sub(1);
        let ends = |line: &str| line.trim_end().ends_with('\\');
        if &*place.file == self.ini.file() {
            return self.lines.get(index).is_some_and(|line| ends(line));
        }
        let text = text_file::read(&place.file).unwrap_or_default();
        text.lines().nth(index).is_some_and(ends)
    }

    /// Adds a key behind the last one of this name, else at the end of the section.
    pub fn add_last(&mut self, section: &str, key: &str, value: &str) {
        let line = format!("{key} = {value}");
        let Some(heading) = self
            .ini
            .headings()
            .iter()
            .find(|heading| heading.name == section)
        else {
            match self
                .new_sections
                .iter_mut()
                .find(|(name, _)| name == section)
            {
                Some((_, lines)) => lines.push(line),
                None => self.new_sections.push((section.to_owned(), vec![line])),
            }
            return;
        };
        let mut entries = self
            .ini
            .entries()
            .iter()
            .filter(|entry| entry.is_read && entry.section == section);
        let named = entries.clone().rfind(|entry| entry.key == key);
        let last = named.or(entries.next_back());
        let place = last.map_or(&heading.place, |entry| &entry.place).clone();
        if &*place.file != self.ini.file() {
            self.changes_included = true;
            return;
        }
        let goes_on = |line: &usize| {
            self.lines
                .get(line - 1)
                .is_some_and(|text| text.trim_end().ends_with('\\'))
        };
        let end = (place.line..)
            .find(|line| !goes_on(line))
            .unwrap_or(place.line);
        self.added.entry(end).or_default().push(line);
    }

    /// The new files.
    ///
    /// # Errors
    /// What is in the way, and [`ConfigureError::Included`] where nothing else is.
    pub fn finish(self) -> Result<Written, ConfigureError> {
        if !self.refusals.is_empty() {
            return Err(ConfigureError::Refused(self.refusals));
        }
        if self.changes_included {
            return Err(ConfigureError::Included);
        }
        let mut text = String::new();
        for (index, line) in self.lines.iter().enumerate() {
            let number = index + 1;
            let replaced = self.replaced.get(&number).map(String::as_str);
            let added = self
                .added
                .get(&number)
                .into_iter()
                .flatten()
                .map(String::as_str);
            for line in std::iter::once(replaced.unwrap_or(line)).chain(added) {
                text.push_str(line);
                text.push('\n');
            }
        }
        for (section, lines) in self.new_sections {
            text.push_str(&format!("\n[{section}]\n{}\n", lines.join("\n")));
        }
        let is_needed = !self.first_hal.is_empty();
        Ok(Written {
            ini: text,
            hal: format!("{HEAD}{}\n", self.hal.join("\n")),
            first_hal: is_needed.then(|| format!("{FIRST_HEAD}{}\n", self.first_hal.join("\n"))),
            warnings: self.warnings,
        })
    }
}
