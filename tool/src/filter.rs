//! `framepath filter`: a part program of another control in, LinuxCNC G-code out.
//!
//! Fits into LinuxCNC's `[FILTER]`: the program goes to standard output, and only when all of it
//! could be translated; progress and errors go to standard error.

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::guess::{guess, undecided};
use crate::dialects::settings::{
    IncrementBase, MOST_BLOCKS, MirrorOutsideXy, MirroredCircle, Settings,
};
use crate::dialects::{Dialect, evaluate};
use crate::encoding::decode;
use crate::program::contour::ContourMove;
use crate::program::trace::{self, Setup, TraceError};
use crate::program::{PathControl, Program};
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
    /// Value of a variable (R5, P5, V.P.NAME) before the program begins; may be given several times
    #[arg(long, value_name = "R5=VALUE", value_parser = variable)]
    pub set: Vec<(String, f64)>,
    /// Row of the tool table that holds a further edge (D2 to D9) of a tool; may be given several times
    #[arg(long, value_name = "TOOL.EDGE=ROW", value_parser = edge)]
    pub edge: Vec<((u32, u32), u32)>,
    /// The feed in force when the program begins, machine units per minute
    #[arg(long, value_name = "FEED", value_parser = feed)]
    pub feed: Option<f64>,
    /// How corners are passed until the program changes it: exactly (G61, with stops at corners only),
    /// with a stop at the end of every move (G61.1), rounded as the machine has it (G64), or rounded by
    /// at most so many mm (a number: G64 with that P)
    #[arg(long, value_name = "G61|G61.1|G64|P", default_value = "G61", value_parser = path_mode)]
    pub path_mode: PathControl,
    /// How many blocks the program may run, besides twice the lines that it has, before it is taken
    /// for one that never ends
    #[arg(long, value_name = "NUMBER", default_value_t = MOST_BLOCKS, value_parser = most_blocks)]
    pub most_blocks: usize,
    /// Number of a tool that the program calls by name; may be given several times
    #[arg(long, value_name = "NAME=NUMBER", value_parser = tool_name)]
    pub tool: Vec<(String, u32)>,
    /// What G21, G22 and G23 of ISG programs mirror outside of G17
    #[arg(long, value_enum, default_value = "refuse")]
    pub mirror_outside_xy: MirrorOutsideXy,
    /// What becomes of a full circle with an absolute centre right after a mirror of an ISG program
    #[arg(long, value_enum, default_value = "refuse")]
    pub mirrored_circle: MirroredCircle,
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
            feed: self.feed,
            path_mode: self.path_mode_of_machine(),
            most_blocks: self.most_blocks,
            tool_edges: self.edge.iter().copied().collect(),
            tool_names: self.tool.iter().cloned().collect(),
            mirror_outside_xy: self.mirror_outside_xy,
            mirrored_circle: self.mirrored_circle,
            ..Settings::default()
        }
    }

    /// The path mode with its tolerance in machine units.
    fn path_mode_of_machine(&self) -> PathControl {
        match self.path_mode {
            PathControl::Continuous {
                tolerance: Some(tolerance),
            } if self.machine_in_inch => PathControl::Continuous {
                tolerance: Some(tolerance / 25.4),
            },
            mode => mode,
        }
    }
}

fn variable(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("write R5=12.5")?;
    let name = name.trim().to_ascii_uppercase();
    let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || "._[]".contains(c));
    let value: Option<f64> = value
        .trim()
        .parse()
        .ok()
        .filter(|value: &f64| value.is_finite());
    match (is_name, value) {
        (true, Some(value)) => Ok((name, value)),
        _ => Err("write R5=12.5".to_string()),
    }
}

fn edge(text: &str) -> Result<((u32, u32), u32), String> {
    let parse = || {
        let (edge, row) = text.split_once('=')?;
        let (tool, edge) = edge.split_once('.')?;
        let numbers = [tool, edge, row].map(|number| number.trim().parse().ok());
        match numbers {
            [Some(tool), Some(edge @ 2..=9), Some(row)] => Some(((tool, edge), row)),
            _ => None,
        }
    };
    parse().ok_or_else(|| "write 3.2=13 for edge D2 of tool 3 in row 13".to_string())
}

fn feed(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if f64::is_finite(value) && value > 0.0 => Ok(value),
        _ => Err("a feed above 0 is needed".to_string()),
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if (1e-6..=10.0).contains(&value) => Ok(value),
        _ => Err("a length from 0.000001 to 10 is needed".to_string()),
    }
}

fn path_mode(text: &str) -> Result<PathControl, String> {
    match text.to_ascii_uppercase().as_str() {
        "G61" => return Ok(PathControl::ExactPath),
        "G61.1" => return Ok(PathControl::ExactStop),
        "G64" => return Ok(PathControl::Continuous { tolerance: None }),
        _ => {}
    }
    match text.parse() {
        Ok(value) if (0.001..=10.0).contains(&value) => Ok(PathControl::Continuous {
            tolerance: Some(value),
        }),
        _ => Err("write G61, G61.1, G64 or a tolerance from 0.001 to 10 mm".to_string()),
    }
}

fn most_blocks(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(value) if (1..=100_000_000).contains(&value) => Ok(value),
        _ => Err("a number from 1 to 100000000 is needed".to_string()),
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

/// What is told while a program is translated.
#[derive(Clone, Debug, PartialEq)]
pub enum Told {
    /// How much is done, percent.
    Progress(u32),
    /// What the user should know.
    Note(String),
}

/// Translates a part program.
pub fn filter(arguments: &FilterArguments, tell: &mut dyn FnMut(Told)) -> Result<String, Refused> {
    let settings = arguments.settings();
    tell(Told::Progress(0));
    let Evaluated {
        program,
        sources,
        mut diagnostics,
        dialect,
        note,
    } = read(arguments.dialect, &arguments.file, &settings)?;
    note.into_iter().for_each(|note| tell(Told::Note(note)));
    tell(Told::Progress(50));
    let warnings: Vec<String> = diagnostics
        .warnings()
        .map(|warning| format!("line {}: {}", sources.line(warning.span), warning.message))
        .collect();
    let write_settings = WriteSettings {
        dialect: dialect.name(),
        machine_in_inch: arguments.machine_in_inch,
        path_mode: settings.path_mode,
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
            tell(Told::Progress(percent));
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
    dialect: Dialect,
    /// How the dialect was guessed.
    note: Option<String>,
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
    let (dialect, note) = resolve(dialect, file, &sources, &mut diagnostics);
    let program = evaluate(dialect, file, settings, &mut sources, &mut diagnostics);
    if diagnostics.errors() > 0 {
        let mut refused = refusal(&diagnostics, &sources);
        if let Some(note) = note {
            refused.0.insert_str(0, &format!("{note}\n"));
        }
        return Err(refused);
    }
    Ok(Evaluated {
        program,
        sources,
        diagnostics,
        dialect,
        note,
    })
}

/// The dialect that is meant, and how it was guessed if it was.
fn resolve(
    dialect: Dialect,
    file: &Path,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) -> (Dialect, Option<String>) {
    if dialect != Dialect::Auto {
        return (dialect, None);
    }
    let Some(guess) = guess(file, &sources.file(0).text) else {
        diagnostics.push(undecided());
        return (dialect, None);
    };
    let because = match guess.line {
        Some(line) => format!("because of line {line}"),
        None => "because of the ending of its file".to_string(),
    };
    let name = guess.dialect.name();
    let note = format!("note: taken as a {name} program, {because}; --dialect says otherwise");
    (guess.dialect, Some(note))
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
        ..
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
