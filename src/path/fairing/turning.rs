//! Which pieces lie on a curve made of short lines, and which ones go around sharp corners.
//!
//! On a curve the third derivative is about the same for a long way. What a few pieces show of it is then where the lines
//! happen to meet, and no place that is slow anyway.

use core::ops::Range;

use super::piece::{Piece, Point, ROOM};
use crate::ring::Ring;

/// Pieces to both sides of one that show whether it lies on a curve.
const BESIDE: u64 = 6;

/// On a curve the direction turns in all by at least this share of what it turns by piece by piece: over more than two radians,
/// or where coordinates are rounded, it is less.
const EVEN: f64 = 0.8;

/// And nowhere by more than this share: a corner is no curve.
const GREATEST_SHARE: f64 = 0.6;

/// Of a curve that turns by more within so many pieces only those show it to either side that turn by this much, radians, and none by more
/// than this share of them.
const TURN_BESIDE: f64 = 1.0;
const GREATEST_SHARE_NEARBY: f64 = 0.3;

/// Pieces to both sides of one that show whether it goes around.
const AROUND: u64 = 12;

/// Length of the difference of unit vectors by which a sharp corner turns at least: 77 degrees. Figures of blunter ones gain from being
/// led along their inner side, as circles do.
const SHARP: f64 = 1.25;

/// So many sharp corners make a way around ..
const CORNERS: u32 = 2;

/// .. if at least this share of all turning is about the same axis.
const ABOUT_ONE_AXIS: f64 = 0.8;

/// How the direction turns over several pieces.
struct Turning {
    /// Piece by piece, and the greatest; lengths of differences of unit vectors.
    sum: f64,
    greatest: f64,
    /// From the first to the last.
    whole: f64,
    /// From the middle of the first to the middle of the last, path distance.
    length: f64,
}

impl Turning {
    fn of(pieces: &Ring<Piece, ROOM>, numbers: Range<u64>) -> Self {
        let first = pieces.at(numbers.start);
        let mut turning = Self {
            sum: 0.0,
            greatest: 0.0,
            whole: 0.0,
            length: 0.0,
        };
        let mut before = first;
        for number in numbers.start + 1..numbers.end {
            let piece = pieces.at(number);
            turning.sum += piece.turn;
            turning.greatest = turning.greatest.max(piece.turn);
            turning.length += 0.5 * (before.leg.length + piece.leg.length);
            before = piece;
        }
        turning.whole = (before.direction - first.direction).norm();
        turning
    }

    /// Whether no piece turns by more than a `share` of it all, and all to about the same side.
    fn is_even(&self, share: f64) -> bool {
        self.greatest < share * self.sum && self.whole > EVEN * self.sum
    }

    /// 1 per machine unit.
    fn curvature(&self) -> f64 {
        self.sum / self.length
    }
}

/// The pieces from `first` to before `next` that show whether one lies on a curve.
pub(super) fn beside(number: u64, first: u64, next: u64) -> Range<u64> {
    number.saturating_sub(BESIDE).max(first)..(number + BESIDE + 1).min(next)
}

/// The curvature of the curve that a piece lies on, as far as those from `first` to before `next` show it, 1 per machine unit;
/// `None` where it lies on none.
pub(super) fn curvature(
    pieces: &Ring<Piece, ROOM>,
    number: u64,
    first: u64,
    next: u64,
) -> Option<f64> {
    let turning = Turning::of(pieces, beside(number, first, next));
    turning.is_even(GREATEST_SHARE).then(|| turning.curvature())
}

/// The curvature around a piece that turns by too much for that within so many pieces, but evenly from piece to piece beside it.
pub(super) fn curvature_nearby(
    pieces: &Ring<Piece, ROOM>,
    number: u64,
    first: u64,
    next: u64,
) -> Option<f64> {
    let turn = |number: u64| pieces.at(number).turn;
    let all = beside(number, first, next);
    let (mut begin, mut before) = (number, 0.0);
    while begin > all.start && before + turn(begin) <= TURN_BESIDE {
        before += turn(begin);
        begin -= 1;
    }
    let (mut end, mut behind) = (number + 1, 0.0);
    while end < all.end && behind + turn(end) <= TURN_BESIDE {
        behind += turn(end);
        end += 1;
    }
    let turning = Turning::of(pieces, begin..end);
    turning
        .is_even(GREATEST_SHARE_NEARBY)
        .then(|| turning.curvature())
}

/// Sums over the pieces around one, from number to number: what lies between sharp corners to the same side that are so near to each
/// other never comes to a great feed.
#[derive(Clone, Debug)]
pub(super) struct Around {
    /// All pieces that are looked at, and those that are summed up.
    whole: Range<u64>,
    summed: Range<u64>,
    /// Of the directions, length of the differences of unit vectors, and about which axis.
    turn: f64,
    about: Point,
    sharp: u32,
    /// From the middle of a piece to the middle of the next one, path distance.
    length: f64,
}

impl Around {
    /// Of pieces from `first` to before `next`.
    pub fn new(first: u64, next: u64) -> Self {
        Self {
            whole: first..next,
            summed: first + 1..first + 1,
            turn: 0.0,
            about: Point::zeros(),
            sharp: 0,
            length: 0.0,
        }
    }

