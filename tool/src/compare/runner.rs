//! Runs every module with every limit of jerk and every length of the queue.

use super::CompareArguments;
#[cfg(feature = "optimum")]
use super::against_optimum::{InTheTube, LeastTime};
use super::conditions::Conditions;
use super::error::CompareError;
use super::figures::Figures;
#[cfg(feature = "optimum")]
use super::holds::holds_of;
use super::progress::Progress;
use super::subjects::Subject;
use crate::arguments::file_name;
use crate::host::job::Job;
use crate::host::operator::Event;
#[cfg(feature = "optimum")]
use crate::host::operator::random_holds;
#[cfg(feature = "optimum")]
use crate::host::recording::Recording;
use crate::host::supervise;
use crate::layer::program::Program;
#[cfg(feature = "optimum")]
use crate::machine::limits::{Limits, infinite_for_none};
use crate::wiring::same_series::check_module;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// LinuxCNC's own planner, in the folder of modules that the build script has found.
const STOCK: &str = concat!(env!("LINUXCNC_MODULES"), "/tpmod.so");

/// A module to run.
struct Module {
    name: String,
    file: String,
}

/// What all runs have in common.
pub(super) struct Runner<'a> {
    arguments: &'a CompareArguments,
    conditions: &'a Conditions,
    events: &'a [Event],
    modules: Vec<Module>,
}

impl<'a> Runner<'a> {
    /// # Errors
    /// A module that does not exist, or that this command cannot call.
    pub(super) fn new(
        arguments: &'a CompareArguments,
        conditions: &'a Conditions,
        events: &'a [Event],
    ) -> Result<Self, CompareError> {
        Ok(Runner {
            arguments,
            conditions,
            events,
            modules: modules(&arguments.modules)?,
        })
    }

    /// How many runs a program has at most.
    pub(super) fn runs_of_a_program(&self) -> usize {
        self.modules.len() * self.arguments.jerk.len() * self.arguments.queue.len().max(1)
    }

    /// All runs of a program: none where there is no excerpt of it.
    pub(super) fn run(
        &self,
        subject: &Subject,
        progress: &Progress,
    ) -> Result<Vec<Figures>, CompareError> {
        let mut runs = Vec::new();
        if subject.no_excerpt.is_some() {
            progress.runs_left_out(self.runs_of_a_program());
            return Ok(runs);
        }
        for module in self.labelled() {
            progress.name(&format!("{}, {}", subject.name, module.label));
            runs.extend(self.run_module(&module, &subject.program, progress)?);
        }
        Ok(runs)
    }

    /// Each module with each length of the queue.
    fn labelled(&self) -> Vec<Labelled<'_>> {
        let mut labelled = Vec::new();
        for Module { name, file } in &self.modules {
            if self.arguments.queue.is_empty() {
                labelled.push(Labelled {
                    file,
                    label: name.clone(),
                    queue: usize::MAX,
                });
            }
            for &queue in &self.arguments.queue {
                labelled.push(Labelled {
                    file,
                    label: format!("{name} queue {queue}"),
                    queue: usize::from(queue),
                });
            }
        }
        labelled
    }

    /// All runs of a module on a program with at most `queue` moves queued. One that has no limit of
    /// jerk runs only once.
    fn run_module(
        &self,
        module: &Labelled,
        program: &Program,
        progress: &Progress,
    ) -> Result<Vec<Figures>, CompareError> {
        let (arguments, conditions) = (self.arguments, self.conditions);
        let joints = conditions.joints.limited();
        let mut runs = Vec::new();
        for (index, &jerk) in arguments.jerk.iter().enumerate() {
            let job = Job {
                module: module.file.to_owned(),
                period: conditions.period,
                limits: conditions.limits,
                jerk: jerk.of_axes(&conditions.limits),
                joints: joints.map(|joints| joints.with_jerk(jerk, 1.0)),
                adds_per_cycle: usize::from(arguments.adds_per_cycle),
                queue: module.queue,
                velocity_limit: conditions.velocity_limit,
                max_feed_override: conditions.max_feed_override,
                stuck_after: 10.0,
                time_limit: 7200.0,
                events: self.events.to_vec(),
                operations: program.operations.clone(),
            };
            let patience = self.patience();
            let (outcome, mut recording) =
                supervise::run(&job, patience).map_err(CompareError::Run)?;
            for _ in 1..arguments.repeat {
                let (_, again) = supervise::run(&job, patience).map_err(CompareError::Run)?;
                if !recording.take_shorter(&again) {
                    return Err(CompareError::NotRepeatable(module.file.into()));
                }
            }
            let figures = Figures::measure(&module.label, jerk, &job, program, outcome, &recording);
            #[cfg(feature = "optimum")]
            let figures = self.against_optimum(figures, &recording, (program, job), progress)?;
            let takes_jerk = figures.takes_jerk;
            runs.push(figures);
            progress.run_done();
            if !takes_jerk {
                progress.runs_left_out(arguments.jerk.len() - index - 1);
                break;
            }
        }
        Ok(runs)
    }
    /// What was asked for that takes the optimum: the least time, and the holds of one more run.
    #[cfg(feature = "optimum")]
    fn against_optimum(
        &self,
        mut figures: Figures,
        recording: &Recording,
        (program, mut job): (&Program, Job),
        progress: &Progress,
    ) -> Result<Figures, CompareError> {
        if !figures.came_through() {
            return Ok(figures);
        }
        if let Some(range) = figures.motion.range
            && self.arguments.with_optimum()
        {
            let optimum = LeastTime::of(recording, program, &job, range, progress);
            if self.arguments.tube.is_some() {
                figures.tube = Some(InTheTube::of(recording, program, &job, range, &optimum));
            }
            figures.optimum = Some(optimum);
        }
        if let Some(count) = self.arguments.holds {
            job.events = random_holds(usize::from(count), figures.motion.time, hold_time(&job));
            let (_, recording) =
                supervise::run(&job, self.patience()).map_err(CompareError::Run)?;
            figures.holds = holds_of(&recording, &job);
        }
        Ok(figures)
    }

    /// How long a call of a module may take.
    fn patience(&self) -> Duration {
        Duration::from_secs_f64(self.arguments.patience.min(1e6))
    }
}

/// Long enough for every planner to come to rest, s: three times what the slowest axis or joint needs from
/// its greatest velocity.
#[cfg(feature = "optimum")]
fn hold_time(job: &Job) -> f64 {
    let Limits {
        velocity,
        acceleration,
    } = job.limits;
    let axes = [velocity, acceleration, job.jerk.map(infinite_for_none)];
    let joints = job.joints.as_ref().map(|joints| *joints.limits());
    [Some(axes), joints]
        .into_iter()
        .flatten()
        .flat_map(|[velocity, acceleration, jerk]| {
            let time = move |mover: usize| {
                let braking = velocity[mover] / acceleration[mover];
                3.0 * (braking + acceleration[mover] / jerk[mover])
            };
            (0..velocity.len()).map(time)
        })
        .filter(|time| time.is_finite())
        .fold(0.0, f64::max)
}

/// A module with a length of the queue, and its name in the tables.
struct Labelled<'a> {
    file: &'a str,
    label: String,
    queue: usize,
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
            check_module(&absolute)?;
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
