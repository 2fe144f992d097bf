//! `framepath compare`: drives planner modules with the same moves, faster than real time, and
//! tabulates time, peaks over the limits, distance from the program, cost of the calls.
//!
//! The files in the order of the work: [`conditions`] says for which machine; [`subjects`] has [`crate::canon`] read the program through LinuxCNC's own
//! interpreter and [`crate::layer`] do with it what the canonical layer does, and cuts an [`excerpt`] out of it if that is asked for; [`runner`] has
//! [`crate::host`] drive the modules with it; [`kinematics`], [`distance`], [`rests`], [`holds`]
//! and [`cost`] measure what they recorded, and [`least_time`] and the one in the [`tube`] if they are asked for; these are
//! figures [`against_optimum`]; [`figures`] holds all of it; [`mod@table`], [`mod@ratios`], [`s_curve`] and [`summary`] show it.

mod against_optimum;
mod asked;
mod conditions;
mod cost;
mod distance;
mod error;
mod excerpt;
mod figures;
#[cfg(feature = "optimum")]
mod holds;
mod kinematics;
#[cfg(feature = "optimum")]
mod least_time;
mod progress;
mod ratios;
mod rests;
mod runner;
mod s_curve;
#[cfg(feature = "optimum")]
mod shortest_stop;
mod subjects;
mod summary;
mod table;
#[cfg(feature = "optimum")]
mod tube;

pub use error::CompareError;

use crate::arguments::{not_negative, period, positive, rate};
use crate::format::significant;
use crate::host;
use crate::host::operator::{Action, Event, at_time, random_events};
use crate::joints::{Joints, LimitedJoints};
use crate::json;
use crate::machine::limits::{Jerk, LimitChanges, Limits};
use crate::path::Position;
use conditions::{Conditions, NO_VELOCITY_LIMIT};
use figures::Figures;
use progress::Progress;
use ratios::{ProgramRuns, ratios};
use runner::Runner;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use subjects::subjects;

/// The options for what the operator does.
const OPERATOR: [&str; 5] = [
    "feed_override",
    "pause",
    "max_velocity",
    "abort",
    "operator",
];

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
    /// Program of `framepath generate`; `all` for every one but random-five-axes and the alternating ones
    #[arg(long, value_name = "NAME", num_args = 1..)]
    pub generated: Vec<String>,
    /// INI file of a machine: its limits of velocity and acceleration, servo period, greatest velocity along the path
    /// and greatest feed override, where the options do not say otherwise
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
    /// Limits of the axes, mm (degrees) and seconds: V=100,A=1000 for all, XY:V=50 for some, several
    /// separated by `;` [default: V=100,A=1000]
    #[arg(long, value_name = "LIMITS")]
    pub limits: Option<LimitChanges>,
    /// Jerk limits to run those modules with that have one: `unlimited`, a number, or a number of
    /// accelerations per second (20A)
    #[arg(
        long,
        value_name = "JERK",
        value_delimiter = ',',
        default_value = "unlimited"
    )]
    pub jerk: Vec<Jerk>,
    /// Raise every F to at least this; feeds per turn (G95) stay as they are
    #[arg(long, value_name = "MM_MIN", value_parser = rate)]
    pub feed_at_least: Option<f64>,
    /// Servo period [default: 0.001]
    #[arg(long, value_name = "SECONDS", value_parser = period)]
    pub period: Option<f64>,
    /// Moves handed to the planner in a cycle
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u16).range(1..))]
    pub adds_per_cycle: u16,
    /// Hand over no move while so many are queued; several numbers for a run with each [default: as
    /// many as the planner takes]
    #[arg(long, value_name = "N", value_delimiter = ',', value_parser = clap::value_parser!(u16).range(2..))]
    pub queue: Vec<u16>,
    /// Greatest velocity along the path, mm/s ([TRAJ]MAX_LINEAR_VELOCITY) [default: none]
    #[arg(long, value_name = "V", value_parser = rate)]
    pub velocity_limit: Option<f64>,
    /// Greatest feed override of the machine ([DISPLAY]MAX_FEED_OVERRIDE), for which LinuxCNC's own
    /// planner leaves room when it blends [default: 1]
    #[arg(long, value_name = "SCALE", value_parser = at_least_one)]
    pub max_feed_override: Option<f64>,
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
    #[arg(long, value_name = "T", value_parser = not_negative)]
    pub abort: Option<f64>,
    /// A restless operator with random overrides, pauses and slider, the same for the same number
    #[arg(long, value_name = "SEED")]
    pub operator: Option<u64>,
    /// Also the least time that the limits allow on the path as it was executed (takes minutes), and
    /// the least time without the limit of jerk
    #[arg(long, conflicts_with_all = OPERATOR)]
    pub optimum: bool,
    /// Compare an excerpt of each program in place of the whole, the middle of its longest run of moves with G64 P, of
    /// so many moves, from rest to rest; with --optimum, and also the least time that the limits allow anywhere in the
    /// tolerance of the excerpt [default: 200 moves]
    #[arg(long, value_name = "MOVES", num_args = 0..=1, require_equals = true, default_missing_value = "200",
          conflicts_with_all = OPERATOR, value_parser = clap::value_parser!(u16).range(1..))]
    pub tube: Option<u16>,
    /// Run each program once more with so many feed holds at random moments and measure the time to
    /// rest
    #[arg(long, value_name = "N", conflicts_with_all = OPERATOR,
          value_parser = clap::value_parser!(u16).range(1..))]
    pub holds: Option<u16>,
    /// Run everything so often: a call costs the shortest time that it took, so that what else the
    /// computer does in between does not count
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u16).range(1..))]
    pub repeat: u16,
    /// Seconds that a module may take for a single call before it counts as hanging
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = positive)]
    pub patience: f64,
    /// How long LinuxCNC's interpreter may take to read a program, seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 60, value_parser = clap::value_parser!(u64).range(1..=86_400))]
    pub most_seconds: u64,
    /// End with exit status 1 where a module exceeds a limit or a tolerance or does not bring a program to its end, and
    /// say which; of several modules the first, which the others are compared with, is not judged
    #[arg(long)]
    pub check: bool,
    /// All figures as JSON in place of the text (docs/json.md)
    #[arg(long)]
    pub json: bool,
}

