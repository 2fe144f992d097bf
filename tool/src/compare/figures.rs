//! All figures of one run of a module.

use super::against_optimum::{Holds, InTheTube, LeastTime};
use super::cost::Cost;
use super::distance::{Distance, Path, executed_to_path, path_to_executed};
#[cfg(feature = "optimum")]
use super::holds::holds_of;
use super::kinematics::{Motion, Mover, Peak, Peaks};
use super::rests::{Rests, rests};
use crate::format::{length, significant};
use crate::host::job::Job;
use crate::host::recording::{ABORTED, Ending, Recording};
use crate::host::supervise::Outcome;
use crate::layer::program::Program;
use crate::layer::turns::TurnsLeftAway;
use crate::machine::limits::Jerk;
use crate::path::exceeded::exceeds;
use crate::path::rates::Quantity;
use crate::path::segment::largest_difference;
use serde::Serialize;

/// Farther than this from the programmed end a program was not finished, mm or degrees.
const OFF_THE_END: f64 = 1e-3;

/// How a run went.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "state", content = "detail")]
pub(crate) enum State {
    Complete,
    Aborted,
    /// A move was refused.
    Refused(String),
    /// It dropped its moves and came to rest where none of them ends.
    GaveUp(String),
    /// It stands still with moves to go.
    Stuck(String),
    TooLong,
    /// The module cannot be loaded or is none.
    NotUsable(String),
    Crashed(String),
    Hung(String),
}

impl State {
    /// For people: what has become of the run.
    pub(crate) fn in_words(&self) -> String {
        match self {
            State::Complete => "complete".to_owned(),
            State::Aborted => "aborted".to_owned(),
            State::Refused(detail) => format!("REFUSED: {detail}"),
            State::GaveUp(detail) => format!("GIVES UP: {detail}"),
            State::Stuck(detail) => format!("STUCK: {detail}"),
            State::TooLong => "TOO LONG".to_owned(),
            State::NotUsable(detail) => format!("NOT USABLE: {detail}"),
            State::Crashed(detail) => format!("CRASHED: {detail}"),
            State::Hung(detail) => format!("HUNG: {detail}"),
        }
    }

    fn of(outcome: Outcome, recording: &Recording, period: f64) -> State {
        let module_says = || match recording.first_error.as_str() {
            "" => String::new(),
            text => format!(": {text}"),
        };
        match (outcome, &recording.ending) {
            (Outcome::Crashed(detail), _) => State::Crashed(detail),
            (Outcome::Hung(detail), _) => State::Hung(detail),
            (Outcome::Ended, ending) => match ending {
                Ending::Complete => State::Complete,
                Ending::Aborted => State::Aborted,
                Ending::Stuck => {
                    let end = recording.samples.len() as f64 * period;
                    State::Stuck(format!("no motion any more at {end:.1} s{}", module_says()))
                }
                Ending::TooLong => State::TooLong,
                Ending::GaveUp { line } => State::GaveUp(format!(
                    "before the end of the move of line {line}{}",
                    module_says()
                )),
                Ending::Refused { line, code } => State::Refused(format!(
                    "the move of line {line}, code {code}{}",
                    module_says()
                )),
                Ending::NotUsable(problem) => {
                    State::NotUsable(format!("{problem}{}", module_says()))
                }
                Ending::Missing => State::Crashed("the record has no end".to_owned()),
            },
        }
    }
}

