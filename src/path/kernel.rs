//! The smooth kernels that round the corners of a path.
//!
//! A corner of the programmed path, a jump of its direction at one point, is spread over the
//! distance w on both sides: the second derivative there becomes a kernel K of width w instead of
//! an impulse. With `x` the distance from the corner over w, phi is the second integral of K that
//! vanishes with its derivatives at `x = 1`, less the corner itself:
//!
//! ```text
//! q(s) = p(s) + jump * w * phi(|s - s_corner| / w)
//! ```
//!
//! The shape of the kernel is a mix, one number from -1 up:
//!
//! - 0 is K2 = 15/16 (1 - x^2)^2, the biweight kernel: nowhere negative, so that a corner is cut on
//!   its inner side only.
//! - 1 is K4 = 105/64 (1 - x^2)^2 (1 - 3 x^2), the biweight kernel of fourth order: its second
//!   moment is zero, so that a curve made of short lines does not shrink (Gasser, Mueller,
//!   Mammitzsch: Kernels for nonparametric curve estimation, 1985). Up to [`GREATEST_PEAKED`] the
//!   mix of the two is nowhere negative: a corner's change of direction is gathered in its middle,
//!   where jerk is what limits its speed.
//! - -1 is K8 = 153/256 (1 - x^8)^2: nearly the same everywhere, as where acceleration alone limits
//!   the speed in a corner.
//!
//! Between these kernels the mix is linear.

use wide::f64x2;

use super::jump::Factors;
use crate::lanes::greater;

/// phi2 in the middle.
pub(super) const PEAK_SECOND_ORDER: f64 = 5.0 / 32.0;

/// phi4 in the middle.
const PEAK_FOURTH_ORDER: f64 = 0.068359375;

/// phi8 in the middle.
const PEAK_FLAT: f64 = 17.0 / 80.0;

/// K8 in the middle.
const FLAT: f64 = 153.0 / 256.0;

/// Coefficients of y^0 to y^4 in what follows.
const POWERS: usize = 5;

/// phi2 without its term `-x / 2`; the last one is 0.
const SECOND_ORDER: [f64; POWERS] = [PEAK_SECOND_ORDER, 0.46875, -0.15625, 0.03125, 0.0];

/// phi4 without the same term.
const FOURTH_ORDER: [f64; POWERS] = [
    PEAK_FOURTH_ORDER,
    0.8203125,
    -0.68359375,
    0.3828125,
    -0.087890625,
];

/// The greatest mix with a kernel that is nowhere negative.
pub(super) const GREATEST_PEAKED: f64 = 2.0 / 9.0;

/// The least value of K4, without its sign, rounded up.
const DIP_FOURTH_ORDER: f64 = 0.2161;

/// The greatest derivatives of K2 and of K8, without their signs, rounded up.
const STEEPEST_SECOND_ORDER: f64 = 1.4434;
const STEEPEST_FLAT: f64 = 2.6179;

/// phi in the middle for a mix up to [`GREATEST_PEAKED`]: its greatest value.
#[inline]
pub(super) fn peak(mix: f64) -> f64 {
    let (other, share) = if mix < 0.0 {
        (PEAK_FLAT, -mix)
    } else {
        (PEAK_FOURTH_ORDER, mix)
    };
    PEAK_SECOND_ORDER + share * (other - PEAK_SECOND_ORDER)
}

/// The greatest value of the kernel for a mix up to [`GREATEST_PEAKED`], in its middle.
#[inline]
pub(super) fn greatest(mix: f64) -> f64 {
    let (other, share) = if mix < 0.0 {
        (FLAT, -mix)
    } else {
        (1.640625, mix)
    };
    0.9375 + share * (other - 0.9375)
}

/// A bound of the kernel's derivative for a mix up to [`GREATEST_PEAKED`].
#[inline]
pub(super) fn steepest(mix: f64) -> f64 {
    if mix < 0.0 {
        STEEPEST_SECOND_ORDER - mix * (STEEPEST_FLAT - STEEPEST_SECOND_ORDER)
    } else {
        STEEPEST_SECOND_ORDER * (1.0 + 1.37 * mix)
    }
}

