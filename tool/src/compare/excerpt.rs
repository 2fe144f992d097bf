//! A part of a program that is run as a program of its own, from rest to rest: moves that have a tolerance.

use crate::canon::call::PathMode;
use crate::layer::program::{MotionType, Move, Operation, Piece, Program, Shape};
use crate::path::Position;
use crate::path::segment::{Arc, Segment};
use serde::Serialize;
use std::array::from_fn;
use std::fmt;
use std::ops::RangeInclusive;

/// Where an excerpt stands in its program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Excerpt {
    /// Lines of its first and its last move.
    pub first_line: i32,
    pub last_line: i32,
    /// Moves of the whole program.
    pub of_moves: usize,
}

/// The first reason against a move, and why none stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Against {
    Rapid,
    Exact,
    NoTolerance,
    OtherAxes,
    Spindle,
    Kind,
}

/// Why a program has no excerpt: how many of its moves each reason stands against.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct NoExcerpt(Vec<(Against, usize)>);

impl fmt::Display for NoExcerpt {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "no move in G1, G2 or G3 of X Y Z with a tolerance (G64 P)"
        )?;
        for (index, (against, count)) in self.0.iter().enumerate() {
            let what = match against {
                Against::Rapid => "in G0",
                Against::Exact => "in G61 or G61.1",
                Against::NoTolerance => "in G64 without P",
                Against::OtherAxes => "with another axis",
                Against::Spindle => "that follow the spindle",
                Against::Kind => "that probe or tap",
            };
            let before = if index == 0 { ": " } else { ", " };
            write!(f, "{before}{count} {what}")?;
        }
        Ok(())
    }
}

/// The middle of the longest run of moves that have a tolerance, with `most` moves at most.
///
/// A run ends where the program waits for the end of motion, and at moves in G0, G61, G61.1, G64 without P, with other
/// axes than X Y Z, or that follow the spindle.
pub(super) fn excerpt(program: &Program, most: usize) -> Result<(Excerpt, Program), NoExcerpt> {
    let run = longest_run(program)?;
    let count = run.clone().count();
    let first = run.start() + count.saturating_sub(most) / 2;
    let moves = first..=first + count.min(most) - 1;
    let line = |index: usize| program.handed[index].line;
    let place = Excerpt {
        first_line: line(*moves.start()),
        last_line: line(*moves.end()),
        of_moves: program.handed.len(),
    };
    Ok((place, cut(program, moves)))
}

fn longest_run(program: &Program) -> Result<RangeInclusive<usize>, NoExcerpt> {
    let mut found: Option<RangeInclusive<usize>> = None;
    let mut none = NoExcerpt::default();
    let mut start = None;
    let mut synchronised = false;
    for operation in &program.operations {
        match operation {
            Operation::Move(a_move) => {
                let piece = &program.handed[a_move.index];
                if let Some(reason) = against(a_move, piece, synchronised) {
                    none.count(reason);
                    start = None;
                    continue;
                }
                // A planner waits for the spindle at rest.
                let first = match start {
                    Some(first) if !a_move.at_speed => first,
                    _ => a_move.index,
                };
                start = Some(first);
                let run = first..=a_move.index;
                if found
                    .as_ref()
                    .is_none_or(|found| found.clone().count() < run.clone().count())
                {
                    found = Some(run);
                }
            }
            Operation::Synchronise { per_revolution, .. } => synchronised = *per_revolution != 0.0,
            Operation::WaitForMotion | Operation::Dwell(_) | Operation::ToolLength(_) => {
                start = None;
            }
            Operation::Termination(..) | Operation::Spindle(_) => {}
        }
    }
    found.ok_or(none)
}

impl NoExcerpt {
    fn count(&mut self, reason: Against) {
        match self.0.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, count)) => *count += 1,
            None => self.0.push((reason, 1)),
        }
    }
}

fn against(a_move: &Move, piece: &Piece, synchronised: bool) -> Option<Against> {
    let segment = &piece.segment;
    if !matches!(a_move.motion_type, MotionType::Feed | MotionType::Arc)
        || a_move.shape == Shape::Tap
    {
        let rapid = a_move.motion_type == MotionType::Traverse;
        Some(if rapid { Against::Rapid } else { Against::Kind })
    } else if synchronised {
        Some(Against::Spindle)
    } else if segment.start[3..] != segment.end[3..] {
        Some(Against::OtherAxes)
    } else if piece.mode != PathMode::Continuous {
        Some(Against::Exact)
    } else if piece.tolerance <= 0.0 {
        Some(Against::NoTolerance)
    } else {
        None
    }
}

/// These moves alone, of which the first begins at zero, where a machine stands before a program.
fn cut(program: &Program, moves: RangeInclusive<usize>) -> Program {
    let origin = program.handed[*moves.start()].segment.start;
    let (first, last) = (
        program.ranges[*moves.start()].0,
        program.ranges[*moves.end()].1,
    );
    let pieces = |pieces: &[Piece]| -> Vec<Piece> {
        let moved = pieces.iter().map(|piece| Piece {
            segment: shifted(&piece.segment, &origin),
            move_index: piece.move_index.saturating_sub(*moves.start()),
            ..*piece
        });
        moved.collect()
    };
    let mut handed = pieces(&program.handed[moves.clone()]);
    if let Some(piece) = handed.last_mut() {
        piece.stops = true;
    }
    Program {
        operations: operations(program, &moves, &origin),
        programmed: pieces(&program.programmed[first..=last]),
        handed,
        ranges: program.ranges[moves]
            .iter()
            .map(|(from, to)| (from - first, to - first))
            .collect(),
        other_axes: false,
    }
}

fn operations(
    program: &Program,
    moves: &RangeInclusive<usize>,
    origin: &Position,
) -> Vec<Operation> {
    let mut mode = None;
    let mut found = Vec::new();
    for operation in &program.operations {
        match operation {
            Operation::Termination(..) => mode = Some(operation.clone()),
            Operation::Move(a_move) if moves.contains(&a_move.index) => {
                found.extend(mode.take());
                let moved = alone(a_move, *moves.start(), origin);
                found.push(Operation::Move(Box::new(moved)));
            }
            _ => {}
        }
    }
    found
}

/// The move in the excerpt, where it waits for no spindle.
fn alone(a_move: &Move, first: usize, origin: &Position) -> Move {
    let mut moved = *a_move;
    moved.index -= first;
    moved.end = minus(&a_move.end, origin);
    moved.at_speed = false;
    if let Shape::Arc { centre, .. } = &mut moved.shape {
        *centre = from_fn(|axis| centre[axis] - origin[axis]);
    }
    moved
}

fn shifted(segment: &Segment, origin: &Position) -> Segment {
    let arc = segment.arc.map(|arc| Arc {
        centre: from_fn(|axis| arc.centre[axis] - origin[axis]),
        ..arc
    });
    Segment {
        start: minus(&segment.start, origin),
        end: minus(&segment.end, origin),
        arc,
        ..*segment
    }
}

fn minus(position: &Position, origin: &Position) -> Position {
    from_fn(|axis| position[axis] - origin[axis])
}
