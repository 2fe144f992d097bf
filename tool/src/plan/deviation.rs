//! Distance between the planned and the programmed path, both ways, while both go by.

use super::drive::Handed;
use crate::layer::judged::{Around, judged, tolerance, wider, with_merging};
use crate::layer::program::{Piece, Shape};
use crate::layer::turns::TurnsLeftAway;
use crate::path::Position;
use crate::path::between::way;
use crate::path::exceeded::is_beyond;
use crate::path::segment::Segment;
use framepath::axes::Axes;
use framepath::path::Orientation;
use std::collections::VecDeque;
use std::ops::Range;

/// Pieces behind and ahead of the nearest one that are looked at in each cycle.
const NEAR: usize = 3;

/// Pieces ahead that are looked at, at most, while that leads nearer.
const FAR: usize = 400;

/// Pieces behind the nearest one that are kept: the path may still come near their ends.
const KEPT: usize = 32;

/// Pieces whose distances differ by less are as near as each other, mm or degrees.
const SAME: f64 = 1e-6;

/// The largest distance found.
#[derive(Clone, Copy, Debug, Default)]
pub struct Farthest {
    /// mm, or degrees of rotary axes.
    pub distance: f64,
    /// The tolerance that rules there, mm; `None` where there is none (G64 without P).
    pub tolerance: Option<f64>,
    /// Line of the program there.
    pub line: i32,
}

impl Farthest {
    fn note(&mut self, distance: f64, piece: &Tracked) {
        if distance > self.distance || self.line == 0 {
            *self = Farthest {
                distance,
                tolerance: piece.allowed(),
                line: piece.piece.line,
            };
        }
    }

    /// The same for the largest share of the tolerance.
    fn note_share(&mut self, distance: f64, piece: &Tracked) {
        let Some(tolerance) = piece.allowed().filter(|tolerance| *tolerance > 0.0) else {
            return;
        };
        let share = |distance: f64, tolerance: f64| distance / tolerance;
        let own = self.tolerance.map_or(-1.0, |t| share(self.distance, t));
        if share(distance, tolerance) > own {
            *self = Farthest {
                distance,
                tolerance: Some(tolerance),
                line: piece.piece.line,
            };
        }
    }
}

/// What was found along the whole path.
#[derive(Clone, Copy, Debug, Default)]
pub struct Deviation {
    /// Of the planned path from the programmed one.
    pub planned: Farthest,
    /// Of the ends of programmed pieces from the planned path.
    pub programmed: Farthest,
    /// Where the tolerance P is used up most, of either.
    pub tightest: Farthest,
    /// In exact path and exact stop modes, of either.
    pub exact: Farthest,
    /// Where the tolerance, or an exact mode, is not kept, of either: what is farthest beyond.
    pub beyond: Option<Farthest>,
    /// Arcs whose whole turns LinuxCNC leaves away.
    pub(crate) turns: TurnsLeftAway,
    /// In a cycle, for the drawing: mm.
    pub now: f64,
}

/// A piece on which the machine is or will be.
#[derive(Debug)]
struct Tracked {
    piece: Piece,
    /// The same with C counting as much as it turns the tool.
    counted: Segment,
    /// What the machine may be on while it taps here: it follows its spindle beyond either end while that turns back.
    tapped: Option<Segment>,
    /// What a degree of C counts.
    turn_share: f64,
    /// Distance of its end from the planned path so far, its positions joined by lines.
    end_missed: f64,
    /// The positions around the cycle that came nearest, see [`way`].
    end_way: [Position; 4],
    /// The last of them is still to come.
    end_near: bool,
    /// P of this piece and the one before; `None` without P.
    tolerance: Option<f64>,
    /// How far merging may have taken the moves from this piece and those beside it, mm: a corner reaches over several, and the
    /// nearest to the machine need not be one that was merged.
    merged: f64,
}

impl Tracked {
    /// How far the planned path may be off here: `Some(0)` in exact modes.
    fn allowed(&self) -> Option<f64> {
        self.tolerance
            .map(|tolerance| with_merging(tolerance, self.merged))
    }

    /// Distance of its end from the planned path: the machine may turn back between two positions, beyond both.
    fn end_from_way(&self, all_axes: bool) -> f64 {
        let around = self.end_way.map(|at| with_turn(&at, self.turn_share));
        let away = |line: Segment| line.deviation(&self.counted.end, all_axes).0;
        way(around)
            .map(|[from, to]| away(Segment::line(from, to)))
            .fold(self.end_missed, f64::min)
    }
}

/// Follows the machine along the program.
#[derive(Debug, Default)]
pub struct Follower {
    pieces: VecDeque<Tracked>,
    /// The piece that the machine was nearest to.
    near: usize,
    /// The move that runs.
    running: usize,
    /// Its pieces, from and to; where none is there any more, the one that follows.
    own: [usize; 2],
    all_axes: bool,
    /// How far rotary axes may leave the program, degrees; 0: as many as P has mm.
    rotary_tolerance: f64,
    /// What turns of C count.
    orientation: Option<Orientation>,
    found: Deviation,
    /// The last two positions.
    last: Option<[Position; 2]>,
}