/// phi at `x`, 0 to 1, for a mix.
#[inline]
pub(super) fn value(x: f64, mix: f64) -> f64 {
    let y = x * x;
    let even = |[c0, c1, c2, c3, c4]: [f64; POWERS]| c0 + y * (c1 + y * (c2 + y * (c3 + y * c4)));
    let second_order = even(SECOND_ORDER);
    let (other, share) = if mix < 0.0 {
        let y4 = y * y * y * y;
        let flat = y * (1.0 / 2.0 - y4 * (1.0 / 45.0 - y4 / 306.0));
        (PEAK_FLAT + FLAT * flat, -mix)
    } else {
        (even(FOURTH_ORDER), mix)
    };
    second_order + share * (other - second_order) - 0.5 * x
}

/// phi at two places `x`, for two mixes that are not below 0.
#[inline(always)]
pub(super) fn values(x: f64x2, mix: f64x2) -> f64x2 {
    let y = x * x;
    let [c0, c1, c2, c3, _] = SECOND_ORDER;
    let second_order = c0 + y * (c1 + y * (c2 + y * c3));
    let [c0, c1, c2, c3, c4] = FOURTH_ORDER;
    let fourth_order = c0 + y * (c1 + y * (c2 + y * (c3 + y * c4)));
    second_order + mix * (fourth_order - second_order) - x * 0.5
}

/// Where a place is as seen from a jump.
#[derive(Clone, Copy, Debug)]
pub(super) enum Side {
    /// Before it.
    Left,
    /// At it or behind it.
    Right,
}

impl Side {
    /// Of a distance, to the right.
    #[inline(always)]
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
        }
    }
}

/// phi of a width and a mix from 0 up, prepared to be evaluated with its derivatives.
///
/// Without their term `-x / 2` phi2 and phi4 are polynomials of `y = x^2`, and so are their
/// derivatives, the odd ones times x.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kernel {
    inverse_width: f64,
    /// Coefficients of y^0 to y^4 for the value and the first derivative by distance. Side by
    /// side, since processors calculate in pairs.
    low: [f64x2; POWERS],
    /// Of y^0 to y^3 for the second and the third.
    high: [f64x2; POWERS - 1],
    /// What is left of the value for a unit of distance, and of the first derivative.
    corner: f64x2,
}

impl Kernel {
    /// One that is nowhere.
    pub const NONE: Self = Self {
        inverse_width: 0.0,
        low: [f64x2::ZERO; POWERS],
        high: [f64x2::ZERO; POWERS - 1],
        corner: f64x2::ZERO,
    };

    /// `width`: positive, or 0 for [`Self::NONE`]. `times`: what phi is multiplied by.
    pub fn new(width: f64, mix: f64, times: f64) -> Self {
        if width <= 0.0 {
            return Self::NONE;
        }
        let inverse = 1.0 / width;
        let mut phi = [0.0; POWERS];
        let orders = SECOND_ORDER.iter().zip(&FOURTH_ORDER);
        for (coefficient, (second, fourth)) in phi.iter_mut().zip(orders) {
            *coefficient = times * (second + mix * (fourth - second));
        }
        let [c0, c1, c2, c3, c4] = phi;
        let square = inverse * inverse;
        Self {
            inverse_width: inverse,
            low: [
                [c0 * width, 2.0 * c1],
                [c1 * width, 4.0 * c2],
                [c2 * width, 6.0 * c3],
                [c3 * width, 8.0 * c4],
                [c4 * width, 0.0],
            ]
            .map(f64x2::new),
            high: [
                [2.0 * c1 * inverse, 24.0 * c2 * square],
                [12.0 * c2 * inverse, 120.0 * c3 * square],
                [30.0 * c3 * inverse, 336.0 * c4 * square],
                [56.0 * c4 * inverse, 0.0],
            ]
            .map(f64x2::new),
            corner: f64x2::splat(-0.5 * times),
        }
    }

    /// What of a jump of dp/ds is to be added to the path at a `distance` from it, 0 to the width, on
    /// this `side`.
    #[inline(always)]
    pub fn factors(&self, distance: f64, side: Side) -> Factors {
        let x = side.sign() * distance * self.inverse_width;
        let y = f64x2::splat(x * x);
        let odd = f64x2::new([1.0, x]);
        Factors {
            low: polynomial(&self.low, y) * odd + self.corner * f64x2::new([distance, side.sign()]),
            high: polynomial(&self.high, y) * odd,
        }
    }
}

/// phi of a width and a mix with a share of K8. Corners with such a kernel stand alone.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlatKernel {
    width: f64,
    mix: f64,
    /// How many times the kernel is taken.
    times: f64,
}

impl FlatKernel {
    /// `width`: positive. `mix`: below 0. `times`: what phi is multiplied by.
    pub fn new(width: f64, mix: f64, times: f64) -> Self {
        Self { width, mix, times }
    }

