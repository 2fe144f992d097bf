//! Fairing: the vertices of runs of short lines are moved within a part of the tolerance, so that the path bends as
//! evenly as it can.
//!
//! Kernels round each vertex where it is. Where lines are short it is the polygon itself that bends more than it has to: it
//! zigzags within what coordinates are rounded to, keeps each step of a staircase, and turns at a corner all at once.
//! What is wanted is the polygon within the tolerance with the least sum over its thirds of divided differences,
//!
//! ```text
//! sum of (s[k+3] - s[k]) / 3 |6 q[s[k], s[k+1], s[k+2], s[k+3]]|^2
//! ```
//!
//! the integral of the square of the third derivative over path distance, which jerk is in proportion to (a smoothing
//! spline: Reinsch, Numerische Mathematik 10, 1967; for polygons, Whittaker, Proceedings of the Edinburgh Mathematical
//! Society 41, 1922). It is a quadratic programme with a constraint for each vertex, which [`solver`] approaches.
//!
//! The kernels of the path find their widths afterwards, within what is left of the tolerance. Nothing depends on how well
//! vertices were moved: none is moved by more than a share of the tolerance, so that a kernel narrow enough always keeps it.
//!
//! Moved are lines in XYZ and UVW, and arcs, under G64 with P, in runs. What is more than two dozen lines away hardly matters, so that
//! vertices become final soon behind the newest one. Long lines beside a corner, and arcs, are [divided](division), or there
//! were nothing to be moved. What bends much anyway [counts less](weights).

mod division;
mod piece;
mod solver;
mod turning;
mod weights;

pub(super) use self::division::MOST_PIECES;
use self::division::{Corner, Cuts};
use self::piece::{Piece, Point, ROOM, is_moved};
use self::solver::Solver;
use super::leg::Leg;
use super::settings::BlendSettings;
use super::shift::Shift;
use crate::ring::Ring;

/// A vertex with so many behind it is final.
const AHEAD: u64 = 24;

/// As many become final at a time.
const BATCH: u64 = 4;

/// Pieces that are looked at for that.
const WINDOW: u64 = AHEAD + BATCH;

/// How often the [`Solver`] is run for them, half of it before weights are determined anew.
const ITERATIONS: u32 = 10;

/// While more than these wait no leg is taken: there is work to be done first.
const MOST_WAITING: u64 = AHEAD + 3 * BATCH;

/// The vertex that a path begins with has the number before the first.
const BEFORE_FIRST: u64 = u64::MAX;

/// Kernel terms that an iteration takes for a vertex.
const COST: usize = 4;

/// Legs whose vertices are being moved.
#[derive(Debug)]
pub(super) struct Fairing {
    pieces: Ring<Piece, ROOM>,
    /// Number of the first piece that waits, and of the one to come.
    first: u64,
    next: u64,
    /// A leg whose next one is not known.
    held: Option<Leg>,
    /// Where it starts, if that vertex may be moved.
    corner: Option<Corner>,
    /// Whether that one, or one before it with nothing but straight lines between them, is a corner.
    in_run: bool,
    /// Number behind the last piece that [closes](Piece::closes).
    closed: u64,
    /// How many of those that wait are final.
    due: u64,
    /// How many are to become final next, behind which piece nothing is looked at for that, and how often the solver is still to be
    /// run.
    batch: u64,
    end: u64,
    iterations: u32,
    solver: Solver,
}

impl Fairing {
    pub const fn new() -> Self {
        Self {
            pieces: Ring::filled_with(Piece::VACANT),
            first: 0,
            next: 0,
            held: None,
            corner: None,
            in_run: false,
            closed: 0,
            due: 0,
            batch: 0,
            end: 0,
            iterations: 0,
            solver: Solver::new(),
        }
    }

    pub fn clear(&mut self) {
        (self.first, self.next) = (0, 0);
        self.held = None;
        self.corner = None;
        self.in_run = false;
        self.closed = 0;
        self.due = 0;
        self.iterations = 0;
    }

    /// How long what waits is, path distance.
    pub fn waiting_length(&self) -> f64 {
        let pieces = (self.first..self.next).map(|number| self.pieces.at(number).leg.length);
        self.held.map_or(0.0, |leg| leg.length) + pieces.sum::<f64>()
    }

    /// How many pieces wait, and may come of the leg that is held.
    pub fn waiting(&self) -> usize {
        let held = if self.held.is_some() { MOST_PIECES } else { 0 };
        held + (self.next - self.first) as usize
    }

    /// Whether there is work to be done before it takes another leg.
    pub fn is_full(&self) -> bool {
        self.next - self.first > MOST_WAITING
    }

    /// Takes the leg that comes next.
    pub fn take(&mut self, leg: Leg, settings: &BlendSettings) {
        let held = self.held.take();
        let corner = held
            .or_else(|| self.last())
            .and_then(|before| self.corner(&before, &leg, settings));
        if let Some(held) = held {
            self.divide(&held, corner, settings);
        }
        self.corner = corner;
        self.in_run = corner.is_some_and(|corner| self.in_run || !corner.is_straight());
        if is_moved(&leg, settings) && !leg.stop_after {
            self.held = Some(leg);
        } else {
            self.divide(&leg, None, settings);
            self.close();
        }
    }

