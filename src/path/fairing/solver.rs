//! The quadratic programme of the [fairing](super): by how much each vertex is moved.
//!
//! Of one that would be moved by more than its room a multiplier holds it back, which grows and falls with the
//! proportion of the two: where it has settled, a vertex is either at the end of its room or not held at all, and that is
//! the optimum. Multipliers are kept from one time to the next, when the window has moved on by a few vertices. With all
//! given, the sum is a quadratic form with four diagonals, the same for all axes. At which of its two ends, X Y Z or U V W,
//! a vertex is moved by more than its room does not matter: one multiplier holds back both.

use super::piece::{ORIGIN, Piece, Point, ROOM, SPAN, vertex};
use crate::path::linear_axes::greater_end;
use crate::ring::Ring;

/// What a multiplier begins with, of what the vertex counts itself.
const FIRST_MULTIPLIER: f64 = 1e-3;

/// What it is held within, in the same units.
const LEAST_MULTIPLIER: f64 = 1e-9;
const GREATEST_MULTIPLIER: f64 = 1e6;

/// What it changes by at most at a time.
const GREATEST_CHANGE: f64 = 10.0;

/// Of what a vertex counts itself, what rounding leaves of it.
const ROUNDING: f64 = 1e-12;

/// A vertex that is being moved.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// The quadratic form: of the vertex with itself and with those behind it.
    form: [f64; SPAN],
    /// What it is moved by without any, times that.
    right: Point,
    /// How far it may be moved; 0 where it stays.
    room: f64,
    multiplier: f64,
    /// Its factor: a triangle with ones in the diagonal, which are left out, and 1 over another diagonal.
    lower: [f64; SPAN - 1],
    inverse: f64,
    shift: Point,
}

impl Row {
    const NONE: Self = Self {
        form: [0.0; SPAN],
        right: ORIGIN,
        room: 0.0,
        multiplier: 1.0,
        lower: [0.0; SPAN - 1],
        inverse: 1.0,
        shift: ORIGIN,
    };
}

/// What the vertices before take off the form and the right side of one.
#[derive(Clone, Copy, Debug)]
struct TakenOff {
    form: [f64; SPAN - 1],
    right: Point,
}

impl TakenOff {
    const NOTHING: Self = Self {
        form: [0.0; SPAN - 1],
        right: ORIGIN,
    };
}

/// See the module.
#[derive(Debug)]
pub(super) struct Solver {
    rows: Ring<Row, ROOM>,
    /// Number of the first vertex, and of the first one that is not moved; vertices are numbered like the pieces that end with
    /// them.
    first: u64,
    last: u64,
}

impl Solver {
    pub const fn new() -> Self {
        Self {
            rows: Ring::filled_with(Row::NONE),
            first: 0,
            last: 0,
        }
    }

    /// Takes on the vertices of the pieces from `first` to before `next`, but for the very last one: nothing is known of what
    /// comes behind it.
    pub fn prepare(&mut self, pieces: &Ring<Piece, ROOM>, first: u64, next: u64) {
        (self.first, self.last) = (first, next.saturating_sub(1).max(first));
        for number in first..self.last {
            let piece = pieces.at(number);
            *self.rows.at_mut(number) = Row {
                form: [piece.weight * piece.weight * piece.keep, 0.0, 0.0, 0.0],
                room: piece.room,
                ..Row::NONE
            };
        }
        for number in first..next {
            self.add_third(pieces, number);
        }
        for number in first..self.last {
            let (piece, row) = (pieces.at(number), self.rows.at_mut(number));
            row.multiplier = if row.room <= 0.0 {
                // It stays, coupled to nothing.
                1.0
            } else if piece.multiplier < 0.0 {
                FIRST_MULTIPLIER * row.form[0]
            } else {
                piece.multiplier
            };
        }
    }

    /// Adds the third divided difference that ends with a piece.
    fn add_third(&mut self, pieces: &Ring<Piece, ROOM>, number: u64) {
        let piece = pieces.at(number);
        if piece.third == [0.0; SPAN] {
            return;
        }
        let third = piece.third.map(|counts| piece.weight * counts);
        let mut fixed = ORIGIN;
        // What those count that are moved.
        let mut moved = [0.0; SPAN];
        for (k, (moved, counts)) in moved.iter_mut().zip(third).enumerate() {
            let vertex = vertex(number, k);
            let piece = pieces.at(vertex);
            fixed += piece.end * counts;
            if self.is_moved(vertex) {
                *moved = counts;
            } else {
                fixed += piece.shift * counts;
            }
        }
        for (k, counts) in moved.iter().enumerate() {
            if *counts != 0.0 {
                let row = self.rows.at_mut(vertex(number, k));
                row.right -= fixed * *counts;
                for (form, other) in row.form.iter_mut().zip(moved.iter().skip(k)) {
                    *form += counts * other;
                }
            }
        }
    }

    fn is_moved(&self, number: u64) -> bool {
        (self.first..self.last).contains(&number) && self.rows.at(number).room > 0.0
    }

