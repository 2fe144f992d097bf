//! The limit of jerk that comes with a move.
//!
//! LinuxCNC 2.10 reckons one along the path from the limits of its axes: on a line what the first of them allows, on an
//! arc the least of those that move. Where the limits of the planner's axes see to that by themselves nothing is added.
//! Otherwise all axes get a limit for this move, and the machine rests between moves that differ in it, since what axes
//! may do changes at rest only.

use crate::axes::Axes;
use crate::moves::shape::Shape;

/// By which share two limits may differ that are the same: they have been converted between units.
const ROUNDING: f64 = 1e-6;

/// What no axis may exceed so that a shape keeps a jerk of `along` its path, units per second cubed; infinite where `jerk`,
/// what the axes may do anyway, shape (9), sees to that.
pub(super) fn of_axes(shape: &Shape, along: f64, jerk: &Axes) -> f64 {
    let (by_axes, share) = match shape {
        Shape::Line(line) => {
            let direction = line.direction().abs();
            (jerk.component_div(&direction).min(), direction.max())
        }
        Shape::Arc(arc) => {
            let moving = jerk.iter().enumerate().filter(|(axis, _)| arc.moves(*axis));
            (
                moving.fold(f64::INFINITY, |least, (_, jerk)| least.min(*jerk)),
                1.0,
            )
        }
    };
    if by_axes <= along * (1.0 + ROUNDING) {
        f64::INFINITY
    } else {
        along * share
    }
}

/// Whether two of these are the same limit.
pub(super) fn is_same(one: f64, other: f64) -> bool {
    one == other || (one - other).abs() <= ROUNDING * one.min(other)
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::moves::shape::{Arc9, Circle, Line9};

    fn axes(x: f64, y: f64) -> Axes {
        Axes::from([x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    fn line(x: f64, y: f64) -> Shape {
        Shape::Line(Line9::new(&Axes::zeros(), &axes(x, y)).expect("a line"))
    }

    fn quarter() -> Shape {
        let circle = Circle {
            center: Vector3::zeros(),
            normal: Vector3::z(),
            revolutions: 0,
        };
        Shape::Arc(Arc9::new(&axes(5.0, 0.0), &axes(0.0, 5.0), &circle).expect("an arc"))
    }

    #[test]
    fn what_linuxcnc_reckons_from_the_same_limits_adds_nothing() {
        let jerk = Axes::from([1000.0, 500.0, 7.0, 7.0, 7.0, 7.0, 7.0, 7.0, 7.0]);
        for (shape, along) in [
            (line(3.0, 0.0), 1000.0),
            (line(0.0, -3.0), 500.0),
            (line(3.0, 4.0), 625.0),
            (quarter(), 500.0),
        ] {
            assert_eq!(of_axes(&shape, along, &jerk), f64::INFINITY);
            assert_eq!(of_axes(&shape, along / (1.0 + 5e-7), &jerk), f64::INFINITY);
            assert_eq!(of_axes(&shape, f64::INFINITY, &jerk), f64::INFINITY);
        }
    }

    #[test]
    fn a_lower_one_is_kept_along_a_line_and_by_each_axis_of_an_arc() {
        let jerk = Axes::repeat(1000.0);
        assert_eq!(of_axes(&line(3.0, 0.0), 100.0, &jerk), 100.0);
        // With 80 for both axes the second one allows 100 along the line.
        assert_eq!(of_axes(&line(3.0, 4.0), 100.0, &jerk), 80.0);
        assert_eq!(of_axes(&quarter(), 100.0, &jerk), 100.0);
        assert_eq!(
            of_axes(&quarter(), 100.0, &Axes::repeat(f64::INFINITY)),
            100.0
        );
    }

    #[test]
    fn rounding_makes_no_other_limit() {
        assert!(is_same(f64::INFINITY, f64::INFINITY) && is_same(100.0, 100.000_05));
        assert!(!is_same(100.0, f64::INFINITY) && !is_same(100.0, 100.001));
    }
}
