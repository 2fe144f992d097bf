//! What the process that drives a module is told, as a stream of bytes: numbers of eight bytes each.

use super::limits::Limits;
use super::operator::{Action, Event};
use super::program::{MotionType, Move, Operation, Shape};
use crate::canon::call::{PathMode, Tag};
use std::array::from_fn;

/// One run of a module.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Job {
    pub module: String,
    /// Servo period, s.
    pub period: f64,
    pub limits: Limits,
    /// Jerk limit of each axis, 0 = not limited.
    pub jerk: [f64; 9],
    pub adds_per_cycle: usize,
    /// No move is handed over while so many are queued.
    pub queue: usize,
    /// Greatest velocity of the machine, mm/s.
    pub velocity_limit: f64,
    /// Greatest feed override that the machine lets the operator set.
    pub max_feed_override: f64,
    /// Standing still that long counts as stuck, s.
    pub stuck_after: f64,
    /// The run ends after that long, s.
    pub time_limit: f64,
    pub events: Vec<Event>,
    pub operations: Vec<Operation>,
}

impl Job {
    /// The greatest feed override that the machine allows or that comes, at least 1.
    pub(crate) fn greatest_override(&self) -> f64 {
        self.events
            .iter()
            .fold(self.max_feed_override.max(1.0), |most, event| {
                match event.action {
                    Action::FeedOverride(scale) => f64::max(most, scale),
                    _ => most,
                }
            })
    }

    /// Whether each move follows the speed of a spindle or its angle.
    pub(crate) fn with_spindle(&self) -> Vec<bool> {
        self.coupled(|_| true)
    }

    /// Whether each move follows the angle of a spindle: no hold takes it out of the thread.
    pub(crate) fn in_thread(&self) -> Vec<bool> {
        self.coupled(|velocity_mode| !velocity_mode)
    }

    /// Whether each move is a tap, or synchronised in a mode that counts.
    fn coupled(&self, counts: impl Fn(bool) -> bool) -> Vec<bool> {
        let mut synchronised = false;
        let mut found = Vec::new();
        for operation in &self.operations {
            match operation {
                Operation::Synchronise {
                    per_revolution,
                    velocity_mode,
                } => synchronised = *per_revolution != 0.0 && counts(*velocity_mode),
                Operation::Move(a_move) => found.push(synchronised || a_move.shape == Shape::Tap),
                _ => {}
            }
        }
        found
    }

    /// The jerk limits that a module is held to, 0 = none: those of the machine where it takes them.
    pub(crate) fn jerk_limits(&self, takes_jerk: bool) -> [f64; 9] {
        if takes_jerk { self.jerk } else { [0.0; 9] }
    }

    pub(crate) fn encode(&self) -> Vec<u8> {
        let mut out = Encoder(Vec::new());
        out.count(self.module.len());
        out.0.extend_from_slice(self.module.as_bytes());
        out.numbers(&[
            self.period,
            self.velocity_limit,
            self.max_feed_override,
            self.stuck_after,
            self.time_limit,
        ]);
        out.count(self.adds_per_cycle);
        out.count(self.queue);
        out.numbers(&self.limits.velocity);
        out.numbers(&self.limits.acceleration);
        out.numbers(&self.jerk);
        out.count(self.events.len());
        for event in &self.events {
            let (kind, value) = match event.action {
                Action::FeedOverride(scale) => (0, scale),
                Action::Pause(seconds) => (1, seconds),
                Action::MaxVelocity(velocity) => (2, velocity),
                Action::Abort => (3, 0.0),
            };
            out.count(kind);
            out.numbers(&[event.time, value]);
        }
        out.count(self.operations.len());
        for operation in &self.operations {
            out.operation(operation);
        }
        out.0
    }

