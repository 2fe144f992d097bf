//! What a stretch of a path allows all along it, from places that are looked at.

use super::path_limits::PathLimits;
use crate::axes::{Axes, AxisLimits};
use crate::cube_root::cube_root;

/// What derivatives of the path may be greater by between the places.
const UNSEEN: f64 = 1.5;

/// The share of a limit that each of the terms takes that add up to it, three for the jerk.
const TERM_SHARE: f64 = 0.3;

/// Second and third derivatives that take less than this share of the limits, at full speed, are those of a line.
const STRAIGHT: f64 = 1e-6;

/// The greatest derivatives of a path by its distance, of all axes or joints.
#[derive(Clone, Copy, Debug)]
pub struct DerivativeBounds {
    first: Axes,
    second: Axes,
    third: Axes,
}

impl DerivativeBounds {
    /// Of no place at all.
    pub fn none() -> Self {
        let [first, second, third] = [Axes::zeros(); 3];
        Self {
            first,
            second,
            third,
        }
    }

    /// Looks at one more place, where the derivatives are these. Where one is not a number, since the machine has no joints
    /// for the place, nothing is possible: the greater of a number and of none would be the number.
    pub fn include(&mut self, [first, second, third]: &[Axes; 3]) {
        let size = |of: f64| if of.is_nan() { f64::INFINITY } else { of.abs() };
        self.first = self.first.sup(&first.map(size));
        self.second = self.second.sup(&second.map(size));
        self.third = self.third.sup(&third.map(size));
    }

    /// The greatest speed at which these velocities are kept, also between the places.
    pub fn velocity(&self, limit: &Axes) -> f64 {
        least(limit, &(self.first * UNSEEN))
    }

    /// What is possible all along the stretch below a velocity of `cap`, all of it at the same time.
    pub fn path_limits(&self, limits: &AxisLimits, cap: f64) -> PathLimits {
        let (second, third) = (self.second * UNSEEN, self.third * UNSEEN);
        let velocity = cap
            .min(self.velocity(&limits.velocity))
            .min((TERM_SHARE * least(&limits.acceleration, &second)).sqrt())
            .min(cube_root(TERM_SHARE * least(&limits.jerk, &third)));
        let coupling = Axes::from_fn(|axis, _| 3.0 * second[axis] * velocity);
        PathLimits {
            velocity,
            acceleration: (TERM_SHARE * least(&limits.acceleration, &self.first))
                .min(TERM_SHARE * least(&limits.jerk, &coupling)),
            jerk: TERM_SHARE * least(&limits.jerk, &self.first),
        }
    }

    /// The same where the stretch is most likely straight: then all of the limits, as of a line.
    pub fn path_limits_of_line(&self, limits: &AxisLimits, cap: f64) -> PathLimits {
        let straight = PathLimits {
            velocity: cap.min(least(&limits.velocity, &self.first)),
            acceleration: least(&limits.acceleration, &self.first),
            jerk: least(&limits.jerk, &self.first),
        };
        let v = straight.velocity;
        let bends = v * v > STRAIGHT * least(&limits.acceleration, &self.second)
            || v * v * v > STRAIGHT * least(&limits.jerk, &self.third);
        if bends {
            self.path_limits(limits, cap)
        } else {
            straight
        }
    }
}

/// The least of what each limit is of these amounts; infinite if all of these are 0.
fn least(limit: &Axes, by: &Axes) -> f64 {
    let quotients = limit.iter().zip(by.iter()).filter(|(_, by)| **by != 0.0);
    quotients.fold(f64::INFINITY, |least, (limit, by)| {
        least.min(limit / by.abs())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: AxisLimits = AxisLimits {
        velocity: Axes::from_array_storage(nalgebra::ArrayStorage([[100.0; 9]])),
        acceleration: Axes::from_array_storage(nalgebra::ArrayStorage([[1000.0; 9]])),
        jerk: Axes::from_array_storage(nalgebra::ArrayStorage([[20_000.0; 9]])),
    };

    #[test]
    fn a_line_has_all_of_the_limits_and_a_curve_a_share() {
        let mut bounds = DerivativeBounds::none();
        bounds.include(&[Axes::x() * 2.0, Axes::zeros(), Axes::zeros()]);
        bounds.include(&[Axes::x() * -1.0, Axes::zeros(), Axes::zeros()]);
        let line = bounds.path_limits_of_line(&LIMITS, f64::INFINITY);
        assert_eq!(
            [line.velocity, line.acceleration, line.jerk],
            [50.0, 500.0, 10_000.0]
        );
        assert_eq!(bounds.path_limits_of_line(&LIMITS, 7.0).velocity, 7.0);
        bounds.include(&[Axes::y(), Axes::y() * 0.1, Axes::zeros()]);
        let curve = bounds.path_limits_of_line(&LIMITS, f64::INFINITY);
        let v = curve.velocity;
        assert!(
            v > 30.0 && 0.1 * v * v + curve.acceleration < 1000.0,
            "{curve:?}"
        );
        assert!(3.0 * 0.1 * v * curve.acceleration + curve.jerk * 2.0 <= 20_000.0);
    }

    #[test]
    fn nothing_is_possible_where_there_are_no_joints() {
        let mut bounds = DerivativeBounds::none();
        bounds.include(&[Axes::x(), Axes::zeros(), Axes::zeros()]);
        bounds.include(&[Axes::repeat(f64::NAN); 3]);
        bounds.include(&[Axes::x(), Axes::zeros(), Axes::zeros()]);
        for limits in [
            bounds.path_limits(&LIMITS, 100.0),
            bounds.path_limits_of_line(&LIMITS, 100.0),
        ] {
            assert_eq!(
                [limits.velocity, limits.acceleration, limits.jerk],
                [0.0; 3]
            );
        }
    }
}
