//! Which pieces lie on a curve made of short lines.
//!
//! On a curve the third derivative is about the same for a long way. What a few pieces show of it is then where the lines
//! happen to meet, and no place that is slow anyway.

use super::piece::{Piece, ROOM};
use crate::ring::Ring;

/// Pieces to both sides of one that show whether it lies on a curve.
const BESIDE: u64 = 6;

/// On a curve the direction turns in all by at least this share of what it turns by piece by piece: over more than two radians,
/// or where coordinates are rounded, it is less.
const EVEN: f64 = 0.8;

/// And nowhere by more than this share: a corner is no curve.
const GREATEST_SHARE: f64 = 0.6;

/// The curvature of the curve that a piece lies on, as far as those from `first` to before `next` show it, 1 per machine unit;
/// `None` where it lies on none.
pub(super) fn curvature(
    pieces: &Ring<Piece, ROOM>,
    number: u64,
    first: u64,
    next: u64,
) -> Option<f64> {
    let begin = number.saturating_sub(BESIDE).max(first);
    let end = (number + BESIDE + 1).min(next);
    let (mut sum, mut greatest, mut length) = (0.0, 0.0f64, 0.0);
    let mut before = pieces.at(begin);
    for number in begin + 1..end {
        let piece = pieces.at(number);
        sum += piece.turn;
        greatest = greatest.max(piece.turn);
        length += 0.5 * (before.leg.length + piece.leg.length);
        before = piece;
    }
    let whole = (before.direction - pieces.at(begin).direction).norm();
    (greatest < GREATEST_SHARE * sum && whole > EVEN * sum).then(|| sum / length)
}

#[cfg(test)]
mod tests {
    use super::super::piece::Point;
    use super::*;

    /// How many of the 20 pieces in the middle of 40 with these directions, radians, lie on a curve.
    fn on_curve(angle: fn(u64) -> f64) -> usize {
        let mut pieces = Box::new(Ring::filled_with(Piece::VACANT));
        let direction = |number: u64| Point::new(angle(number).cos(), angle(number).sin(), 0.0);
        for number in 1..40 {
            let piece = pieces.at_mut(number);
            piece.direction = direction(number);
            piece.turn = (direction(number) - direction(number - 1)).norm();
        }
        (10..30)
            .filter(|number| curvature(&pieces, *number, 0, 40).is_some())
            .count()
    }

    #[test]
    fn a_circle_of_chords_is_a_curve_divided_or_not() {
        assert_eq!(on_curve(|number| 0.1 * number as f64), 20);
        assert_eq!(on_curve(|number| 0.3 * (number / 3) as f64), 20);
    }

    #[test]
    fn a_circle_has_its_curvature() {
        let mut pieces = Box::new(Ring::filled_with(Piece::VACANT));
        // With a radius of 10, of chords that are divided unevenly.
        let angle = |number: u64| 0.07 * number as f64 + 0.02 * (number % 3) as f64;
        let point = |number| {
            Point::new(
                10.0 * f64::sin(angle(number)),
                -10.0 * f64::cos(angle(number)),
                0.0,
            )
        };
        let mut before = Piece::VACANT;
        for number in 0..40 {
            let mut piece = Piece {
                end: point(number + 1),
                ..Piece::VACANT
            };
            before.end = point(number);
            piece.leg.length = (piece.end - before.end).norm();
            piece.follow(&before);
            before = piece;
            *pieces.at_mut(number) = piece;
        }
        for number in 10..30 {
            let found = curvature(&pieces, number, 0, 40).expect("a curve");
            assert!((found / 0.1 - 1.0).abs() < 0.01, "{number}: {found}");
        }
    }

    #[test]
    fn a_corner_a_zigzag_and_a_line_are_none() {
        assert_eq!(on_curve(|number| if number < 20 { 0.0 } else { 1.5 }), 0);
        assert_eq!(on_curve(|number| 0.1 * (number % 2) as f64), 0);
        assert_eq!(on_curve(|_| 0.5), 0);
    }
}