    /// Moves the vertices to where the sum is least with the multipliers that there are, and corrects these. Answers how many
    /// vertices there are.
    pub fn iterate(&mut self) -> usize {
        self.factor();
        let (mut next, mut second, mut third) = (ORIGIN, ORIGIN, ORIGIN);
        for number in (self.first..self.last).rev() {
            let row = self.rows.at_mut(number);
            let [one, two, three] = row.lower;
            row.shift = row.shift * row.inverse - next * one - second * two - third * three;
            (next, second, third) = (row.shift, next, second);
            row.correct();
        }
        (self.last - self.first) as usize
    }

    /// L D L^T, and the right side through L.
    fn factor(&mut self) {
        let mut taken_off = [TakenOff::NOTHING; SPAN - 1];
        for number in self.first..self.last {
            let row = self.rows.at_mut(number);
            let [off, next, second] = taken_off;
            taken_off = [next, second, TakenOff::NOTHING];
            let own = row.form[0] + row.multiplier;
            let inverse = (own - off.form[0]).max(ROUNDING * own).recip();
            let one = row.form[1] - off.form[1];
            let two = row.form[2] - off.form[2];
            let three = row.form[3];
            row.inverse = inverse;
            row.lower = [one * inverse, two * inverse, three * inverse];
            row.shift = row.right - off.right;
            let behind = [[one, two, three], [two, three, 0.0], [three, 0.0, 0.0]];
            for ((taken_off, coupled), share) in taken_off.iter_mut().zip(behind).zip(row.lower) {
                for (form, coupled) in taken_off.form.iter_mut().zip(coupled) {
                    *form += share * coupled;
                }
                taken_off.right += row.shift * share;
            }
        }
    }

    /// Puts what was found into the pieces.
    pub fn store(&self, pieces: &mut Ring<Piece, ROOM>) {
        for number in self.first..self.last {
            let (row, piece) = (self.rows.at(number), pieces.at_mut(number));
            if row.room <= 0.0 {
                continue;
            }
            piece.multiplier = row.multiplier;
            let size = greater_end(&row.shift);
            piece.shift = if size > row.room {
                row.shift * (row.room / size)
            } else if size.is_finite() {
                row.shift
            } else {
                ORIGIN
            };
        }
    }
}

impl Row {
    /// Draws the multiplier after what was found.
    fn correct(&mut self) {
        if self.room > 0.0 {
            let [own, ..] = self.form;
            let proportion = greater_end(&self.shift) / self.room;
            let change = proportion.max(GREATEST_CHANGE.recip()).min(GREATEST_CHANGE);
            self.multiplier = (self.multiplier * change)
                .max(LEAST_MULTIPLIER * own)
                .min(GREATEST_MULTIPLIER * own);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::piece::{at, third};
    use super::*;

    /// Pieces of length 1 with points of a zigzag.
    fn zigzag(height: f64, room: f64, test: fn(&mut Solver, &mut Ring<Piece, ROOM>)) {
        let mut pieces = Box::new(Ring::filled_with(Piece::VACANT));
        let point = |k: u64| at(k as f64, height * (k % 2) as f64);
        for number in 0..40 {
            *pieces.at_mut(number) = Piece {
                end: point(number + 1),
                joined: number < 39,
                room: if number < 39 { room } else { 0.0 },
                keep: 1e-6,
                weight: 1.0,
                third: if number >= 2 {
                    third([1.0; 3])
                } else {
                    [0.0; SPAN]
                },
                ..Piece::VACANT
            };
        }
        let mut solver = Box::new(Solver::new());
        solver.prepare(&pieces, 0, 40);
        test(&mut solver, &mut pieces);
    }

    #[test]
    fn with_room_enough_nothing_is_held() {
        zigzag(0.1, 10.0, |solver, pieces| {
            for _ in 0..100 {
                assert_eq!(solver.iterate(), 39);
            }
            solver.store(pieces);
            let places = (10..30).map(|k| pieces.at(k).end + pieces.at(k).shift);
            let heights: Vec<f64> = places.map(|place| place[1]).collect();
            let spread = heights.windows(2).map(|pair| (pair[1] - pair[0]).abs());
            assert!(spread.fold(0.0, f64::max) < 0.01, "{heights:?}");
        });
    }

    #[test]
    fn with_too_little_room_all_of_it_is_used() {
        zigzag(0.1, 0.02, |solver, pieces| {
            for _ in 0..100 {
                solver.iterate();
            }
            solver.store(pieces);
            for number in 5..35 {
                let size = pieces.at(number).shift.norm();
                assert!((0.019..=0.0200001).contains(&size), "{number}: {size}");
            }
        });
    }

    #[test]
    fn what_is_no_number_moves_nothing() {
        zigzag(f64::NAN, 0.02, |solver, pieces| {
            solver.iterate();
            solver.store(pieces);
            assert!((0..40).all(|number| pieces.at(number).shift == ORIGIN));
        });
    }
}
