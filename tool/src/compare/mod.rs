//! `framepath compare`: drives planner modules with the same moves, faster than real time, and
//! tabulates time, peaks over the limits, distance from the program, cost of the calls.
//!
//! The files in the order of the work: [`crate::canon`] reads the program through LinuxCNC's own
//! interpreter; [`layer`] does with it what the canonical layer does, the result is a [`program`]
//! made of [`segment`]s; [`job`] tells it to a process of its own ([`supervise`]), which drives the
//! module ([`host`]) and sends a [`recording`]; [`kinematics`], [`distance`], [`rests`], [`holds`]
//! and [`cost`] measure it, [`figures`] holds all of it; [`table`], [`ratios`] and [`s_curve`]
//! show it.

mod cost;
mod distance;
mod error;
mod figures;
mod holds;
pub(crate) mod host;
mod job;
mod kinematics;
mod layer;
mod limits;
mod operator;
mod program;
mod ratios;
mod recording;
mod rests;
mod s_curve;
mod segment;
mod supervise;
mod table;

pub use error::CompareError;

use crate::canon::{read_program, read_text};
use crate::generate;
use figures::Figures;
use job::Job;
use layer::{LayerSettings, lay};
use limits::{Jerk, Limits};
use operator::{Action, Event, at_time, random_events, seconds};
use program::Program;
use ratios::{ProgramRuns, ratios};
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

/// Where Debian's linuxcnc-uspace has its modules.
const STOCK: &str = "/usr/lib/linuxcnc/modules/tpmod.so";

/// Arguments of `framepath compare`.
#[derive(Clone, Debug, clap::Args)]
pub struct CompareArguments {
    /// G-code programs
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Planner module; the first is what the others are compared with [default: LinuxCNC's own
    /// tpmod.so, and blendtp.so from the folder FRAMEPATH_MODULES or LinuxCNC's]
    #[arg(long = "with", value_name = "MODULE.so")]
    pub modules: Vec<PathBuf>,
    /// Program of `framepath generate`; `all` for every one
    #[arg(long, value_name = "NAME", num_args = 1..)]
    pub generated: Vec<String>,
    /// Limits of the axes, mm (degrees) and seconds: V=100,A=1000 for all, XY:V=50 for some, several
    /// separated by `;`
    #[arg(long, value_name = "LIMITS", default_value = "V=100,A=1000")]
    pub limits: String,
    /// Jerk limits to run those modules with that have one: `unlimited`, a number, or a number of
    /// accelerations per second (20A)
    #[arg(
        long,
        value_name = "JERK",
        value_delimiter = ',',
        default_value = "unlimited"
    )]
    pub jerk: Vec<String>,
    /// Raise every F to at least this
    #[arg(long, value_name = "MM_MIN", value_parser = seconds)]
    pub feed_at_least: Option<f64>,
    /// Servo period
    #[arg(long, value_name = "SECONDS", default_value = "0.001", value_parser = period)]
    pub period: f64,
    /// Moves handed to the planner in a cycle
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u16).range(1..))]
    pub adds_per_cycle: u16,
    /// Greatest velocity of the machine, mm/s
    #[arg(long, value_name = "V", default_value = "1e9", value_parser = seconds)]
    pub velocity_limit: f64,
    /// Feed override from a time on: SECONDS:SCALE
    #[arg(long, value_name = "T:SCALE", value_parser = at_time)]
    pub feed_override: Vec<(f64, f64)>,
    /// Pause at a time for so long: SECONDS:SECONDS
    #[arg(long, value_name = "T:SECONDS", value_parser = at_time)]
    pub pause: Vec<(f64, f64)>,
    /// Velocity slider from a time on: SECONDS:VELOCITY
    #[arg(long, value_name = "T:V", value_parser = at_time)]
    pub max_velocity: Vec<(f64, f64)>,
    /// Abort at a time
    #[arg(long, value_name = "T", value_parser = seconds)]
    pub abort: Option<f64>,
    /// A restless operator with random overrides, pauses and slider, the same for the same number
    #[arg(long, value_name = "SEED")]
    pub operator: Option<u64>,
    /// Seconds that a module may take for a single call before it counts as hanging
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = seconds)]
    pub patience: f64,
    /// All figures as JSON in place of the tables
    #[arg(long)]
    pub json: bool,
}

