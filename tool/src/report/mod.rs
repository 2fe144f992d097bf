//! `framepath report`: what the planner did with a program, from a recording of every servo cycle.
//!
//! The files in the order of the work: [`recording`] reads, [`differences`] finds the peaks of velocity,
//! acceleration and jerk, [`frame_changes`] the changes of the frame; [`following`] compares the
//! executed path with the programmed path; [`summary`] holds all figures and [`findings`] draws the
//! conclusions; [`text`] and [`mod@page`] show them, the latter with the few points that [`decimation`]
//! leaves.

mod decimation;
mod differences;
mod error;
mod findings;
mod following;
mod frame_changes;
mod page;
mod recording;
mod short_lines;
mod summary;
mod text;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

pub use error::ReportError;

use crate::arguments::{file_name, positive};
use crate::dialects::Dialect;
use crate::dialects::program_options::ProgramOptions;
use crate::encoding::decode;
use crate::format::significant;
use crate::json;
use crate::machine::configuration::{AXIS_LETTERS, Machine};
use crate::machine::ini::Ini;
use crate::machine::warn_of;
use crate::output::{OutputFile, overwrites};
use crate::part_program::contour;
use crate::program::contour::ContourMove;
use crate::program::trace::Setup;
use page::Listing;
use recording::Recording;
use summary::{Report, Verdict};

/// Arguments of `framepath report`.
#[derive(Clone, Debug, clap::Args)]
pub struct ReportArguments {
    /// Recording of a run: CSV with one row for every servo cycle, header
    /// time,id,line,joint.0,..,axis.x,..
    #[arg(long, value_name = "FILE.csv")]
    pub recording: PathBuf,
    /// INI file of the machine that was recorded
    #[arg(long, value_name = "MACHINE.ini")]
    pub ini: PathBuf,
    /// Headline of the report [default: name of the program, or of the recording]
    #[arg(long, value_name = "TEXT")]
    pub title: Option<String>,
    /// With --dialect: how far the executed path may be from the programmed path (G64 P), in machine units
    #[arg(
        long,
        value_name = "LENGTH",
        value_parser = positive,
        allow_negative_numbers = true,
        requires = "dialect"
    )]
    pub tolerance: Option<f64>,
    /// End with exit status 1 where a limit or the tolerance was exceeded or the path was left, or where that cannot be
    /// told, and say which
    #[arg(long)]
    pub check: bool,
    /// All figures as JSON in place of the text (docs/json.md)
    #[arg(long)]
    pub json: bool,
    /// Write a page with drawings to this file: one file that needs no network
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Dialect of PROGRAM, for example sinumerik: compare with the path that it programs.
    /// Without it PROGRAM is what LinuxCNC ran, and is only listed
    #[arg(long, value_enum, value_name = "DIALECT", requires = "program")]
    pub dialect: Option<Dialect>,
    /// How the program is read.
    #[command(flatten)]
    pub reading: ProgramOptions,
    /// Program that was recorded
    #[arg(value_name = "PROGRAM")]
    pub program: Option<PathBuf>,
}

/// Makes the report: text or JSON on standard output, a page into a file where asked for. With a
/// dialect, the recording is compared with the path of the program in that dialect. Where the work
/// offsets are is not in the recording: the path is that without any.
///
/// # Errors
/// Unreadable or unusable files; then there is no output at all.
pub fn run(arguments: &ReportArguments) -> Result<(), ReportError> {
    let ini = Ini::read(&arguments.ini)?;
    let machine = Machine::from_ini(&ini)?;
    let contour = programmed(arguments, &machine)?;
    refuse_to_overwrite(arguments, &ini)?;
    let members = machine.joints.iter().chain(&machine.axes);
    warn_of(ini.passed_over());
    warn_of(members.flat_map(|member| &member.assumed));
    let mut recording = Recording::read(&arguments.recording)?;
    let letter_order = |letter: char| AXIS_LETTERS.find(letter.to_ascii_uppercase());
    recording
        .axes
        .sort_by_key(|(letter, _)| letter_order(*letter));
    check_match(arguments, &machine, &recording)?;
    let listing = match &arguments.program {
        Some(program) => Some(Listing {
            name: file_name(program),
            text: decode(&std::fs::read(program).map_err(|source| ReportError::Read {
                file: program.clone(),
                source,
            })?),
            by_source: arguments.dialect.is_some(),
        }),
        None => None,
    };

    let recording_name = file_name(&arguments.recording);
    let title = title(arguments);
    let analysis = summary::analyse(&title, &machine, &recording, &contour, arguments.tolerance);
    let text = text::render(&analysis.report, &recording_name)
        .map_err(|error| unwritable_output(io::Error::other(error)))?;
    if let Some(file) = &arguments.html {
        let page = page::render(
            &analysis,
            &recording,
            &recording_name,
            &text,
            &contour,
            listing.as_ref(),
        );
        page.map_err(io::Error::from)
            .and_then(|page| written(file, &page)?.finish())
            .map_err(|source| ReportError::Write {
                file: file.clone(),
                source,
            })?;
    }
    print(arguments, &analysis.report, text).map_err(unwritable_output)?;
    match analysis.report.verdict {
        Verdict::Fail if arguments.check => Err(ReportError::NotKept(findings(&analysis.report))),
        Verdict::Incomplete if arguments.check => {
            Err(ReportError::Incomplete(findings(&analysis.report)))
        }
        _ => Ok(()),
    }
}

