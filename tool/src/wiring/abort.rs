//! What LinuxCNC calls when something is aborted: by `o<frame_abort>` the frame goes.

use super::subroutine_files::{Folder, first};
use std::path::PathBuf;

/// The value of `[RS274NGC]ON_ABORT_COMMAND`, and the line for a subroutine of a user's own.
pub const COMMAND: &str = "o<frame_abort> call";

/// The subroutine of framepath.
const OWN: &str = "frame_abort";

/// What comes of a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Abort {
    /// The frame goes.
    Clears,
    /// It calls this file, which does not call `o<frame_abort>`.
    Without(PathBuf),
    /// It calls this subroutine, which is in none of the folders.
    Missing(String),
    /// It calls no subroutine.
    Other,
}

impl Abort {
    /// What a command does, with subroutines in these folders.
    pub fn of(command: &str, folders: &[Folder]) -> Abort {
        let called = called(command);
        let Some(name) = called.first() else {
            return Abort::Other;
        };
        if reaches(name, folders, &mut Vec::new()) {
            return Abort::Clears;
        }
        match first(folders, name) {
            Some(file) => Abort::Without(file),
            None => Abort::Missing(name.clone()),
        }
    }

    /// What is wrong with the command, and what to write; `None`: nothing.
    pub fn problem(&self, command: &str) -> Option<(String, String)> {
        let both = format!("or write ON_ABORT_COMMAND = {COMMAND}");
        let (why, help) = match self {
            Abort::Clears => return None,
            Abort::Without(file) => (
                format!("and {} does not call o<{OWN}>", file.display()),
                format!(
                    "{COMMAND} as the first line of that subroutine; where others use it as well, a subroutine of your own \
                     that calls both"
                ),
            ),
            Abort::Missing(name) => (
                format!("and {name}.ngc is in none of the folders in which LinuxCNC looks"),
                format!("{COMMAND} as the first line of that subroutine, {both}"),
            ),
            Abort::Other => (
                format!("and not o<{OWN}>"),
                format!("{COMMAND} in a subroutine that ON_ABORT_COMMAND calls, {both}"),
            ),
        };
        let found = format!("on aborts `{command}` is called, {why}: frames stay behind an abort");
        Some((found, help))
    }
}

/// Whether a subroutine calls framepath's, by others as well; `seen`: those that were looked at.
fn reaches(name: &str, folders: &[Folder], seen: &mut Vec<String>) -> bool {
    if name == OWN {
        return true;
    }
    if seen.iter().any(|known| known == name) {
        return false;
    }
    seen.push(name.to_owned());
    let text = first(folders, name).and_then(|file| std::fs::read(file).ok());
    let text = String::from_utf8_lossy(text.as_deref().unwrap_or_default()).into_owned();
    called(&text)
        .iter()
        .any(|called| reaches(called, folders, seen))
}

/// The subroutines that a text in LinuxCNC's language calls.
fn called(text: &str) -> Vec<String> {
    text.lines().filter_map(called_in_line).collect()
}

fn called_in_line(line: &str) -> Option<String> {
    let mut code = String::new();
    let mut is_comment = false;
    for character in line.chars() {
        match character {
            ';' if !is_comment => break,
            '(' => is_comment = true,
            ')' => is_comment = false,
            _ if is_comment || character.is_whitespace() => {}
            _ => code.push(character.to_ascii_lowercase()),
        }
    }
    let (name, rest) = code.strip_prefix("o<")?.split_once('>')?;
    rest.starts_with("call").then(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calls_are_found_as_linuxcnc_reads_them() {
        for (text, names) in [
            ("O <On_Abort> call [5]", vec!["on_abort"]),
            ("(o<a> call)\n  o<b>call ; o<c> call\no<d> sub\n", vec!["b"]),
            ("; o<a> call\nM5 M9", vec![]),
            ("o<a> (first) call\no<b> call", vec!["a", "b"]),
        ] {
            assert_eq!(called(text), names, "{text}");
        }
    }
}
