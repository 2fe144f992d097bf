//! `framepath filter`: a part program of another control in, LinuxCNC G-code out.
//!
//! Fits into LinuxCNC's `[FILTER]`: the program goes to standard output, and only when all of it
//! could be translated; progress and errors go to standard error.

mod options;

pub use options::{Backend, FilterArguments, PathMode};

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::About;
use crate::dialects::run_program;
use crate::dialects::settings::Settings;
use crate::output::in_temporary_folder;
use crate::part_program::{Opened, Refused, open, refusal};
use crate::program::{Block, FrameScope, Sink};
use crate::source::{Sources, Span};
use crate::write::{self, WriteSettings, Writer};
use std::io::{self, Seek, SeekFrom, Write};
use tempfile::SpooledTempFile;

/// How much of the output is held in memory, bytes; what is longer waits in a temporary file.
const HELD: usize = 8 << 20;

/// What is told while a program is translated.
#[derive(Clone, Debug, PartialEq)]
pub enum Told {
    /// How much is done, percent.
    Progress(u32),
    /// What the user should know.
    Note(String),
}

/// A program that was translated.
pub struct Translated {
    header: String,
    body: SpooledTempFile,
}

impl Translated {
    /// Writes it.
    ///
    /// # Errors
    ///
    /// Where it cannot be written.
    pub fn write_to(mut self, out: &mut impl Write) -> io::Result<()> {
        out.write_all(self.header.as_bytes())?;
        self.body.seek(SeekFrom::Start(0))?;
        io::copy(&mut self.body, out)?;
        out.flush()
    }
}

/// Translates a part program.
///
/// # Errors
///
/// The text of all that is wrong with it.
pub fn filter(
    arguments: &FilterArguments,
    tell: &mut dyn FnMut(Told),
) -> Result<Translated, Refused> {
    tell(Told::Progress(0));
    let refused = |problem| Refused(format!("error: {problem}\n"));
    arguments.contradiction().map_err(refused)?;
    arguments.program.folders().map_err(refused)?;
    let settings = arguments
        .settings()
        .map_err(|error| Refused(format!("error: {error}\n")))?;
    for warning in arguments.warnings() {
        tell(Told::Note(warning));
    }
    let opened = open(arguments.dialect, &arguments.file, &settings.reading)?;
    let mut job = Job {
        arguments,
        settings,
        opened,
        told: 0,
        tell,
    };
    job.tell_notes();
    match arguments.backend {
        Backend::Kinematics => job
            .translate(write::Backend::Kinematics, None)?
            .into_result(),
        Backend::Program => job.translate(write::Backend::Program, None)?.into_result(),
        Backend::Auto => {
            let attempt = job.translate(write::Backend::Program, None)?;
            match attempt.reason() {
                Some(reason) => job
                    .translate(write::Backend::Kinematics, Some(reason))?
                    .into_result(),
                None => attempt.into_result(),
            }
        }
    }
}

/// The translation of one program.
struct Job<'a> {
    arguments: &'a FilterArguments,
    settings: Settings,
    opened: Opened,
    told: u32,
    tell: &'a mut dyn FnMut(Told),
}

/// What a backend has made of a program that could be evaluated.
struct Attempt {
    translated: Translated,
    /// What was said about the program, and what the backend cannot do.
    diagnostics: Diagnostics,
    sources: Sources,
}

impl Attempt {
    /// Why this backend cannot carry out the program, if it cannot.
    fn reason(&self) -> Option<String> {
        let errors = self.diagnostics.iter();
        let first = errors.into_iter().find(|one| one.is_error())?;
        let line = self.sources.line(first.span);
        Some(format!(
            "needs the frame kinematics: line {line}: {}",
            first.message
        ))
    }

    fn into_result(self) -> Result<Translated, Refused> {
        match self.diagnostics.errors() {
            0 => Ok(self.translated),
            _ => Err(refusal(&self.diagnostics, &self.sources)),
        }
    }
}

