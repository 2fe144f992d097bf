//! Where programs and subprograms come from: sections of the file itself, files beside it, files in
//! the folders of the settings.

use super::settings::Settings;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::encoding::{Encoding, decode_as};
use crate::source::{Sources, Span, Text};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// A program or subprogram, ready to run.
pub trait Routine {
    /// The name that calls use, in upper case.
    fn name(&self) -> &str;
    /// Whether it was declared a main program, or is not declared at all.
    fn is_main(&self) -> bool;
    /// Whether it holds nothing but comments.
    fn is_empty(&self) -> bool;
    /// Where its first block stands.
    fn first_span(&self) -> Span;
    /// What calls that lead in a circle name it.
    fn title(&self) -> &str {
        self.name()
    }
}

/// Parses lines of a file of the sources, whose name without its ending, in upper case, is the second
/// argument.
pub type Parse<R> = fn(Text, &str, &Sources, &mut Diagnostics) -> Vec<R>;

/// All programs that are known so far.
#[derive(Debug)]
pub struct Library<R> {
    main: Option<Rc<R>>,
    routines: Vec<Rc<R>>,
    folders: Vec<PathBuf>,
    /// Files that were read, and names that were looked for in vain.
    read: Vec<PathBuf>,
    missing: Vec<String>,
    extensions: &'static [&'static str],
    encoding: Option<Encoding>,
    stem: String,
    parse: Parse<R>,
}

