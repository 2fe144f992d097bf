//! The hull: from coefficients whose slope may fall as fast as it likes to coefficients that keep
//! the jerk in both directions.
//!
//! The sweeps bound how fast the slope of the coefficients grows, but where the lower of both is
//! taken, or a cap begins, it falls at once. Let L be a function whose slope grows at each
//! coefficient by what the jerk allows. The slope of C falls nowhere faster than allowed where
//! C + L is convex; the greatest such C below the sweeps is their lower convex hull with L added,
//! less L. The hull is the one of Andrew (Another efficient algorithm for convex hulls in two
//! dimensions, Information Processing Letters 9(5), 1979), one coefficient at a time.

use super::spline::CAPACITY;
use crate::ring::Ring;

/// A coefficient of the sweeps with L added.
#[derive(Clone, Copy, Debug)]
struct Lifted {
    /// Position: coefficients lie as far apart as the sum of their intervals.
    x: f64,
    /// The slope of L in front.
    slope: f64,
    /// L.
    lift: f64,
    /// The coefficient and L.
    y: f64,
    /// The corner of the hull before this one, if this were the last.
    previous: usize,
}

/// The hull of the last [`CAPACITY`] coefficients.
#[derive(Debug)]
pub(super) struct Hull {
    points: Ring<Lifted, CAPACITY>,
    base: usize,
}

impl Hull {
    pub const NONE: Self = Self {
        points: Ring::filled_with(Lifted {
            x: 0.0,
            slope: 0.0,
            lift: 0.0,
            y: 0.0,
            previous: 0,
        }),
        base: 0,
    };

    /// Begins at the coefficient `base`, which stays as it is.
    pub fn restart(&mut self, base: usize, value: f64) {
        self.base = base;
        *self.points.at_mut(base as u64) = Lifted {
            x: 0.0,
            slope: 0.0,
            lift: 0.0,
            y: value,
            previous: base,
        };
    }

    /// Appends coefficient `k`, `distance` behind the one before, at which the slope may fall by
    /// `fall`.
    pub fn append(&mut self, k: usize, value: f64, distance: f64, fall: f64) {
        let before = *self.at(k - 1);
        let slope = before.slope + fall;
        let lift = before.lift + slope * distance;
        let x = before.x + distance;
        let y = value + lift;
        let mut corner = k - 1;
        for _ in 0..CAPACITY {
            if corner <= self.base {
                break;
            }
            let here = self.at(corner);
            let previous = self.at(here.previous);
            // Whether the chord before the corner is as steep as the one behind it.
            let reflex =
                (here.y - previous.y) * (x - here.x) >= (y - here.y) * (here.x - previous.x);
            if !reflex {
                break;
            }
            corner = here.previous;
        }
        *self.points.at_mut(k as u64) = Lifted {
            x,
            slope,
            lift,
            y,
            previous: corner,
        };
    }

    /// The corner before corner `k`.
    pub fn previous(&self, k: usize) -> usize {
        self.at(k).previous
    }

    /// The hull less L at `k`, which lies between the corner `corner` and the one before it.
    pub fn value(&self, k: usize, corner: usize) -> f64 {
        let end = self.at(corner);
        let start = self.at(end.previous);
        let here = self.at(k);
        if end.x <= start.x {
            return here.y - here.lift;
        }
        let steep = (end.y - start.y) / (end.x - start.x);
        start.y + steep * (here.x - start.x) - here.lift
    }

    fn at(&self, k: usize) -> &Lifted {
        self.points.at(k as u64)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// Below the values, slopes fall by no more than allowed, and corners touch.
        #[test]
        fn is_below_and_falls_slowly(
            values in prop::collection::vec((1.0..100.0f64, 0.1..3.0f64, 0.0..5.0f64), 3..60),
        ) {
            let mut hull = Box::new(Hull::NONE);
            let base = 1000;
            let count = values.len();
            hull.restart(base, values[0].0);
            prop_assert_eq!(hull.value(base, base), values[0].0);
            for (i, (value, distance, fall)) in values.iter().enumerate().skip(1) {
                hull.append(base + i, *value, *distance, *fall);
            }
            let mut result = vec![0.0; count];
            let mut corner = base + count - 1;
            result[count - 1] = hull.value(corner, corner);
            let mut k = corner;
            while k > base {
                if k == hull.previous(corner) {
                    corner = k;
                }
                result[k - base] = hull.value(k, corner);
                if k == corner {
                    prop_assert!((result[k - base] - values[k - base].0).abs() < 1e-9);
                }
                k -= 1;
            }
            result[0] = values[0].0;
            for i in 1..count {
                prop_assert!(result[i] <= values[i].0 + 1e-9);
            }
            for i in 1..count - 1 {
                let before = (result[i] - result[i - 1]) / values[i].1;
                let behind = (result[i + 1] - result[i]) / values[i + 1].1;
                prop_assert!(behind >= before - values[i + 1].2 - 1e-8);
            }
        }
    }
}
