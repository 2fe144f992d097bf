//! `framepath plan`: what the planner of blendtp will do with a program, before anything is cut.
//!
//! The files in the order of the work: [`setup`] is the machine, [`start`] where it begins, [`source`] the program as the task
//! controller gets it, [`drive`] runs the planner in the place of task and motion controller, with its [`joints`] where these have limits, a
//! [`spindle`] and what [`kinds`] of moves there are beside it, moves coming one a cycle or as recorded [`arrivals`], with their [`lines`]; [`collector`] takes in each servo
//! cycle, a [`sample`]: [`cause`] says what limits the machine, [`places`] where time is lost, [`evenness`] how much of cutting is near the feed,
//! [`deviation`] how far the plan is from the program, [`profile`] and [`polyline`] are for the
//! drawings; [`figures`] holds all of it, the greatest [`speed`] and the [`distances`] among it, with [`findings`] of what is not kept; [`text`], [`page`], [`svg`] and [`csv`] show it, with a
//! [`listing`] of the program. Nothing is kept of a cycle, so that a program may have any length.

mod arrivals;
mod cause;
mod collector;
mod csv;
mod deviation;
mod dip;
mod distances;
mod drive;
mod error;
mod evenness;
mod figures;
mod findings;
mod joint_way;
mod joints;
mod kinds;
mod limit;
mod lines;
mod listing;
mod page;
mod places;
mod polyline;
mod profile;
mod progress;
mod sample;
mod setup;
mod soft_limits;
mod source;
mod speed;
mod spindle;
mod start;
mod supply;
mod svg;
mod text;
mod times;

pub use error::PlanError;

use crate::arguments::{file_name, period, positive, rate};
use crate::json;
use crate::layer::LayerSettings;
use crate::layer::stream::LayerStream;
use crate::machine::limits::{Jerk, LimitChanges};
use crate::output::{OutputFile, named_twice, overwrites};
use crate::signals::stop_on_signals;
use arrivals::Arrivals;
use collector::Collector;
use csv::Table;
use drive::Drive;
use figures::{Figures, SurfaceFigures};
use limit::Limit;
use progress::Progress;
use serde::Serialize;
use setup::Setup;
use source::Source;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use supply::Supply;
use times::Times;

/// Stack for a planner, which is a few megabytes and made in place.
const STACK: usize = 256 << 20;

/// Arguments of `framepath plan`.
#[derive(Clone, Debug, clap::Args)]
pub struct PlanArguments {
    /// G-code programs, as LinuxCNC runs them
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// INI file of the machine: limits, servo period, units, parameters, tool table, subroutines
    /// [default: a machine in mm with 100 mm/s, 1000 mm/s2 and 20000 mm/s3 on each axis, 1 ms]
    #[arg(long, value_name = "MACHINE.ini")]
    pub ini: Option<PathBuf>,
    /// As programs run behind G43.4 or M64 P0: X Y Z are the tool centre point on the table of framekins that the INI file
    /// names, whose joints have limits
    #[arg(long, requires = "ini")]
    pub tool_centre_point: bool,
    /// As programs run behind a switch of the kinematics to this type (M428, M429, M430): of the kinematics module that the
    /// INI file names, or HAL files with inner=, whose joints have limits
    #[arg(long, requires = "ini", value_name = "TYPE", value_parser = clap::value_parser!(i32).range(0..16))]
    pub kinematics_type: Option<i32>,
    /// Limits of the axes in place of those of the machine, mm (degrees) and seconds: V=100,A=1000
    /// for all, XY:V=50 for some, several separated by `;`
    #[arg(long, value_name = "LIMITS")]
    pub limits: Option<LimitChanges>,
    /// Jerk limits in place of those of the machine: `unlimited`, a number (mm/s3), or a number of
    /// accelerations per second (20A)
    #[arg(long, value_name = "JERK")]
    pub jerk: Option<Jerk>,
    /// Greatest velocity along the path, mm/s, in place of [TRAJ]MAX_LINEAR_VELOCITY
    #[arg(long, value_name = "V", value_parser = rate)]
    pub velocity_limit: Option<f64>,
    /// Servo period in place of [EMCMOT]SERVO_PERIOD
    #[arg(long, value_name = "SECONDS", value_parser = period)]
    pub period: Option<f64>,
    /// Raise every F to at least this; feeds per turn (G95) stay as they are
    #[arg(long, value_name = "MM_MIN", value_parser = rate)]
    pub feed_at_least: Option<f64>,
    /// Hold the machine at the start until the queue is full or the program waits, as a feed hold
    /// does: the plan then depends less on how fast moves come
    #[arg(long)]
    pub fill_queue: bool,
    /// Hand over each move when it came in a LinuxCNC that ran, in place of one in each servo cycle.
    /// Lines of a servo cycle, the moves that have come by then, and what all feeds are multiplied by
    #[arg(long, value_name = "FILE", conflicts_with = "fill_queue")]
    pub arrivals: Option<PathBuf>,
    /// blendtp.rotary-tolerance: how far rotary axes may leave the program, or the tool axis where framekins
    /// has the tool centre point on, degrees [default: as many as P has mm]
    #[arg(long, value_name = "DEGREES", value_parser = positive)]
    pub rotary_tolerance: Option<f64>,
    /// blendtp.default-tolerance: tolerance of runs of short moves under G64 without P, machine units
    /// [default: 0.02]
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    pub default_tolerance: Option<f64>,
    /// blendtp.corners-inside: corners are rounded on their inner side only
    #[arg(long)]
    pub corners_inside: bool,
    /// Leave out blocks that begin with a slash, as LinuxCNC does while block delete is on
    #[arg(long)]
    pub skip_blocks: bool,
    /// The longest program, bytes
    #[arg(long, value_name = "BYTES", default_value_t = 1_000_000_000, value_parser = clap::value_parser!(u64).range(1..))]
    pub most_bytes: u64,
    /// How long the plan of a program may take, seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 3600, value_parser = clap::value_parser!(u64).range(1..=86_400))]
    pub most_seconds: u64,
    /// End with exit status 1 where the plan exceeds a limit or a tolerance, and say which
    #[arg(long)]
    pub check: bool,
    /// All figures as JSON in place of the text (docs/json.md)
    #[arg(long)]
    pub json: bool,
    /// Write a page with drawings to this file: one file that needs no network
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Write a drawing of path and speed to this file
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Write a row for every servo cycle to this file
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Write when the machine is where in the program to this file, for the operator's time left: PROGRAM.times beside the
    /// program
    #[arg(long, value_name = "FILE")]
    pub times: Option<PathBuf>,
}

