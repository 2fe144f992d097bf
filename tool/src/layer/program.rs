//! A program as task controller and motion controller see it, and the path that it describes.

use super::spindle::SpindleCommand;
use crate::canon::call::{PathMode, Tag};
use crate::machine::limits::is_rotary;
use crate::path::Position;
use crate::path::segment::Segment;
use framepath::moves::{FeedWord, ProgrammedFeed};
use serde::{Deserialize, Serialize};

/// LinuxCNC's numbers for the kinds of motion (`EMC_MOTION_TYPE_..`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub(crate) enum MotionType {
    Traverse = 1,
    Feed = 2,
    Arc = 3,
    Probing = 5,
}

/// Shape of a move for the planner; it starts where the one before ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Shape {
    Line,
    Arc {
        centre: [f64; 3],
        normal: [f64; 3],
        /// As `tpAddCircle` takes it: further turns, negative for clockwise.
        turn: i32,
    },
    /// Down and back.
    Tap,
}

/// A move that the planner is given.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Move {
    /// Number of the move from 0; the planner gets this plus one.
    pub index: usize,
    pub line: i32,
    pub shape: Shape,
    pub end: Position,
    pub motion_type: MotionType,
    /// mm/s, or degrees per second where nothing but rotary axes moves.
    pub velocity: f64,
    /// What the axes allow.
    pub greatest_velocity: f64,
    pub acceleration: f64,
    /// Waits for the spindle.
    pub at_speed: bool,
    pub tag: Tag,
}

/// The feeds of a program's moves as blendtp takes them: LinuxCNC slows an arc down for its radius, and blendtp goes by what other
/// moves with the same F were handed over with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Feeds {
    known: ProgrammedFeed,
    /// Where the move before ends.
    end: Option<Position>,
}

impl Move {
    /// Whether its line is one of the program, not of a file of subroutines.
    pub fn is_of_program(&self) -> bool {
        self.tag.file == 0
    }
}

impl Feeds {
    /// Of a program that begins.
    pub const BEGINNING: Self = Self {
        known: ProgrammedFeed::UNKNOWN,
        end: None,
    };

    /// Velocity and greatest velocity of the next move, mm/s, or degrees per second where nothing but rotary axes moves.
    pub fn of(&mut self, a_move: &Move) -> [f64; 2] {
        let handed = [a_move.velocity, a_move.greatest_velocity];
        let before = self.end.replace(a_move.end);
        let is_arc = matches!(a_move.shape, Shape::Arc { .. });
        let linear = before.is_none_or(|before| {
            (0..before.len()).any(|axis| !is_rotary(axis) && before[axis] != a_move.end[axis])
        });
        match a_move.motion_type {
            MotionType::Feed | MotionType::Arc if is_arc || linear => {
                let word = FeedWord::of_tag(a_move.tag.feed, a_move.tag.flags);
                self.known.of_move(is_arc, handed, word)
            }
            _ => handed,
        }
    }
}

/// What is done one after the other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Operation {
    Move(Box<Move>),
    /// Path mode of the moves to come, tolerance in mm.
    Termination(PathMode, f64),
    /// The next operation waits for the end of motion.
    WaitForMotion,
    /// Seconds.
    Dwell(f64),
    /// Length of the tool along Z from here on, mm.
    ToolLength(f64),
    Synchronise {
        per_revolution: f64,
        velocity_mode: bool,
    },
    Spindle(SpindleCommand),
}

/// A piece of the path with the tolerance that rules it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub segment: Segment,
    pub line: i32,
    /// The move to which it belongs.
    pub move_index: usize,
    pub mode: PathMode,
    /// G64 P, mm; 0 if none was given.
    pub tolerance: f64,
    /// How far merging may have taken the move from it, mm (Q; 0 where nothing was merged).
    pub merged_within: f64,
    /// Whole turns of an arc that LinuxCNC leaves away, since what is left of it without them is flat.
    pub turns_left_away: u32,
    /// Whether motion comes to its end here whatever the planner does.
    pub stops: bool,
}

/// The program.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program {
    pub operations: Vec<Operation>,
    /// As programmed.
    pub programmed: Vec<Piece>,
    /// As handed to the planner, one a move.
    pub handed: Vec<Piece>,
    /// For each move the range of programmed pieces, first and last.
    pub ranges: Vec<(usize, usize)>,
    /// Axes other than X Y Z move.
    pub other_axes: bool,
}

impl Program {
    /// Where the program ends; a rigid tap comes back to where it began.
    pub(crate) fn end(&self) -> Position {
        let Some(piece) = self.handed.last() else {
            return [0.0; 9];
        };
        let mut backwards = self.operations.iter().rev();
        let last = backwards.find_map(|operation| match operation {
            Operation::Move(a_move) => Some(a_move.shape),
            _ => None,
        });
        match last {
            Some(Shape::Tap) => piece.segment.start,
            _ => piece.segment.end,
        }
    }
}
