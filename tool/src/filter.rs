//! `framepath filter`: a part program of another control in, LinuxCNC G-code out.
//!
//! Fits into LinuxCNC's `[FILTER]`: the program goes to standard output, and only when all of it
//! could be translated; progress and errors go to standard error.

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::settings::{IncrementBase, Settings};
use crate::dialects::{Dialect, evaluate};
use crate::encoding::decode;
use crate::program::Program;
use crate::program::contour::ContourMove;
use crate::program::trace::{self, Setup, TraceError};
use crate::source::Sources;
use crate::write::{self, WriteSettings};
use clap::Args;
use std::path::{Path, PathBuf};

/// How frames are carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Backend {
    /// By the frame kinematics: calls of its subroutines, moves as programmed.
    Kinematics,
    /// By rewriting the coordinates: runs on any machine, frames that tilt the plane are refused.
    Program,
    /// By rewriting the coordinates where that is possible, else by the frame kinematics.
    Auto,
}

/// Arguments of `framepath filter`.
#[derive(Clone, Debug, Args)]
pub struct FilterArguments {
    /// The language of the part program
    #[arg(long, value_enum)]
    pub dialect: Dialect,
    /// How frames are carried out
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: Backend,
    /// Folder with subprogram files; may be given several times. The folder of FILE comes first
    #[arg(long, value_name = "DIR")]
    pub subprograms: Vec<PathBuf>,
    /// LinuxCNC's unit of length is the inch: programs are taken as inch unless they say otherwise
    #[arg(long)]
    pub machine_in_inch: bool,
    /// What an increment counts from when the frame changed since the axis moved last
    #[arg(long, value_enum, default_value = "programmed")]
    pub increment_after_frame: IncrementBase,
    /// Leave out blocks that begin with /
    #[arg(long)]
    pub skip_blocks: bool,
    /// M function that is passed on to LinuxCNC; may be given several times
    #[arg(long, value_name = "NUMBER", value_delimiter = ',')]
    pub pass_m: Vec<u32>,
    /// Value of an R parameter before the program begins; may be given several times
    #[arg(long, value_name = "R5=VALUE", value_parser = variable)]
    pub set: Vec<(String, f64)>,
    /// Number of a tool that the program calls by name; may be given several times
    #[arg(long, value_name = "NAME=NUMBER", value_parser = tool_name)]
    pub tool: Vec<(String, u32)>,
    /// Largest distance of the chords from the ellipse that unequal scales make of an arc, machine
    /// units
    #[arg(long, value_name = "LENGTH", default_value_t = 0.005, value_parser = tolerance)]
    pub chord_tolerance: f64,
    /// The part program
    pub file: PathBuf,
}

impl FilterArguments {
    fn settings(&self) -> Settings {
        Settings {
            subprogram_folders: self.subprograms.clone(),
            machine_in_inch: self.machine_in_inch,
            increment_after_frame: self.increment_after_frame,
            skip_blocks: self.skip_blocks,
            passed_m: self.pass_m.clone(),
            variables: self.set.iter().cloned().collect(),
            tool_names: self.tool.iter().cloned().collect(),
            ..Settings::default()
        }
    }
}

fn variable(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("write R5=12.5")?;
    let number = name
        .strip_prefix(['R', 'r'])
        .and_then(|number| number.parse::<u32>().ok());
    let value: Option<f64> = value
        .trim()
        .parse()
        .ok()
        .filter(|value: &f64| value.is_finite());
    match (number, value) {
        (Some(number), Some(value)) => Ok((format!("R{number}"), value)),
        _ => Err("write R5=12.5".to_string()),
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if (1e-6..=10.0).contains(&value) => Ok(value),
        _ => Err("a length from 0.000001 to 10 is needed".to_string()),
    }
}

fn tool_name(text: &str) -> Result<(String, u32), String> {
    let (name, number) = text.rsplit_once('=').ok_or("write NAME=NUMBER")?;
    let number = number.trim().parse().map_err(|_| "write NAME=NUMBER")?;
    Ok((name.to_string(), number))
}

/// Why nothing was written: the text for standard error.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused(pub String);

impl std::fmt::Display for Refused {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.0)
    }
}

impl std::error::Error for Refused {}

