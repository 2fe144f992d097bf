//! `#INCLUDE FILE` in INI files, which the script `linuxcnc` replaces by the file before anything reads it.

use super::text_file;
use std::path::{Path, PathBuf};

/// The name behind `#INCLUDE`, if the line is one.
pub(super) fn included(line: &str) -> Option<&str> {
    let rest = line.strip_prefix("#INCLUDE")?;
    let is_word = rest.is_empty() || rest.starts_with(char::is_whitespace);
    is_word.then(|| rest.trim())
}

/// The text of an INI file with the files that it includes in it, whose folder is that of `ini`: what an included file includes is
/// a comment, as is a file that is not there; `None` if it includes none.
pub(super) fn put_in(ini: &Path, text: &str) -> Option<String> {
    let is_include = |line: &str| included(line.trim()).is_some();
    if !text.lines().any(is_include) {
        return None;
    }
    let comment = |line: &str| match is_include(line) {
        true => format!("# {line}\n"),
        false => format!("{line}\n"),
    };
    let mut expanded = String::new();
    for line in text.split_terminator('\n') {
        match included(line.trim()).map(|name| read(ini, name)) {
            None => expanded.push_str(&format!("{line}\n")),
            Some(Err(_)) => expanded.push_str(&comment(line)),
            Some(Ok((path, content))) => {
                let name = path.display();
                expanded.push_str(&format!("#*** Begin #INCLUDE file: {name}\n"));
                expanded.extend(content.split_terminator('\n').map(comment));
                expanded.push_str(&format!("#*** End   #INCLUDE file: {name}\n"));
            }
        }
    }
    Some(expanded)
}

/// Why a file is not there.
pub(super) enum NotIncluded {
    /// For LinuxCNC neither.
    Missing(String),
    /// LinuxCNC may well read it.
    NotExpanded(String),
}

/// The file that `name` stands for in the INI file `ini`, and its text.
pub(super) fn read(ini: &Path, name: &str) -> Result<(PathBuf, String), NotIncluded> {
    let name = name.split(" #").next().unwrap_or("").trim();
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
