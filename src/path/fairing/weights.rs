//! What the third derivative counts where.
//!
//! What costs time is its cube root where it limits the speed, and not its square: a place that is slow anyway may bend more,
//! one that is fast may not. So it counts the less the greater it is, and the sum of squares comes to one of absolute
//! values (iteratively reweighted least squares: Lawson, 1961).

use core::ops::Range;

use super::piece::{EVEN, Piece, Point, ROOM, SPAN, vertex};
use super::turning::{self, Around, curvature, curvature_nearby};
use crate::ring::Ring;

/// Over so many pieces to both sides the third derivative is averaged: kernels smooth as far.
const BESIDE: u64 = 2;

/// On a curve over all that are being moved, and so many before them.
const ALONG: u64 = 24;

/// Of the square of its curvature, which is the third derivative of a circle, what a curve is even enough with however great the
/// feed is: jerk allows 1.8 times the speed with it that it allows on the circle.
const OF_CURVE: f64 = 0.17;

/// The same where it turns by more than two radians within the pieces that show it. Such a curve gains from being led along its inner
/// side, and without this the more feed there was the less evenly it was.
const OF_TIGHT_CURVE: f64 = 0.02;

/// The same of the square of what the way around sharp corners turns by in the mean.
const AROUND_CORNERS: f64 = 0.3;

/// Where lines are divided a path that has less than [`EVEN`] times the third derivative that its feed allows is even enough with what
/// it has, but not with less than so many times: nearly even for its feed, it can be made so.
const LEAST_EVEN: f64 = 1.5;

/// Gives the pieces from `first` to before `next` that have none the weight of the one before.
pub(super) fn begin(pieces: &mut Ring<Piece, ROOM>, first: u64, next: u64) {
    let before = pieces.at(first.wrapping_sub(1));
    let mut known = if before.joined { before.weight } else { -1.0 };
    for number in first..next {
        let piece = pieces.at_mut(number);
        if piece.weight < 0.0 {
            piece.weight = if known < 0.0 { 1.0 } else { known };
        }
        known = piece.weight;
    }
}

/// Determines the weights of the pieces from `first` to before `next` from where their vertices are: on a curve the same for all.
/// `batch`: as many before them have become final since the last time.
pub(super) fn weigh(pieces: &mut Ring<Piece, ROOM>, first: u64, next: u64, batch: u64) {
    let from = start_of_run(pieces, first);
    for number in first.saturating_sub(batch).max(from)..next {
        pieces.at_mut(number).square = square(pieces, number);
    }
    let along = mean_square(pieces, from..next);
    let mut around = Around::new(from, next);
    for number in first..next {
        around.go_on_to(pieces, number);
        let (mean, allowed, of_feed) = if let Some(curvature) =
            curvature(pieces, number, from, next)
        {
            let allowed = OF_CURVE * curvature * curvature;
            (along, allowed, slowest(pieces, number, from, next))
        } else {
            let beside = number.saturating_sub(BESIDE).max(from)..(number + BESIDE + 1).min(next);
            let mean = mean_square(pieces, beside);
            let around = around.curvature();
            let around = AROUND_CORNERS * around * around;
            match curvature_nearby(pieces, number, from, next) {
                None => (mean, around, pieces.at(number).even),
                Some(curvature) => {
                    let allowed = around.max(OF_TIGHT_CURVE * curvature * curvature);
                    (mean, allowed, slowest(pieces, number, from, next))
                }
            }
        };
        let piece = pieces.at_mut(number);
        let even = of_feed.max(allowed);
        let share = if piece.leg.length < piece.leg.whole {
            (mean.sqrt() / of_feed).clamp(LEAST_EVEN, EVEN) / EVEN
        } else {
            1.0
        };
        // Infinite over infinite, without limits, would be no number.
        let slower = if of_feed > piece.even {
            of_feed / piece.even
        } else {
            1.0
        };
        let raised = (share * slower).max(allowed / piece.even);
        piece.keep = piece.keep_at_feed * raised * raised;
        let greatest = even * even;
        piece.weight = if mean > greatest {
            (greatest / mean).sqrt().sqrt()
        } else {
            1.0
        };
    }
}