    /// Nothing more is waited for.
    pub fn flush(&mut self, settings: &BlendSettings) {
        if let Some(held) = self.held.take() {
            self.divide(&held, None, settings);
        }
        self.close();
    }

    /// The piece before those to come.
    fn last(&self) -> Option<Leg> {
        let number = self.next.checked_sub(1)?;
        Some(self.pieces.at(number).leg)
    }

    /// Where two legs meet, if the vertex in between may be moved.
    fn corner(&self, before: &Leg, after: &Leg, settings: &BlendSettings) -> Option<Corner> {
        let moved = is_moved(before, settings) && is_moved(after, settings);
        if !moved || before.stop_after || after.stop_before {
            return None;
        }
        let corner = Corner::between(before, after, settings);
        (!corner.is_lone(self.in_run)).then_some(corner)
    }

    /// Nothing to come changes what waits: it is to become final, as it would have if it had come sooner.
    fn close(&mut self) {
        if self.first < self.next {
            self.pieces.at_mut(self.next - 1).closes = true;
            self.closed = self.next;
        }
    }

    /// Whether there is work that waits for nothing to come.
    pub fn is_pressed(&self) -> bool {
        self.due > 0 || self.closed > self.first
    }

    /// Number of the first piece whose vertex may still be moved.
    fn settled(&self) -> u64 {
        self.first + self.due
    }

    /// Behind which piece nothing matters to the one with the number `settled`, if that is known.
    fn end_of_run(&self, settled: u64) -> Option<u64> {
        let mut closed = settled..self.closed;
        let last = closed.find(|number| self.pieces.at(*number).closes)?;
        Some(last + 1)
    }

    /// Moves the vertices that wait a little nearer to where they should be. Answers the kernel terms that it took, 0 if there
    /// is nothing to do.
    pub fn step(&mut self) -> usize {
        let settled = self.settled();
        if self.iterations == 0 {
            let end_of_run = self.end_of_run(settled);
            let end = end_of_run.unwrap_or(self.next);
            if end.saturating_sub(settled) >= WINDOW {
                (self.batch, self.end) = (BATCH, settled + WINDOW);
            } else if end_of_run.is_none() {
                return 0;
            } else if (settled..end - 1).any(|number| self.pieces.at(number).joined) {
                (self.batch, self.end) = (end - settled, end);
            } else {
                self.due = end - self.first;
                return 1;
            }
            weights::begin(&mut self.pieces, settled, self.end);
            self.solver.prepare(&self.pieces, settled, self.end);
            self.iterations = ITERATIONS;
        }
        let vertices = self.solver.iterate();
        self.iterations -= 1;
        if self.iterations == ITERATIONS / 2 {
            self.solver.store(&mut self.pieces);
            weights::weigh(&mut self.pieces, settled, self.end, BATCH);
            self.solver.prepare(&self.pieces, settled, self.end);
        }
        if self.iterations == 0 {
            self.solver.store(&mut self.pieces);
            self.due += self.batch;
        }
        COST * vertices
    }

    /// The next piece that is final, in the place where it is.
    pub fn next(&mut self) -> Option<Leg> {
        if self.due == 0 || self.first >= self.next {
            self.due = 0;
            return None;
        }
        let start = match self.first.checked_sub(1) {
            Some(before) => self.pieces.at(before).shift,
            None => Point::zeros(),
        };
        let piece = self.pieces.at(self.first);
        let leg = Leg {
            shift: Shift::between(&start, &piece.shift, piece.leg.length),
            ..piece.leg
        };
        self.first += 1;
        self.due -= 1;
        Some(leg)
    }

    /// Divides a leg that ends with a `corner`, if that is moved.
    fn divide(&mut self, leg: &Leg, corner: Option<Corner>, settings: &BlendSettings) {
        let joined = self.corner.is_some();
        if leg.is_chord() {
            self.push(*leg, joined, settings);
            return;
        }
        let ends = [self.corner, corner]
            .map(|corner| corner.map_or(f64::INFINITY, |corner| corner.first_piece(leg, settings)));
        let cuts = Cuts::new(leg.length, ends, division::longest(leg));
        let mut lead = 0.0;
        for end in cuts.ends() {
            self.push(leg.part(lead, end), joined || lead > 0.0, settings);
            lead = end;
        }
    }

    /// Takes a piece. `joined`: the vertex at its start may be moved.
    fn push(&mut self, leg: Leg, joined: bool, settings: &BlendSettings) {
        let number = self.next;
        let mut piece = Piece::new(leg, settings);
        if let Some(before) = number.checked_sub(1) {
            let before = self.pieces.at_mut(before);
            before.join(&leg, joined, settings);
            if !before.joined {
                self.close();
            }
        } else {
            *self.pieces.at_mut(BEFORE_FIRST) = Piece::before(&leg);
        }
        piece.follow(self.pieces.at(number.wrapping_sub(1)));
        if let Some(earliest) = number.checked_sub(2) {
            let (one, two) = (self.pieces.at(earliest), self.pieces.at(earliest + 1));
            if one.joined && two.joined {
                piece.third = piece::third([one.leg.length, two.leg.length, leg.length]);
            }
        }
        *self.pieces.at_mut(number) = piece;
        self.next += 1;
    }
}

#[cfg(test)]
mod tests;
