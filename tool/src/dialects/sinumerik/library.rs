//! Where programs and subprograms come from: sections of the file itself, files beside it, files in
//! the folders of the settings.

use super::lexer::tokens;
use super::parser::parse;
use super::structure::Structure;
use super::syntax::{Section, Statement};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::settings::Settings;
use crate::encoding::decode;
use crate::source::{Sources, Span};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// A program or subprogram, ready to run.
#[derive(Debug)]
pub struct Routine {
    /// Its name in upper case.
    pub name: String,
    /// The file it was found in.
    pub file: usize,
    /// Its blocks.
    pub section: Section,
    /// Which blocks of it belong together.
    pub structure: Structure,
}

/// All programs that are known so far.
#[derive(Debug)]
pub struct Library {
    main: Option<Rc<Routine>>,
    routines: Vec<Rc<Routine>>,
    folders: Vec<PathBuf>,
}

impl Library {
    /// Reads file 0 of `sources`, which lies at `path`.
    pub fn new(
        path: &Path,
        settings: &Settings,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) -> Library {
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
        };
        library.add_file(0, path, sources, diagnostics);
        let main = |routine: &&Rc<Routine>| routine.section.main && routine.has_content();
        let mut candidates = library.routines.iter().filter(main);
        let first = candidates.next().cloned();
        if let Some(second) = candidates.next() {
            diagnostics.push(
                Diagnostic::error(
                    first_span(second),
                    "a second main program begins in the same file",
                )
                .help("keep one program in the file, or declare this one as a subprogram (_SPF)"),
            );
        }
        library.main = first.or(library.routines.first().cloned());
        library
    }

    /// The main program.
    pub fn main(&self) -> Option<Rc<Routine>> {
        self.main.clone()
    }

    /// The subprogram with this name, in upper case. Looks into the folders if need be.
    pub fn find(
        &mut self,
        name: &str,
        sources: &mut Sources,
        diagnostics: &mut Diagnostics,
    ) -> Option<Rc<Routine>> {
        if let Some(known) = self.known(name) {
            return Some(known);
        }
        let path = self
            .folders
            .iter()
            .find_map(|folder| in_folder(folder, name))?;
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) => {
                let span = Span {
                    file: 0,
                    start: 0,
                    end: 0,
                };
                diagnostics.push(Diagnostic::error(
                    span,
                    format!("{} cannot be read: {error}", path.display()),
                ));
                return None;
            }
        };
        let file = sources.add(path.display().to_string(), decode(&bytes));
        self.add_file(file, &path, sources, diagnostics);
        self.known(name)
    }

    fn known(&self, name: &str) -> Option<Rc<Routine>> {
        let wanted = |routine: &&Rc<Routine>| routine.name == name;
        self.routines.iter().find(wanted).cloned()
    }

    fn add_file(
        &mut self,
        file: usize,
        path: &Path,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) {
        let source = sources.file(file);
        let tokens = tokens(file, &source.text, diagnostics);
        let stem = path
            .file_stem()
            .map(|stem| stem.to_string_lossy().to_ascii_uppercase())
            .unwrap_or_default();
        let sections = parse(source, &tokens, diagnostics);
        for section in sections {
            let name = match section.name.is_empty() {
                true => stem.clone(),
                false => section.name.clone(),
            };
            let structure = Structure::of(&section, diagnostics);
            self.routines.push(Rc::new(Routine {
                name,
                file,
                section,
                structure,
            }));
        }
    }
}

impl Routine {
    fn has_content(&self) -> bool {
        self.section
            .blocks
            .iter()
            .any(|block| block.statement != Statement::Empty)
    }
}

fn first_span(routine: &Routine) -> Span {
    let blocks = &routine.section.blocks;
    blocks
        .iter()
        .find(|block| block.statement != Statement::Empty)
        .map_or(
            Span {
                file: routine.file,
                start: 0,
                end: 0,
            },
            |block| block.span,
        )
}

/// `NAME.spf` or `NAME.mpf`, upper or lower case in any mixture. With several that differ in case
/// only, the first in alphabetical order: the choice must not depend on the file system.
fn in_folder(folder: &Path, name: &str) -> Option<PathBuf> {
    let mut found: Vec<PathBuf> = std::fs::read_dir(folder)
        .ok()?
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| {
            let is = |part: Option<&std::ffi::OsStr>, wanted: &str| {
                part.is_some_and(|part| part.to_string_lossy().eq_ignore_ascii_case(wanted))
            };
            is(path.file_stem(), name)
                && (is(path.extension(), "spf") || is(path.extension(), "mpf"))
        })
        .collect();
    // A subprogram file comes before a main program of the same name.
    found.sort_by_key(|path| {
        let extension = path.extension().map(|e| e.to_ascii_lowercase());
        (extension != Some("spf".into()), path.clone())
    });
    found.into_iter().next()
}
