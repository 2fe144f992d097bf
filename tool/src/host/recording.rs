//! What came back from a run: a sample of every servo cycle, the cost of each call, how it ended.
//!
//! The driven process writes it as a stream of records, so that what was recorded before a crash is there.

use crate::joints::LimitedJoints;
use crate::path::Position;
use serde::{Deserialize, Serialize};
use std::io::{self, Write};

/// One servo cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Sample {
    pub position: Position,
    /// Net feed scale.
    pub scale: f64,
    /// Number of the move that runs (from 1), as the module says.
    pub id: i32,
    /// Moves that are queued.
    pub queued: i32,
    /// Duration of tpRunCycle, ns; 0 if nothing was queued.
    pub run: u32,
    pub flags: u8,
}

/// Paused by the operator, or feed override 0.
pub(crate) const HELD: u8 = 1;
/// The module says that motion is done.
pub(crate) const DONE: u8 = 2;
/// The program waits: dwell, or the next operation waits for the end of motion.
pub(crate) const WAITING: u8 = 4;
/// Fewer than two moves are queued although more are to come.
pub(crate) const STARVED: u8 = 8;
/// After an abort.
pub(crate) const ABORTED: u8 = 16;

/// Less travel in a cycle is standstill, mm or degrees.
const AT_REST: f64 = 1e-9;

/// Travel of each axis in cycle `k`; the machine stood at zero before.
pub(crate) fn step(samples: &[Sample], k: usize) -> [f64; 9] {
    let before = match k.checked_sub(1).and_then(|k| samples.get(k)) {
        Some(sample) => sample.position,
        None => [0.0; 9],
    };
    let mut step = [0.0; 9];
    if let Some(sample) = samples.get(k) {
        for (axis, travel) in step.iter_mut().enumerate() {
            *travel = sample.position[axis] - before[axis];
        }
    }
    step
}

/// Whether an axis moves.
pub(crate) fn moves(step: &[f64; 9]) -> bool {
    step.iter()
        .any(|travel| travel.is_nan() || travel.abs() > AT_REST)
}

/// How a run ended.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) enum Ending {
    /// The program came to its end.
    Complete,
    /// Aborted as asked for, at rest again.
    Aborted,
    /// It stood still for too long with moves to go.
    Stuck,
    /// It took longer than allowed.
    TooLong,
    /// A move was refused: the line and the code.
    Refused { line: i32, code: i32 },
    /// Nothing was left to do although the move of this line, the last one handed over, was not run.
    GaveUp { line: i32 },
    /// The module could not be used.
    NotUsable(String),
    /// The record ends without an end.
    #[default]
    Missing,
}

/// All of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Recording {
    pub samples: Vec<Sample>,
    /// Duration of each tpAddLine and tpAddCircle, ns.
    pub adds: Vec<u32>,
    /// Pins for the jerk of each axis were found.
    pub takes_jerk: bool,
    /// Shortest time between two looks at the clock, ns.
    pub clock: u32,
    /// Heap functions called in planner calls.
    pub heap_calls: u64,
    /// Error messages of the module.
    pub errors: u64,
    pub first_error: String,
    pub ending: Ending,
}

/// What the driven process writes, one after the other.
#[derive(Debug, Serialize, Deserialize)]
enum Record {
    Start {
        takes_jerk: bool,
        clock: u32,
    },
    Cycle(Sample),
    /// Duration of a tpAddLine or tpAddCircle, ns.
    Add(u32),
    End(End),
}

/// The last record; see [`Recording`].
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct End {
    pub ending: Ending,
    pub heap_calls: u64,
    pub errors: u64,
    pub first_error: String,
}

/// Writes records while the program runs.
pub(crate) struct Recorder<W: Write>(pub W);

impl<W: Write> Recorder<W> {
    pub(crate) fn start(&mut self, takes_jerk: bool, clock: u32) -> io::Result<()> {
        self.write(&Record::Start { takes_jerk, clock })
    }

    pub(crate) fn sample(&mut self, sample: &Sample) -> io::Result<()> {
        self.write(&Record::Cycle(*sample))
    }

    pub(crate) fn add(&mut self, nanoseconds: u32) -> io::Result<()> {
        self.write(&Record::Add(nanoseconds))
    }

