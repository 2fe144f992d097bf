//! A number that goes along a path, with its three derivatives by the same parameter.

use core::f64::consts::PI;
use core::ops::{Add, Mul, Sub};

use crate::frame::angle::sin_cos_degrees;

/// A value, and its first, second and third derivative. Sums and products are those of the values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jet(pub [f64; 4]);

impl Jet {
    /// Sine and cosine of an angle in degrees.
    #[inline]
    pub fn sin_cos(self) -> (Self, Self) {
        let Self([angle, first, second, third]) = self;
        let (s, c) = sin_cos_degrees(angle);
        let [first, second, third] = [first, second, third].map(|degrees| degrees * (PI / 180.0));
        let square = first * first;
        let sine = [
            s,
            c * first,
            c * second - s * square,
            c * (third - square * first) - 3.0 * s * first * second,
        ];
        let cosine = [
            c,
            -s * first,
            -s * second - c * square,
            -s * (third - square * first) - 3.0 * c * first * second,
        ];
        (Self(sine), Self(cosine))
    }
}

impl Add for Jet {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let Self([a, b, c, d]) = self;
        let Self([e, f, g, h]) = other;
        Self([a + e, b + f, c + g, d + h])
    }
}

impl Sub for Jet {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        let Self([a, b, c, d]) = self;
        let Self([e, f, g, h]) = other;
        Self([a - e, b - f, c - g, d - h])
    }
}

impl Sub<f64> for Jet {
    type Output = Self;

    #[inline]
    fn sub(self, number: f64) -> Self {
        let Self([value, first, second, third]) = self;
        Self([value - number, first, second, third])
    }
}

impl Mul for Jet {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let Self([a, a1, a2, a3]) = self;
        let Self([b, b1, b2, b3]) = other;
        Self([
            a * b,
            a1 * b + a * b1,
            a2 * b + 2.0 * a1 * b1 + a * b2,
            a3 * b + 3.0 * (a2 * b1 + a1 * b2) + a * b3,
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// t^2 and t^3 at t = 2.
    const SQUARE: Jet = Jet([4.0, 4.0, 2.0, 0.0]);
    const CUBE: Jet = Jet([8.0, 12.0, 12.0, 6.0]);

    #[test]
    fn sums_and_products_are_those_of_polynomials() {
        assert_eq!(SQUARE + CUBE, Jet([12.0, 16.0, 14.0, 6.0]));
        assert_eq!(CUBE - SQUARE - 1.0, Jet([3.0, 8.0, 10.0, 6.0]));
        // t^5: 5 t^4, 20 t^3, 60 t^2.
        assert_eq!(SQUARE * CUBE, Jet([32.0, 80.0, 160.0, 240.0]));
    }

    #[test]
    fn sine_and_cosine_of_what_is_no_line() {
        let (sine, cosine) = CUBE.sin_cos();
        let at = |t: f64| (t * t * t * PI / 180.0).sin_cos();
        let h = 1e-3;
        for (jet, of) in [(sine, 0), (cosine, 1)] {
            let pick = |t: f64| if of == 0 { at(t).0 } else { at(t).1 };
            let [m2, m1, zero, p1, p2] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| pick(2.0 + k * h));
            let differences = [
                zero,
                (p1 - m1) / (2.0 * h),
                (p1 - 2.0 * zero + m1) / (h * h),
                (p2 - 2.0 * p1 + 2.0 * m1 - m2) / (2.0 * h * h * h),
            ];
            for (exact, by_difference) in jet.0.iter().zip(differences) {
                assert!(
                    (exact - by_difference).abs() < 2e-5,
                    "{jet:?} {differences:?}"
                );
            }
        }
    }
}
