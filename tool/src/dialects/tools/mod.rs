//! What the tools are called, and how thick they are: lists `tools.csv` beside the program and beside
//! the INI file, and LinuxCNC's own tool table.
//!
//! They are read when a program asks for the first time: one that names no tool is not refused for
//! what is wrong in them.

mod list;
mod table;

use super::spelling::nearest_few;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::encoding::decode_as;
use crate::machine::ini::Ini;
use crate::source::{Sources, Span, Text};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The name of a list of tools.
pub const LIST: &str = "tools.csv";

/// The greatest number of a tool.
pub const MOST: u32 = 99_999;

/// Where tools are looked up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ToolFiles {
    /// Lists of names and numbers; the earlier counts where two have the same name.
    pub lists: Vec<PathBuf>,
    /// The INI file of the machine, which names LinuxCNC's tool table.
    pub ini: Option<PathBuf>,
}

impl ToolFiles {
    /// The lists beside the program and beside the INI file, as far as they are there.
    pub fn beside(program: &Path, ini: Option<PathBuf>) -> ToolFiles {
        let folders = [Some(program), ini.as_deref()].into_iter().flatten();
        let mut lists: Vec<PathBuf> = Vec::new();
        for list in folders.map(|file| file.with_file_name(LIST)) {
            if list.is_file() && !lists.contains(&list) {
                lists.push(list);
            }
        }
        ToolFiles { lists, ini }
    }
}

/// The tools of one file.
#[derive(Clone, Debug, Default, PartialEq)]
struct Tools {
    /// The file, as messages call it.
    file: String,
    /// Numbers by name, in upper case; several where a name is there more than once.
    numbers: BTreeMap<String, Vec<u32>>,
    /// Diameters by number, machine units.
    diameters: BTreeMap<u32, f64>,
    /// Whether an offset of a tool moves another axis than Z.
    aside: bool,
}

impl Tools {
    fn add(&mut self, name: &str, number: u32) {
        let numbers = self.numbers.entry(key(name)).or_default();
        if !numbers.contains(&number) {
            numbers.push(number);
        }
    }
}

/// Names are the same in upper and lower case.
fn key(name: &str) -> String {
    name.trim().to_uppercase()
}

/// The tools of all files.
#[derive(Clone, Debug, Default)]
pub struct ToolBook {
    files: Vec<Tools>,
    /// Why LinuxCNC's tool table is not among them, if there is a reason.
    without_table: Option<String>,
}

impl ToolBook {
    /// Reads all files.
    ///
    /// # Errors
    ///
    /// The first thing that is wrong in each of them, at its place.
    pub fn read(files: &ToolFiles, sources: &mut Sources) -> Result<ToolBook, Diagnostics> {
        let mut book = ToolBook::default();
        let mut diagnostics = Diagnostics::default();
        for path in &files.lists {
            match add_source(path, sources, list::parse) {
                Ok(tools) => book.add(path, tools),
                Err(diagnostic) => diagnostics.push(diagnostic),
            }
        }
        let table = match &files.ini {
            None => Err("no INI file is known (INI_FILE_NAME, --ini)".to_string()),
            Some(ini) => tool_table(ini),
        };
        match table {
            Err(reason) => book.without_table = Some(reason),
            Ok(path) => match add_source(&path, sources, table::parse) {
                Ok(tools) => book.add(&path, tools),
                Err(diagnostic) => diagnostics.push(diagnostic),
            },
        }
        match diagnostics.errors() {
            0 => Ok(book),
            _ => Err(diagnostics),
        }
    }

    fn add(&mut self, path: &Path, tools: Tools) {
        let file = path.display().to_string();
        self.files.push(Tools { file, ..tools });
    }

