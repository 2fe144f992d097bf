//! Where programs and subprograms come from: sections of the file itself, files beside it, files in
//! the folders of the settings.

use super::fillers;
use super::settings::Settings;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::encoding::Encoding;
use crate::source::open::{Content, OpenError, Reading, open};
use crate::source::{Sources, Span};
use std::io;
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
    /// Parses what did not run, for the errors in it.
    ///
    /// # Errors
    ///
    /// Where its file cannot be read any more.
    fn check_rest(&self, sources: &Sources, diagnostics: &mut Diagnostics) -> io::Result<()>;
}

/// Looks for the programs and subprograms of the file of the sources with an index. The second argument is its
/// name without its ending, in upper case.
pub type Read<R> = fn(usize, &str, &Sources, &mut Diagnostics) -> Vec<R>;

/// All programs that are known so far.
#[derive(Debug)]
pub struct Library<R> {
    main: Option<Rc<R>>,
    routines: Vec<Rc<R>>,
    folders: Vec<PathBuf>,
    /// Files that were read, and names that were looked for in vain.
    read: Vec<PathBuf>,
    missing: Vec<String>,
    /// The first routine of each file that was read.
    firsts: Vec<(PathBuf, Rc<R>)>,
    /// Those that only calls by the path of their file mean.
    unnamed: Vec<Rc<R>>,
    extensions: &'static [&'static str],
    reading: Reading,
    stem: String,
    read_routines: Read<R>,
}