/// A position with C counting a share.
fn with_turn(position: &Position, share: f64) -> Position {
    let mut counted = *position;
    counted[5] *= share;
    counted
}

impl Follower {
    /// Where rotary axes may leave the program by so many degrees; 0: as many as P has mm.
    /// `tilt`: the axis, 3 or 4, that tilts the tool while C turns it, so that the tolerance is one of the tool axis.
    pub fn new(rotary_tolerance: f64, tilt: Option<usize>) -> Follower {
        let tilt = tilt.filter(|_| rotary_tolerance > 0.0);
        Follower {
            rotary_tolerance,
            orientation: tilt.map(|tilt| Orientation {
                tilt,
                tolerance: rotary_tolerance,
            }),
            ..Follower::default()
        }
    }

    /// A move that the planner was given.
    pub(super) fn add(&mut self, handed: &Handed) {
        for piece in &handed.pieces {
            // Two moves may share a piece (a flat arc that merging has cut).
            let last = self.pieces.back().map(|tracked| tracked.piece);
            if last.is_some_and(|last| last.segment == piece.segment && last.line == piece.line) {
                continue;
            }
            self.all_axes |= piece.segment.start[3..] != piece.segment.end[3..];
            self.found.turns.note(piece);
            // Near its start the tolerance of the one before holds.
            let own = tolerance(piece);
            let before = last.as_ref().map_or(own, tolerance);
            let turn_share = self.orientation.map_or(1.0, |orientation| {
                let ends = [piece.segment.start, piece.segment.end].map(Axes::from);
                orientation.share(&ends[0], &ends[1])
            });
            let mut merged = piece.merged_within;
            for beside in self.pieces.iter_mut().rev().take(NEAR) {
                merged = merged.max(beside.piece.merged_within);
                beside.merged = beside.merged.max(piece.merged_within);
            }
            let counted = Segment {
                start: with_turn(&piece.segment.start, turn_share),
                end: with_turn(&piece.segment.end, turn_share),
                ..piece.segment
            };
            self.pieces.push_back(Tracked {
                piece: *piece,
                counted,
                tapped: matches!(handed.a_move.shape, Shape::Tap)
                    .then(|| counted.beyond_both_ends()),
                turn_share,
                end_missed: f64::INFINITY,
                end_way: [[0.0; 9]; 4],
                end_near: false,
                tolerance: wider(own, before),
                merged,
            });
        }
    }

    /// A servo cycle in which the machine moves, and the number of the move that runs.
    pub fn step(&mut self, position: &Position, running: Option<usize>) {
        let came_from = self.near;
        self.go_on_to(running.unwrap_or(self.running));
        let Some((near, distance)) = self.nearest(position) else {
            return;
        };
        let [earlier, before] = self.last.unwrap_or([*position; 2]);
        let [first, last] = self.own;
        // A cycle may pass many short pieces, and the move that runs may be the next one at its end.
        let from = first.min(near).min(came_from).saturating_sub(NEAR);
        let to = (last.max(near) + NEAR + 1).min(self.pieces.len());
        for tracked in self.pieces.range_mut(from..to) {
            let turn_share = tracked.turn_share;
            let chord = Segment::line(
                with_turn(&before, turn_share),
                with_turn(position, turn_share),
            );
            let missed = chord.deviation(&tracked.counted.end, self.all_axes).0;
            if tracked.end_near {
                tracked.end_way[3] = *position;
            }
            tracked.end_near = missed < tracked.end_missed;
            if tracked.end_near {
                tracked.end_missed = missed;
                tracked.end_way = [earlier, before, *position, *position];
            }
        }
        self.last = Some([before, *position]);
        self.near = near;
        self.found.now = distance;
        let place = Place {
            follower: self,
            position,
        };
        let (judging, distance) = judged(&place, self.own, (near, distance));
        if let Some(tracked) = self.pieces.get(judging) {
            self.found.planned.note(distance, tracked);
            self.found.tightest.note_share(distance, tracked);
            if tracked.tolerance == Some(0.0) {
                self.found.exact.note(distance, tracked);
            }
            let (tolerance, line) = (tracked.allowed(), tracked.piece.line);
            self.note_beyond(distance, tolerance, line);
        }
        while self.near.min(self.own[0]) > KEPT {
            self.leave();
            self.near -= 1;
            self.own = self.own.map(|index| index - 1);
        }
    }

    /// The machine is at this move. What is nearest is looked for around it: a program may come by at the same place again
    /// and again, as in the passes of a thread.
    fn go_on_to(&mut self, running: usize) {
        self.running = running;
        let of = |index: usize| {
            self.pieces
                .get(index)
                .map(|tracked| tracked.piece.move_index)
        };
        let [mut first, mut last] = self.own;
        while of(first).is_some_and(|index| index < running) {
            first += 1;
        }
        last = last.max(first);
        while of(last + 1).is_some_and(|index| index <= running) {
            last += 1;
        }
        self.own = [first, last];
        self.near = self.near.clamp(first.saturating_sub(NEAR), last + NEAR);
    }