    /// `None` if it is not a job.
    pub(crate) fn decode(bytes: &[u8]) -> Option<Job> {
        let mut input = Decoder(bytes);
        let length = input.count()?;
        let (module, rest) = input.0.split_at_checked(length)?;
        let module = String::from_utf8(module.to_vec()).ok()?;
        input.0 = rest;
        let [
            period,
            velocity_limit,
            max_feed_override,
            stuck_after,
            time_limit,
        ] = input.numbers()?;
        let adds_per_cycle = input.count()?;
        let queue = input.count()?;
        let limits = Limits {
            velocity: input.numbers()?,
            acceleration: input.numbers()?,
        };
        let jerk = input.numbers()?;
        let events = (0..input.count()?)
            .map(|_| input.event())
            .collect::<Option<_>>()?;
        let operations = (0..input.count()?)
            .map(|_| input.operation())
            .collect::<Option<_>>()?;
        Some(Job {
            module,
            period,
            limits,
            jerk,
            adds_per_cycle,
            queue,
            velocity_limit,
            max_feed_override,
            stuck_after,
            time_limit,
            events,
            operations,
        })
    }
}

struct Encoder(Vec<u8>);

impl Encoder {
    fn count(&mut self, count: usize) {
        self.0.extend_from_slice(&(count as u64).to_le_bytes());
    }

    fn integer(&mut self, number: i32) {
        self.0.extend_from_slice(&i64::from(number).to_le_bytes());
    }

    fn numbers(&mut self, numbers: &[f64]) {
        for number in numbers {
            self.0.extend_from_slice(&number.to_le_bytes());
        }
    }

    fn operation(&mut self, operation: &Operation) {
        match operation {
            Operation::Move(a_move) => {
                self.count(0);
                self.a_move(a_move);
            }
            Operation::Termination(mode, tolerance) => {
                self.count(1);
                self.count(match mode {
                    PathMode::ExactStop => 0,
                    PathMode::ExactPath => 1,
                    PathMode::Continuous => 2,
                });
                self.numbers(&[*tolerance]);
            }
            Operation::WaitForMotion => self.count(2),
            Operation::Dwell(seconds) => {
                self.count(3);
                self.numbers(&[*seconds]);
            }
            Operation::Synchronise {
                per_revolution,
                velocity_mode,
            } => {
                self.count(4);
                self.numbers(&[*per_revolution]);
                self.count(usize::from(*velocity_mode));
            }
            Operation::Spindle(speed) => {
                self.count(5);
                self.numbers(&[*speed]);
            }
        }
    }

    fn a_move(&mut self, a_move: &Move) {
        self.count(a_move.index);
        self.integer(a_move.line);
        match a_move.shape {
            Shape::Line => self.count(0),
            Shape::Arc {
                centre,
                normal,
                turn,
            } => {
                self.count(1);
                self.numbers(&centre);
                self.numbers(&normal);
                self.integer(turn);
            }
            Shape::Tap => self.count(2),
        }
        self.numbers(&a_move.end);
        self.integer(a_move.motion_type as i32);
        self.numbers(&[
            a_move.velocity,
            a_move.greatest_velocity,
            a_move.acceleration,
        ]);
        self.count(usize::from(a_move.at_speed));
        let tag = &a_move.tag;
        self.numbers(&[
            tag.path_tolerance,
            tag.naive_cam_tolerance,
            tag.feed,
            tag.speed,
        ]);
        self.0.extend_from_slice(&tag.flags.to_le_bytes());
        for field in tag.fields {
            self.integer(field);
        }
    }
}

struct Decoder<'a>(&'a [u8]);