impl Job<'_> {
    fn tell_notes(&mut self) {
        for note in &self.opened.notes {
            (self.tell)(Told::Note(note.clone()));
        }
    }

    /// Runs the program and writes it. `because`: what the operator is to hear about the choice of the
    /// backend.
    fn translate(
        &mut self,
        backend: write::Backend,
        because: Option<String>,
    ) -> Result<Attempt, Refused> {
        let mut sources = self.opened.sources()?;
        let mut diagnostics = Diagnostics::default();
        let mut body = SpooledTempFile::new(HELD);
        let write_settings = WriteSettings {
            dialect: self.opened.dialect.name(),
            machine_in_inch: self.arguments.machine_in_inch,
            diameters_before: self.settings.diameters_before,
            path_mode: self.settings.path_mode,
            tolerance: self.settings.tolerance,
            chord_tolerance: self.arguments.chord_tolerance,
            arc_tolerance: &self.settings.arc_tolerance,
        };
        let blocks;
        let written = {
            let mut output = Output {
                writer: write::writer(backend, &write_settings, &mut body),
                length: self.opened.length,
                told: &mut self.told,
                tell: &mut *self.tell,
                blocks: 0,
            };
            let about = About {
                sources: &mut sources,
                diagnostics: &mut diagnostics,
                sink: &mut output,
            };
            let path = &self.arguments.file;
            run_program(self.opened.dialect, path, &self.settings, about);
            blocks = output.blocks;
            output.writer.finish()
        };
        if blocks == 0 && diagnostics.errors() == 0 {
            diagnostics.push(nothing_in_it());
        }
        for note in diagnostics.notes() {
            (self.tell)(Told::Note(note.clone()));
        }
        if diagnostics.errors() > 0 {
            return Err(refusal(&diagnostics, &sources));
        }
        let refused = written.map_err(|error| {
            let error = in_temporary_folder(error);
            Refused(format!(
                "error: no room for the translated program: {error}\n"
            ))
        })?;
        let mut warnings = operator_messages(&diagnostics, &sources);
        warnings.extend(because);
        diagnostics.append(refused);
        let header = write::header(backend, &write_settings, &sources, &warnings);
        Ok(Attempt {
            translated: Translated { header, body },
            diagnostics,
            sources,
        })
    }
}

/// A file that was not transferred, or an empty one: LinuxCNC would refuse a program without its end.
fn nothing_in_it() -> Diagnostic {
    let message = "there is no block in this program: nothing that a machine could do, and no end";
    Diagnostic::error(Span::start_of(0), message)
        .help("send the file once more, or write M30 (M02) at its end if it is to do nothing")
}

/// The warnings as the operator is to see them when the program starts.
fn operator_messages(diagnostics: &Diagnostics, sources: &Sources) -> Vec<String> {
    let warnings = diagnostics.warnings();
    let message = |warning: &Diagnostic| {
        let line = sources.line(warning.span);
        format!("line {line}: {}", warning.message)
    };
    warnings.map(message).collect()
}

/// Gives the blocks to a writer and tells how far it is.
struct Output<'a> {
    writer: Box<dyn Writer + 'a>,
    /// The length of the program, bytes.
    length: u64,
    told: &'a mut u32,
    tell: &'a mut dyn FnMut(Told),
    /// How many blocks there were.
    blocks: usize,
}

impl Output<'_> {
    fn progress(&mut self, share: f64) {
        let percent = (100.0 * share.min(1.0)) as u32;
        if percent > *self.told {
            *self.told = percent;
            (self.tell)(Told::Progress(percent));
        }
    }
}

impl Sink for Output<'_> {
    fn take(&mut self, blocks: Vec<Block>, scope: FrameScope, sources: &Sources) {
        // A program that is held as a whole has been evaluated by now.
        let pieces = sources.file(0).is_windowed();
        if let Some(last) = blocks.last().filter(|last| pieces && last.origin.file == 0) {
            self.progress(last.origin.span.end as f64 / self.length.max(1) as f64);
        }
        self.blocks += blocks.len();
        for (index, block) in blocks.iter().enumerate() {
            self.writer.block(block, scope, sources);
            if !pieces && index.is_multiple_of(1024) {
                self.progress(0.5 + 0.5 * index as f64 / blocks.len() as f64);
            }
        }
        if !pieces {
            self.progress(1.0);
        }
    }
}
