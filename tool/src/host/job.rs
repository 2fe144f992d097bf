//! What the process that drives a module is told.

use super::operator::{Action, Event};
use crate::joints::LimitedJoints;
use crate::layer::program::Operation;
#[cfg(feature = "optimum")]
use crate::layer::program::Shape;
use crate::machine::limits::{Limits, infinite_for_none};
use crate::path::Position;
use serde::{Deserialize, Serialize};

/// One run of a module.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Job {
    pub module: String,
    /// Servo period, s.
    pub period: f64,
    pub limits: Limits,
    /// Jerk limit of each axis, 0 = not limited.
    pub jerk: [f64; 9],
    pub adds_per_cycle: usize,
    /// The joints that have limits of their own, with these.
    pub joints: Option<LimitedJoints>,
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

    /// The jerk limits that a module is held to, 0 = none: those of the machine where it takes them.
    pub(crate) fn jerk_limits(&self, takes_jerk: bool) -> [f64; 9] {
        if takes_jerk { self.jerk } else { [0.0; 9] }
    }

    /// What a module is held to: velocity, acceleration and jerk of each axis, shape (3, 9), infinite where there is no
    /// limit. Where joints have limits of their own, axes keep their velocities alone.
    pub(crate) fn bounds(&self, takes_jerk: bool) -> [Position; 3] {
        let none = [f64::INFINITY; 9];
        let Limits {
            velocity,
            acceleration,
        } = self.limits;
        if self.joints.is_some() {
            return [velocity, none, none];
        }
        let jerk = self.jerk_limits(takes_jerk).map(infinite_for_none);
        [velocity, acceleration, jerk]
    }

    /// The same of the joints that have limits.
    pub(crate) fn joint_bounds(&self, takes_jerk: bool) -> Option<[Position; 3]> {
        let [velocity, acceleration, jerk] = *self.joints.as_ref()?.limits();
        let jerk = if takes_jerk { jerk } else { [f64::INFINITY; 9] };
        Some([velocity, acceleration, jerk])
    }
}

#[cfg(feature = "optimum")]
impl Job {
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
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::canon::call::{PathMode, Tag};
    use crate::layer::program::{MotionType, Move, Shape};
    use crate::layer::spindle::{SpindleCommand, Surface};

    /// One of each kind of operation.
    pub(crate) fn job() -> Job {
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
            joints: None,
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
                Operation::Spindle(SpindleCommand {
                    speed: -100.0,
                    surface: Some(Surface {
                        speed: -1e5,
                        centre: 3.0,
                    }),
                }),
                Operation::WaitForMotion,
            ],
        }
    }

    #[test]
    fn comes_out_as_it_went_in() {
        let bytes = postcard::to_stdvec(&job()).expect("bytes");
        assert_eq!(postcard::from_bytes(&bytes), Ok(job()));
    }

    #[test]
    fn what_is_cut_off_is_no_job() {
        let bytes = postcard::to_stdvec(&job()).expect("bytes");
        for end in 0..bytes.len() {
            assert!(postcard::from_bytes::<Job>(&bytes[..end]).is_err(), "{end}");
        }
    }
}
