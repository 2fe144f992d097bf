//! How much a turn of C turns the tool where A or B tilts it.
//!
//! Tool axes tilted by a and a', with C turned by c between them, are the chord
//!
//! ```text
//! 4 sin^2(angle / 2) = 4 sin^2((a - a') / 2) + 4 sin a sin a' sin^2(c / 2) <= (a - a')^2 + S^2 c^2
//! ```
//!
//! apart, S being the greatest |sin| of all tilts there. So a degree of C counts S of a degree, and next to the
//! pole, where the tool hardly tilts, C may leave the program by much more than the tool axis does.

use crate::axes::Axes;

/// C leaves the program by no more than this, however little it turns the tool; degrees.
pub const GREATEST_TURN: f64 = 45.0;

/// The axis that tilts the tool, with C turning it, and how far the tool may lean from the program.
#[derive(Clone, Copy, Debug)]
pub struct Orientation {
    /// 4 for B, otherwise A.
    pub tilt: usize,
    /// Degrees, positive.
    pub tolerance: f64,
}

impl Orientation {
    /// What a degree of C counts at most where the tilt runs from that of one position to that of the other, shapes (9), degrees,
    /// and leaves this by the tolerance: above 0, up to 1.
    pub fn share(&self, from: &Axes, to: &Axes) -> f64 {
        // written so that no index can be out of range: the modules cannot panic
        let tilt = |position: &Axes| match self.tilt {
            4 => position[4],
            _ => position[3],
        };
        let (one, other) = (tilt(from), tilt(to));
        let low = one.min(other) - self.tolerance;
        let high = one.max(other) + self.tolerance;
        let lies_flat = ((low - 90.0) / 180.0).ceil() <= ((high - 90.0) / 180.0).floor();
        let sine = |angle: f64| angle.to_radians().sin().abs();
        let greatest = if lies_flat {
            1.0
        } else {
            sine(low).max(sine(high))
        };
        greatest.max(self.tolerance / GREATEST_TURN).min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn axis(tilt: f64, turn: f64) -> nalgebra::Vector3<f64> {
        let (tilt, turn) = (tilt.to_radians(), turn.to_radians());
        nalgebra::Vector3::new(
            tilt.sin() * turn.sin(),
            -tilt.sin() * turn.cos(),
            tilt.cos(),
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn tools_lean_by_no_more_than_the_tolerance(
            ends in prop::array::uniform2(prop_oneof![-2.0..2.0f64, -180.0..180.0f64]),
            place in 0.0..=1.0f64,
            tolerance in 0.01..5.0f64,
            direction in 0.0..core::f64::consts::TAU,
        ) {
            let orientation = Orientation { tilt: 3, tolerance };
            let mut positions = [Axes::zeros(); 2];
            for (position, end) in positions.iter_mut().zip(ends) {
                position[3] = end;
            }
            let share = orientation.share(&positions[0], &positions[1]);
            let tilt = ends[0] + place * (ends[1] - ends[0]);
            let (lean, turn) = (tolerance * direction.cos(), tolerance * direction.sin() / share);
            prop_assert!(turn.abs() <= GREATEST_TURN + 1e-9);
            let chord = (axis(tilt + lean, turn) - axis(tilt, 0.0)).norm();
            let angle = 2.0 * (0.5 * chord).asin().to_degrees();
            prop_assert!(angle <= 1.005 * tolerance, "{angle}");
        }
    }

    #[test]
    fn next_to_the_pole_c_is_nearly_free_and_far_from_it_a_degree_is_a_degree() {
        let orientation = Orientation {
            tilt: 4,
            tolerance: 0.05,
        };
        let at = |angle: f64| {
            let mut position = Axes::zeros();
            position[4] = angle;
            orientation.share(&position, &position)
        };
        assert!((at(1.0) - 1.05f64.to_radians().sin()).abs() < 1e-12);
        assert_eq!(at(0.0), 0.05 / GREATEST_TURN);
        assert_eq!(at(90.0), 1.0);
        assert_eq!(at(-270.0), 1.0);
    }
}