fn at_least_one(text: &str) -> Result<f64, String> {
    match positive(text) {
        Ok(number) if number >= 1.0 => Ok(number),
        _ => Err("a number from 1 up is needed".to_owned()),
    }
}

impl CompareArguments {
    /// Whether the least time on the path is asked for.
    fn with_optimum(&self) -> bool {
        self.optimum || self.tube.is_some()
    }
}

/// What a process does that was started to drive a module.
pub fn serve_as_host() -> ExitCode {
    host::drive::serve()
}

#[derive(Serialize)]
struct Report<'a> {
    period: f64,
    limits: Limits,
    joints: Option<ReportedJoints>,
    feed_at_least: Option<f64>,
    adds_per_cycle: u16,
    velocity_limit: f64,
    max_feed_override: f64,
    events: &'a [Event],
    programs: &'a [ProgramRuns],
    ratios: &'a [ratios::Ratio],
}

/// The joints that have limits of their own.
#[derive(Serialize)]
struct ReportedJoints {
    behind: String,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
}

impl ReportedJoints {
    fn new(joints: &LimitedJoints) -> ReportedJoints {
        let [velocity, acceleration, _] = joints.limits();
        let of_joints = |limits: &Position| limits.iter().take(joints.count()).copied().collect();
        ReportedJoints {
            behind: joints.told(),
            velocity: of_joints(velocity),
            acceleration: of_joints(acceleration),
        }
    }
}

/// Compares; tables or JSON on standard output.
///
/// # Errors
/// Programs that cannot be read, modules that do not exist; behind the results, programs that a planner
/// refused or gave up. A module that crashes, hangs or is none is no error but a result.
pub fn run(arguments: &CompareArguments) -> Result<(), CompareError> {
    let optimum = arguments.with_optimum();
    if cfg!(not(feature = "optimum")) && (optimum || arguments.holds.is_some()) {
        return Err(CompareError::NoOptimum);
    }
    let conditions = Conditions::new(arguments)?;
    if arguments.tube.is_some() && conditions.joints.limited().is_some() {
        return Err(CompareError::TubeOfJoints);
    }
    let limits = conditions.limits;
    let subjects = subjects(arguments, limits, &conditions.start)?;
    let events = events(arguments);
    refuse_to_hold(&events)?;
    let runner = Runner::new(arguments, &conditions, &events)?;
    let mut output = std::io::stdout().lock();
    if !arguments.json {
        writeln!(output, "{}\n", headline(arguments, &conditions)).map_err(CompareError::Write)?;
    }
    let mut all = Vec::new();
    let progress = Progress::new(subjects.len() * runner.runs_of_a_program());
    for subject in subjects {
        let runs = runner.run(&subject, &progress)?;
        if !arguments.json {
            let text = table::table(&subject, &runs);
            progress
                .suspend(|| writeln!(output, "{text}"))
                .map_err(CompareError::Write)?;
            output.flush().map_err(CompareError::Write)?;
        }
        all.push(ProgramRuns::new(subject, runs));
    }
    progress.finish();
    let mut ratios = ratios(&all);
    if conditions.joints.limited().is_none() {
        ratios.extend(s_curve::ratios(&all, &limits));
    }
    ratios.extend(ratios::over_the_optimum(&all));
    if arguments.json {
        let report = Report {
            period: conditions.period,
            limits,
            joints: conditions.joints.limited().map(ReportedJoints::new),
            feed_at_least: arguments.feed_at_least,
            adds_per_cycle: arguments.adds_per_cycle,
            velocity_limit: conditions.velocity_limit,
            max_feed_override: conditions.max_feed_override,
            events: &events,
            programs: &all,
            ratios: &ratios,
        };
        json::write(&mut output, "compare", &report).map_err(CompareError::Write)?;
    } else {
        write!(output, "{}", ratios::text(&ratios)).map_err(CompareError::Write)?;
        write!(output, "{}", summary::text(&all)).map_err(CompareError::Write)?;
        write!(output, "\n{}", table::LEGEND).map_err(CompareError::Write)?;
        if conditions.joints.limited().is_some() {
            write!(output, "{}", table::JOINT_LEGEND).map_err(CompareError::Write)?;
        }
        if optimum {
            write!(output, "{}", table::OPTIMUM_LEGEND).map_err(CompareError::Write)?;
        }
        if arguments.tube.is_some() {
            write!(output, "{}", table::TUBE_LEGEND).map_err(CompareError::Write)?;
        }
    }
    output.flush().map_err(CompareError::Write)?;
    let not_done = not_done(&all);
    if !not_done.is_empty() {
        return Err(CompareError::NotDone(not_done));
    }
    match not_kept(&all) {
        Some(problem) if arguments.check => Err(CompareError::NotKept(problem)),
        _ => Ok(()),
    }
}