/// What the feed allows on the slowest of the pieces beside one. On a curve it is alike for all: what an axis takes of the feed along it
/// would make the curve less even where it is run across.
fn slowest(pieces: &Ring<Piece, ROOM>, number: u64, first: u64, next: u64) -> f64 {
    turning::beside(number, first, next)
        .map(|number| pieces.at(number).even)
        .fold(0.0, f64::max)
}

/// Number of the first piece of a run that goes on with `first`, or of the first one that is looked at.
fn start_of_run(pieces: &Ring<Piece, ROOM>, first: u64) -> u64 {
    let earliest = first.saturating_sub(ALONG);
    let mut from = first;
    while from > earliest && pieces.at(from - 1).joined {
        from -= 1;
    }
    from
}

/// The mean of the square of the third derivative over these pieces, as far as they are runs.
fn mean_square(pieces: &Ring<Piece, ROOM>, numbers: Range<u64>) -> f64 {
    let (mut sum, mut length) = (0.0, 0.0);
    for piece in numbers.map(|number| pieces.at(number)) {
        if piece.third != [0.0; SPAN] {
            sum += piece.square;
            length += piece.leg.length;
        }
    }
    if length > 0.0 { sum / length } else { 0.0 }
}

/// The square of the third divided difference that ends with a piece, times its length.
fn square(pieces: &Ring<Piece, ROOM>, number: u64) -> f64 {
    let counts = pieces.at(number).third;
    let mut sum = Point::zeros();
    for (k, counts) in counts.into_iter().enumerate() {
        let piece = pieces.at(vertex(number, k));
        sum += (piece.end + piece.shift) * counts;
    }
    sum.norm_squared()
}

#[cfg(test)]
mod tests {
    use super::super::piece::{at, third};
    use super::*;

    #[test]
    fn what_bends_more_counts_less() {
        let mut pieces = Box::new(Ring::filled_with(Piece::VACANT));
        let height = |k: u64| if k < 20 { 0.01 } else { 1.0 };
        let point = |k: u64| at(k as f64, height(k) * (k % 2) as f64);
        for number in 0..40 {
            *pieces.at_mut(number) = Piece {
                end: point(number + 1),
                third: if number >= 2 {
                    third([1.0; 3])
                } else {
                    [0.0; SPAN]
                },
                even: 0.1,
                ..Piece::VACANT
            };
            pieces.at_mut(number).leg.length = 1.0;
        }
        weigh(&mut pieces, 0, 40, 0);
        // The third derivative of a zigzag of height h is 4 h.
        for (number, height) in [(10, 0.01), (30, 1.0)] {
            let expected = (0.1f64 / (4.0 * height)).sqrt().min(1.0);
            let weight = pieces.at(number).weight;
            assert!((weight - expected).abs() < 1e-9, "{weight} {expected}");
        }
    }

    #[test]
    fn on_a_curve_all_count_the_same() {
        let mut pieces = Box::new(Ring::filled_with(Piece::VACANT));
        let mut before = Piece::VACANT;
        for number in 0..40 {
            // A circle with a radius of 10 of chords that are divided unevenly.
            let angle = 0.07 * number as f64 + 0.02 * (number % 3) as f64;
            let mut piece = Piece {
                end: at(10.0 * angle.sin(), -10.0 * angle.cos()),
                joined: true,
                third: if number >= 3 {
                    third([0.7; 3])
                } else {
                    [0.0; SPAN]
                },
                even: 1e-4,
                ..Piece::VACANT
            };
            piece.leg.length = 0.7;
            piece.follow(&before);
            before = piece;
            *pieces.at_mut(number) = piece;
        }
        weigh(&mut pieces, 0, 40, 0);
        let weights: Vec<f64> = (10..30).map(|number| pieces.at(number).weight).collect();
        assert!(weights[0] < 1.0, "{weights:?}");
        assert!(
            weights
                .iter()
                .all(|weight| (weight / weights[0] - 1.0).abs() < 1e-12),
            "{weights:?}"
        );
    }
}