    /// Goes on to a piece: numbers only rise.
    pub fn go_on_to(&mut self, pieces: &Ring<Piece, ROOM>, number: u64) {
        let start = number.saturating_sub(AROUND).max(self.whole.start) + 1;
        let end = (number + AROUND + 1).min(self.whole.end);
        while self.summed.end < end {
            self.count(pieces, self.summed.end, 1);
            self.summed.end += 1;
        }
        while self.summed.start < start {
            self.count(pieces, self.summed.start, -1);
            self.summed.start += 1;
        }
    }

    fn count(&mut self, pieces: &Ring<Piece, ROOM>, number: u64, sign: i32) {
        let (before, piece) = (pieces.at(number.wrapping_sub(1)), pieces.at(number));
        let times = f64::from(sign);
        self.turn += times * piece.turn;
        self.about += piece.about * times;
        if piece.turn > SHARP {
            self.sharp = self.sharp.wrapping_add_signed(sign);
        }
        self.length += times * 0.5 * (before.leg.length + piece.leg.length);
    }

    /// By how much the way turns in the mean, 1 per machine unit; 0 where it does not go around.
    pub fn curvature(&self) -> f64 {
        let around = self.sharp >= CORNERS && self.about.norm() > ABOUT_ONE_AXIS * self.turn;
        if around { self.turn / self.length } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::piece::at;
    use super::*;

    /// 40 pieces of length .4 with these directions, radians.
    fn pieces(angle: fn(u64) -> f64) -> Box<Ring<Piece, ROOM>> {
        let mut pieces = Box::new(Ring::filled_with(Piece::VACANT));
        let direction = |number: u64| at(angle(number).cos(), angle(number).sin());
        for number in 1..40 {
            let piece = pieces.at_mut(number);
            piece.direction = direction(number);
            piece.turn = (direction(number) - direction(number - 1)).norm();
            piece.leg.length = 0.4;
        }
        pieces
    }

    /// How many of the 20 in the middle lie on a curve.
    fn on_curve(angle: fn(u64) -> f64) -> usize {
        let pieces = pieces(angle);
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
    fn a_circle_of_few_chords_has_its_curvature_and_corners_have_none() {
        let nearby = |angle| {
            let pieces = pieces(angle);
            assert_eq!(on_curve(angle), 0);
            (10..30)
                .filter_map(|number| curvature_nearby(&pieces, number, 0, 40))
                .collect::<Vec<_>>()
        };
        let found = nearby(|number| 0.2 * number as f64);
        assert_eq!(found.len(), 20);
        let radius = 0.2 / (2.0 * 0.1f64.sin());
        let even = found
            .iter()
            .all(|curvature| (0.4 * curvature * radius - 0.2).abs() < 1e-9);
        assert!(even, "{found:?}");
        assert!(nearby(|number| 0.8 * number as f64).is_empty(), "corners");
        assert!(
            nearby(|number| 0.2 * (number % 2) as f64).is_empty(),
            "zigzag"
        );
    }

    #[test]
    fn a_circle_has_its_curvature() {
        let mut pieces = Box::new(Ring::filled_with(Piece::VACANT));
        // With a radius of 10, of chords that are divided unevenly.
        let angle = |number: u64| 0.07 * number as f64 + 0.02 * (number % 3) as f64;
        let point = |number| {
            at(
                10.0 * f64::sin(angle(number)),
                -10.0 * f64::cos(angle(number)),
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

    /// What the piece in the middle of 40 of length .25 goes around with, that turn by an angle at each fourth of them, radians.
    fn around_corners(turn: fn(u64) -> f64) -> f64 {
        let mut pieces = Box::new(Ring::filled_with(Piece::VACANT));
        let (mut before, mut angle) = (Piece::VACANT, 0.0f64);
        for number in 0..40 {
            if number % 4 == 0 {
                angle += turn(number / 4);
            }
            let way = 0.25 * at(angle.cos(), angle.sin());
            let mut piece = Piece {
                end: before.end + way,
                ..Piece::VACANT
            };
            piece.leg.length = 0.25;
            piece.follow(&before);
            before = piece;
            *pieces.at_mut(number) = piece;
        }
        let mut around = Around::new(2, 40);
        for number in 3..=20 {
            around.go_on_to(&pieces, number);
        }
        let mut at_once = Around::new(2, 40);
        at_once.go_on_to(&pieces, 20);
        assert!((around.curvature() - at_once.curvature()).abs() < 1e-12);
        around.curvature()
    }

    #[test]
    fn a_square_goes_around_and_stairs_do_not() {
        // Each corner turns by the length of a diagonal, in 1 mm.
        let square = around_corners(|_| 1.57);
        assert!((square - 1.414).abs() < 0.01, "{square}");
        assert_eq!(
            around_corners(|corner| if corner % 2 == 0 { 1.57 } else { -1.57 }),
            0.0
        );
        assert_eq!(
            around_corners(|corner| if corner == 5 { 1.57 } else { 0.0 }),
            0.0
        );
        assert_eq!(around_corners(|_| 1.0), 0.0, "blunt corners");
        // Both are farther away than the twelve pieces that are looked at.
        assert_eq!(
            around_corners(|corner| if corner == 1 || corner == 2 {
                1.57
            } else {
                0.0
            }),
            0.0
        );
    }

    #[test]
    fn a_corner_a_zigzag_and_a_line_are_none() {
        assert_eq!(on_curve(|number| if number < 20 { 0.0 } else { 1.5 }), 0);
        assert_eq!(on_curve(|number| 0.1 * (number % 2) as f64), 0);
        assert_eq!(on_curve(|_| 0.5), 0);
    }
}
