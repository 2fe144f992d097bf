//! What nalgebra does not have for 3x3 matrices, or has otherwise.

use nalgebra::{Matrix3, Vector3};

/// The three columns: the images of the unit vectors.
pub fn columns(m: &Matrix3<f64>) -> [Vector3<f64>; 3] {
    [
        Vector3::new(m.m11, m.m21, m.m31),
        Vector3::new(m.m12, m.m22, m.m32),
        Vector3::new(m.m13, m.m23, m.m33),
    ]
}

/// Greatest absolute value of the elements; NaN elements are passed over.
pub fn greatest_element(m: &Matrix3<f64>) -> f64 {
    m.iter()
        .fold(0.0, |greatest: f64, element| greatest.max(element.abs()))
}

/// Determinant, as the triple product of the columns. That of nalgebra goes along the first row and rounds
/// otherwise; frames are the same to the last bit from one version to the next.
pub fn determinant(m: &Matrix3<f64>) -> f64 {
    let [x, y, z] = columns(m);
    x.dot(&y.cross(&z))
}
