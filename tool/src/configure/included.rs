//! An INI file with the files that it includes in it: where lines of these change, the new one has them itself, and they stay as they
//! are. Names of files in them mean the same, since LinuxCNC looks for them from the folder of the INI file.

use super::edits;
use super::error::{ConfigureError, Refusal};
use crate::hal::read_script;
use crate::machine::IniError;
use crate::machine::ini::{Entry, Ini};
use crate::machine::place::Place;
use crate::machine::warn_of;
use crate::wiring::subject::Subject;
use std::collections::BTreeSet;
use std::path::Path;

/// The configuration with all its lines in the INI file. What LinuxCNC does not include is told, and left out.
///
/// # Errors
/// A file that LinuxCNC may include and that is not read here, one that is no UTF-8, and lines that would be read otherwise.
pub fn put_in(subject: &Subject) -> Result<Subject, ConfigureError> {
    let ini = &subject.ini;
    unread(subject)?;
    for file in files(ini) {
        edits::original(file)?;
    }
    let (whole, _) = Ini::parse_all(ini.file(), ini.expanded().unwrap_or_default());
    if let Some(entry) = first_otherwise(ini, &whole) {
        return refused(
            &entry.place,
            format!("{} is read otherwise without #INCLUDE", entry.key),
            format!("write it in one line, in {}", ini.file().display()),
        );
    }
    let passed = |problem: &IniError| format!("{problem}: LinuxCNC passes over this line");
    warn_of(&subject.ini_problems.iter().map(passed).collect::<Vec<_>>());
    let script = read_script(&whole, &[]);
    Ok(Subject::new(whole, Vec::new(), script))
}

fn unread(subject: &Subject) -> Result<(), ConfigureError> {
    for problem in &subject.ini_problems {
        if let IniError::Unread {
            file,
            line,
            problem,
        } = problem
        {
            let place = Place {
                line: *line,
                ..Place::file(file)
            };
            let help = "#INCLUDE and the name of the file itself";
            return refused(&place, problem.clone(), help.to_owned());
        }
    }
    Ok(())
}

/// The files that have lines of the configuration.
fn files(ini: &Ini) -> BTreeSet<&Path> {
    let entries = ini.entries().iter().map(|entry| &*entry.place.file);
    let headings = ini.headings().iter().map(|heading| &*heading.place.file);
    entries.chain(headings).collect()
}

/// The first key that is another one, or has another value, in `whole`.
fn first_otherwise<'a>(ini: &'a Ini, whole: &'a Ini) -> Option<&'a Entry> {
    let is_same = |a: &Entry, b: &Entry| {
        (&a.section, &a.key, &a.raw, a.is_read) == (&b.section, &b.key, &b.raw, b.is_read)
    };
    let [before, after] = [ini, whole].map(|ini| ini.entries());
    let mut pairs = before.iter().zip(after);
    let other = pairs.find(|(a, b)| !is_same(a, b)).map(|(a, _)| a);
    let shorter = before.len().min(after.len());
    other.or(before.get(shorter)).or(after.get(shorter))
}

fn refused<T>(place: &Place, found: String, help: String) -> Result<T, ConfigureError> {
    let place = place.clone();
    Err(ConfigureError::Refused(vec![Refusal {
        place,
        found,
        help,
    }]))
}