/// Everything that is not kept by a module that is judged, in one line.
fn not_kept(programs: &[ProgramRuns]) -> Option<String> {
    let modules = programs.iter().flat_map(|program| &program.runs);
    let first = modules.clone().next().map(|run| &run.module);
    let is_judged = |run: &&Figures| Some(&run.module) != first;
    let only = !modules.clone().any(|run| is_judged(&run));
    let mut problems = Vec::new();
    for program in programs {
        for run in program.runs.iter().filter(|run| only || is_judged(run)) {
            let (name, module, jerk) = (&program.program, &run.module, run.jerk);
            let told = |problem: String| format!("{name}: {module} with jerk {jerk}: {problem}");
            problems.extend(run.not_kept().into_iter().map(told));
        }
    }
    (!problems.is_empty()).then(|| problems.join("; "))
}

/// A line for each run in which the planner itself left something of the program out.
fn not_done(programs: &[ProgramRuns]) -> Vec<String> {
    let line = |program: &ProgramRuns, run: &Figures| {
        let what = run.not_done()?;
        Some(format!(
            "{}: {} with jerk {} {what}",
            program.program, run.module, run.jerk
        ))
    };
    programs
        .iter()
        .flat_map(|program| {
            program
                .runs
                .iter()
                .filter_map(move |run| line(program, run))
        })
        .collect()
}

/// Under what conditions the modules are compared.
fn headline(arguments: &CompareArguments, conditions: &Conditions) -> String {
    let feed = match arguments.feed_at_least {
        Some(feed) => format!("every F but that of G95 raised to {feed} mm/min at least"),
        None => "F as programmed".to_owned(),
    };
    let limits = &conditions.limits_from;
    let period = significant(conditions.period * 1e3, 6);
    let adds = arguments.adds_per_cycle;
    let moves = if adds == 1 { "move" } else { "moves" };
    let mut text =
        format!("{limits}; {feed}; servo period {period} ms, {adds} {moves} handed over in each");
    if conditions.velocity_limit < NO_VELOCITY_LIMIT {
        text += &format!(
            "; at most {} mm/s along the path",
            conditions.velocity_limit
        );
    }
    match &conditions.joints {
        Joints::Axes => {}
        Joints::Unknown(kinematics) => {
            text += &format!(
                "; the limits of joints that its HAL files set behind {kinematics} do NOT hold here, those of the axes do"
            );
        }
        Joints::Limited(joints) => {
            text += &format!(
                "; limits of joints as its HAL files set them behind {}",
                joints.told()
            );
        }
    }
    if conditions.max_feed_override > 1.0 {
        let percent = significant(100.0 * conditions.max_feed_override, 6);
        text += &format!("; feed override up to {percent} %");
    }
    text
}

/// A machine that is held for good does not come to the end of its program, whichever planner it has.
fn refuse_to_hold(events: &[Event]) -> Result<(), CompareError> {
    let mut held = None;
    for event in events {
        held = match event.action {
            Action::Abort => return Ok(()),
            Action::FeedOverride(0.0) => Some(("--feed-override", event.time)),
            Action::MaxVelocity(0.0) => Some(("--max-velocity", event.time)),
            Action::FeedOverride(_) => held.filter(|(option, _)| *option != "--feed-override"),
            Action::MaxVelocity(_) => held.filter(|(option, _)| *option != "--max-velocity"),
            Action::Pause(_) => held,
        };
    }
    match held {
        None => Ok(()),
        Some((option, time)) => Err(CompareError::HeldForGood { option, time }),
    }
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
