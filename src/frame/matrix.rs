//! 3x3 matrices written out by their elements.
//!
//! Named elements cannot be out of bounds, so none of this can panic, and it is as fast in a debug
//! build as it needs to be.

use nalgebra::{Matrix3, Vector3};

/// Matrix times vector.
#[inline]
pub fn transform(m: &Matrix3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(
        m.m11 * v.x + m.m12 * v.y + m.m13 * v.z,
        m.m21 * v.x + m.m22 * v.y + m.m23 * v.z,
        m.m31 * v.x + m.m32 * v.y + m.m33 * v.z,
    )
}

/// Matrix times matrix.
pub fn product(left: &Matrix3<f64>, right: &Matrix3<f64>) -> Matrix3<f64> {
    let [x, y, z] = columns(right);
    from_columns(
        &transform(left, &x),
        &transform(left, &y),
        &transform(left, &z),
    )
}

/// The three columns: the images of the unit vectors.
pub fn columns(m: &Matrix3<f64>) -> [Vector3<f64>; 3] {
    [
        Vector3::new(m.m11, m.m21, m.m31),
        Vector3::new(m.m12, m.m22, m.m32),
        Vector3::new(m.m13, m.m23, m.m33),
    ]
}

/// The matrix with these columns.
pub fn from_columns(x: &Vector3<f64>, y: &Vector3<f64>, z: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(
        x.x, y.x, z.x, //
        x.y, y.y, z.y, //
        x.z, y.z, z.z,
    )
}

/// Diagonal matrix.
pub fn diagonal(d: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(
        d.x, 0.0, 0.0, //
        0.0, d.y, 0.0, //
        0.0, 0.0, d.z,
    )
}

/// Scalar product.
#[inline]
pub fn dot(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// Vector product.
pub fn cross(a: &Vector3<f64>, b: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(
        a.y * b.z - a.z * b.y,
        a.z * b.x - a.x * b.z,
        a.x * b.y - a.y * b.x,
    )
}

/// Euclidean length.
pub fn length(v: &Vector3<f64>) -> f64 {
    dot(v, v).sqrt()
}

/// Greatest absolute value of the elements; NaN elements are passed over.
pub fn greatest_element(m: &Matrix3<f64>) -> f64 {
    m.iter()
        .fold(0.0, |greatest: f64, element| greatest.max(element.abs()))
}

/// Determinant.
pub fn determinant(m: &Matrix3<f64>) -> f64 {
    let [x, y, z] = columns(m);
    dot(&x, &cross(&y, &z))
}

/// Whether all elements are finite.
pub fn is_finite(m: &Matrix3<f64>) -> bool {
    m.iter().all(|element| element.is_finite())
}
