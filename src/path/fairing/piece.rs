//! A piece of a leg that waits, with the vertex at its end.

use crate::path::leg::Leg;
use crate::path::linear_axes::{self, LinearAxes};
use crate::path::settings::{Allowance, BlendSettings};

/// XYZ and UVW.
pub(super) type Point = LinearAxes;

pub(super) const ORIGIN: Point = linear_axes::ORIGIN;

/// Pieces that there is room for, and those before them that the first ones depend on.
pub(super) const ROOM: usize = 128;

/// Vertices that a third divided difference spans.
pub(super) const SPAN: usize = 4;

/// What of the tolerance a vertex is moved by at most: the rest is for the kernels.
const SHARE: f64 = 0.7;

/// A path bends evenly enough with so many times the third derivative that its feed allows. Circles made of chords would
/// shrink by as much as they may, since that makes them a little more even.
pub(super) const EVEN: f64 = 3.0;

/// Radians that an arc turns by at most, whose vertices are moved: it is divided.
const MOST_TURN: f64 = 7.0;

/// The same of a piece: three of them tell a third derivative.
const MOST_TURN_OF_PIECE: f64 = 0.6;

/// Sine of the least turn that has an axis.
const LEAST_TURN: f64 = 1e-9;

/// A line, or a part of one, and the vertex at its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub leg: Leg,
    /// Where the program ends it.
    pub end: Point,
    /// Which way it leads there, from its start straight to its end, length 1.
    pub direction: Point,
    /// By how much that differs from the one before.
    pub turn: f64,
    /// The axis that it turns about, as long as `turn`; zero where it turns back.
    pub about: Point,
    /// Whether nothing to come changes what lies before its end.
    pub closes: bool,
    /// Whether another line follows it without a stop that vertices are moved on as well.
    pub joined: bool,
    /// How far its vertex is moved at most.
    pub room: f64,
    /// What a unit of that costs, however even the path is ..
    pub keep: f64,
    /// .. where nothing but the feed says what is even enough.
    pub keep_at_feed: f64,
    /// What the vertices count from which on three pieces end with this one; zeros where they are no run.
    pub third: [f64; SPAN],
    /// The third derivative that the feed allows here.
    pub even: f64,
    /// Square of what its third divided difference is, see [`weights`](super::weights).
    pub square: f64,
    /// Square root of what the third derivative [counts](super::weights) here; negative where that is not known yet.
    pub weight: f64,
    /// What its vertex is moved by.
    pub shift: Point,
    /// What holds that within its room; negative where that is not known yet.
    pub multiplier: f64,
}

impl Piece {
    pub const VACANT: Self = {
        Self {
            leg: Leg::VACANT,
            end: ORIGIN,
            direction: ORIGIN,
            turn: 0.0,
            about: ORIGIN,
            closes: false,
            joined: false,
            room: 0.0,
            keep: 0.0,
            keep_at_feed: 0.0,
            third: [0.0; SPAN],
            even: 1.0,
            square: 0.0,
            weight: -1.0,
            shift: ORIGIN,
            multiplier: -1.0,
        }
    };

    pub fn new(leg: Leg, settings: &BlendSettings) -> Self {
        Self {
            even: settings.even_third(leg.speed),
            end: linear_axes::of(&leg.programmed_point(leg.end()).position),
            leg,
            ..Self::VACANT
        }
    }

    /// Behind another one.
    pub fn follow(&mut self, before: &Self) {
        let way = self.end - before.end;
        self.direction = way / way.norm().max(f64::MIN_POSITIVE);
        self.turn = (self.direction - before.direction).norm();
        let about = linear_axes::cross(&before.direction, &self.direction);
        self.about = about * (self.turn / about.norm().max(LEAST_TURN));
    }

    /// None, where this leg starts.
    pub fn before(leg: &Leg) -> Self {
        Self {
            end: linear_axes::of(&leg.programmed_point(leg.start).position),
            ..Self::VACANT
        }
    }

    /// Takes note of what follows, and whether the vertex in between may be moved.
    pub fn join(&mut self, next: &Leg, joined: bool, settings: &BlendSettings) {
        let leg = &self.leg;
        self.joined = joined && is_short(leg) && is_short(next);
        if self.joined {
            self.room = SHARE * leg.tolerance().min(next.tolerance());
            let even = EVEN * settings.even_third(leg.speed.max(next.speed)) / self.room;
            self.keep_at_feed = 0.5 * (leg.length + next.length) * even * even;
            self.keep = self.keep_at_feed;
        }
    }
}

fn is_short(piece: &Leg) -> bool {
    piece.turning * piece.length <= MOST_TURN_OF_PIECE
}

/// Whether vertices at the ends of a leg may be moved: lines in XYZ and UVW alone, and arcs, that have a tolerance, and may be left to
/// either side.
pub(super) fn is_moved(leg: &Leg, settings: &BlendSettings) -> bool {
    leg.turning * leg.whole <= MOST_TURN
        && matches!(leg.allowance, Allowance::Tolerance(_))
        && leg.is_linear
        && leg.may_swing_out
        && settings.swings()
        && !leg.near_limit.start
        && !leg.near_limit.end
}

/// Number of a vertex, 0 to 3, that the third divided difference spans which ends with a piece.
pub(super) fn vertex(piece: u64, k: usize) -> u64 {
    piece.wrapping_sub((SPAN - 1 - k) as u64)
}

/// What the vertices count in the square root of what a third divided difference costs that spans pieces of these lengths.
pub(super) fn third(lengths: [f64; SPAN - 1]) -> [f64; SPAN] {
    let [a, b, c] = lengths;
    let weight = 6.0 * ((a + b + c) / 3.0).sqrt();
    [
        -weight / (a * (a + b) * (a + b + c)),
        weight / (a * b * (b + c)),
        -weight / ((a + b) * b * c),
        weight / ((a + b + c) * (b + c) * c),
    ]
}

/// X and Y.
#[cfg(test)]
pub(super) fn at(x: f64, y: f64) -> Point {
    Point::from([x, y, 0.0, 0.0, 0.0, 0.0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_has_its_third_derivative_everywhere() {
        let lengths = [0.5, 2.0, 0.25];
        let places = [1.0, 1.5, 3.5, 3.75];
        let cubic = |s: f64| 2.0 * s * s * s - s * s + 7.0;
        let counted: f64 = third(lengths)
            .iter()
            .zip(places)
            .map(|(counts, s)| counts * cubic(s))
            .sum();
        let expected = 12.0 * (2.75f64 / 3.0).sqrt();
        assert!((counted - expected).abs() < 1e-9, "{counted} {expected}");
    }
}
