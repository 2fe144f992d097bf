//! What is known of the path in an interval: the rows at three places, by how much they may be left in
//! between, and caps.

use super::departure::{Between, Departure};
use super::place::{Place, middle};
use super::route::Route;
use super::rows::AxisRows;
use super::sample::{Cap, Sample};
use crate::lanes::lesser;
use crate::moves::shape::PathPoint;

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
            lesser(least, cap.raised(raise_squared))
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
        let between = Between {
            rows,
            route,
            start: s,
            length,
        };
        self.departure = between.departure_from(self.places());
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
}
