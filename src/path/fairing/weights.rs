//! What the third derivative counts where.
//!
//! What costs time is its cube root where it limits the speed, and not its square: a place that is slow anyway may bend more,
//! one that is fast may not. So it counts the less the greater it is, and the sum of squares comes to one of absolute
//! values (iteratively reweighted least squares: Lawson, 1961).

use super::piece::{Piece, Point, ROOM, SPAN, vertex};
use crate::ring::Ring;

/// Over so many pieces to both sides the third derivative is averaged: kernels smooth as far.
const BESIDE: u64 = 2;

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

/// Determines the weights of the pieces from `first` to before `next` from where their vertices are.
pub(super) fn weigh(pieces: &mut Ring<Piece, ROOM>, first: u64, next: u64) {
    let from = first.saturating_sub(BESIDE + 1);
    for number in from..next {
        pieces.at_mut(number).square = square(pieces, number);
    }
    for number in first..next {
        let beside = number.saturating_sub(BESIDE).max(from)..(number + BESIDE + 1).min(next);
        let (mut sum, mut length) = (0.0, 0.0);
        for piece in beside.map(|number| pieces.at(number)) {
            if piece.third != [0.0; SPAN] {
                sum += piece.square;
                length += piece.leg.length;
            }
        }
        let piece = pieces.at_mut(number);
        let greatest = piece.even * piece.even * length;
        piece.weight = if sum > greatest {
            (greatest / sum).sqrt().sqrt()
        } else {
            1.0
        };
    }
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
    use super::super::piece::third;
    use super::*;

    #[test]
    fn what_bends_more_counts_less() {
        let mut pieces = Box::new(Ring::filled_with(Piece::VACANT));
        let height = |k: u64| if k < 20 { 0.01 } else { 1.0 };
        let point = |k: u64| Point::new(k as f64, height(k) * (k % 2) as f64, 0.0);
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
        weigh(&mut pieces, 0, 40);
        // The third derivative of a zigzag of height h is 4 h.
        for (number, height) in [(10, 0.01), (30, 1.0)] {
            let expected = (0.1f64 / (4.0 * height)).sqrt().min(1.0);
            let weight = pieces.at(number).weight;
            assert!((weight - expected).abs() < 1e-9, "{weight} {expected}");
        }
    }
}
