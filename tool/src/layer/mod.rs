//! What LinuxCNC's canonical layer does with the calls of the interpreter: velocity and
//! acceleration of each move by the limits of the axes, merging of short lines ("naive cam"), path
//! modes, spindle synchronisation; and where the task controller waits for the end of motion.
//!
//! Behaviour read in LinuxCNC 2.9 (`emccanon.cc`, `emctaskmain.cc`). [`straight`] is the arithmetic
//! of a straight move, [`arc`] that of an arc, [`merging`] joins short lines, [`spindle`] is what the spindle is told, [`builder`] keeps
//! the list of operations and pieces, which make a [`program`], [`turns`] says which arcs lose theirs, [`judged`] by which piece a place of the machine is judged, [`stream`] hands them out while the
//! program is read.

mod arc;
mod builder;
pub(crate) mod judged;
mod merging;
pub(crate) mod program;
pub(crate) mod spindle;
mod straight;
pub(crate) mod stream;
#[cfg(test)]
mod tests;
pub(crate) mod turns;

use crate::canon::call::{Call, PathMode, Tag};
use crate::machine::limits::Limits;
use crate::path::Position;
use crate::path::segment::Segment;
use builder::Builder;
use merging::Chain;
use program::{MotionType, Move, Operation, Program, Shape};
use spindle::Spindle;
use straight::Straight;

/// How the layer is to work.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LayerSettings {
    pub limits: Limits,
    /// Every F is raised to at least this, mm/min.
    pub feed_at_least: Option<f64>,
}

/// Turns the calls of a program into the operations of the task controller.
pub(crate) fn lay(calls: &[Call], settings: &LayerSettings) -> Program {
    let mut layer = Layer::new(settings);
    for call in calls {
        layer.take(call);
    }
    layer.flush();
    layer.builder.finish()
}

struct Layer<'a> {
    settings: &'a LayerSettings,
    builder: Builder,
    chain: Chain,
    /// Millimetres of a program unit.
    unit: f64,
    /// mm/s; as programmed with feed per revolution.
    linear_feed: f64,
    /// Degrees per second.
    angular_feed: f64,
    per_revolution: bool,
    synchronised: bool,
    /// End of the last move that was handed over.
    end: Position,
    /// End of the last programmed move.
    programmed_end: Position,
    tag: Tag,
    spindle: Spindle,
    /// The next move at feed waits for the spindle.
    at_speed_next: bool,
}

impl<'a> Layer<'a> {
    fn new(settings: &'a LayerSettings) -> Self {
        Layer {
            settings,
            builder: Builder::new(),
            chain: Chain::default(),
            unit: 1.0,
            linear_feed: 0.0,
            angular_feed: 0.0,
            per_revolution: false,
            synchronised: false,
            end: [0.0; 9],
            programmed_end: [0.0; 9],
            tag: Tag::default(),
            spindle: Spindle::default(),
            at_speed_next: false,
        }
    }

    fn take(&mut self, call: &Call) {
        match *call {
            Call::Traverse { line, end } => self.traverse(line, end),
            Call::Feed { line, end } => self.feed(line, end),
            Call::Probe { line, end } => self.probe(line, end),
            Call::Tap { line, end } => self.tap(line, end),
            Call::Arc { .. } => self.arc(call),
            Call::Rate(rate) => self.rate(rate),
            Call::PerRevolution(on) => {
                self.flush();
                self.per_revolution = on;
                if !on {
                    self.synchronise(0.0, false);
                }
            }
            Call::Unit(unit) => self.unit = unit,
            Call::Mode(mode, tolerance) => {
                self.flush();
                self.builder.mode(mode, tolerance);
            }
            Call::NaiveCam(tolerance) => self.chain.tolerance = tolerance,
            Call::Tag(tag) => self.tag = tag,
            Call::Synchronise {
                per_revolution,
                velocity_mode,
            } => self.synchronise(per_revolution, velocity_mode),
            Call::Surface { greatest, centre } => self.surface(greatest, centre),
            Call::Spindle { speed, direction } => self.switch_spindle(speed, direction),
            Call::Speed(speed) => self.spindle_speed(speed),
            Call::ToolLength(length) => {
                self.wait();
                self.builder.operation(Operation::ToolLength(length));
            }
            Call::Dwell(seconds) => {
                self.wait();
                self.builder.operation(Operation::Dwell(seconds));
            }
            Call::Wait | Call::UserCode(_) => self.wait(),
            // Motion has come to its end for it before.
            Call::Input(_) | Call::OptionalBlock => {}
            Call::Flush => self.flush(),
        }
    }