fn period(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (1e-5..=0.1).contains(&number) => Ok(number),
        _ => Err(format!("`{text}`: seconds from 0.00001 to 0.1 are needed")),
    }
}

/// What a process does that was started to drive a module.
pub fn serve_as_host() -> ExitCode {
    host::drive::serve()
}

/// A module to run.
struct Module {
    name: String,
    file: String,
}

#[derive(Serialize)]
struct Report<'a> {
    period: f64,
    limits: Limits,
    feed_at_least: Option<f64>,
    adds_per_cycle: u16,
    events: &'a [Event],
    programs: &'a [ProgramRuns],
    ratios: &'a [ratios::Ratio],
}

/// Compares; tables or JSON on standard output.
///
/// # Errors
/// Programs that cannot be read, modules that do not exist. A module that crashes, hangs or is none
/// is no error but a result.
pub fn run(arguments: &CompareArguments) -> Result<(), Box<dyn std::error::Error>> {
    let mut limits = Limits::default();
    limits
        .apply(&arguments.limits)
        .map_err(|problem| format!("--limits: {problem}"))?;
    let jerks = arguments
        .jerk
        .iter()
        .map(|text| Jerk::parse(text).map_err(|problem| format!("--jerk: {problem}")))
        .collect::<Result<Vec<_>, _>>()?;
    let modules = modules(&arguments.modules)?;
    let programs = programs(arguments, limits)?;
    let events = events(arguments);
    let mut output = std::io::stdout().lock();
    if !arguments.json {
        writeln!(output, "{}\n", headline(arguments)).map_err(CompareError::Write)?;
    }
    let mut all = Vec::new();
    for (name, program) in programs {
        let mut runs = Vec::new();
        for module in &modules {
            runs.extend(run_module(
                module, &program, &jerks, arguments, limits, &events,
            )?);
        }
        if !arguments.json {
            let text = table::table(&name, &program, &runs);
            writeln!(output, "{text}").map_err(CompareError::Write)?;
            output.flush().map_err(CompareError::Write)?;
        }
        all.push(ProgramRuns {
            program: name,
            moves: program.handed.len(),
            runs,
        });
    }
    let mut ratios = ratios(&all);
    ratios.extend(s_curve::ratios(&all, &limits));
    if arguments.json {
        let report = Report {
            period: arguments.period,
            limits,
            feed_at_least: arguments.feed_at_least,
            adds_per_cycle: arguments.adds_per_cycle,
            events: &events,
            programs: &all,
            ratios: &ratios,
        };
        serde_json::to_writer_pretty(&mut output, &report)?;
        writeln!(output).map_err(CompareError::Write)?;
    } else {
        write!(output, "{}", ratios::text(&ratios)).map_err(CompareError::Write)?;
        write!(output, "\n{}", table::LEGEND).map_err(CompareError::Write)?;
    }
    Ok(())
}

/// Under what conditions the modules are compared.
fn headline(arguments: &CompareArguments) -> String {
    let feed = match arguments.feed_at_least {
        Some(feed) => format!("every F raised to {feed} mm/min at least"),
        None => "F as programmed".to_owned(),
    };
    let (limits, period) = (&arguments.limits, arguments.period * 1e3);
    let adds = arguments.adds_per_cycle;
    let moves = if adds == 1 { "move" } else { "moves" };
    format!("{limits}; {feed}; servo period {period} ms, {adds} {moves} handed over in each")
}

/// All runs of a module on a program. One that has no limit of jerk runs only once.
fn run_module(
    module: &Module,
    program: &Program,
    jerks: &[Jerk],
    arguments: &CompareArguments,
    limits: Limits,
    events: &[Event],
) -> Result<Vec<Figures>, CompareError> {
    let mut runs = Vec::new();
    for &jerk in jerks {
        let job = Job {
            module: module.file.clone(),
            period: arguments.period,
            limits,
            jerk: jerk.of_axes(&limits),
            adds_per_cycle: usize::from(arguments.adds_per_cycle),
            velocity_limit: arguments.velocity_limit,
            stuck_after: 10.0,
            time_limit: 7200.0,
            events: events.to_vec(),
            operations: program.operations.clone(),
        };
        let patience = Duration::from_secs_f64(arguments.patience.min(1e6));
        let (outcome, recording) = supervise::run(&job, patience).map_err(CompareError::Run)?;
        let figures = Figures::measure(&module.name, jerk, &job, program, outcome, &recording);
        let takes_jerk = figures.takes_jerk;
        runs.push(figures);
        if !takes_jerk {
            break;
        }
    }
    Ok(runs)
}

