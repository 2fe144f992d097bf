//! Long lines beside a corner are divided: a vertex has to be there to be moved.
//!
//! The first piece beside a corner is a share of what a kernel could be wide there, and each one farther away so much
//! longer than the one before. Where a corner does not limit the speed nothing is divided.

use crate::path::kernel;
use crate::path::leg::Leg;
use crate::path::linear_axes::{self, share_of_greater_end};
use crate::path::settings::BlendSettings;
use crate::path::unlike_axes;

/// The most pieces of a line.
pub(in crate::path) const MOST_PIECES: usize = 16;

/// The first piece, in widths of the kernel that uses up the tolerance of a corner.
const FIRST: f64 = 0.3;

/// Ratio of a piece to the one before.
const GROWTH: f64 = 1.5;

/// A corner stands alone if the kernel that uses up the tolerance is narrower than this share of its shorter line.
const LONE: f64 = 0.4;

/// The same behind one that does not: where corners are now a little wider and now a little narrower than that, all are
/// moved or none.
const LONE_IN_RUN: f64 = 0.15;

/// Two legs that turn by no more, length of the difference of unit vectors, go straight on.
const STRAIGHT: f64 = 1e-3;

/// Radians that a piece of an arc turns by at most.
const LONGEST_ON_ARC: f64 = 0.35;

/// What is not longer than so many of the pieces to come is not divided further.
const LEAST_LEFT: f64 = 1.6;

/// Where a line is divided, path distance from its start: at `left` from there on, and at `right` back from its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cuts {
    places: [f64; MOST_PIECES],
    count: usize,
}

impl Cuts {
    /// Cuts a line so that the pieces at its ends have these lengths, and none is much longer than `longest`; nowhere if both
    /// are infinite.
    pub fn new(length: f64, ends: [f64; 2], longest: f64) -> Self {
        let mut cuts = Self {
            places: [length; MOST_PIECES],
            count: 1,
        };
        let (mut from, mut to) = (0.0, length);
        let [mut left, mut right] = ends;
        if left.min(right).is_finite() {
            (left, right) = (left.min(longest), right.min(longest));
        }
        while cuts.count < MOST_PIECES && to - from >= LEAST_LEFT * left.min(right) {
            let place = if left <= right {
                from += left;
                left = (left * GROWTH).min(longest);
                from
            } else {
                to -= right;
                right = (right * GROWTH).min(longest);
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

/// The longest piece of a leg, path distance; infinite on a line.
pub(super) fn longest(leg: &Leg) -> f64 {
    LONGEST_ON_ARC / leg.turning
}

/// Where two legs meet whose vertex may be moved.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// By how much the program turns, length of the difference of unit vectors.
    turn: f64,
    /// The kernel that uses up the tolerance.
    widest: f64,
    /// The shorter leg.
    shorter: f64,
    /// Whether its legs move [axes that are unlike](unlike_axes).
    of_unlike_axes: bool,
}

impl Corner {
    pub fn between(before: &Leg, after: &Leg, settings: &BlendSettings) -> Self {
        let from = before.programmed_point(before.end()).first;
        let to = after.programmed_point(after.start).first;
        let turn = (to - from).norm();
        Self {
            turn,
            widest: before.tolerance().min(after.tolerance())
                / (kernel::peak(0.0) * turn * share_of_greater_end(&linear_axes::of(&(to - from)))),
            shorter: before.whole.min(after.whole),
            of_unlike_axes: unlike_axes::stands_alone(before, after, settings),
        }
    }

    pub fn is_straight(&self) -> bool {
        self.turn <= STRAIGHT
    }

    /// Whether it stands alone: it has its own way to use the tolerance.
    pub fn is_lone(&self, in_run: bool) -> bool {
        self.of_unlike_axes || self.widest < if in_run { LONE_IN_RUN } else { LONE } * self.shorter
    }

    /// The length of the piece of a leg beside it; infinite where it does not limit the speed.
    pub fn first_piece(&self, leg: &Leg, settings: &BlendSettings) -> f64 {
        let first = FIRST * self.widest;
        if settings.full_speed_width(self.turn, leg.speed) > first {
            first
        } else {
            f64::INFINITY
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(length: f64, ends: [f64; 2]) -> Vec<f64> {
        Cuts::new(length, ends, f64::INFINITY).ends().collect()
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
