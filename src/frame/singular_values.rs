//! Singular values of a 3x3 matrix: by how much it stretches, in its three principal directions.

use nalgebra::{Matrix3, Vector3};

use super::matrix::{columns, greatest_element};

/// One-sided Jacobi converges quadratically; three columns are orthogonal to the last bit after
/// four or five sweeps.
const SWEEPS: usize = 10;

/// Singular values in descending order, never negative, shape (3).
///
/// One-sided Jacobi rotations (Hestenes 1958), which keep the small values accurate relative to
/// themselves (Demmel and Veselic, "Jacobi's method is more accurate than QR", SIMAX 13(4), 1992).
/// Values below 1e-150 of the greatest may come out as zero. Expects finite elements.
pub fn singular_values(m: &Matrix3<f64>) -> Vector3<f64> {
    let scale = greatest_element(m);
    if scale == 0.0 {
        return Vector3::zeros();
    }
    let [mut a, mut b, mut c] = columns(m).map(|column| column / scale);
    for _ in 0..SWEEPS {
        orthogonalise(&mut a, &mut b);
        orthogonalise(&mut a, &mut c);
        orthogonalise(&mut b, &mut c);
    }
    let (a, b, c) = (a.norm(), b.norm(), c.norm());
    let greatest = a.max(b).max(c);
    let smallest = a.min(b).min(c);
    let middle = a.min(b).max(a.max(b).min(c));
    Vector3::new(greatest, middle, smallest) * scale
}

/// Greatest over smallest singular value, at least 1; infinite for a singular matrix.
pub fn condition_number(m: &Matrix3<f64>) -> f64 {
    let values = singular_values(m);
    if values.z > 0.0 {
        values.x / values.z
    } else {
        f64::INFINITY
    }
}

/// Rotates two columns in their own plane until they are perpendicular.
fn orthogonalise(a: &mut Vector3<f64>, b: &mut Vector3<f64>) {
    let (aa, bb, ab) = (a.dot(a), b.dot(b), a.dot(b));
    if ab.abs() <= f64::EPSILON * (aa * bb).sqrt() {
        return;
    }
    let zeta = (bb - aa) / (2.0 * ab);
    let tangent = 1.0_f64.copysign(zeta) / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    let sine = cosine * tangent;
    (*a, *b) = (*a * cosine - *b * sine, *a * sine + *b * cosine);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::rotation::roll_pitch_yaw;

    #[test]
    fn rotations_do_not_hide_the_scales() {
        let outer = roll_pitch_yaw(&Vector3::new(20.0, -35.0, 110.0));
        let inner = roll_pitch_yaw(&Vector3::new(-64.0, 12.0, 3.0));
        for scales in [
            [3.0, 2.0, 0.5],
            [1.0, 1.0, 1.0],
            [1000.0, 1.0, 1e-3],
            [2.0, 1e-9, 1e-9],
            [1e200, 1e199, 1e190],
        ] {
            let scales = Vector3::from(scales);
            let m = outer * (Matrix3::from_diagonal(&scales) * inner);
            let values = singular_values(&m);
            assert!((values.x / scales.x - 1.0).abs() < 1e-13, "{values}");
            // The product itself is only accurate relative to its greatest element.
            assert!((values.y - scales.y).abs() < 1e-15 * scales.x, "{values}");
            assert!((values.z - scales.z).abs() < 1e-15 * scales.x, "{values}");
        }
    }

    #[test]
    fn singular_matrices_have_no_bounded_condition() {
        assert_eq!(condition_number(&Matrix3::zeros()), f64::INFINITY);
        let flat = Matrix3::from_diagonal(&Vector3::new(1.0, 0.0, 1.0));
        assert_eq!(condition_number(&flat), f64::INFINITY);
        let dependent = Matrix3::new(1.0, 2.0, 3.0, 2.0, 4.0, 6.0, -1.0, 0.5, 2.0);
        assert!(condition_number(&dependent) > 1e12);
    }
}