impl<R: Routine> Library<R> {
    /// Looks through file 0 of `sources`, which lies at `path`. Subprogram files have one of the
    /// `extensions`; where several have the same name, the earlier ending counts.
    pub fn new(
        path: &Path,
        extensions: &'static [&'static str],
        settings: &Settings,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
        read_routines: Read<R>,
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
            firsts: Vec::new(),
            unnamed: Vec::new(),
            extensions,
            reading: settings.reading,
            stem: stem(path),
            read_routines,
        };
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

    /// Parses what did not run of all files that were read.
    ///
    /// # Errors
    ///
    /// Where a file cannot be read any more.
    pub fn check_rest(&self, sources: &Sources, diagnostics: &mut Diagnostics) -> io::Result<()> {
        let mut routines = self.routines.iter().chain(&self.unnamed);
        routines.try_for_each(|routine| routine.check_rest(sources, diagnostics))
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
            let mut firsts = self.firsts.iter();
            let first = firsts.find(|(known, first)| *known == path && first.name() == name);
            return first.map(|(_, first)| Rc::clone(first));
        }
        self.read.push(path.clone());
        self.take_in(&path, Span::start_of(0), sources, diagnostics)?;
        self.known(name)
    }

    /// The file that has been read for this name, and the name of the program with which it begins.
    pub fn first_of_file(&self, name: &str) -> Option<(&Path, &str)> {
        let mut folders = self.folders.iter();
        let path = folders.find_map(|folder| in_folder(folder, name, self.extensions))?;
        let (path, first) = self.firsts.iter().find(|(known, _)| *known == path)?;
        Some((path, first.name()))
    }

    /// The first program of the file with this name, with this ending or one of those of subprograms. `folders`
    /// are looked for inside the known ones, the outermost first, which may be missing there.
    pub fn find_file(
        &mut self,
        folders: &[String],
        name: &str,
        extension: Option<&str>,
        sources: &mut Sources,
        diagnostics: &mut Diagnostics,
    ) -> Option<Rc<R>> {
        let wanted = extension.map(|extension| [extension]);
        let extensions = wanted
            .as_ref()
            .map_or(self.extensions, |one| one.as_slice());
        let inside = (0..=folders.len()).filter_map(|first| folders.get(first..));
        let places = inside.flat_map(|inside| {
            let below = |folder: &PathBuf| subfolder(folder, inside);
            self.folders.iter().filter_map(below)
        });
        let path = { places }.find_map(|folder| in_folder(&folder, name, extensions))?;
        if !self.read.contains(&path) {
            self.read.push(path.clone());
            let known = self.routines.len();
            self.take_in(&path, Span::start_of(0), sources, diagnostics)?;
            // Another file may have the name that calls without a path mean.
            if known < self.routines.len() {
                self.unnamed.push(self.routines.remove(known));
            }
        }
        let first = self.firsts.iter().find(|(known, _)| *known == path);
        first.map(|(_, routine)| Rc::clone(routine))
    }

    /// The subprogram with this name, wherever it is defined: in the file itself or in any program file
    /// of the folders. `defines` tells by a quick look whether a text defines a name; it is called at `span`. Two
    /// files that define it are an error.
    pub fn find_defined(
        &mut self,
        name: &str,
        defines: fn(&str, &str) -> bool,
        span: Span,
        sources: &mut Sources,
        diagnostics: &mut Diagnostics,
    ) -> Option<Rc<R>> {
        let known = self.known(name);
        if known.is_some() || self.missing.iter().any(|missing| missing == name) {
            return known;
        }
        let mut found: Option<PathBuf> = None;
        for path in self.folders.iter().flat_map(|folder| files(folder)) {
            let extension = path.extension().unwrap_or_default().to_string_lossy();
            let is_program = |wanted: &&str| extension.eq_ignore_ascii_case(wanted);
            if !self.extensions.iter().any(is_program) || self.read.contains(&path) {
                continue;
            }
            let seems_to = match self.look_through(&path, |text| defines(text, name)) {
                Ok(seems_to) => seems_to,
                Err(error) => {
                    let path = path.display();
                    diagnostics.push(Diagnostic::warning(
                        span,
                        format!("{path} cannot be read, whether it defines {name}: {error}"),
                    ));
                    continue;
                }
            };
            if !seems_to {
                continue;
            }
            if let Some(first) = &found {
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
            found = Some(path);
        }
        let Some(path) = found else {
            self.missing.push(name.to_string());
            return None;
        };
        self.read.push(path.clone());
        self.take_in(&path, span, sources, diagnostics)?;
        self.known(name)
    }

    /// Whether something holds for the whole text of a file, or for one of its pieces.
    fn look_through(&self, path: &Path, holds: impl Fn(&str) -> bool) -> Result<bool, OpenError> {
        if std::fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
            return Err(OpenError::System(io::Error::other("it is no file")));
        }
        let opened = match open(path, &self.reading) {
            // What is wrong with the encoding of a file counts only if the file is wanted.
            Err(OpenError::NotUtf8(_)) => {
                let any = Reading {
                    encoding: Some(Encoding::Windows1252),
                    ..self.reading
                };
                open(path, &any)?
            }
            opened => opened?,
        };
        let pieces = match &opened.content {
            Content::Whole(text) => return Ok(holds(text)),
            Content::Pieces(pieces) => pieces,
        };
        let (mut pieces, mut place) = (pieces.again()?, 0);
        while let Some(piece) = pieces.text_at(place)? {
            if holds(&piece.lines) {
                return Ok(true);
            }
            place = piece.next;
        }
        Ok(false)
    }

    /// Looks through a file that is called at `span`; `None` where it cannot be read, which is said.
    fn take_in(
        &mut self,
        path: &Path,
        span: Span,
        sources: &mut Sources,
        diagnostics: &mut Diagnostics,
    ) -> Option<()> {
        let name = path.display().to_string();
        let opened = open(path, &self.reading).and_then(|opened| {
            let file = opened.content.add_to(sources, name.clone())?;
            Ok((opened, file))
        });
        let (opened, file) = match opened {
            Ok(opened) => opened,
            Err(error) => {
                let message = format!("{name} cannot be read: {error}");
                let unreadable = Diagnostic::error(span, message);
                diagnostics.push(match error {
                    OpenError::NotUtf8(_) => {
                        unreadable.help("leave --encoding out, or name the encoding of all files")
                    }
                    _ => unreadable,
                });
                return None;
            }
        };
        if let Some(guessed) = opened.guessed {
            diagnostics.note_encoding(&name, guessed);
        }
        // What cannot be read is said by those who read it.
        if fillers::is_empty(sources.file(file)).unwrap_or(false) {
            diagnostics.push(nothing_to_call(file));
        }
        self.add_file(file, path, sources, diagnostics);
        Some(())
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
        // What cannot be read is said by those who read it.
        if fillers::is_nul(sources.file(file)).unwrap_or(false) {
            diagnostics.push(fillers::nothing_but_nul(file));
        }
        let routines = (self.read_routines)(file, &stem(path), sources, diagnostics);
        let known = self.routines.len();
        self.routines.extend(routines.into_iter().map(Rc::new));
        if let Some(first) = self.routines.get(known) {
            self.firsts.push((path.to_path_buf(), Rc::clone(first)));
        }
    }
}

/// A subprogram file that was not transferred, or an empty one: the program would go on as if it had run.
fn nothing_to_call(file: usize) -> Diagnostic {
    let message =
        "there is no block in this subprogram: nothing that a machine could do, and no end";
    Diagnostic::error(Span::start_of(file), message)
        .help("send the file once more, or write its end into it (M17, M99 or the like) if it is to do nothing")
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
        let extension = path.extension().unwrap_or_default().to_string_lossy();
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

/// The folder inside of others, upper or lower case in any mixture; `_N_JOB_WPD` of the control may be called JOB or
/// JOB.WPD.
fn subfolder(folder: &Path, inside: &[String]) -> Option<PathBuf> {
    let mut folder = folder.to_path_buf();
    for name in inside {
        let entries = std::fs::read_dir(&folder).into_iter().flatten();
        let is_wanted = |path: &PathBuf| {
            let found = path.file_name().unwrap_or_default().to_string_lossy();
            let found = found.to_ascii_uppercase();
            path.is_dir() && found.strip_suffix(".WPD").unwrap_or(&found) == name
        };
        let entries = entries.filter_map(|entry| entry.ok().map(|entry| entry.path()));
        folder = entries.filter(is_wanted).min()?;
    }
    Some(folder)
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