    pub(crate) fn end(&mut self, end: End) -> io::Result<()> {
        self.write(&Record::End(end))?;
        self.0.flush()
    }

    fn write(&mut self, record: &Record) -> io::Result<()> {
        let written = postcard::to_io(record, &mut self.0);
        written.map(|_| ()).map_err(io::Error::other)
    }
}

impl Recording {
    /// Of each call the shorter time of two runs, so that what else the computer did in one of them
    /// does not count. `false` if the runs differ in what they did.
    pub(crate) fn take_shorter(&mut self, other: &Recording) -> bool {
        let same = self.ending == other.ending
            && self.adds.len() == other.adds.len()
            && self.samples.len() == other.samples.len()
            && self
                .samples
                .iter()
                .zip(&other.samples)
                .all(|(one, two)| one.position == two.position);
        if !same {
            return false;
        }
        for (sample, other) in self.samples.iter_mut().zip(&other.samples) {
            sample.run = sample.run.min(other.run);
        }
        for (add, other) in self.adds.iter_mut().zip(&other.adds) {
            *add = (*add).min(*other);
        }
        true
    }

    /// The same with the joints in place of the axes.
    pub(crate) fn of_joints(&self, joints: &LimitedJoints) -> Recording {
        let mut recording = self.clone();
        for sample in &mut recording.samples {
            sample.position = joints.at(&sample.position);
        }
        recording
    }

    /// Reads records up to the end, or to where they break off.
    pub(crate) fn parse(mut bytes: &[u8]) -> Recording {
        let mut recording = Recording::default();
        while let Ok((record, rest)) = postcard::take_from_bytes(bytes) {
            bytes = rest;
            match record {
                Record::Start { takes_jerk, clock } => {
                    recording.takes_jerk = takes_jerk;
                    recording.clock = clock;
                }
                Record::Cycle(sample) => recording.samples.push(sample),
                Record::Add(nanoseconds) => recording.adds.push(nanoseconds),
                Record::End(end) => {
                    recording.ending = end.ending;
                    recording.heap_calls = end.heap_calls;
                    recording.errors = end.errors;
                    recording.first_error = end.first_error;
                    break;
                }
            }
        }
        recording
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_call_costs_the_shorter_time_of_two_runs() {
        let run = |times: [u32; 2], adds: &[u32], end: f64| Recording {
            samples: times
                .map(|run| Sample {
                    position: [end; 9],
                    run,
                    ..Sample::default()
                })
                .to_vec(),
            adds: adds.to_vec(),
            ending: Ending::Complete,
            ..Recording::default()
        };
        let mut one = run([10, 40], &[7, 8], 1.0);
        assert!(one.take_shorter(&run([20, 30], &[9, 6], 1.0)));
        assert_eq!(one, run([10, 30], &[7, 6], 1.0));
        assert!(!one.take_shorter(&run([1, 1], &[1, 1], 1.1)));
        assert!(!one.take_shorter(&run([1, 1], &[1], 1.0)));
        assert_eq!(one, run([10, 30], &[7, 6], 1.0));
    }

    #[test]
    fn what_was_recorded_before_a_crash_is_there() {
        let mut recorder = Recorder(Vec::new());
        let sample = Sample {
            position: [0.1; 9],
            scale: 0.5,
            id: 7,
            queued: 3,
            run: 1234,
            flags: HELD,
        };
        recorder.start(true, 25).expect("memory");
        recorder.add(800).expect("memory");
        recorder.sample(&sample).expect("memory");
        let crashed = Recording::parse(&recorder.0);
        assert_eq!((crashed.samples, crashed.adds), (vec![sample], vec![800]));
        assert_eq!(crashed.ending, Ending::Missing);

        let refused = Ending::Refused { line: 12, code: -1 };
        let end = End {
            ending: refused.clone(),
            heap_calls: 3,
            errors: 1,
            first_error: "too far".to_owned(),
        };
        recorder.end(end).expect("memory");
        let recording = Recording::parse(&recorder.0);
        assert_eq!(recording.ending, refused);
        assert_eq!((recording.heap_calls, recording.errors), (3, 1));
        assert_eq!(recording.first_error, "too far");
    }
}