/// The path that the program has in its dialect, as it was given to `framepath filter` on this machine; empty without a dialect.
fn programmed(
    arguments: &ReportArguments,
    machine: &Machine,
) -> Result<Vec<ContourMove>, ReportError> {
    let options = &arguments.reading;
    let (Some(dialect), Some(program)) = (arguments.dialect, &arguments.program) else {
        return match options.is_default() {
            true => Ok(Vec::new()),
            false => Err(ReportError::Option(
                "options that say how PROGRAM is read need --dialect, without which it is only listed: \
                 name its dialect, or leave them out"
                    .to_owned(),
            )),
        };
    };
    options.contradiction().map_err(ReportError::Option)?;
    options.folders().map_err(ReportError::Option)?;
    let in_inch = machine.length_unit == "in";
    let settings = options.settings(program, Some(arguments.ini.clone()), in_inch)?;
    Ok(contour(dialect, program, &settings, &Setup::default())?)
}

/// The page may not take the place of what the report is made from.
fn refuse_to_overwrite(arguments: &ReportArguments, ini: &Ini) -> Result<(), ReportError> {
    let named = [&arguments.recording, &arguments.ini];
    let named = named.into_iter().chain(&arguments.program);
    let included = ini.entries().iter().map(|entry| &*entry.place.file);
    let read: Vec<&Path> = named.map(PathBuf::as_path).chain(included).collect();
    match overwrites(arguments.html.as_deref(), &read) {
        Some(file) => Err(ReportError::Overwritten(file.to_owned())),
        None => Ok(()),
    }
}

/// In one line.
fn findings(report: &Report) -> String {
    report.findings.join("; ")
}

/// As asked for, or the name of what was recorded.
fn title(arguments: &ReportArguments) -> String {
    arguments.title.clone().unwrap_or_else(|| {
        let named = arguments.program.as_ref().unwrap_or(&arguments.recording);
        named.file_stem().map_or_else(
            || file_name(named),
            |stem| stem.to_string_lossy().into_owned(),
        )
    })
}

fn unwritable_output(source: io::Error) -> ReportError {
    ReportError::Write {
        file: PathBuf::from("standard output"),
        source,
    }
}

/// The figures on standard output, all of them at once.
fn print(arguments: &ReportArguments, report: &Report, mut text: String) -> io::Result<()> {
    let mut output = io::stdout().lock();
    if arguments.json {
        return json::write(&mut output, "report", report);
    }
    if let Some(file) = &arguments.html {
        text.push_str(&format!("Page: {}\n", file.display()));
    }
    output.write_all(text.as_bytes())?;
    output.flush()
}

/// A file with its content, which takes its place when it is finished.
fn written(file: &Path, content: &str) -> io::Result<OutputFile> {
    let mut file = OutputFile::create(file)?;
    file.write_all(content.as_bytes())?;
    Ok(file)
}

/// Recording and INI file have to describe the same machine, or limits would be compared with
/// the wrong columns.
fn check_match(
    arguments: &ReportArguments,
    machine: &Machine,
    recording: &Recording,
) -> Result<(), ReportError> {
    let fail = |problem: String| {
        Err(ReportError::Mismatch {
            recording: arguments.recording.clone(),
            ini: arguments.ini.clone(),
            problem,
        })
    };
    if recording.joints.len() != machine.joints.len() {
        return fail(format!(
            "{} joints are recorded, [KINS]KINEMATICS names {}; record joint.0 to joint.{}",
            recording.joints.len(),
            machine.joints.len(),
            machine.joints.len() - 1
        ));
    }
    let recorded: String = recording.axes.iter().map(|(letter, _)| *letter).collect();
    let named: String = machine
        .axes
        .iter()
        .map(|axis| axis.letter.to_ascii_lowercase())
        .collect();
    if recorded != named {
        return fail(format!(
            "the axes `{recorded}` are recorded, [TRAJ]COORDINATES (or [KINS]KINEMATICS) names `{named}`; record a \
             column axis.L for each"
        ));
    }
    let period = recording.period();
    if (period / machine.servo_period - 1.0).abs() > 0.01 {
        return fail(format!(
            "the rows are {} ms apart, [EMCMOT]SERVO_PERIOD is {} ms; record every servo cycle, \
             and give the INI file that was used",
            significant(period * 1e3, 6),
            significant(machine.servo_period * 1e3, 6)
        ));
    }
    Ok(())
}
