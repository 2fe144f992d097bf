//! Moves on which nothing but linear axes counts for much: X, Y, Z and U, V, W.
//!
//! Their path may be anywhere in its tolerance: it swings out at corners, vertices of dense code are moved, and where along a line
//! it is does not matter. A rotary axis that turns a little beside them, as on a part that is wrapped around it, changes
//! nothing of that: the tolerance is still kept in the [metric](super::metric) of all axes, and the widths are chosen for
//! the limits of all of them.
//!
//! Not so beside U, V and W, where nothing is gained by it, and where it turns the tool about its tip. Joints then follow it with X, Y and Z, and what widths gain for these three
//! is lost again: random programs in five axes took up to 5.5 % longer.

use super::settings::BlendSettings;
use crate::moves::shape::{Line9, Shape};

/// The share that X, Y and Z have in the length of a line at least, where A, B and C count for little beside them. With .3
/// circles about a swinging axis take 18 % longer.
const NEARLY: f64 = 0.8;

/// What the length of a move may differ by from what F counts on it, of that: nothing else moves.
const ROUNDING: f64 = 1e-12;

/// Whether a move whose length F counts along X, Y and Z is one of them, where its path is `per_measure` times as long as that. On an
/// arc nothing else may move.
pub(super) fn is_nearly_linear(shape: &Shape, per_measure: f64, settings: &BlendSettings) -> bool {
    let (linear, least_share) = match shape {
        Shape::Line(line) => {
            let linear = linear_measure(line);
            let alone = linear == 1.0 && !settings.turns_tool();
            (linear, if alone { NEARLY } else { 1.0 - ROUNDING })
        }
        Shape::Arc(_) => (1.0, 1.0 - ROUNDING),
    };
    per_measure * least_share < linear
}

/// How far X, Y, Z and U, V, W go together on a line while X, Y and Z go one unit.
fn linear_measure(line: &Line9) -> f64 {
    let [.., u, v, w]: [f64; 9] = (*line.direction()).into();
    let parallel = u * u + v * v + w * w;
    if parallel > 0.0 {
        (1.0 + parallel).sqrt()
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::super::metric::Metric;
    use super::*;
    use crate::axes::Axes;

    /// Whether a line of 10 mm along X, and so far along another axis, is one.
    fn is_one(axis: usize, way: f64, settings: &BlendSettings) -> bool {
        let mut end = Axes::zeros();
        (end[0], end[axis]) = (10.0, way);
        let shape = Shape::Line(Line9::new(&Axes::zeros(), &end).expect("a line"));
        let per_measure = Metric::new(0.1).per_measure(&shape);
        is_nearly_linear(&shape, per_measure, settings)
    }

    #[test]
    fn a_rotary_axis_may_turn_a_little_unless_it_turns_the_tool() {
        let plain = BlendSettings::DEFAULT;
        for (axis, way, expected) in [
            (1, 50.0, true),
            (3, 70.0, true),
            (5, -70.0, true),
            (5, 80.0, false),
            (6, 0.01, true),
            (7, 50.0, true),
        ] {
            assert_eq!(is_one(axis, way, &plain), expected, "{axis} {way}");
        }
        let turning = plain.with_turning_tool();
        assert!(is_one(2, 3.0, &turning) && !is_one(4, 1.0, &turning));
    }
}