/// Translates a part program. `progress` is told percents.
pub fn filter(
    arguments: &FilterArguments,
    progress: &mut dyn FnMut(u32),
) -> Result<String, Refused> {
    let settings = arguments.settings();
    progress(0);
    let Evaluated {
        program,
        sources,
        mut diagnostics,
    } = read(arguments.dialect, &arguments.file, &settings)?;
    progress(50);
    let warnings: Vec<String> = diagnostics
        .warnings()
        .map(|warning| format!("line {}: {}", sources.line(warning.span), warning.message))
        .collect();
    let write_settings = WriteSettings {
        dialect: arguments.dialect.name(),
        machine_in_inch: arguments.machine_in_inch,
        sources: &sources,
        chord_tolerance: arguments.chord_tolerance,
        arc_tolerance: &settings.arc_tolerance,
        warnings: &warnings,
    };
    let mut last = 50;
    let mut half = |share: f64| {
        let percent = 50 + (50.0 * share) as u32;
        if percent > last {
            last = percent;
            progress(percent);
        }
    };
    let text = match arguments.backend {
        Backend::Kinematics => {
            write::kinematics::write(&program, &write_settings, &mut diagnostics, &mut half)
        }
        Backend::Program => {
            write::rewrite::write(&program, &write_settings, &mut diagnostics, &mut half)
        }
        Backend::Auto => {
            let mut attempt = Diagnostics::default();
            let text = write::rewrite::write(&program, &write_settings, &mut attempt, &mut half);
            match attempt.iter().next() {
                None => text,
                Some(reason) => {
                    let line = sources.line(reason.span);
                    let mut warnings = warnings.clone();
                    warnings.push(format!(
                        "needs the frame kinematics: line {line}: {}",
                        reason.message
                    ));
                    let write_settings = WriteSettings {
                        warnings: &warnings,
                        ..write_settings
                    };
                    write::kinematics::write(&program, &write_settings, &mut diagnostics, &mut half)
                }
            }
        }
    };
    if diagnostics.errors() > 0 {
        return Err(refusal(&diagnostics, &sources));
    }
    Ok(text)
}

/// A program that could be evaluated, with its files and warnings.
struct Evaluated {
    program: Program,
    sources: Sources,
    diagnostics: Diagnostics,
}

fn read(dialect: Dialect, file: &Path, settings: &Settings) -> Result<Evaluated, Refused> {
    let bytes = std::fs::read(file).map_err(|error| {
        Refused(format!(
            "error: {} cannot be read: {error}\n",
            file.display()
        ))
    })?;
    let mut sources = Sources::default();
    let mut diagnostics = Diagnostics::default();
    sources.add(file.display().to_string(), decode(&bytes));
    let program = evaluate(dialect, file, settings, &mut sources, &mut diagnostics);
    if diagnostics.errors() > 0 {
        return Err(refusal(&diagnostics, &sources));
    }
    Ok(Evaluated {
        program,
        sources,
        diagnostics,
    })
}

/// The contour of a part program, machine coordinates; see [`trace::contour`].
///
/// # Errors
///
/// The text of all errors in the program, as `framepath filter` shows them.
pub fn contour(
    dialect: Dialect,
    file: &Path,
    settings: &Settings,
    setup: &Setup,
) -> Result<Vec<ContourMove>, Refused> {
    let Evaluated {
        program,
        sources,
        mut diagnostics,
    } = read(dialect, file, settings)?;
    trace::contour(&program, setup, &settings.arc_tolerance).map_err(|error| {
        let (origin, message) = match error {
            TraceError::Arc(origin, _) => (origin, "this arc does not reach its end"),
            TraceError::Frame(origin, _) => (origin, "the frame of this move has no inverse"),
        };
        diagnostics.push(Diagnostic::error(origin.span, message));
        refusal(&diagnostics, &sources)
    })
}

fn refusal(diagnostics: &Diagnostics, sources: &Sources) -> Refused {
    let mut text = diagnostics.render(sources);
    let errors = match diagnostics.errors() {
        1 => "1 error".to_string(),
        count => format!("{count} errors"),
    };
    text.push_str(&format!("{errors}: nothing was written\n"));
    Refused(text)
}