    /// As [`Kernel::factors`], at a signed distance; -0 is to the left.
    #[inline(never)]
    pub fn factors(&self, distance: f64) -> Factors {
        let inverse = 1.0 / self.width;
        let x = distance.abs() * inverse;
        let y = x * x;
        let rest = 1.0 - y;
        let y4 = y * y * y * y;
        let flat_rest = 1.0 - y4;
        let side = 1.0f64.copysign(distance);
        let mixed = |second_order: f64, flat: f64| second_order - self.mix * (flat - second_order);
        let first = mixed(
            -0.5 + x * (0.9375 + y * (-0.625 + y * 0.1875)),
            -0.5 + FLAT * x * (1.0 - y4 * (2.0 / 9.0 - y4 / 17.0)),
        );
        let second = mixed(0.9375 * rest * rest, FLAT * flat_rest * flat_rest);
        let third = mixed(-3.75 * x * rest, -16.0 * FLAT * y * y * y * x * flat_rest);
        Factors {
            low: f64x2::new([value(x, self.mix) / inverse, side * first]) * self.times,
            high: f64x2::new([second * inverse, side * third * inverse * inverse]) * self.times,
        }
    }
}

/// Two polynomials of y, by the coefficients of its powers.
#[inline(always)]
fn polynomial<const N: usize>(powers: &[f64x2; N], y: f64x2) -> f64x2 {
    let mut sum = f64x2::ZERO;
    for (from_highest, coefficients) in powers.iter().rev().enumerate() {
        sum = if from_highest == 0 {
            *coefficients
        } else {
            sum * y + *coefficients
        };
    }
    sum
}

/// A bound of |K| at all places from `x`, 0 to 1, outwards: it never grows with x.
#[inline]
pub(super) fn majorant(x: f64, mix: f64) -> f64 {
    let y = x * x;
    let rest = (1.0 - y) * (1.0 - y);
    let second_order = 0.9375 * rest;
    if mix < 0.0 {
        let flat = 1.0 - y * y * y * y;
        return (1.0 + mix) * second_order - mix * FLAT * flat * flat;
    }
    let fourth_order = greater(DIP_FOURTH_ORDER, 1.640625 * rest * (1.0 - 3.0 * y));
    (1.0 - mix).abs() * second_order + mix * fourth_order
}

/// The same at two places for two mixes that are not below 0.
#[inline(always)]
pub(super) fn majorants(x: f64x2, mix: f64x2) -> f64x2 {
    let y = x * x;
    let rest = (1.0 - y) * (1.0 - y);
    let second_order = rest * 0.9375;
    let fourth_order = (rest * 1.640625 * (1.0 - y * 3.0)).fast_max(f64x2::splat(DIP_FOURTH_ORDER));
    (1.0 - mix).abs() * second_order + mix * fourth_order
}

#[cfg(test)]
mod tests {
    use super::*;

    /// phi with its derivatives by x.
    #[derive(Debug)]
    struct KernelDerivatives {
        value: f64,
        first: f64,
        second: f64,
        third: f64,
    }

    /// Of either kind.
    fn factors(width: f64, mix: f64, distance: f64, side: Side) -> Factors {
        if mix < 0.0 {
            FlatKernel::new(width, mix, 1.0).factors(side.sign() * distance)
        } else {
            Kernel::new(width, mix, 1.0).factors(distance, side)
        }
    }

    fn derivatives(x: f64, mix: f64) -> KernelDerivatives {
        let Factors { low, high } = factors(1.0, mix, x, Side::Right);
        let ([value, first], [second, third]) = (low.to_array(), high.to_array());
        KernelDerivatives {
            value,
            first,
            second,
            third,
        }
    }

    const MIXES: [f64; 7] = [-1.0, -0.6, 0.0, GREATEST_PEAKED, 0.4, 1.0, 1.15];

