//! By how much derivatives of the path leave the parabolas through the three places of an interval.
//!
//! Between its three places a derivative of the path is taken for the parabola through them. Where the
//! rounding of a corner begins or ends it leaves that parabola. How far is seen at the places where the
//! third derivative or its slope jumps, since it is smooth in between, and in the middles between those, where
//! a change shows that is 0 at both; so much of the limits is set aside in all rows, as much as the speed asks for:
//!
//! ```text
//! |q' a + q'' b| + d2 b <= A     |q' u + 3 q'' a + q''' b| sqrt(b) + d3 b^1.5 <= J
//! ```

use super::route::{MOST_BREAKPOINTS, Route};
use super::rows::AxisRows;
use super::sample::Sample;
use crate::lanes::greatest_amount;

/// Of the second difference of three places, how far what is smooth may leave the parabola through them.
const SMOOTH_SHARE: f64 = 0.125;

/// The greatest value of the cubic that vanishes at start, middle and end, over its integral up to the middle as
/// a share of the length.
const CUBIC: f64 = 3.0792;

/// The greatest departures of all axes in an interval.
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

/// An interval between its places.
pub(super) struct Between<'a, R: Route> {
    pub rows: &'a AxisRows,
    pub route: &'a R,
    /// Where it starts.
    pub start: f64,
    /// Its length in s.
    pub length: f64,
}

impl<R: Route> Between<'_, R> {
    /// By how much the path departs from what these samples of its start, middle and end say.
    pub fn departure_from(&self, samples: [&Sample; 3]) -> Departure {
        let end = self.start + self.length;
        let mut most = self.smooth(samples);
        let mut look = |place: f64| {
            let [second, third] = self.departure_at(samples, place);
            most = [most[0].max(second), most[1].max(third)];
        };
        let (mut from, mut last) = (self.start, self.start);
        while from < end {
            let mut places = [0.0; MOST_BREAKPOINTS];
            let (to, count) = self.breakpoints(from, end, &mut places);
            let places = &mut places[..count];
            sort(places);
            // Where the interval is divided there may be one, too.
            let divided = (to < end).then_some(to);
            for place in places.iter().copied().chain(divided) {
                if let Some(middle) = middle(last, place) {
                    look(middle);
                }
                look(place);
                last = place;
            }
            from = to;
        }
        if let Some(middle) = middle(last, end).filter(|_| last > self.start) {
            look(middle);
        }
        let [second, third] = most.map(|share| share as f32);
        Departure { second, third }
    }

    /// The breakpoints behind `from` and before `end`, or before a place nearer than that where there is no room for all of them:
    /// that place, and how many.
    fn breakpoints(
        &self,
        from: f64,
        end: f64,
        places: &mut [f64; MOST_BREAKPOINTS],
    ) -> (f64, usize) {
        let mut to = end;
        loop {
            let count = self.route.breakpoints(from, to, places);
            match middle(from, to) {
                Some(middle) if count >= MOST_BREAKPOINTS => to = middle,
                _ => return (to, count.min(MOST_BREAKPOINTS)),
            }
        }
    }

    /// How far q'' and q''' leave their parabolas where they are smooth, over A and J. If q''' is a cubic, that changes q''
    /// up to the middle by something else than the parabola does.
    fn smooth(&self, samples: [&Sample; 3]) -> [f64; 2] {
        let [start, middle, end] = samples;
        let second = start.second + end.second - middle.second * 2.0;
        let third = start.third + end.third - middle.third * 2.0;
        let by_parabola =
            (start.third * 5.0 + middle.third * 8.0 - end.third) * (self.length / 24.0);
        let change = (middle.second - start.second) / 3.0;
        let cubic = CUBIC * greatest_amount(&(change - by_parabola)) / self.length;
        let to_acceleration = self.rows.third_of_jerk_time();
        [
            greatest_amount(&second.component_mul(to_acceleration)) * SMOOTH_SHARE,
            (greatest_amount(&third) * SMOOTH_SHARE).max(cubic),
        ]
    }

    /// How far q'' and q''' are off their parabolas at a place, over A and J; without end where the machine has no joints for
    /// the place: the greater of a number and of none would be the number.
    fn departure_at(&self, samples: [&Sample; 3], place: f64) -> [f64; 2] {
        let x = (place - self.start) / self.length;
        let weights = [
            (1.0 - x) * (1.0 - 2.0 * x),
            4.0 * x * (1.0 - x),
            x * (2.0 * x - 1.0),
        ];
        let there = self.rows.curving(self.route, place);
        let (mut second, mut third) = (there.second, there.third);
        for (sample, weight) in samples.into_iter().zip(weights) {
            second -= sample.second * weight;
            third -= sample.third * weight;
        }
        if self.rows.bends() && !(second.sum() + third.sum()).is_finite() {
            return [f64::INFINITY; 2];
        }
        let to_acceleration = self.rows.third_of_jerk_time();
        let second = greatest_amount(&second.component_mul(to_acceleration));
        [second, greatest_amount(&third)]
    }
}