    /// The number of the tool with this name.
    ///
    /// # Errors
    ///
    /// No tool has the name, or several have.
    pub fn number(&self, name: &str, span: Span) -> Result<u32, Diagnostic> {
        let wanted = key(name);
        let found = self
            .files
            .iter()
            .find_map(|file| file.numbers.get(&wanted).map(|numbers| (file, numbers)));
        match found {
            Some((_, numbers)) if numbers.len() == 1 => Ok(numbers[0]),
            Some((file, numbers)) => {
                let list: Vec<String> = numbers.iter().map(|number| format!("T{number}")).collect();
                Err(Diagnostic::error(
                    span,
                    format!(
                        "several tools are called \"{name}\" in {}: {}",
                        file.file,
                        list.join(", ")
                    ),
                )
                .help(format!(
                    "say which is meant, in {LIST} beside the program or as --tool \"{name}={}\"",
                    numbers[0]
                )))
            }
            None => Err(self.unknown(name, &wanted, span)),
        }
    }

    fn unknown(&self, name: &str, wanted: &str, span: Span) -> Diagnostic {
        let error = Diagnostic::error(span, format!("no tool is called \"{name}\""));
        let known = || self.files.iter().flat_map(|file| &file.numbers);
        let mut nearest = nearest_few(wanted, known().map(|(name, _)| name.as_str()));
        // A tool of LinuxCNC's table has two names.
        let mut told: Vec<&Vec<u32>> = Vec::new();
        nearest.retain(|name| {
            let numbers = known().find(|(known, _)| known == name);
            let new = numbers.is_some_and(|(_, numbers)| !told.contains(&numbers));
            told.extend(numbers.map(|(_, numbers)| numbers));
            new
        });
        if !nearest.is_empty() {
            return error.help(format!("did you mean \"{}\"?", nearest.join("\", \"")));
        }
        let read: Vec<&str> = self.files.iter().map(|file| file.file.as_str()).collect();
        let read = match (read.is_empty(), &self.without_table) {
            (true, Some(reason)) => format!("no list was found, and {reason}"),
            (_, None) => format!("it is not in {}", read.join(" nor in ")),
            (false, Some(reason)) => {
                format!("it is not in {}, and {reason}", read.join(" nor in "))
            }
        };
        error.help(format!(
            "{read}; give its number as a line \"{name},3\" of {LIST} beside the program or beside the INI \
             file, as the comment of its line of LinuxCNC's tool table, or as --tool \"{name}=3\""
        ))
    }

    /// The diameter of a tool, machine units, where LinuxCNC's tool table has one.
    pub fn diameter(&self, number: u32) -> Option<f64> {
        let of = |file: &Tools| file.diameters.get(&number).copied();
        self.files.iter().find_map(of)
    }

    /// Whether LinuxCNC's tool table is known, and no offset in it moves another axis than Z.
    pub fn offsets_move_z_only(&self) -> bool {
        self.without_table.is_none() && !self.files.iter().any(|file| file.aside)
    }

    /// Why there is no tool table, if there is none.
    pub fn without_table(&self) -> Option<&str> {
        self.without_table.as_deref()
    }
}

/// The tool table that an INI file names.
fn tool_table(ini: &Path) -> Result<PathBuf, String> {
    let read = Ini::read(ini).map_err(|error| error.to_string())?;
    if read.text("EMCIO", "DB_PROGRAM").is_some() {
        return Err(format!(
            "{} has its tools from [EMCIO]DB_PROGRAM",
            ini.display()
        ));
    }
    match read.text("EMCIO", "TOOL_TABLE") {
        Some(table) => Ok(ini.with_file_name(table)),
        None => Err(format!("{} has no [EMCIO]TOOL_TABLE", ini.display())),
    }
}

/// Takes a file up among those that messages show, and what `parse` finds in it.
fn add_source(
    path: &Path,
    sources: &mut Sources,
    parse: fn(Text) -> Result<Tools, Diagnostic>,
) -> Result<Tools, Diagnostic> {
    let shown = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|error| {
        let message = format!("{shown} cannot be read: {error}");
        Diagnostic::error(Span::start_of(0), message)
    })?;
    let text = decode_as(&bytes, None).map_or_else(
        |_| String::from_utf8_lossy(&bytes).into_owned(),
        |decoded| decoded.text,
    );
    let file = sources.add(shown, text.clone());
    parse(Text {
        file,
        text: &text,
        start: 0,
    })
}

/// The lines of a file, each with the position of its first byte.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.split_inclusive('\n').scan(0, |start, line| {
        let begins = *start;
        *start += line.len();
        Some((begins, line.trim_end_matches(['\n', '\r'])))
    })
}