    #[test]
    fn derivatives_are_those_of_the_value() {
        let step = 1e-4;
        for mix in MIXES {
            for k in 1..99 {
                let x = 0.01 * f64::from(k);
                let (before, here, after) = (
                    derivatives(x - step, mix),
                    derivatives(x, mix),
                    derivatives(x + step, mix),
                );
                let slope = |a: f64, b: f64| (b - a) / (2.0 * step);
                assert!((slope(before.value, after.value) - here.first).abs() < 1e-6);
                assert!((slope(before.first, after.first) - here.second).abs() < 1e-6);
                assert!((slope(before.second, after.second) - here.third).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn everything_fades_out_at_the_edge() {
        for mix in MIXES {
            let edge = derivatives(1.0, mix);
            for value in [edge.value, edge.first, edge.second, edge.third] {
                assert!(value.abs() < 1e-13, "{mix}: {edge:?}");
            }
        }
    }

    #[test]
    fn half_a_corner_lies_on_either_side_and_the_third_derivative_is_continuous() {
        for mix in MIXES {
            let middle = derivatives(0.0, mix);
            assert_eq!(middle.first, -0.5);
            assert_eq!(middle.third, 0.0);
            let integral: f64 = (0..10_000)
                .map(|k| derivatives((f64::from(k) + 0.5) * 1e-4, mix).second * 1e-4)
                .sum();
            assert!((integral - 0.5).abs() < 1e-7);
        }
    }

    #[test]
    fn the_kernel_of_fourth_order_has_no_second_moment() {
        let moment = |mix| -> f64 {
            (0..10_000)
                .map(|k| (f64::from(k) + 0.5) * 1e-4)
                .map(|x| x * x * derivatives(x, mix).second * 1e-4)
                .sum()
        };
        assert!(moment(1.0).abs() < 1e-7);
        assert!((moment(0.0) - 1.0 / 14.0).abs() < 1e-7);
    }

    #[test]
    fn the_peak_is_in_the_middle() {
        for mix in MIXES {
            for k in 0..=1000 {
                let here = value(0.001 * f64::from(k), mix).abs();
                assert!(here <= peak(mix).max(PEAK_FOURTH_ORDER) + 1e-15, "{mix}");
            }
            if mix <= GREATEST_PEAKED {
                assert!((value(0.0, mix) - peak(mix)).abs() < 1e-15, "{mix}");
            }
        }
    }

    #[test]
    fn corners_are_cut_on_the_inside_and_their_kernels_bounded() {
        for mix in [-1.0, -0.3, 0.0, 0.1, GREATEST_PEAKED] {
            for k in 0..=1000 {
                let here = derivatives(0.001 * f64::from(k), mix);
                assert!(
                    here.value >= -1e-15 && here.second >= -1e-12,
                    "{mix} {here:?}"
                );
                assert!(here.second <= greatest(mix) + 1e-12, "{mix}");
                assert!(here.third.abs() <= steepest(mix), "{mix} {here:?}");
            }
        }
    }

    #[test]
    fn width_and_side_scale_the_derivatives() {
        let width = 0.25;
        for mix in MIXES {
            for k in 0..100 {
                let x = 0.01 * f64::from(k);
                let unit = derivatives(x, mix);
                assert!((unit.value - value(x, mix)).abs() < 1e-15);
                let even = [unit.value * width, unit.second / width];
                let odd = [unit.first, unit.third / (width * width)];
                let [right, left] = [Side::Right, Side::Left].map(|side| {
                    let Factors { low, high } = factors(width, mix, x * width, side);
                    [low, high].map(f64x2::to_array)
                });
                for i in 0..2 {
                    for (is, expected) in [
                        (right[i][0], even[i]),
                        (left[i][0], even[i]),
                        (right[i][1], odd[i]),
                        (left[i][1], -odd[i]),
                    ] {
                        assert!((is - expected).abs() < 1e-12, "{mix} {x}: {is} {expected}");
                    }
                }
            }
        }
    }

    #[test]
    fn two_at_a_time_are_as_one_by_one() {
        for mix in [[0.0, 0.1], [GREATEST_PEAKED, 1.0], [1.15, 0.4]] {
            for k in 0..=100 {
                let x = [0.01 * f64::from(k), 1.0 - 0.01 * f64::from(k)];
                let (places, mixes) = (f64x2::new(x), f64x2::new(mix));
                let one_by_one = |of: fn(f64, f64) -> f64| [0, 1].map(|i| of(x[i], mix[i]));
                assert_eq!(values(places, mixes).to_array(), one_by_one(value));
                assert_eq!(majorants(places, mixes).to_array(), one_by_one(majorant));
            }
        }
    }

    #[test]
    fn majorants_bound_the_kernel_and_never_grow() {
        for mix in MIXES {
            let mut outer = 0.0f64;
            for k in (0..=1000).rev() {
                let x = 0.001 * f64::from(k);
                outer = outer.max(derivatives(x, mix).second.abs());
                assert!(majorant(x, mix) >= outer - 1e-13, "{mix} {x}");
            }
        }
    }
}