/// What lies between two places, if anything does: both sides of a jump are neighbours.
fn middle(from: f64, to: f64) -> Option<f64> {
    let middle = 0.5 * (from + to);
    (from < middle && middle < to).then_some(middle)
}

/// They are few, and nearly in order.
fn sort(places: &mut [f64]) {
    for end in 1..places.len() {
        let mut k = end;
        while k > 0 && places[k - 1] > places[k] {
            places.swap(k - 1, k);
            k -= 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::ArrayStorage;

    use super::super::test_route::TestRoute;
    use super::*;
    use crate::axes::{Axes, AxisLimits};
    use crate::machine_map::{JointMap, MachineMap};
    use crate::moves::shape::PathPoint;

    /// q''' of X is a tooth of height 1 between these places, and 0 elsewhere.
    fn tooth(from: f64, to: f64) -> TestRoute<impl Fn(f64) -> PathPoint> {
        let half = 0.5 * (to - from);
        let point = move |s: f64| {
            let x = ((s - from) / half).clamp(0.0, 2.0);
            let height = x.min(2.0 - x);
            let area = if x < 1.0 {
                0.5 * x * x
            } else {
                1.0 - 0.5 * height * height
            };
            PathPoint {
                position: Axes::x() * s,
                first: Axes::zeros(),
                second: Axes::x() * (half * area),
                third: Axes::x() * height,
            }
        };
        TestRoute {
            point,
            breakpoints: vec![to, from],
            vertices: Vec::new(),
        }
    }

    const JERK: f64 = 20_000.0;

    const LIMITS: AxisLimits = AxisLimits {
        velocity: Axes::from_array_storage(ArrayStorage([[100.0; 9]])),
        acceleration: Axes::from_array_storage(ArrayStorage([[1000.0; 9]])),
        jerk: Axes::from_array_storage(ArrayStorage([[JERK; 9]])),
    };

    /// The departure of q''' in the interval from 0 to 1.
    fn departure(route: &impl Route, map: &MachineMap) -> f64 {
        let rows = AxisRows::new(&LIMITS, map, 1e-3);
        let samples = [0.0, 0.5, 1.0].map(|s| rows.sample(route, s, 0.0));
        let between = Between {
            rows: &rows,
            route,
            start: 0.0,
            length: 1.0,
        };
        f64::from(between.departure_from(samples.each_ref()).third) * JERK
    }

    #[test]
    fn a_change_that_is_0_at_both_breakpoints_and_all_samples_is_seen_between_them() {
        for (from, to) in [(0.1, 0.4), (0.6, 0.62), (0.7, 1.0), (0.2, 0.2001)] {
            let third = departure(&tooth(from, to), &MachineMap::IDENTITY);
            assert!((third - 1.0).abs() < 1e-3, "{from} {third}");
        }
    }

    #[test]
    fn what_begins_in_an_interval_departs_most_there() {
        // The parabola through 0, 1 and 0 is .64 where the tooth begins and ends.
        let third = departure(&tooth(0.2, 0.8), &MachineMap::IDENTITY);
        assert!((third - 0.64).abs() < 1e-6, "{third}");
    }

    #[test]
    fn none_of_many_breakpoints_is_passed_over() {
        let mut route = tooth(0.1, 0.4);
        let others = (1..200).map(|k| 0.5 + 0.002 * f64::from(k));
        route.breakpoints = others.chain([0.4, 0.1]).collect();
        let third = departure(&route, &MachineMap::IDENTITY);
        assert!((third - 1.0).abs() < 1e-3, "{third}");
    }

    #[test]
    fn a_place_without_joints_departs_without_end() {
        let hole = JointMap::new(
            |position, derivatives, _| {
                if (0.2..0.3).contains(&position[0]) {
                    [Axes::repeat(f64::NAN); 3]
                } else {
                    *derivatives
                }
            },
            &LIMITS,
            0.0,
        );
        let map = MachineMap::IDENTITY.with_joints(Some(hole));
        assert_eq!(departure(&tooth(0.1, 0.4), &map), f64::INFINITY);
    }
}