    /// A tolerance that may be one of rotary axes, too.
    fn widened(&self, tolerance: f64) -> f64 {
        match self.all_axes && tolerance > 0.0 {
            true => tolerance.max(self.rotary_tolerance),
            false => tolerance,
        }
    }

    /// Keeps the place that is farthest beyond its tolerance.
    fn note_beyond(&mut self, distance: f64, tolerance: Option<f64>, line: i32) {
        let allowed = tolerance.map(|tolerance| self.widened(tolerance));
        let Some(allowed) = allowed.filter(|allowed| is_beyond(distance, *allowed)) else {
            return;
        };
        let by = |found: &Farthest| found.distance - found.tolerance.unwrap_or(0.0);
        let known = self.found.beyond.as_ref();
        if known.is_none_or(|known| distance - allowed > by(known)) {
            self.found.beyond = Some(Farthest {
                distance,
                tolerance: Some(allowed),
                line,
            });
        }
    }

    /// Drops the first piece.
    fn leave(&mut self) {
        let Some(left) = self.pieces.pop_front() else {
            return;
        };
        // At the end of a piece the tolerance of the next one holds, too.
        let next = self.pieces.front().map(|next| next.tolerance);
        let judged = Tracked {
            tolerance: match next {
                Some(next) => wider(left.tolerance, next),
                None => left.tolerance,
            },
            ..left
        };
        if judged.end_missed.is_finite() {
            let missed = judged.end_from_way(self.all_axes);
            self.found.programmed.note(missed, &judged);
            self.found.tightest.note_share(missed, &judged);
            if judged.tolerance == Some(0.0) {
                self.found.exact.note(missed, &judged);
            }
            self.note_beyond(missed, judged.allowed(), judged.piece.line);
        }
    }

    /// Whether a piece at a distance is rather where the machine is than another before it: of two that run along each other it
    /// is the one that belongs to the move that runs.
    fn is_better(&self, (index, distance): (usize, f64), best: (usize, f64)) -> bool {
        if (distance - best.1).abs() > SAME {
            return distance < best.1;
        }
        let away = |index: usize| {
            let found = self.pieces.get(index);
            found.map_or(usize::MAX, |tracked| {
                tracked.piece.move_index.abs_diff(self.running)
            })
        };
        away(index) <= away(best.0)
    }

    /// How far a position is from a piece.
    fn away(&self, position: &Position, index: usize) -> Option<f64> {
        let tracked = self.pieces.get(index)?;
        let position = with_turn(position, tracked.turn_share);
        let runs = tracked.piece.move_index == self.running;
        let segment = tracked.tapped.filter(|_| runs).unwrap_or(tracked.counted);
        Some(segment.deviation(&position, self.all_axes).0)
    }

    /// The nearest piece, and its distance.
    fn nearest(&self, position: &Position) -> Option<(usize, f64)> {
        let away = |index: usize| self.away(position, index);
        let first = self.near.saturating_sub(NEAR);
        let mut best = (first, away(first)?);
        let mut index = first;
        // On as long as that leads nearer and over all that merging made the move that runs of, which may turn back on the way,
        // and a little farther.
        let at_least = self.near.max(self.own[1]);
        while index < best.0.max(at_least) + NEAR && index < self.near + FAR {
            index += 1;
            match away(index) {
                Some(distance) if self.is_better((index, distance), best) => {
                    best = (index, distance);
                }
                Some(_) => {}
                None => break,
            }
        }
        Some(best)
    }

    /// What was found so far.
    pub fn found(&self) -> &Deviation {
        &self.found
    }

    /// At the end of the program.
    pub fn finish(mut self) -> Deviation {
        while !self.pieces.is_empty() {
            self.leave();
        }
        self.found
    }
}

/// Where the machine is, on the program that it follows.
struct Place<'a> {
    follower: &'a Follower,
    position: &'a Position,
}

impl Around for Place<'_> {
    fn count(&self) -> usize {
        self.follower.pieces.len()
    }

    fn piece(&self, index: usize) -> Option<&Piece> {
        self.follower
            .pieces
            .get(index)
            .map(|tracked| &tracked.piece)
    }

    fn distance(&self, index: usize) -> Option<f64> {
        self.follower.away(self.position, index)
    }

    fn allowed(&self, index: usize) -> Option<f64> {
        self.follower.pieces.get(index)?.allowed()
    }

    fn merged(&self, index: usize) -> f64 {
        let tracked = self.follower.pieces.get(index);
        tracked.map_or(0.0, |tracked| tracked.merged)
    }

    fn length(&self, pieces: Range<usize>) -> f64 {
        let pieces = self.follower.pieces.range(pieces);
        pieces.map(|tracked| tracked.piece.segment.length).sum()
    }

    fn admits(&self, distance: f64, tolerance: Option<f64>) -> bool {
        tolerance.is_none_or(|tolerance| !is_beyond(distance, self.follower.widened(tolerance)))
    }
}

#[cfg(test)]
mod tests;
