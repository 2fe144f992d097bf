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

/// phi2 in the middle.
pub(super) const PEAK_SECOND_ORDER: f64 = 5.0 / 32.0;

/// phi4 in the middle.
const PEAK_FOURTH_ORDER: f64 = 0.068359375;

/// phi8 in the middle.
const PEAK_FLAT: f64 = 17.0 / 80.0;

/// K8 in the middle.
const FLAT: f64 = 153.0 / 256.0;

/// The greatest mix with a kernel that is nowhere negative.
pub(super) const GREATEST_PEAKED: f64 = 2.0 / 9.0;

/// The least value of K4, without its sign, rounded up.
const DIP_FOURTH_ORDER: f64 = 0.2161;

/// The greatest derivatives of K2 and of K8, without their signs, rounded up.
const STEEPEST_SECOND_ORDER: f64 = 1.4434;
const STEEPEST_FLAT: f64 = 2.6179;

/// A function of x with three derivatives by x.
#[derive(Clone, Copy, Debug)]
pub(super) struct Derivatives {
    pub value: f64,
    pub first: f64,
    pub second: f64,
    pub third: f64,
}

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
    let second_order = 0.15625 - 0.5 * x + y * (0.46875 + y * (-0.15625 + y * 0.03125));
    let (other, share) = if mix < 0.0 {
        let y4 = y * y * y * y;
        let flat = y * (1.0 / 2.0 - y4 * (1.0 / 45.0 - y4 / 306.0));
        (PEAK_FLAT - 0.5 * x + FLAT * flat, -mix)
    } else {
        let fourth_order = y * (0.8203125 + y * (-0.68359375 + y * (0.3828125 - y * 0.087890625)));
        (PEAK_FOURTH_ORDER - 0.5 * x + fourth_order, mix)
    };
    second_order + share * (other - second_order)
}

/// phi at `x`, 0 to 1, for a mix, with its derivatives. The second is the kernel itself.
#[inline]
pub(super) fn derivatives(x: f64, mix: f64) -> Derivatives {
    let y = x * x;
    let rest = 1.0 - y;
    let (first, second, third, share);
    if mix < 0.0 {
        let y4 = y * y * y * y;
        let rest = 1.0 - y4;
        first = -0.5 + FLAT * x * (1.0 - y4 * (2.0 / 9.0 - y4 / 17.0));
        second = FLAT * rest * rest;
        third = -16.0 * FLAT * y * y * y * x * rest;
        share = -mix;
    } else {
        first = -0.5 + x * (1.640625 + y * (-2.734375 + y * (2.296875 - y * 0.703125)));
        second = 1.640625 * rest * rest * (1.0 - 3.0 * y);
        third = -16.40625 * x * rest * (1.0 - 1.8 * y);
        share = mix;
    }
    let mixed = |second_order: f64, other: f64| second_order + share * (other - second_order);
    Derivatives {
        value: value(x, mix),
        first: mixed(-0.5 + x * (0.9375 + y * (-0.625 + y * 0.1875)), first),
        second: mixed(0.9375 * rest * rest, second),
        third: mixed(-3.75 * x * rest, third),
    }
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
    let fourth_order = (1.640625 * rest * (1.0 - 3.0 * y)).max(DIP_FOURTH_ORDER);
    (1.0 - mix).abs() * second_order + mix * fourth_order
}

#[cfg(test)]
mod tests {
    use super::*;

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
                assert!(value.abs() < 1e-15, "{mix}: {edge:?}");
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
    fn majorants_bound_the_kernel_and_never_grow() {
        for mix in MIXES {
            let mut outer = 0.0f64;
            for k in (0..=1000).rev() {
                let x = 0.001 * f64::from(k);
                outer = outer.max(derivatives(x, mix).second.abs());
                assert!(majorant(x, mix) >= outer * (1.0 - 1e-12), "{mix} {x}");
            }
        }
    }
}
