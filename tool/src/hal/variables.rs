//! What stands for `[SECTION]KEY`, `[SECTION](KEY)`, `$NAME` and `$(NAME)` in HAL files.

use crate::machine::ini::Ini;
use std::path::Path;

/// Where `linuxcnc` has its own HAL files.
pub const HALLIB: &str = "/usr/share/linuxcnc/hallib";

/// Why there is nothing to put in.
#[derive(Clone, Debug, PartialEq)]
pub enum Missing {
    /// The bracket or the parenthesis is not closed, or there is no name.
    Form,
    /// No such key that LinuxCNC reads, or an empty one.
    Key {
        /// The section.
        section: String,
        /// The key.
        key: String,
    },
    /// No such variable of the environment here.
    Environment(String),
}

/// A reference at the beginning of `text`: how many characters it takes, and what it stands for.
pub fn resolve(text: &[char], ini: &Ini) -> Result<(usize, String), Missing> {
    let mut at = 1;
    let mut section = None;
    if text.first() == Some(&'[') {
        let length = text[at..].iter().position(|&c| c == ']');
        let length = length.ok_or(Missing::Form)?;
        section = Some(text[at..at + length].iter().collect::<String>());
        at += length + 1;
    }
    let (name, end) = name(text, at)?;
    let value = match section {
        Some(section) => value_of_key(ini, section, name)?,
        None => value_of_variable(ini, name)?,
    };
    Ok((end, value))
}

fn name(text: &[char], at: usize) -> Result<(String, usize), Missing> {
    let is_part = |c: &char| c.is_ascii_alphanumeric() || "_-.".contains(*c);
    let rest = text.get(at..).unwrap_or_default();
    let (from, length, end) = if rest.first() == Some(&'(') {
        let length = rest[1..].iter().position(|&c| c == ')');
        let length = length.ok_or(Missing::Form)?;
        (at + 1, length, at + length + 2)
    } else {
        let length = rest.iter().take_while(|c| is_part(c)).count();
        (at, length, at + length)
    };
    match length {
        0 => Err(Missing::Form),
        _ => Ok((text[from..from + length].iter().collect(), end)),
    }
}

fn value_of_key(ini: &Ini, section: String, key: String) -> Result<String, Missing> {
    match ini.entry(&section, &key) {
        Some(entry) if !entry.raw.is_empty() => Ok(entry.raw.clone()),
        _ => Err(Missing::Key { section, key }),
    }
}

/// The script `linuxcnc` sets some variables before it runs HAL files.
fn value_of_variable(ini: &Ini, name: String) -> Result<String, Missing> {
    let folder = ini.file().parent().unwrap_or(Path::new("."));
    let set = match name.as_str() {
        "INI_FILE_NAME" => Some(ini.file().display().to_string()),
        "CONFIG_DIR" => Some(folder.display().to_string()),
        "HALLIB_DIR" => Some(HALLIB.to_owned()),
        "LINUXCNC_HOME" => Some("/usr".to_owned()),
        "LINUXCNC_NCFILES_DIR" => Some("/usr/share/linuxcnc/ncfiles".to_owned()),
        "LINUXCNC_HELP_DIR" => Some("/usr/share/doc/linuxcnc".to_owned()),
        _ => std::env::var(&name).ok(),
    };
    set.ok_or(Missing::Environment(name))
}
