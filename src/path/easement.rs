//! The easement where the curvature jumps, as between a line and an arc.
//!
//! The jump of the second derivative is spread over the distance w on both sides. With `x` the
//! distance from the jump over w,
//!
//! ```text
//! q(s) = p(s) + jump * w^2 * sign(s - s_jump) * f(x),    f = (1 - x)^4 (0.0808 x + 0.0732 x^2)
//! ```
//!
//! f'' is -1/2 at the jump, which fills it from both sides; value and odd derivatives are
//! continuous there, and all vanish at the edge. So the second derivative of q is continuous and
//! the third bounded. The coefficients make the greatest |f| small: little deviation for the width.
//!
//! On one side of the jump the path is led to the outer side of the curve. Near a soft limit it is led to the inner side
//! all along, by an even function that is nowhere less than |f|, times the sum of both curvatures:
//!
//! ```text
//! (p1'' + p2'') * w^2 * b(x),    b = 0.017 (1 - x^2)^4
//! ```
//!
//! Where the direction jumps too, its kernel is the biweight one and as wide as the easement: that leads an arc beyond its
//! own extreme place by less than this leads it back, and a corner whose arc curves to the outer side back by more.

use wide::f64x2;

use super::jump::Factors;
use super::kernel::Side;

/// The greatest value of |f|, rounded up.
pub(super) const PEAK: f64 = 0.0079;

/// The greatest value of |f''|, at the jump.
pub(super) const GREATEST_SECOND: f64 = 0.5;

/// The greatest value of b + |f|, rounded up.
pub(super) const INNER_PEAK: f64 = 0.0228;

/// The greatest value of |b''| + |f''|.
pub(super) const INNER_GREATEST_SECOND: f64 = 0.64;

/// A function of x with three derivatives by x.
#[derive(Clone, Copy, Debug)]
struct EasementDerivatives {
    pub value: f64,
    pub first: f64,
    pub second: f64,
    pub third: f64,
}

const LINEAR: f64 = 0.0808;
const SQUARE: f64 = 0.0732;
const INNER: f64 = 0.017;

/// f at `x`, 0 to 1.
#[inline]
pub(super) fn value(x: f64) -> f64 {
    let rest = (1.0 - x) * (1.0 - x);
    rest * rest * x * (LINEAR + SQUARE * x)
}

/// f at `x`, 0 to 1, with its derivatives.
#[inline]
fn derivatives(x: f64) -> EasementDerivatives {
    let rest = 1.0 - x;
    let rest2 = rest * rest;
    let rest3 = rest2 * rest;
    let rest4 = rest2 * rest2;
    let factor = x * (LINEAR + SQUARE * x);
    let slope = LINEAR + 2.0 * SQUARE * x;
    let bend = 2.0 * SQUARE;
    EasementDerivatives {
        value: rest4 * factor,
        first: rest4 * slope - 4.0 * rest3 * factor,
        second: rest4 * bend - 8.0 * rest3 * slope + 12.0 * rest2 * factor,
        third: -12.0 * rest3 * bend + 36.0 * rest2 * slope - 24.0 * rest * factor,
    }
}

/// b at `x`, 0 to 1.
#[inline]
pub(super) fn inner_value(x: f64) -> f64 {
    let rest = (1.0 - x * x) * (1.0 - x * x);
    INNER * rest * rest
}

/// b at `x`, 0 to 1, with its derivatives.
#[inline]
fn inner_derivatives(x: f64) -> EasementDerivatives {
    let square = x * x;
    let rest = 1.0 - square;
    let rest2 = rest * rest;
    EasementDerivatives {
        value: INNER * rest2 * rest2,
        first: -8.0 * INNER * x * rest2 * rest,
        second: 8.0 * INNER * rest2 * (7.0 * square - 1.0),
        third: 48.0 * INNER * x * rest * (3.0 - 7.0 * square),
    }
}

/// What of a jump of the curvature is to be added to the path at a `distance` from it, 0 to the `width`, on this `side`.
// Not where it is called: few vertices have an easement.
#[inline(never)]
pub(super) fn factors(width: f64, distance: f64, side: Side) -> Factors {
    let side = side.sign();
    let f = derivatives(distance / width);
    Factors {
        low: f64x2::new([side * width * width * f.value, width * f.first]),
        high: f64x2::new([side * f.second, f.third / width]),
    }
}

/// The same of both curvatures added up, for what leads to the inner side.
// As above.
#[inline(never)]
pub(super) fn inner_factors(width: f64, distance: f64, side: Side) -> Factors {
    let side = side.sign();
    let b = inner_derivatives(distance / width);
    Factors {
        low: f64x2::new([width * width * b.value, side * width * b.first]),
        high: f64x2::new([b.second, side * b.third / width]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inner_side_is_never_left() {
        for k in 0..=10_000 {
            let x = 1e-4 * f64::from(k);
            let (here, inner) = (value(x), inner_value(x));
            assert!(inner >= here, "{x}");
            assert!(inner + here <= INNER_PEAK, "{x}");
            let second = derivatives(x).second.abs() + inner_derivatives(x).second.abs();
            assert!(second <= INNER_GREATEST_SECOND + 1e-15, "{x}");
        }
    }

    #[test]
    fn derivatives_of_the_inner_side_are_those_of_its_value() {
        let step = 1e-4;
        for k in 1..100 {
            let x = 0.01 * f64::from(k);
            let at = inner_derivatives;
            let (before, here, after) = (at(x - step), at(x), at(x + step));
            let slope = |a: f64, b: f64| (b - a) / (2.0 * step);
            assert!((inner_value(x) - here.value).abs() < 1e-17);
            assert!((slope(before.value, after.value) - here.first).abs() < 1e-7);
            assert!((slope(before.first, after.first) - here.second).abs() < 1e-7);
            assert!((slope(before.second, after.second) - here.third).abs() < 1e-6);
        }
        let edge = inner_derivatives(1.0);
        for value in [edge.value, edge.first, edge.second, edge.third] {
            assert_eq!(value, 0.0);
        }
    }

    #[test]
    fn derivatives_are_those_of_the_value() {
        let step = 1e-4;
        for k in 1..100 {
            let x = 0.01 * f64::from(k);
            let (before, here, after) =
                (derivatives(x - step), derivatives(x), derivatives(x + step));
            let slope = |a: f64, b: f64| (b - a) / (2.0 * step);
            assert!((value(x) - here.value).abs() < 1e-15);
            assert!((slope(before.value, after.value) - here.first).abs() < 1e-6);
            assert!((slope(before.first, after.first) - here.second).abs() < 1e-6);
            assert!((slope(before.second, after.second) - here.third).abs() < 1e-6);
        }
    }

    #[test]
    fn fills_the_jump_and_fades_out_at_the_edge() {
        let middle = derivatives(0.0);
        assert_eq!(middle.value, 0.0);
        assert!((middle.second + 0.5).abs() < 1e-15);
        let edge = derivatives(1.0);
        for value in [edge.value, edge.first, edge.second, edge.third] {
            assert_eq!(value, 0.0);
        }
    }

    #[test]
    fn bounds_hold_everywhere() {
        for k in 0..=10_000 {
            let here = derivatives(1e-4 * f64::from(k));
            assert!(here.value.abs() <= PEAK);
            assert!(here.second.abs() <= GREATEST_SECOND + 1e-15);
        }
    }
}