impl<R: Routine> Library<R> {
    /// Parses file 0 of `sources`, which lies at `path`, if all of it is held. Subprogram files have one of the
    /// `extensions`; where several have the same name, the earlier ending counts.
    pub fn new(
        path: &Path,
        extensions: &'static [&'static str],
        settings: &Settings,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
        parse: Parse<R>,
    ) -> Library<R> {
        let folder = path.parent().unwrap_or(Path::new("."));
        let folder = match folder.as_os_str().is_empty() {
            true => Path::new("."),
            false => folder,
        };
        let mut library = Library {
            main: None,
            routines: Vec::new(),
            folders: std::iter::once(folder.to_path_buf())
                .chain(settings.subprogram_folders.iter().cloned())
                .collect(),
            read: vec![folder.join(path.file_name().unwrap_or_default())],
            missing: Vec::new(),
            extensions,
            encoding: settings.encoding,
            stem: stem(path),
            parse,
        };
        if sources.file(0).is_windowed() {
            return library;
        }
        library.add_file(0, path, sources, diagnostics);
        let main = |routine: &&Rc<R>| routine.is_main() && !routine.is_empty();
        let mut candidates = library.routines.iter().filter(main);
        let first = candidates.next().cloned();
        if let Some(second) = candidates.next() {
            diagnostics.push(
                Diagnostic::error(
                    second.first_span(),
                    "a second main program begins in the same file",
                )
                .help("keep one program in the file, or declare this one as a subprogram"),
            );
        }
        library.main = first.or(library.routines.first().cloned());
        library
    }

    /// The name of the program's file without its ending, in upper case.
    pub fn stem(&self) -> &str {
        &self.stem
    }

    /// How files are parsed.
    pub fn parser(&self) -> Parse<R> {
        self.parse
    }

    /// The main program.
    pub fn main(&self) -> Option<Rc<R>> {
        self.main.clone()
    }

    /// The subprogram with this name, in upper case. Looks into the folders if need be.
    pub fn find(
        &mut self,
        name: &str,
        sources: &mut Sources,
        diagnostics: &mut Diagnostics,
    ) -> Option<Rc<R>> {
        if let Some(known) = self.known(name) {
            return Some(known);
        }
        let path = self
            .folders
            .iter()
            .find_map(|folder| in_folder(folder, name, self.extensions))?;
        // A file that holds something else than its name says is not read at every call.
        if self.read.contains(&path) {
            return None;
        }
        self.read.push(path.clone());
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) => {
                let span = Span::start_of(0);
                diagnostics.push(Diagnostic::error(
                    span,
                    format!("{} cannot be read: {error}", path.display()),
                ));
                return None;
            }
        };
        self.take_in(&path, &bytes, sources, diagnostics)?;
        self.known(name)
    }

    /// The subprogram with this name, wherever it is defined: in the file itself or in any program file
    /// of the folders. `defines` tells by a quick look whether a text defines a name. Two files that
    /// define it are an error.
    pub fn find_defined(
        &mut self,
        name: &str,
        defines: fn(&str, &str) -> bool,
        sources: &mut Sources,
        diagnostics: &mut Diagnostics,
    ) -> Option<Rc<R>> {
        let known = self.known(name);
        if known.is_some() || self.missing.iter().any(|missing| missing == name) {
            return known;
        }
        let mut found: Option<(PathBuf, Vec<u8>)> = None;
        for path in self.folders.iter().flat_map(|folder| files(folder)) {
            let extension = path.extension().unwrap_or_default().to_string_lossy();
            let is_program = |wanted: &&str| extension.eq_ignore_ascii_case(wanted);
            if !self.extensions.iter().any(is_program) || self.read.contains(&path) {
                continue;
            }
            let bytes = match std::fs::read(&path) {
                Ok(bytes) => bytes,
                Err(error) => {
                    let path = path.display();
                    let message =
                        format!("{path} cannot be read, whether it defines {name}: {error}");
                    diagnostics.push(Diagnostic::warning(Span::start_of(0), message));
                    continue;
                }
            };
            // What is wrong with the encoding of a file counts only if the file is wanted.
            let text = decode_as(&bytes, self.encoding).map_or_else(
                |_| String::from_utf8_lossy(&bytes).into_owned(),
                |decoded| decoded.text,
            );
            if !defines(&text, name) {
                continue;
            }
            if let Some((first, _)) = &found {
                let span = Span::start_of(0);
                diagnostics.push(
                    Diagnostic::error(
                        span,
                        format!(
                            "{name} is defined in {} and in {}",
                            first.display(),
                            path.display()
                        ),
                    )
                    .help("move one of the files into another folder"),
                );
                break;
            }
            found = Some((path, bytes));
        }
        let Some((path, bytes)) = found else {
            self.missing.push(name.to_string());
            return None;
        };
        self.read.push(path.clone());
        self.take_in(&path, &bytes, sources, diagnostics)?;
        self.known(name)
    }

    /// Parses a file; `None` where it is not in its encoding, which is said.
    fn take_in(
        &mut self,
        path: &Path,
        bytes: &[u8],
        sources: &mut Sources,
        diagnostics: &mut Diagnostics,
    ) -> Option<()> {
        let text = self.decode(bytes, path, diagnostics)?;
        let file = sources.add(path.display().to_string(), text);
        self.add_file(file, path, sources, diagnostics);
        Some(())
    }

    fn decode(&self, bytes: &[u8], path: &Path, diagnostics: &mut Diagnostics) -> Option<String> {
        let decoded = match decode_as(bytes, self.encoding) {
            Ok(decoded) => decoded,
            Err(at) => {
                let path = path.display();
                let message = format!("{path} is not UTF-8: byte {} is not", at + 1);
                diagnostics.push(
                    Diagnostic::error(Span::start_of(0), message)
                        .help("leave --encoding out, or name the encoding of all files"),
                );
                return None;
            }
        };
        if let Some(guessed) = decoded.guessed {
            diagnostics.note_encoding(&path.display().to_string(), guessed);
        }
        Some(decoded.text)
    }

    fn known(&self, name: &str) -> Option<Rc<R>> {
        let wanted = |routine: &&Rc<R>| routine.name() == name;
        self.routines.iter().find(wanted).cloned()
    }

    fn add_file(
        &mut self,
        file: usize,
        path: &Path,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) {
        let routines = (self.parse)(sources.text(file), &stem(path), sources, diagnostics);
        self.routines.extend(routines.into_iter().map(Rc::new));
    }
}

fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().to_ascii_uppercase()
}

/// The file with this name and one of the endings, upper or lower case in any mixture. With several
/// that differ in case only, the first in alphabetical order: the choice must not depend on the file
/// system.
fn in_folder(folder: &Path, name: &str, extensions: &[&str]) -> Option<PathBuf> {
    let rank = |path: &PathBuf| {
        let extension = path.extension()?.to_string_lossy();
        extensions
            .iter()
            .position(|wanted| extension.eq_ignore_ascii_case(wanted))
    };
    let mut found: Vec<PathBuf> = files(folder)
        .into_iter()
        .filter(|path| {
            let stem = path.file_stem();
            stem.is_some_and(|stem| stem.to_string_lossy().eq_ignore_ascii_case(name))
                && rank(path).is_some()
        })
        .collect();
    found.sort_by_key(|path| (rank(path), path.clone()));
    found.into_iter().next()
}

/// The files of a folder, in alphabetical order.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut found: Vec<PathBuf> = entries
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| !path.is_dir())
        .collect();
    found.sort();
    found
}
