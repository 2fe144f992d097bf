//! By how much acceleration and jerk may lie beyond what they are at both ends of a stretch of a cell.

use crate::axes::Axes;

/// A stretch that takes less, seconds, is looked at in its middle: what numerical jets of its ends differ by would become jerk.
const LEAST_TIME: f64 = 6e-5;

/// A parabola through three values exceeds its ends by no more than the middle value exceeds their mean; a smooth curve
/// over a small angle hardly differs from it. Each shape (9).
#[derive(Clone, Debug)]
pub(super) struct Bulge {
    pub acceleration: Axes,
    pub jerk: Axes,
}

impl Bulge {
    /// Of the accelerations and jerks at start, middle and end.
    pub fn through(accelerations: [&Axes; 3], jerks: [&Axes; 3]) -> Self {
        let [acceleration, jerk] =
            [accelerations, jerks].map(|[start, middle, end]| (middle - (start + end) * 0.5).abs());
        Self { acceleration, jerk }
    }

    /// Of those at start and end alone, so many `seconds` apart: the jerk is the one that makes the one acceleration of
    /// the other, and the acceleration bends with the jerk. `None` where that says too little.
    pub fn between(accelerations: [&Axes; 2], jerks: [&Axes; 2], seconds: f64) -> Option<Self> {
        let ([start, end], [from, to]) = (accelerations, jerks);
        (seconds >= LEAST_TIME).then(|| Self {
            acceleration: ((from - to) * (seconds / 8.0)).abs(),
            jerk: ((end - start) * (1.5 / seconds) - (from + to) * 0.75).abs(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where the jerk is a parabola the ends say all.
    #[test]
    fn the_ends_say_what_the_middle_is() {
        let seconds = 2e-3;
        // 3 + 4 t - 5 t^2 and what becomes of it, in milliseconds.
        let jerk = |t: f64| Axes::repeat(3.0 + t * (4.0 - 5.0 * t)) * 1e9;
        let acceleration = |t: f64| Axes::repeat(7.0 + t * (3.0 + t * (2.0 - t * 5.0 / 3.0))) * 1e6;
        let (accelerations, jerks) = ([0.0, 1.0, 2.0].map(acceleration), [0.0, 1.0, 2.0].map(jerk));
        let seen = Bulge::through(accelerations.each_ref(), jerks.each_ref());
        let ends = |places: &[Axes; 3]| [places[0], places[2]];
        let (accelerations, jerks) = (ends(&accelerations), ends(&jerks));
        let told = Bulge::between(accelerations.each_ref(), jerks.each_ref(), seconds)
            .expect("long enough");
        assert!((seen.jerk - told.jerk).amax() < 1.0, "{seen:?} {told:?}");
        // A cubic leaves its parabola in the middle by nothing.
        assert!(
            (seen.acceleration - told.acceleration).amax() < 1e-3,
            "{seen:?} {told:?}"
        );
    }

    #[test]
    fn a_short_stretch_is_looked_at() {
        let nothing = Axes::zeros();
        let between = |seconds| Bulge::between([&nothing; 2], [&nothing; 2], seconds);
        assert!(between(1e-6).is_none());
        assert!(between(1e-3).is_some());
    }
}
