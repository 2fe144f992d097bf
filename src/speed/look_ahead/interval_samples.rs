//! What is known of the path in an interval: the rows at three places, and by how much they may be left in
//! between.
//!
//! Between its three places a derivative of the path is taken for the parabola through them. Where the
//! rounding of a corner begins or ends it leaves that parabola. How far is seen at the places where the
//! third derivative or its slope jumps, since it is smooth in between; so much of the limits is set aside in
//! all rows, as much as the speed asks for:
//!
//! ```text
//! |q' a + q'' b| + d2 b <= A     |q' u + 3 q'' a + q''' b| sqrt(b) + d3 b^1.5 <= J
//! ```

use super::place::{Place, middle};
use super::route::{MOST_BREAKPOINTS, Route, before};
use super::rows::AxisRows;
use super::sample::{Cap, Sample};
use crate::moves::shape::PathPoint;

/// Of the second difference of three places, how far what is smooth may leave the parabola through them.
const SMOOTH_SHARE: f64 = 0.125;

/// The greatest value of the cubic that vanishes at start, middle and end, over its integral up to the middle as
/// a share of the length.
const CUBIC: f64 = 3.0792;

/// By how much derivatives of the path leave the parabolas through three places, the greatest of all axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Departure {
    /// Of q'', over A.
    pub second: f32,
    /// Of q''', over J.
    pub third: f32,
}

impl Departure {
    pub const NONE: Self = Self {
        second: 0.0,
        third: 0.0,
    };
}

/// The samples of an interval, at start and end as they are inside of it: where two legs meet the
/// third derivative of the path may jump.
#[derive(Clone, Copy, Debug)]
pub(super) struct IntervalSamples {
    pub start: Sample,
    pub middle: Sample,
    pub end: Sample,
    pub departure: Departure,
    /// The caps in the middle of both halves.
    pub quarters: [Cap; 2],
}

impl IntervalSamples {
    pub const NONE: Self = Self {
        start: Sample::NONE,
        middle: Sample::NONE,
        end: Sample::NONE,
        departure: Departure::NONE,
        quarters: [Cap::NONE; 2],
    };

    /// The samples at start, middle and end.
    #[inline]
    pub fn places(&self) -> [&Sample; 3] {
        [&self.start, &self.middle, &self.end]
    }

    /// The least cap at the places that are looked at.
    pub fn least_cap(&self, raise_squared: f64) -> f64 {
        let places = self.places().map(|sample| sample.cap);
        let caps = places.iter().chain(&self.quarters);
        caps.fold(f64::INFINITY, |least, cap| {
            least.min(cap.raised(raise_squared))
        })
    }

    /// The cap changes at this share of the length and is not above `cap` there: nor then at the two places
    /// beside it that are looked at.
    pub fn cap_beside(&mut self, share: f64, cap: &Cap) {
        let [first, last] = &mut self.quarters;
        let caps = [
            (0.0, &mut self.start.cap),
            (0.25, first),
            (0.5, &mut self.middle.cap),
            (0.75, last),
            (1.0, &mut self.end.cap),
        ];
        for (place, here) in caps {
            if (place - share).abs() < 0.25 {
                *here = here.least(cap);
            }
        }
    }

    /// Looks between the three `places` of the interval of this length from `s` on.
    pub fn look_between<R: Route>(
        &mut self,
        rows: &AxisRows,
        route: &R,
        s: f64,
        length: f64,
        places: [&Place; 3],
    ) {
        self.departure = self.departure_of(rows, route, s, length);
        let [start, half, end] = places;
        self.quarters = [(start, half, 0.25), (half, end, 0.75)].map(|(start, end, share)| {
            let (from, to) = (&start.point, &end.point);
            let first = middle([&from.first, &to.first], [&from.second, &to.second], length);
            // Where one bends |q'| up and the other down, their mean would hide both.
            let third = if first.dot(&from.third) < first.dot(&to.third) {
                from.third
            } else {
                to.third
            };
            let point = PathPoint {
                first,
                second: (from.second + to.second) * 0.5,
                third,
                ..*from
            };
            let place = rows.place_between(&point, [start, end], length);
            rows.cap(route, s + share * length, &place, 0.25 * length)
        });
    }

    /// By how much q''' leaves its parabola if it is a cubic, over J: that changes q'' up to the middle by
    /// something else than the parabola does.
    fn cubic(&self, length: f64) -> f64 {
        let [start, middle, end] = self.places();
        let by_parabola = (start.third * 5.0 + middle.third * 8.0 - end.third) * (length / 24.0);
        let change = (middle.second - start.second) / 3.0;
        CUBIC * (change - by_parabola).amax() / length
    }

    fn departure_of<R: Route>(&self, rows: &AxisRows, route: &R, s: f64, length: f64) -> Departure {
        let [start, middle, end] = self.places();
        let to_acceleration = *rows.jerk_time() / 3.0;
        let second = start.second + end.second - middle.second * 2.0;
        let third = start.third + end.third - middle.third * 2.0;
        let mut second = second.component_mul(&to_acceleration).amax() * SMOOTH_SHARE;
        let mut third = (third.amax() * SMOOTH_SHARE).max(self.cubic(length));
        let mut places = [0.0; MOST_BREAKPOINTS];
        let count = route.breakpoints(s, s + length, &mut places);
        for &place in places.iter().take(count) {
            let x = (place - s) / length;
            let weights = [
                (1.0 - x) * (1.0 - 2.0 * x),
                4.0 * x * (1.0 - x),
                x * (2.0 * x - 1.0),
            ];
            for side in [before(place), place] {
                let there = rows.curving(route, side);
                let leaves = |value, [a, b, c]: [_; 3]| {
                    value - a * weights[0] - b * weights[1] - c * weights[2]
                };
                let by = leaves(there.second, [start.second, middle.second, end.second]);
                second = second.max(by.component_mul(&to_acceleration).amax());
                let by = leaves(there.third, [start.third, middle.third, end.third]);
                third = third.max(by.amax());
            }
        }
        Departure {
            second: second as f32,
            third: third as f32,
        }
    }
}