impl Decoder<'_> {
    fn word(&mut self) -> Option<[u8; 8]> {
        let (word, rest) = self.0.split_first_chunk::<8>()?;
        self.0 = rest;
        Some(*word)
    }

    fn count(&mut self) -> Option<usize> {
        usize::try_from(u64::from_le_bytes(self.word()?)).ok()
    }

    fn integer(&mut self) -> Option<i32> {
        i32::try_from(i64::from_le_bytes(self.word()?)).ok()
    }

    fn number(&mut self) -> Option<f64> {
        Some(f64::from_le_bytes(self.word()?))
    }

    fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        let numbers: [Option<f64>; N] = from_fn(|_| self.number());
        numbers
            .iter()
            .all(Option::is_some)
            .then(|| numbers.map(Option::unwrap_or_default))
    }

    fn event(&mut self) -> Option<Event> {
        let kind = self.count()?;
        let [time, value] = self.numbers()?;
        let action = match kind {
            0 => Action::FeedOverride(value),
            1 => Action::Pause(value),
            2 => Action::MaxVelocity(value),
            3 => Action::Abort,
            _ => return None,
        };
        Some(Event { time, action })
    }

    fn operation(&mut self) -> Option<Operation> {
        Some(match self.count()? {
            0 => Operation::Move(Box::new(self.a_move()?)),
            1 => {
                let mode = match self.count()? {
                    0 => PathMode::ExactStop,
                    1 => PathMode::ExactPath,
                    2 => PathMode::Continuous,
                    _ => return None,
                };
                Operation::Termination(mode, self.number()?)
            }
            2 => Operation::WaitForMotion,
            3 => Operation::Dwell(self.number()?),
            4 => Operation::Synchronise {
                per_revolution: self.number()?,
                velocity_mode: self.count()? != 0,
            },
            5 => Operation::Spindle(self.number()?),
            _ => return None,
        })
    }

    fn a_move(&mut self) -> Option<Move> {
        let index = self.count()?;
        let line = self.integer()?;
        let shape = match self.count()? {
            0 => Shape::Line,
            1 => Shape::Arc {
                centre: self.numbers()?,
                normal: self.numbers()?,
                turn: self.integer()?,
            },
            2 => Shape::Tap,
            _ => return None,
        };
        let end = self.numbers()?;
        let motion_type = match self.integer()? {
            1 => MotionType::Traverse,
            2 => MotionType::Feed,
            3 => MotionType::Arc,
            5 => MotionType::Probing,
            _ => return None,
        };
        let [velocity, greatest_velocity, acceleration] = self.numbers()?;
        let at_speed = self.count()? != 0;
        let [path_tolerance, naive_cam_tolerance, feed, speed] = self.numbers()?;
        let flags = u64::from_le_bytes(self.word()?);
        let mut fields = [0; 8];
        for field in &mut fields {
            *field = self.integer()?;
        }
        Some(Move {
            index,
            line,
            shape,
            end,
            motion_type,
            velocity,
            greatest_velocity,
            acceleration,
            at_speed,
            tag: Tag {
                path_tolerance,
                naive_cam_tolerance,
                feed,
                speed,
                flags,
                fields,
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job() -> Job {
        let a_move = Move {
            index: 3,
            line: -1,
            shape: Shape::Arc {
                centre: [1.0, 2.0, 3.0],
                normal: [0.0, 0.0, 1.0],
                turn: -2,
            },
            end: [0.1; 9],
            motion_type: MotionType::Arc,
            velocity: 1.0,
            greatest_velocity: 2.0,
            acceleration: 3.0,
            at_speed: true,
            tag: Tag {
                path_tolerance: 0.05,
                flags: u64::MAX,
                fields: [-1; 8],
                ..Tag::default()
            },
        };
        Job {
            module: "a planner.so".to_owned(),
            period: 0.001,
            limits: Limits::default(),
            jerk: [20_000.0; 9],
            adds_per_cycle: 1,
            queue: usize::MAX,
            velocity_limit: 1e9,
            max_feed_override: 2.0,
            stuck_after: 10.0,
            time_limit: 7200.0,
            events: vec![Event {
                time: 1.0,
                action: Action::Abort,
            }],
            operations: vec![
                Operation::Termination(PathMode::Continuous, 0.05),
                Operation::Move(Box::new(a_move)),
                Operation::Dwell(0.5),
                Operation::Synchronise {
                    per_revolution: 1.5,
                    velocity_mode: true,
                },
                Operation::Spindle(-100.0),
                Operation::WaitForMotion,
            ],
        }
    }

    #[test]
    fn comes_out_as_it_went_in() {
        assert_eq!(Job::decode(&job().encode()), Some(job()));
    }

    #[test]
    fn what_is_cut_off_is_no_job() {
        let bytes = job().encode();
        for end in (0..bytes.len()).step_by(7) {
            assert_eq!(Job::decode(&bytes[..end]), None, "{end} bytes");
        }
    }
}
