//! Long lines beside a corner are divided: a vertex has to be there to be moved.
//!
//! The first piece beside a corner is a share of what a kernel could be wide there, and each one farther away so much
//! longer than the one before. Where a corner does not limit the speed nothing is divided.

use crate::path::kernel;
use crate::path::leg::Leg;
use crate::path::settings::BlendSettings;

/// The most pieces of a line.
pub(in crate::path) const MOST_PIECES: usize = 16;

/// The first piece, in widths of the kernel that uses up the tolerance of a corner.
const FIRST: f64 = 0.3;

/// Ratio of a piece to the one before.
const GROWTH: f64 = 1.5;

/// A corner stands alone if the kernel that uses up the tolerance is narrower than this share of its shorter line.
const LONE: f64 = 0.4;

/// What is not longer than so many of the pieces to come is not divided further.
const LEAST_LEFT: f64 = 1.6;

/// Where a line is divided, path distance from its start: at `left` from there on, and at `right` back from its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cuts {
    places: [f64; MOST_PIECES],
    count: usize,
}

impl Cuts {
    /// Cuts a line so that the pieces at its ends have these lengths, which may be infinite.
    pub fn new(length: f64, [mut left, mut right]: [f64; 2]) -> Self {
        let mut cuts = Self {
            places: [length; MOST_PIECES],
            count: 1,
        };
        let (mut from, mut to) = (0.0, length);
        while cuts.count < MOST_PIECES && to - from >= LEAST_LEFT * left.min(right) {
            let place = if left <= right {
                from += left;
                left *= GROWTH;
                from
            } else {
                to -= right;
                right *= GROWTH;
                to
            };
            if let Some(free) = cuts.places.get_mut(cuts.count) {
                *free = place;
            }
            cuts.count += 1;
        }
        if let Some(used) = cuts.places.get_mut(..cuts.count) {
            used.sort_unstable_by(f64::total_cmp);
        }
        cuts
    }

    /// Where pieces end, the last one with the line.
    pub fn ends(&self) -> impl Iterator<Item = f64> + '_ {
        self.places.iter().take(self.count).copied()
    }
}

/// The length of the piece of a leg beside a corner that turns the direction by `turn`, length of the difference of unit
/// vectors; infinite where that does not limit the speed.
pub(super) fn first_piece(leg: &Leg, turn: f64, settings: &BlendSettings) -> f64 {
    let widest = leg.tolerance() / (kernel::peak(0.0) * turn);
    if settings.full_speed_width(turn, leg.speed) > FIRST * widest {
        FIRST * widest
    } else {
        f64::INFINITY
    }
}

/// Whether two lines meet in a corner that stands alone: it has its own way to use the tolerance.
pub(super) fn is_lone(before: &Leg, after: &Leg) -> bool {
    let turn = turn_between(before, after);
    let tolerance = before.tolerance().min(after.tolerance());
    turn > 0.0 && tolerance / (kernel::peak(0.0) * turn) < LONE * before.whole.min(after.whole)
}

/// By how much the program turns between two lines, length of the difference of unit vectors.
pub(super) fn turn_between(before: &Leg, after: &Leg) -> f64 {
    let direction = |leg: &Leg| leg.programmed_point(leg.start).first;
    (direction(after) - direction(before)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(length: f64, ends: [f64; 2]) -> Vec<f64> {
        Cuts::new(length, ends).ends().collect()
    }

    #[test]
    fn pieces_grow_away_from_corners() {
        assert_eq!(cut(10.0, [f64::INFINITY; 2]), [10.0]);
        assert_eq!(cut(10.0, [1.0, f64::INFINITY]), [1.0, 2.5, 4.75, 10.0]);
        assert_eq!(cut(10.0, [f64::INFINITY, 2.0]), [5.0, 8.0, 10.0]);
        assert_eq!(cut(10.0, [1.0, 2.0]), [1.0, 2.5, 4.75, 8.0, 10.0]);
        assert_eq!(cut(10.0, [7.0, 7.0]), [10.0]);
    }

    #[test]
    fn a_line_has_so_many_pieces_at_most() {
        let cuts = cut(1e6, [1e-6, 1e-6]);
        assert_eq!(cuts.len(), MOST_PIECES);
        assert!(cuts.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(cuts.last(), Some(&1e6));
    }
}