/// What was measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Figures {
    /// Name of the module's file.
    pub module: String,
    pub jerk: Jerk,
    /// The module has pins for the jerk of its axes.
    pub takes_jerk: bool,
    #[serde(flatten)]
    pub state: State,
    pub motion: Motion,
    /// Executed positions from the program.
    pub deviation: Distance,
    /// Executed positions from the moves as they were handed over, after merging.
    pub deviation_from_moves: Distance,
    /// Points of the program from the executed path.
    pub missed: Distance,
    /// Points of the moves as they were handed over from the executed path.
    pub missed_of_moves: Distance,
    /// Arcs of the program whose whole turns LinuxCNC leaves away, whatever planner it has.
    #[serde(skip_serializing_if = "TurnsLeftAway::is_none")]
    pub turns_left_away: TurnsLeftAway,
    /// Distance of the last position from the programmed end, mm or degrees.
    pub final_error: f64,
    pub rests: Rests,
    /// Measured with the feature `optimum`.
    #[cfg_attr(not(feature = "optimum"), serde(skip))]
    pub holds: Holds,
    /// Measured when it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub optimum: Option<LeastTime>,
    /// Measured of excerpts when it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tube: Option<InTheTube>,
    /// Most moves that were queued at a time.
    pub most_queued: i32,
    /// tpRunCycle while moves are queued.
    pub run: Cost,
    /// tpAddLine and tpAddCircle.
    pub add: Cost,
    /// The clock itself, microseconds.
    pub clock: f64,
    /// Heap functions called in planner calls.
    pub heap_calls: u64,
    /// Error messages of the module, and the first of them.
    pub errors: u64,
    pub first_error: String,
    /// How often the number of the running move went back.
    pub id_backwards: usize,
}

impl Figures {
    /// It came to the end of the program, at the programmed end: its time counts.
    pub(crate) fn came_through(&self) -> bool {
        self.state == State::Complete && !self.motion.not_finite && self.final_error <= OFF_THE_END
    }

    /// What the planner did not do of the program, by its own decision: `None` where it came to the end,
    /// and where that is not its doing.
    pub(crate) fn not_done(&self) -> Option<String> {
        match &self.state {
            State::Refused(detail) => Some(format!("refuses {detail}")),
            State::GaveUp(detail) => Some(format!("gives up {detail}")),
            State::Stuck(detail) => Some(format!("is stuck: {detail}")),
            State::Complete if self.final_error > OFF_THE_END => Some(format!(
                "ends {:.6} mm off {}",
                self.final_error, self.first_error
            )),
            _ => None,
        }
    }

    /// A limit or a tolerance is exceeded by more than counts.
    pub(crate) fn exceeds(&self) -> bool {
        !self.broken().is_empty()
    }

    /// Each limit and tolerance that is exceeded, in words.
    pub(crate) fn broken(&self) -> Vec<String> {
        let motion = &self.motion;
        let mut broken = Vec::new();
        if motion.not_finite {
            broken.push("a position is not a number".to_owned());
        }
        broken.extend(broken_limits(&motion.axes));
        broken.extend(motion.joints.iter().flat_map(broken_limits));
        broken.extend(self.turns_left_away.told());
        for (what, distance) in [
            ("the executed path is off the program", &self.deviation),
            (
                "the executed path passes by a programmed point",
                &self.missed,
            ),
        ] {
            if distance.exceeds {
                let (largest, line) = (length(distance.largest, "mm"), distance.line);
                broken.push(format!(
                    "{what} by more than its tolerance, at most by {largest} at line {line}"
                ));
            }
        }
        broken
    }

    /// Why this run does not keep what is promised: limits and tolerance, and the program to its end.
    pub(crate) fn not_kept(&self) -> Vec<String> {
        let mut problems = self.broken();
        if !self.came_through() && self.state != State::Aborted {
            problems.push(self.not_done().unwrap_or_else(|| self.state.in_words()));
        }
        problems
    }

