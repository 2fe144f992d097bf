//! The distance by which a blended path is measured.
//!
//! ```text
//! ds^2 = dx^2 + dy^2 + dz^2 + du^2 + dv^2 + dw^2 + weight^2 (da^2 + db^2 + dc^2)
//! ```
//!
//! with the weight in machine units per degree. Unlike the distance that F counts (see
//! [`measure`](crate::moves::shape::measure)) it is the same for all moves, so that directions on both
//! sides of a corner can be compared. Both are in proportion on every single move: a leg of the
//! path keeps their quotient.
//!
//! The tolerance P of G64 is a distance of this kind too, but X, Y, Z and U, V, W keep it each by themselves: these are the two
//! ends of a wire, each with its own path, and both keep P at the same time. Rotary axes may deviate by P over the weight, in
//! degrees, and count at both ends.

use super::linear_axes::greater;
use crate::axes::Axes;
use crate::moves::shape::Shape;

/// The distance in nine axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Metric {
    /// Machine units per degree, squared.
    rotary: f64,
}

impl Metric {
    /// `weight`: machine units per degree, positive.
    pub const fn new(weight: f64) -> Self {
        Self {
            rotary: weight * weight,
        }
    }

    /// The scalar product of two displacements, shapes (9).
    #[inline]
    pub fn product(&self, one: &Axes, other: &Axes) -> f64 {
        let [x, y, z, a, b, c, u, v, w]: [f64; 9] = (*one).into();
        let [x1, y1, z1, a1, b1, c1, u1, v1, w1]: [f64; 9] = (*other).into();
        x * x1
            + y * y1
            + z * z1
            + u * u1
            + v * v1
            + w * w1
            + self.rotary * (a * a1 + b * b1 + c * c1)
    }

    /// The length of a displacement, shape (9).
    #[inline]
    pub fn norm(&self, displacement: &Axes) -> f64 {
        self.product(displacement, displacement).sqrt()
    }

    /// What a displacement, shape (9), counts of a tolerance: its length at X Y Z or at U V W, whichever is greater. A degree of C
    /// counts a `share` of a degree, 0 to 1.
    #[inline]
    pub fn deviation(&self, displacement: &Axes, share: f64) -> f64 {
        let [x, y, z, a, b, c, u, v, w]: [f64; 9] = (*displacement).into();
        let c = share * c;
        let greater = greater(x * x + y * y + z * z, u * u + v * v + w * w);
        (greater + self.rotary * (a * a + b * b + c * c)).sqrt()
    }

    /// How far a shape goes in this distance while F counts one unit. For a spiral the greatest
    /// value, which holds where its radius is greatest.
    pub fn per_measure(&self, shape: &Shape) -> f64 {
        match shape {
            Shape::Line(line) => self.norm(line.direction()),
            Shape::Arc(arc) => {
                let mut first = arc.point(0.0).first;
                for rate in first.iter_mut().take(3) {
                    *rate = 0.0;
                }
                (1.0 + self.product(&first, &first)).sqrt()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::moves::shape::{Arc9, Circle, Line9};

    #[test]
    fn degrees_count_by_their_weight() {
        let metric = Metric::new(0.1);
        let displacement = Axes::from([1.0, 2.0, 2.0, 30.0, 0.0, 40.0, 2.0, 4.0, 4.0]);
        assert!((metric.norm(&displacement) - 70f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn each_end_keeps_the_tolerance_by_itself() {
        let metric = Metric::new(0.1);
        let of = |numbers: [f64; 9]| metric.deviation(&Axes::from(numbers), 0.5);
        let ends = of([1.0, 2.0, 2.0, 0.0, 0.0, 0.0, 2.0, 4.0, 4.0]);
        assert!((ends - 6.0).abs() < 1e-12, "{ends}");
        let turned = of([3.0, 0.0, 0.0, 0.0, 40.0, 0.0, 0.0, 0.0, 1.0]);
        assert!((turned - 5.0).abs() < 1e-12, "{turned}");
        for axis in 0..9 {
            let mut numbers = [1.0; 9];
            numbers[axis] = f64::NAN;
            assert!(of(numbers).is_nan(), "{axis}");
        }
        assert!((of([0.0, 0.0, 0.0, 0.0, 0.0, 40.0, 0.0, 0.0, 0.0]) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn the_quotient_to_the_measure_of_the_feed() {
        let metric = Metric::new(0.1);
        let mut end = Axes::zeros();
        end[3] = 30.0;
        let turn = Line9::new(&Axes::zeros(), &end).expect("a line");
        assert!((metric.per_measure(&Shape::Line(turn)) - 0.1).abs() < 1e-15);
        end[0] = 3.0;
        let both = Line9::new(&Axes::zeros(), &end).expect("a line");
        assert!((metric.per_measure(&Shape::Line(both)) - 2f64.sqrt()).abs() < 1e-15);

        let circle = Circle {
            center: Vector3::new(-1.0, 0.0, 0.0),
            normal: Vector3::z(),
            revolutions: 0,
        };
        let mut end = Axes::zeros();
        end[4] = 10.0 * core::f64::consts::TAU;
        let arc = Arc9::new(&Axes::zeros(), &end, &circle).expect("an arc");
        assert!((metric.per_measure(&Shape::Arc(arc)) - 2f64.sqrt()).abs() < 1e-12);
    }
}
