//! The distance that F counts.
//!
//! As in LinuxCNC: the distance in XYZ; if XYZ does not move, the distance in UVW; if that does
//! not move either, the angle in ABC (NIST RS274/NGC, feed rate; LinuxCNC manual, "Feed Rate").

use crate::axes::Axes;

/// What moves less than this does not move: a tenth of a nanometre on a machine in millimetres.
pub const LEAST_DISTANCE: f64 = 1e-7;

/// Which axes F counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// X Y Z, machine units.
    Linear,
    /// U V W, machine units.
    Secondary,
    /// A B C, degrees.
    Rotary,
}

/// The measure of a straight displacement, shape (9), and its length in it; `None` if nothing
/// moves.
pub fn of(displacement: &Axes) -> Option<(Measure, f64)> {
    let [x, y, z, a, b, c, u, v, w] = displacement.data.0[0];
    [
        (Measure::Linear, norm(x, y, z)),
        (Measure::Secondary, norm(u, v, w)),
        (Measure::Rotary, norm(a, b, c)),
    ]
    .into_iter()
    .find(|(_, length)| *length > LEAST_DISTANCE)
}

fn norm(x: f64, y: f64, z: f64) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_axes_count_first_then_secondary_then_rotary() {
        let mut displacement = Axes::zeros();
        assert_eq!(of(&displacement), None);
        displacement[5] = -90.0;
        assert_eq!(of(&displacement), Some((Measure::Rotary, 90.0)));
        displacement[8] = 2.0;
        assert_eq!(of(&displacement), Some((Measure::Secondary, 2.0)));
        displacement[0] = 3.0;
        displacement[1] = 4.0;
        assert_eq!(of(&displacement), Some((Measure::Linear, 5.0)));
    }
}
