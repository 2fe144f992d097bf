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
//! Two kernels are mixed, `phi = (1 - rho) phi2 + rho phi4`:
//!
//! - K2 = 15/16 (1 - x^2)^2, the biweight kernel: nowhere negative, so that a corner is cut on its
//!   inner side only.
//! - K4 = 105/64 (1 - x^2)^2 (1 - 3 x^2), the biweight kernel of fourth order: its second moment is
//!   zero, so that a curve made of short lines does not shrink (Gasser, Mueller, Mammitzsch:
//!   Kernels for nonparametric curve estimation, 1985).

/// phi2 and phi4 at their middle, where they are greatest.
pub(super) const PEAK_SECOND_ORDER: f64 = 5.0 / 32.0;

/// The least value of K4, without its sign, rounded up.
const DIP_FOURTH_ORDER: f64 = 0.2161;

/// A function of x with three derivatives by x.
#[derive(Clone, Copy, Debug)]
pub(super) struct Derivatives {
    pub value: f64,
    pub first: f64,
    pub second: f64,
    pub third: f64,
}

/// phi at `x`, 0 to 1, for a mix `rho`.
#[inline]
pub(super) fn value(x: f64, rho: f64) -> f64 {
    let y = x * x;
    let second_order = 0.15625 - 0.5 * x + y * (0.46875 + y * (-0.15625 + y * 0.03125));
    let fourth_order = 0.068359375 - 0.5 * x
        + y * (0.8203125 + y * (-0.68359375 + y * (0.3828125 - y * 0.087890625)));
    second_order + rho * (fourth_order - second_order)
}

/// phi at `x`, 0 to 1, for a mix `rho`, with its derivatives. The second is the kernel itself.
#[inline]
pub(super) fn derivatives(x: f64, rho: f64) -> Derivatives {
    let y = x * x;
    let rest = 1.0 - y;
    let mix =
        |second_order: f64, fourth_order: f64| second_order + rho * (fourth_order - second_order);
    Derivatives {
        value: value(x, rho),
        first: mix(
            -0.5 + x * (0.9375 + y * (-0.625 + y * 0.1875)),
            -0.5 + x * (1.640625 + y * (-2.734375 + y * (2.296875 - y * 0.703125))),
        ),
        second: mix(
            0.9375 * rest * rest,
            1.640625 * rest * rest * (1.0 - 3.0 * y),
        ),
        third: mix(-3.75 * x * rest, -16.40625 * x * rest * (1.0 - 1.8 * y)),
    }
}

/// A bound of |K| at all places from `x`, 0 to 1, outwards: it never grows with x.
#[inline]
pub(super) fn majorant(x: f64, rho: f64) -> f64 {
    let y = x * x;
    let rest = (1.0 - y) * (1.0 - y);
    let second_order = 0.9375 * rest;
    let fourth_order = (1.640625 * rest * (1.0 - 3.0 * y)).max(DIP_FOURTH_ORDER);
    (1.0 - rho).abs() * second_order + rho.abs() * fourth_order
}

#[cfg(test)]
mod tests {
    use super::*;

    const MIXES: [f64; 4] = [0.0, 0.4, 1.0, 1.15];

    #[test]
    fn derivatives_are_those_of_the_value() {
        let step = 1e-4;
        for rho in MIXES {
            for k in 1..100 {
                let x = 0.01 * f64::from(k);
                let (before, here, after) = (
                    derivatives(x - step, rho),
                    derivatives(x, rho),
                    derivatives(x + step, rho),
                );
                let slope = |a: f64, b: f64| (b - a) / (2.0 * step);
                assert!((slope(before.value, after.value) - here.first).abs() < 1e-6);
                assert!((slope(before.first, after.first) - here.second).abs() < 1e-6);
                assert!((slope(before.second, after.second) - here.third).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn everything_fades_out_at_the_edge() {
        for rho in MIXES {
            let edge = derivatives(1.0, rho);
            for value in [edge.value, edge.first, edge.second, edge.third] {
                assert!(value.abs() < 1e-15, "{rho}: {edge:?}");
            }
        }
    }

    #[test]
    fn half_a_corner_lies_on_either_side_and_the_third_derivative_is_continuous() {
        for rho in MIXES {
            let middle = derivatives(0.0, rho);
            assert_eq!(middle.first, -0.5);
            assert_eq!(middle.third, 0.0);
            let integral: f64 = (0..10_000)
                .map(|k| derivatives((f64::from(k) + 0.5) * 1e-4, rho).second * 1e-4)
                .sum();
            assert!((integral - 0.5).abs() < 1e-7);
        }
    }

    #[test]
    fn the_kernel_of_fourth_order_has_no_second_moment() {
        let moment = |rho| -> f64 {
            (0..10_000)
                .map(|k| (f64::from(k) + 0.5) * 1e-4)
                .map(|x| x * x * derivatives(x, rho).second * 1e-4)
                .sum()
        };
        assert!(moment(1.0).abs() < 1e-7);
        assert!((moment(0.0) - 1.0 / 14.0).abs() < 1e-7);
    }

    #[test]
    fn the_peak_is_in_the_middle() {
        assert_eq!(value(0.0, 0.0), PEAK_SECOND_ORDER);
        for rho in MIXES {
            for k in 0..=1000 {
                assert!(value(0.001 * f64::from(k), rho).abs() <= PEAK_SECOND_ORDER);
            }
        }
    }

    #[test]
    fn majorants_bound_the_kernel_and_never_grow() {
        for rho in MIXES {
            let mut outer = 0.0f64;
            for k in (0..=1000).rev() {
                let x = 0.001 * f64::from(k);
                outer = outer.max(derivatives(x, rho).second.abs());
                assert!(majorant(x, rho) >= outer * (1.0 - 1e-12), "{rho} {x}");
            }
        }
    }
}
