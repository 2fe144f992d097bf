//! `framepath check`: what is missing, contradictory or unwise in the INI and HAL files of a machine.
//!
//! The files in the order of the work: the machine is read as LinuxCNC would, [`rules`] look at it and
//! make each [`finding`], [`stop`] works out how far each axis runs on; [`text`] shows both. Nothing is run.

mod finding;
mod rules;
mod stop;
mod text;

pub use finding::{Finding, Level};
pub use rules::FilterCheck;

use crate::hal::read_script;
use crate::json;
use crate::machine::IniError;
use crate::machine::ini::Ini;
use crate::wiring::installed::LinuxCnc;
use crate::wiring::subject::Subject;
use finding::Findings;
use serde::Serialize;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use stop::Stop;

/// Arguments of `framepath check`.
#[derive(Clone, Debug, clap::Args)]
pub struct CheckArguments {
    /// INI file of the machine
    #[arg(value_name = "MACHINE.ini")]
    pub ini: PathBuf,
    /// Folder with HAL files that is looked through first, as with `linuxcnc -H`; may be given several times
    #[arg(long, value_name = "DIR")]
    pub hal_folder: Vec<PathBuf>,
    /// All findings and figures as JSON in place of the text (docs/json.md)
    #[arg(long)]
    pub json: bool,
}

/// Why nothing was looked at.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// The INI file.
    #[error(transparent)]
    Ini(#[from] IniError),
    /// Standard output.
    #[error("the findings cannot be written: {0}")]
    Write(io::Error),
}

/// Everything that is told.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The INI file.
    pub ini: String,
    /// HAL files that were read, in their order.
    pub hal: Vec<String>,
    /// How many errors there are.
    pub errors: usize,
    /// How many warnings.
    pub warnings: usize,
    /// How many notes.
    pub notes: usize,
    /// The worst first.
    pub findings: Vec<Finding>,
    /// How far each axis runs on.
    pub stops: Vec<Stop>,
}

/// Looks at a machine, and tells it on standard output; whether there are no errors. `filter` says what is wrong with
/// the arguments of a `framepath filter`.
///
/// # Errors
/// An INI file that cannot be read, an output that cannot be written.
pub fn run(arguments: &CheckArguments, filter: FilterCheck) -> Result<bool, CheckError> {
    let (ini, problems) = Ini::read_all(&arguments.ini)?;
    let linuxcnc = LinuxCnc::in_path();
    let script = read_script(&ini, &arguments.hal_folder);
    let subject = Subject::new(ini, problems, script);
    let report = look(&subject, filter, linuxcnc.as_ref());
    let mut output = io::stdout().lock();
    let written = match arguments.json {
        true => json::write(&mut output, "check", &report),
        false => output.write_all(text::render(&report).as_bytes()),
    };
    written
        .and_then(|()| output.flush())
        .map_err(CheckError::Write)?;
    Ok(report.errors == 0)
}

/// The same with a text in place of the INI file; HAL files are those beside `file`, and no LinuxCNC is here.
pub fn look_at_text(file: &Path, text: &str, filter: FilterCheck) -> Report {
    let (ini, problems) = Ini::parse_all(file, text);
    let script = read_script(&ini, &[]);
    look(&Subject::new(ini, problems, script), filter, None)
}

fn look(subject: &Subject, filter: FilterCheck, linuxcnc: Option<&LinuxCnc>) -> Report {
    let mut findings: Findings = rules::apply(subject, filter, linuxcnc);
    let stops = stop::stops(subject);
    stop::look(subject, &stops, &mut findings);
    let findings = findings.sorted();
    let count = |level: Level| {
        findings
            .iter()
            .filter(|finding| finding.level == level)
            .count()
    };
    Report {
        ini: subject.ini.file().display().to_string(),
        hal: subject
            .script
            .files
            .iter()
            .map(|file| file.display().to_string())
            .collect(),
        errors: count(Level::Error),
        warnings: count(Level::Warning),
        notes: count(Level::Note),
        findings,
        stops,
    }
}
