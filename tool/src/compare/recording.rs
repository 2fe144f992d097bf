//! What came back from a run: a sample of every servo cycle, the cost of each call, how it ended.
//!
//! The driven process writes it as a stream of records, each with a letter in front, so that what was
//! recorded before a crash is there.

use crate::canon::call::Position;
use std::io::{self, Write};

/// One servo cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

/// How a run ended.
#[derive(Clone, Debug, Default, PartialEq)]
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

/// What the driven process writes while it runs.
pub(crate) struct Recorder<W: Write>(pub W);

impl<W: Write> Recorder<W> {
    pub(crate) fn start(&mut self, takes_jerk: bool, clock: u32) -> io::Result<()> {
        self.0.write_all(b"S")?;
        self.0.write_all(&[u8::from(takes_jerk)])?;
        self.0.write_all(&clock.to_le_bytes())
    }

    pub(crate) fn sample(&mut self, sample: &Sample) -> io::Result<()> {
        self.0.write_all(b"C")?;
        for coordinate in sample.position {
            self.0.write_all(&coordinate.to_le_bytes())?;
        }
        self.0.write_all(&sample.scale.to_le_bytes())?;
        self.0.write_all(&sample.id.to_le_bytes())?;
        self.0.write_all(&sample.queued.to_le_bytes())?;
        self.0.write_all(&sample.run.to_le_bytes())?;
        self.0.write_all(&[sample.flags])
    }

    pub(crate) fn add(&mut self, nanoseconds: u32) -> io::Result<()> {
        self.0.write_all(b"A")?;
        self.0.write_all(&nanoseconds.to_le_bytes())
    }

    pub(crate) fn end(
        &mut self,
        ending: &Ending,
        heap_calls: u64,
        errors: u64,
        first_error: &str,
    ) -> io::Result<()> {
        let (kind, line, code, text) = match ending {
            Ending::Complete => (0, 0, 0, ""),
            Ending::Aborted => (1, 0, 0, ""),
            Ending::Stuck => (2, 0, 0, ""),
            Ending::TooLong => (3, 0, 0, ""),
            Ending::Refused { line, code } => (4, *line, *code, ""),
            Ending::NotUsable(text) => (5, 0, 0, text.as_str()),
            Ending::GaveUp { line } => (6, *line, 0, ""),
            Ending::Missing => return Ok(()),
        };
        self.0.write_all(b"E")?;
        self.0.write_all(&[kind])?;
        self.0.write_all(&line.to_le_bytes())?;
        self.0.write_all(&code.to_le_bytes())?;
        self.0.write_all(&heap_calls.to_le_bytes())?;
        self.0.write_all(&errors.to_le_bytes())?;
        for text in [text, first_error] {
            self.0.write_all(&(text.len() as u32).to_le_bytes())?;
            self.0.write_all(text.as_bytes())?;
        }
        self.0.flush()
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

    /// Reads records up to the end, or to where they break off.
    pub(crate) fn parse(bytes: &[u8]) -> Recording {
        let mut recording = Recording::default();
        let mut input = Input(bytes);
        while recording.record(&mut input).is_some() {}
        recording
    }

    fn record(&mut self, input: &mut Input) -> Option<()> {
        match input.take::<1>()? {
            [b'S'] => {
                self.takes_jerk = input.take::<1>()? != [0];
                self.clock = u32::from_le_bytes(input.take()?);
            }
            [b'C'] => {
                let mut sample = Sample::default();
                for coordinate in &mut sample.position {
                    *coordinate = f64::from_le_bytes(input.take()?);
                }
                sample.scale = f64::from_le_bytes(input.take()?);
                sample.id = i32::from_le_bytes(input.take()?);
                sample.queued = i32::from_le_bytes(input.take()?);
                sample.run = u32::from_le_bytes(input.take()?);
                [sample.flags] = input.take()?;
                self.samples.push(sample);
            }
            [b'A'] => self.adds.push(u32::from_le_bytes(input.take()?)),
            [b'E'] => {
                let [kind] = input.take()?;
                let line = i32::from_le_bytes(input.take()?);
                let code = i32::from_le_bytes(input.take()?);
                self.heap_calls = u64::from_le_bytes(input.take()?);
                self.errors = u64::from_le_bytes(input.take()?);
                let text = input.text()?;
                self.first_error = input.text()?;
                self.ending = match kind {
                    0 => Ending::Complete,
                    1 => Ending::Aborted,
                    2 => Ending::Stuck,
                    3 => Ending::TooLong,
                    4 => Ending::Refused { line, code },
                    6 => Ending::GaveUp { line },
                    _ => Ending::NotUsable(text),
                };
                return None;
            }
            _ => return None,
        }
        Some(())
    }
}

struct Input<'a>(&'a [u8]);

impl Input<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (taken, rest) = self.0.split_first_chunk::<N>()?;
        self.0 = rest;
        Some(*taken)
    }

    fn text(&mut self) -> Option<String> {
        let length = u32::from_le_bytes(self.take()?) as usize;
        let (text, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        Some(String::from_utf8_lossy(text).into_owned())
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
        recorder.end(&refused, 3, 1, "too far").expect("memory");
        let recording = Recording::parse(&recorder.0);
        assert_eq!(recording.ending, refused);
        assert_eq!((recording.heap_calls, recording.errors), (3, 1));
        assert_eq!(recording.first_error, "too far");
    }
}
