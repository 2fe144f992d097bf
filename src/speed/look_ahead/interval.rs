//! One interval of the speed spline, and the motion over it in closed form.

use crate::lanes::greater;

/// b = v^2 over an interval: `b + 2 a x + u x^2`, x from 0 to `length`.
///
/// Since d(v^2)/ds = 2 dv/dt, the acceleration along the path is `a + u x`, and the jerk is `u v`.
#[derive(Clone, Copy, Debug)]
pub struct Parabola {
    /// v^2 at the start.
    pub b: f64,
    /// Acceleration at the start.
    pub a: f64,
    /// Change of acceleration with s, per second squared.
    pub u: f64,
    /// Greater than 0.
    pub length: f64,
}

/// Below this |y| the series of the duration is exact to rounding (next term y^8/17).
const SERIES_RANGE: f64 = 0.03;

/// The greatest |u| h^2 over b0 + b1. Beyond it b comes so near to 0 between the ends that three
/// points do not describe the interval, and the closed forms lose their digits.
pub(super) const GREATEST_BEND: f64 = 0.5;

impl Parabola {
    /// From the lengths of three intervals and their coefficients, the middle one being meant.
    #[inline]
    pub fn of_coefficients(lengths: [f64; 3], coefficients: [f64; 3]) -> Self {
        let [before, here, after] = lengths;
        let [c_before, c_here, c_after] = coefficients;
        let left = before + here;
        let right = here + after;
        let a = (c_here - c_before) / left;
        let a_end = (c_after - c_here) / right;
        Self {
            b: (here * c_before + before * c_here) / left,
            a,
            u: (a_end - a) / here,
            length: here,
        }
    }

    /// v^2 and acceleration at `x`.
    #[inline]
    pub fn at(&self, x: f64) -> (f64, f64) {
        (
            self.b + x * (2.0 * self.a + self.u * x),
            self.a + self.u * x,
        )
    }

    /// Whether the interval is too near to rest to be described by b over s.
    #[inline]
    pub fn is_degenerate(&self) -> bool {
        let (end, _) = self.at(self.length);
        let bend = self.u.abs() * self.length * self.length;
        // Not a comparison the other way round: what is not a number is degenerate too.
        let sound = self.b > 0.0 && end > 0.0 && bend <= GREATEST_BEND * (self.b + end);
        !sound
    }

    /// Seconds over the interval, which must not be degenerate.
    ///
    /// The integral of ds / sqrt(b), as `2 h / (v0 + v1) artanh(r) / r` with
    /// `r^2 = y = u h^2 / (v0 + v1)^2`, arctan where y < 0.
    pub fn duration(&self) -> f64 {
        let (end, _) = self.at(self.length);
        let sum = greater(0.0, self.b).sqrt() + greater(0.0, end).sqrt();
        let y = self.u * self.length * self.length / (sum * sum);
        let factor = if y.abs() < SERIES_RANGE {
            let tail = 1.0 / 9.0 + y * (1.0 / 11.0 + y * (1.0 / 13.0 + y / 15.0));
            1.0 + y * (1.0 / 3.0 + y * (1.0 / 5.0 + y * (1.0 / 7.0 + y * tail)))
        } else if y > 0.0 {
            let root = y.sqrt();
            root.atanh() / root
        } else {
            let root = (-y).sqrt();
            root.atan() / root
        };
        2.0 * self.length / sum * factor
    }

    /// Distance, velocity and acceleration at `t` seconds from the start.
    ///
    /// v'' = u v, so v is a hyperbolic or trigonometric function of sqrt|u| t; the power series in
    /// `z = u t^2` serves both. |z| stays below 3 in an interval that is not degenerate.
    pub fn state(&self, t: f64) -> (f64, f64, f64) {
        let v = greater(0.0, self.b).sqrt();
        let z = self.u * t * t;
        // cosh(r), sinh(r) / r and (cosh(r) - 1) / r^2 with r^2 = z.
        let cosine = series(z, 0.0);
        let sine = series(z, 1.0);
        let versine = 0.5 * series(z, 2.0);
        let distance = t * (v * sine + self.a * t * versine);
        let velocity = v * cosine + self.a * t * sine;
        let acceleration = self.a * cosine + self.u * t * v * sine;
        (distance, velocity, acceleration)
    }
}

/// `1 + z / ((m+1)(m+2)) (1 + z / ((m+3)(m+4)) (1 + ..))`, nine terms: m! times the power series
/// of cosh, sinh and their integrals for m = 0, 1, 2.
#[inline]
fn series(z: f64, m: f64) -> f64 {
    let mut sum = 1.0;
    for term in [9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0] {
        let even = m + 2.0 * term;
        sum = 1.0 + z / ((even - 1.0) * even) * sum;
    }
    sum
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// The state at the end of the duration is the one at the end of the interval.
        #[test]
        fn duration_and_state_agree(
            b in (-6.0..6.0f64).prop_map(f64::exp),
            (slope, bend) in (-0.9..3.0f64, -0.6..0.6f64),
            length in (-6.0..3.0f64).prop_map(f64::exp),
        ) {
            let parabola = Parabola {
                b,
                a: slope * b / (2.0 * length),
                u: bend * b / (length * length),
                length,
            };
            prop_assume!(!parabola.is_degenerate());
            let duration = parabola.duration();
            let (distance, velocity, acceleration) = parabola.state(duration);
            let (end, a_end) = parabola.at(length);
            prop_assert!((distance - length).abs() <= 1e-9 * length);
            prop_assert!((velocity - end.sqrt()).abs() <= 1e-9 * b.max(end).sqrt());
            let scale = parabola.a.abs().max(a_end.abs()).max(b / length);
            prop_assert!((acceleration - a_end).abs() <= 1e-8 * scale);
        }
    }

    #[test]
    fn what_is_not_a_number_is_degenerate() {
        let sound = Parabola {
            b: 1.0,
            a: 0.0,
            u: 0.0,
            length: 1.0,
        };
        assert!(!sound.is_degenerate());
        assert!(
            Parabola {
                b: f64::NAN,
                ..sound
            }
            .is_degenerate()
        );
        assert!(
            Parabola {
                u: f64::NAN,
                ..sound
            }
            .is_degenerate()
        );
        assert!(Parabola { u: 3.0, ..sound }.is_degenerate());
        assert!(Parabola { b: -1.0, ..sound }.is_degenerate());
    }
}