    fn wait(&mut self) {
        self.flush();
        self.builder.wait();
    }

    fn synchronise(&mut self, per_revolution: f64, velocity_mode: bool) {
        self.flush();
        self.builder.operation(Operation::Synchronise {
            per_revolution,
            velocity_mode,
        });
        self.synchronised = per_revolution != 0.0;
    }

    fn rate(&mut self, rate: f64) {
        if self.per_revolution {
            self.synchronise(rate * self.unit, true);
            self.linear_feed = rate;
            return;
        }
        let least = self.settings.feed_at_least.unwrap_or(0.0);
        // In this order, as in LinuxCNC: to the last digit.
        let a_second = rate / 60.0;
        let linear = (a_second * self.unit).max(least / 60.0);
        let angular = a_second.max(least / 60.0);
        if linear != self.linear_feed || angular != self.angular_feed {
            self.flush();
        }
        self.linear_feed = linear;
        self.angular_feed = angular;
    }

    fn straight(&self, end: &Position) -> Straight {
        Straight::between(&self.end, end, &self.settings.limits)
    }

    /// The velocity of a straight move at feed.
    fn feed_velocity(&self, straight: &Straight) -> f64 {
        let greatest = straight.velocity(self.linear_feed, self.angular_feed);
        if straight.linear {
            greatest.min(self.linear_feed)
        } else if straight.angular {
            greatest.min(self.angular_feed)
        } else {
            greatest
        }
    }

    fn greatest_velocity(&self, straight: &Straight) -> f64 {
        straight.velocity(self.linear_feed, self.angular_feed)
    }

    fn traverse(&mut self, line: i32, end: Position) {
        self.flush();
        let straight = self.straight(&end);
        let velocity = self.greatest_velocity(&straight);
        // A rapid does not follow the spindle; what comes after it does again.
        if self.per_revolution {
            self.synchronise(0.0, false);
        }
        if velocity > 0.0 && straight.acceleration() > 0.0 {
            self.programmed_line(line, end);
            self.hand_line(
                line,
                end,
                MotionType::Traverse,
                velocity,
                &straight,
                self.tag,
            );
            self.await_new_diameter();
        }
        if self.per_revolution {
            self.synchronise(self.linear_feed * self.unit, true);
        }
        self.end = end;
        self.programmed_end = end;
    }

    fn probe(&mut self, line: i32, end: Position) {
        self.wait();
        let straight = self.straight(&end);
        let velocity = self.feed_velocity(&straight);
        if velocity > 0.0 && straight.acceleration() > 0.0 {
            self.programmed_line(line, end);
            self.hand_line(
                line,
                end,
                MotionType::Probing,
                velocity,
                &straight,
                self.tag,
            );
        }
        self.builder.wait();
        self.end = end;
        self.programmed_end = end;
    }

    /// Down and back: the end of the move before stays where it was.
    fn tap(&mut self, line: i32, end: Position) {
        self.wait();
        let straight = self.straight(&end);
        let velocity = self.greatest_velocity(&straight);
        if velocity > 0.0 && straight.acceleration() > 0.0 {
            let top = self.end;
            self.builder.piece(line, Segment::line(top, end));
            self.builder.piece(line, Segment::line(end, top));
            let tap = self.a_move(line, Shape::Tap, end, velocity, &straight);
            self.builder.hand(tap, Segment::line(top, end));
        }
    }

    fn a_move(
        &self,
        line: i32,
        shape: Shape,
        end: Position,
        velocity: f64,
        straight: &Straight,
    ) -> Move {
        Move {
            index: 0,
            line,
            shape,
            end,
            motion_type: MotionType::Feed,
            velocity,
            greatest_velocity: self.greatest_velocity(straight),
            acceleration: straight.acceleration(),
            at_speed: false,
            tag: self.tag,
        }
    }

    /// Notes a line of the program, for the moves to come.
    fn programmed_line(&mut self, line: i32, end: Position) {
        self.builder
            .piece(line, Segment::line(self.programmed_end, end));
    }

    /// Hands over a line with all pieces that were noted.
    fn hand_line(
        &mut self,
        line: i32,
        end: Position,
        motion_type: MotionType,
        velocity: f64,
        straight: &Straight,
        tag: Tag,
    ) {
        let mut line = self.a_move(line, Shape::Line, end, velocity, straight);
        line.motion_type = motion_type;
        line.tag = tag;
        line.at_speed =
            motion_type != MotionType::Traverse && std::mem::take(&mut self.at_speed_next);
        self.builder.hand(line, Segment::line(self.end, end));
    }

    fn continuous(&self) -> bool {
        self.builder.path_mode() == PathMode::Continuous
    }
}