    /// Measures a run.
    pub(crate) fn measure(
        module: &str,
        jerk: Jerk,
        job: &Job,
        program: &Program,
        outcome: Outcome,
        recording: &Recording,
    ) -> Figures {
        let state = State::of(outcome, recording, job.period);
        let motion = Motion::of(recording, job);
        let samples = recording.samples.as_slice();
        let aborted = samples
            .iter()
            .position(|sample| sample.flags & ABORTED != 0);
        let complete = state == State::Complete;
        let along = |path: &Path| {
            if motion.not_finite {
                return (Distance::default(), Distance::default());
            }
            let (there, matched) = executed_to_path(path, samples);
            let back = if complete {
                path_to_executed(path, &matched)
            } else {
                Distance::default()
            };
            (there, back)
        };
        let (deviation_from_moves, missed_of_moves) = along(&Path::handed(program));
        let (deviation, missed) = along(&Path::programmed(program));
        let mut turns_left_away = TurnsLeftAway::default();
        program
            .programmed
            .iter()
            .for_each(|piece| turns_left_away.note(piece));
        let final_error = match samples.last() {
            Some(sample) if aborted.is_none() => {
                largest_difference(&sample.position, &program.end())
            }
            _ => 0.0,
        };
        Figures {
            module: module.to_owned(),
            jerk,
            takes_jerk: recording.takes_jerk,
            rests: rests(recording, program, job, motion.range),
            #[cfg(not(feature = "optimum"))]
            holds: Holds::default(),
            #[cfg(feature = "optimum")]
            holds: holds_of(recording, job),
            optimum: None,
            tube: None,
            state,
            motion,
            deviation,
            deviation_from_moves,
            missed,
            missed_of_moves,
            turns_left_away,
            final_error,
            most_queued: samples
                .iter()
                .map(|sample| sample.queued)
                .max()
                .unwrap_or(0),
            run: Cost::of(
                samples
                    .iter()
                    .map(|sample| sample.run)
                    .filter(|&run| run > 0),
            ),
            add: Cost::of(recording.adds.iter().copied()),
            clock: f64::from(recording.clock) / 1e3,
            heap_calls: recording.heap_calls,
            errors: recording.errors,
            first_error: recording.first_error.clone(),
            id_backwards: ids_going_back(recording, program.handed.len()),
        }
    }
}

/// In words, each limit that is exceeded.
fn broken_limits(peaks: &Peaks) -> Vec<String> {
    let quantities = [
        (Quantity::Velocity, &peaks.velocity),
        (Quantity::Acceleration, &peaks.acceleration),
        (Quantity::Jerk, &peaks.jerk),
    ];
    let exceeded = |&(quantity, peak): &(Quantity, &Peak)| exceeds(quantity, peak.ratio);
    let told = |(quantity, peak): (Quantity, &Peak)| {
        let (name, time) = (quantity.name(), peak.time);
        let ratio = significant(peak.ratio, 4);
        let whose = match peak.mover {
            Mover::Axis(_) => String::new(),
            Mover::Joint(joint) => format!(" of joint {joint}"),
        };
        format!("{name}{whose} is {ratio} times its limit at {time:.3} s")
    };
    quantities.into_iter().filter(exceeded).map(told).collect()
}

fn ids_going_back(recording: &Recording, count: usize) -> usize {
    let mut last = 0;
    let mut backwards = 0;
    for sample in &recording.samples {
        let id = usize::try_from(sample.id).unwrap_or(0);
        if (1..=count).contains(&id) {
            backwards += usize::from(id < last);
            last = id;
        }
    }
    backwards
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Figures of a run without a fault.
    pub(crate) fn finished(module: &str, time: f64) -> Figures {
        Figures {
            module: module.to_owned(),
            jerk: Jerk::Unlimited,
            takes_jerk: false,
            state: State::Complete,
            motion: Motion {
                time,
                ..Motion::default()
            },
            deviation: Distance::default(),
            deviation_from_moves: Distance::default(),
            missed: Distance::default(),
            missed_of_moves: Distance::default(),
            turns_left_away: TurnsLeftAway::default(),
            final_error: 0.0,
            rests: Rests::default(),
            holds: Holds::default(),
            optimum: None,
            tube: None,
            most_queued: 0,
            run: Cost::default(),
            add: Cost::default(),
            clock: 0.0,
            heap_calls: 0,
            errors: 0,
            first_error: String::new(),
            id_backwards: 0,
        }
    }

    #[test]
    fn what_counts_as_exceeded() {
        assert!(!finished("a", 1.0).exceeds());
        let mut fast = finished("a", 1.0);
        fast.motion.axes.velocity.ratio = 1.02;
        assert!(fast.exceeds());
        let mut lost = finished("a", 1.0);
        lost.turns_left_away = TurnsLeftAway {
            arcs: 2,
            line: 7,
            turns: 1,
        };
        let told =
            "LinuxCNC leaves a whole turn of the arc at line 7 away, the first of 2 such arcs: ";
        assert!(lost.broken()[0].starts_with(told));
        let mut off = finished("a", 1.0);
        off.missed.exceeds = true;
        assert!(off.exceeds() && off.came_through());
        off.final_error = 0.01;
        assert!(!off.came_through());
    }
}