fn modules(named: &[PathBuf]) -> Result<Vec<Module>, CompareError> {
    let default;
    let files = if named.is_empty() {
        default = [PathBuf::from(STOCK), our_module()];
        &default[..]
    } else {
        named
    };
    files
        .iter()
        .map(|file| {
            let hint = if named.is_empty() {
                "; install LinuxCNC and build the modules (make modules), or name modules with --with"
            } else {
                ""
            };
            // An absolute path: dlopen looks for a mere name elsewhere.
            let absolute = std::fs::canonicalize(file).map_err(|_| CompareError::NoModule {
                file: file.clone(),
                hint,
            })?;
            Ok(Module {
                name: file_name(file),
                file: absolute.to_string_lossy().into_owned(),
            })
        })
        .collect()
}

/// Where our module is: in the folder of the build, else among LinuxCNC's.
fn our_module() -> PathBuf {
    let folder = std::env::var_os("FRAMEPATH_MODULES").map(PathBuf::from);
    let built = folder.map(|folder| folder.join("blendtp.so"));
    let installed = Path::new(STOCK).with_file_name("blendtp.so");
    match built {
        Some(built) if built.exists() || !installed.exists() => built,
        _ => installed,
    }
}

fn file_name(file: &Path) -> String {
    file.file_name().map_or_else(
        || file.display().to_string(),
        |name| name.to_string_lossy().into_owned(),
    )
}

/// Reads all programs, so that one that cannot be read is known before anything runs.
fn programs(
    arguments: &CompareArguments,
    limits: Limits,
) -> Result<Vec<(String, Program)>, CompareError> {
    let settings = LayerSettings {
        limits,
        feed_at_least: arguments.feed_at_least,
    };
    let names = generated_names(&arguments.generated)?;
    if arguments.files.is_empty() && names.is_empty() {
        return Err(CompareError::NoProgram(generate::names().join(", ")));
    }
    let mut programs = Vec::new();
    for file in &arguments.files {
        let name = file_name(file);
        programs.push((name, lay(&read_program(file)?, &settings)));
    }
    for name in names {
        let text = generate::program(&name).unwrap_or_default();
        programs.push((name.clone(), lay(&read_text(&name, &text)?, &settings)));
    }
    for (name, program) in &programs {
        if program.handed.is_empty() {
            return Err(CompareError::NoMoves(name.clone()));
        }
    }
    Ok(programs)
}

fn generated_names(asked: &[String]) -> Result<Vec<String>, CompareError> {
    let known = generate::names();
    let mut names = Vec::new();
    for name in asked {
        if name == "all" {
            names.extend(known.iter().map(|&name| name.to_owned()));
        } else if known.contains(&name.as_str()) {
            names.push(name.clone());
        } else {
            return Err(CompareError::UnknownProgram {
                name: name.clone(),
                known: known.join(", "),
            });
        }
    }
    Ok(names)
}

/// What the operator does, in the order of time.
fn events(arguments: &CompareArguments) -> Vec<Event> {
    let mut events = arguments.operator.map_or_else(Vec::new, random_events);
    let mut add = |time: f64, action: Action| events.push(Event { time, action });
    for &(time, scale) in &arguments.feed_override {
        add(time, Action::FeedOverride(scale));
    }
    for &(time, duration) in &arguments.pause {
        add(time, Action::Pause(duration));
    }
    for &(time, velocity) in &arguments.max_velocity {
        add(time, Action::MaxVelocity(velocity));
    }
    if let Some(time) = arguments.abort {
        add(time, Action::Abort);
    }
    events.sort_by(|a, b| a.time.total_cmp(&b.time));
    events
}
