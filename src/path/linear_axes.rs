//! What X, Y, Z and U, V, W have of a quantity of nine axes.

use nalgebra::{SVector, Vector3};

use crate::axes::Axes;

/// One number for each of X Y Z U V W, machine units of length, shape (6).
pub(super) type LinearAxes = SVector<f64, 6>;

pub(super) const ORIGIN: LinearAxes =
    LinearAxes::from_array_storage(nalgebra::ArrayStorage([[0.0; 6]]));

/// Of all axes, shape (9).
#[inline]
pub(super) fn of(axes: &Axes) -> LinearAxes {
    let [x, y, z, _, _, _, u, v, w]: [f64; 9] = (*axes).into();
    LinearAxes::from([x, y, z, u, v, w])
}

/// The length of a displacement at X Y Z or at U V W, whichever is greater: [what it counts](super::metric) of a tolerance.
#[inline]
pub(super) fn greater_end(displacement: &LinearAxes) -> f64 {
    let [one, other] = ends(displacement);
    greater(one.norm_squared(), other.norm_squared()).sqrt()
}

/// The greater of two; none if either is no number.
#[inline]
pub(super) fn greater(one: f64, other: f64) -> f64 {
    if one.is_nan() || one > other {
        one
    } else {
        other
    }
}

/// The same over the length of both together, 1 of what moves but one of them.
pub(super) fn share_of_greater_end(displacement: &LinearAxes) -> f64 {
    let whole = displacement.norm();
    if whole > 0.0 {
        greater_end(displacement) / whole
    } else {
        1.0
    }
}

/// About which axes two directions turn from one to the other: the vector product in X Y Z, and that in U V W.
pub(super) fn cross(from: &LinearAxes, to: &LinearAxes) -> LinearAxes {
    let [from, to] = [from, to].map(ends);
    let [[x, y, z], [u, v, w]]: [[f64; 3]; 2] =
        core::array::from_fn(|end| from[end].cross(&to[end]).into());
    LinearAxes::from([x, y, z, u, v, w])
}

/// X Y Z, and U V W.
#[inline]
pub(super) fn ends(axes: &LinearAxes) -> [Vector3<f64>; 2] {
    let [x, y, z, u, v, w]: [f64; 6] = (*axes).into();
    [Vector3::new(x, y, z), Vector3::new(u, v, w)]
}

/// Adds them to what has nine axes.
#[inline]
pub(super) fn add(axes: &mut Axes, linear: &LinearAxes) {
    let [x, y, z, u, v, w]: [f64; 6] = (*linear).into();
    let nine = Axes::from([x, y, z, 0.0, 0.0, 0.0, u, v, w]);
    *axes += nine;
}