impl PlanArguments {
    /// The files that are asked for.
    fn written(&self) -> [&Option<PathBuf>; 4] {
        [&self.html, &self.svg, &self.csv, &self.times]
    }
}

/// What `--json` prints.
#[derive(Serialize)]
struct Programs<'a> {
    programs: &'a [Figures],
}

/// Plans; text or JSON on standard output, drawings into files where asked for.
///
/// # Errors
/// See [`PlanError`]. Then nothing is on standard output, and files are as they were before.
pub fn run(arguments: &PlanArguments) -> Result<(), PlanError> {
    let files = arguments.written();
    let single = files.iter().any(|file| file.is_some()) || arguments.arrivals.is_some();
    if arguments.files.len() > 1 && single {
        let problem = "--html, --svg, --csv, --times and --arrivals are for one program: plan them one by one";
        return Err(PlanError::Option(problem.to_owned()));
    }
    if let Some(file) = named_twice(&files) {
        return Err(PlanError::Option(format!(
            "{}: two of --html, --svg, --csv and --times would be written there: give each a file of its own",
            file.display()
        )));
    }
    let setup = Setup::new(arguments)?;
    let of_arguments = arguments
        .files
        .iter()
        .chain(&arguments.ini)
        .chain(&arguments.arrivals);
    let read: Vec<&Path> = of_arguments
        .chain(&setup.read)
        .map(PathBuf::as_path)
        .collect();
    refuse_to_overwrite(arguments, &read)?;
    crate::machine::warn_of(&setup.assumed);
    let unheard = |error| PlanError::Option(format!("Ctrl-C cannot be waited for: {error}"));
    // Or what is begun would be left behind.
    let stop = stop_on_signals().map_err(unheard)?;
    let mut all = Vec::new();
    for file in &arguments.files {
        all.push(in_a_thread(|| plan(file, &setup, arguments, &stop))?);
    }
    let mut output = std::io::stdout().lock();
    let unwritable = |source| PlanError::unwritable(Path::new("standard output"), source);
    if arguments.json {
        let programs = Programs { programs: &all };
        json::write(&mut output, "plan", &programs).map_err(unwritable)?;
    } else {
        let texts = all.iter().map(text::render);
        let texts = texts.collect::<Result<Vec<_>, _>>();
        let texts = texts.map_err(|error| unwritable(io::Error::other(error)))?;
        write!(output, "{}", texts.join("\n\n")).map_err(unwritable)?;
        for file in files.into_iter().flatten() {
            writeln!(output, "\nWritten: {}", file.display()).map_err(unwritable)?;
        }
    }
    // Else what does not end with a line is written at the end of the process, whose errors nobody sees.
    output.flush().map_err(unwritable)?;
    match not_kept(&all) {
        Some(problem) if arguments.check => Err(PlanError::NotKept(problem)),
        _ => Ok(()),
    }
}

/// No file that is asked for may take the place of one that is `read`.
fn refuse_to_overwrite(arguments: &PlanArguments, read: &[&Path]) -> Result<(), PlanError> {
    let written = arguments.written().into_iter();
    match overwrites(written.filter_map(|file| file.as_deref()), read) {
        Some(file) => Err(PlanError::Option(format!(
            "{}: this file is read for the plan, and --html, --svg, --csv or --times would be written there: give it a file \
             of its own",
            file.display()
        ))),
        None => Ok(()),
    }
}

/// Everything that is not kept, in one line.
fn not_kept(all: &[Figures]) -> Option<String> {
    let of_program = |figures: &Figures| -> Vec<String> {
        let told = |finding: &String| format!("{}: {finding}", figures.program);
        figures.findings.iter().map(told).collect()
    };
    let findings: Vec<String> = all.iter().flat_map(of_program).collect();
    (!findings.is_empty()).then(|| findings.join("; "))
}

/// Runs `work` where a planner has room.
fn in_a_thread<T: Send>(
    work: impl FnOnce() -> Result<T, PlanError> + Send,
) -> Result<T, PlanError> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new()
            .stack_size(STACK)
            .spawn_scoped(scope, work)
            .map_err(|error| PlanError::Option(format!("the plan has no room: {error}")))?;
        thread
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

/// Begins to write a file that was asked for.
fn begin(file: Option<&PathBuf>) -> Result<Option<OutputFile>, PlanError> {
    let begun = file
        .map(|file| OutputFile::create(file).map_err(|source| PlanError::unwritable(file, source)));
    begun.transpose()
}

/// Plans a program and writes its files, all of them when nothing can be refused any more.
fn plan(
    file: &Path,
    setup: &Setup,
    arguments: &PlanArguments,
    stop: &Arc<AtomicBool>,
) -> Result<Figures, PlanError> {
    let settings = LayerSettings {
        limits: setup.limits,
        feed_at_least: arguments.feed_at_least,
    };
    let layer = LayerStream::new(&settings, setup.surroundings.start);
    let mut limit = Limit::check(file, arguments, stop)?;
    let mut source = Source::open(file, setup, layer, limit.most_time(), stop)?;
    let name = file_name(file);
    let mut progress = Progress::new(&name, listing::count_lines(file));
    // Now: that a file cannot be written should not turn out behind a long plan.
    let html = begin(arguments.html.as_ref())?;
    let svg = begin(arguments.svg.as_ref())?;
    let csv = begin(arguments.csv.as_ref())?;
    let times = begin(arguments.times.as_ref())?;
    let mut table = csv.map(|csv| Table::new(csv, setup)).transpose()?;
    let mut times = times
        .map(|times| Times::new(times, file, setup.period))
        .transpose()?;
    let supply = match &arguments.arrivals {
        Some(recording) => Supply::Recorded(Arrivals::read(recording)?),
        None if arguments.fill_queue => Supply::BeforeStart,
        None => Supply::EveryCycle,
    };
    let handed_over = supply.name();
    let mut drive = Drive::new(file, setup, supply)?;
    let mut collector = Collector::new(setup);
    let mut end = 0.0;
    while let Some(sample) = drive
        .step(&mut source, |handed| collector.add(&handed))
        .map_err(|error| setup.explained(error))?
    {
        let shown = collector.note(&sample);
        if let Some(table) = &mut table {
            table.note(&shown)?;
        }
        if let Some(times) = &mut times {
            times.note(&sample, shown.line)?;
        }
        end = shown.time;
        progress.note(shown.line, shown.time);
        limit.note(|| drive.line(&sample))?;
    }
    progress.finish();
    crate::machine::warn_of(drive.warnings());
    crate::machine::warn_of(&source.warnings());
    let collected = collector.finish();
    if collected.cycles == 0 {
        return Err(PlanError::NoMoves(file.to_owned()));
    }
    let mut figures = Figures::new(&name, setup, (source.moves, handed_over), &collected);
    figures.surface_speed = drive.surface_speeds().map(SurfaceFigures::from);
    let listing = listing::read(file, &figures, &collected);
    listing.put_into(&mut figures);
    let mut files = Vec::from_iter(table.map(Table::into_file));
    if let Some(times) = times {
        files.push(times.finish(end)?);
    }
    if let Some(html) = html {
        let text = text::render(&figures).map_err(io::Error::other);
        let page = text.and_then(|text| Ok(page::render(&figures, &collected, &listing, &text)?));
        files.push(filled(html, page)?);
    }
    if let Some(svg) = svg {
        let drawing = svg::render(&figures, &collected).map_err(io::Error::other);
        files.push(filled(svg, drawing)?);
    }
    // Which subroutines are called is known only now.
    refuse_to_overwrite(arguments, &Vec::from_iter(source.read()))?;
    limit.go_on()?;
    for file in files {
        let name = file.name().to_owned();
        let finished = file.finish();
        finished.map_err(|source| PlanError::unwritable(&name, source))?;
    }
    Ok(figures)
}

/// The file with what belongs into it.
fn filled(mut file: OutputFile, content: io::Result<String>) -> Result<OutputFile, PlanError> {
    let written = content.and_then(|content| file.write_all(content.as_bytes()));
    match written {
        Ok(()) => Ok(file),
        Err(source) => Err(PlanError::unwritable(file.name(), source)),
    }
}
