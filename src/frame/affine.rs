//! Affine maps of space: what an ordered list of frame operations amounts to.

use nalgebra::{Matrix3, Vector3};

use super::error::FrameError;
use super::matrix::{determinant, greatest_element};
use super::plane::{Handedness, LinearAxis, Plane};
use super::rotation::about_axis;
use super::singular_values::condition_number;

/// Greatest shift of a frame, work offset or tool, machine units (or degrees for A B C).
///
/// Doubles resolve 1e-10 there, so an inverse stays exact to 1e-9; a kilometre of shift is a slip.
pub const MAX_TRANSLATION: f64 = 1e6;

/// Above this condition number a map counts as singular: nothing of an inverse would be true.
const SINGULAR_CONDITION: f64 = 1e12;

/// How exactly lengths and angles must agree for circles to count as circles, relative.
const SIMILARITY_TOLERANCE: f64 = 1e-9;

/// `p -> linear * p + translation`, all numbers finite when it was made by [`AffineMap::new`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineMap {
    linear: Matrix3<f64>,
    translation: Vector3<f64>,
}

impl AffineMap {
    /// The map that changes nothing.
    pub fn identity() -> Self {
        Self::from_linear(Matrix3::identity())
    }

    /// A map from its parts; `translation` in machine units.
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`].
    pub fn new(linear: Matrix3<f64>, translation: Vector3<f64>) -> Result<Self, FrameError> {
        let map = Self {
            linear,
            translation,
        };
        if map.is_finite() {
            Ok(map)
        } else {
            Err(FrameError::NotFinite)
        }
    }

    /// A map from three rows of four numbers, the last of each the translation.
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`].
    pub fn from_rows(rows: &[[f64; 4]; 3]) -> Result<Self, FrameError> {
        let [[a, b, c, x], [d, e, f, y], [g, h, i, z]] = *rows;
        Self::new(
            Matrix3::new(a, b, c, d, e, f, g, h, i),
            Vector3::new(x, y, z),
        )
    }

    /// Three rows of four numbers, the last of each the translation.
    pub fn to_rows(&self) -> [[f64; 4]; 3] {
        let (m, t) = (&self.linear, &self.translation);
        [
            [m.m11, m.m12, m.m13, t.x],
            [m.m21, m.m22, m.m23, t.y],
            [m.m31, m.m32, m.m33, t.z],
        ]
    }

    pub(super) fn from_linear(linear: Matrix3<f64>) -> Self {
        Self {
            linear,
            translation: Vector3::zeros(),
        }
    }

    pub(super) fn from_translation(translation: Vector3<f64>) -> Self {
        Self {
            linear: Matrix3::identity(),
            translation,
        }
    }

    /// Rotation about Z by `degrees`, then a shift, without a check of the numbers.
    pub(super) fn turned_and_shifted(degrees: f64, translation: Vector3<f64>) -> Self {
        Self {
            linear: about_axis(LinearAxis::Z, degrees),
            translation,
        }
    }

    /// The linear part.
    pub fn linear(&self) -> &Matrix3<f64> {
        &self.linear
    }

    /// The image of the origin.
    pub fn translation(&self) -> &Vector3<f64> {
        &self.translation
    }

    /// Whether all twelve numbers are finite.
    pub fn is_finite(&self) -> bool {
        let mut numbers = self.linear.iter().chain(&self.translation);
        numbers.all(|value| value.is_finite())
    }

    /// `p -> self(inner(p))`: `inner` acts first, in the coordinates that `self` made.
    ///
    /// Products of very large maps can overflow; [`ProgrammableFrame`](super::ProgrammableFrame)
    /// refuses the outcome.
    pub fn compose(&self, inner: &Self) -> Self {
        Self {
            linear: self.linear * inner.linear,
            translation: self.apply(&inner.translation),
        }
    }

    /// Image of a point.
    #[inline]
    pub fn apply(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.linear * point + self.translation
    }

    /// Image of a displacement, which a shift does not change.
    pub fn apply_to_vector(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        self.linear * vector
    }

    /// The map that undoes this one.
    ///
    /// By the adjugate of the matrix, scaled so that nothing overflows on the way.
    ///
    /// # Errors
    ///
    /// [`FrameError::Singular`] above a condition number of 1e12, [`FrameError::NotFinite`] if the
    /// inverse overflows.
    pub fn inverse(&self) -> Result<Self, FrameError> {
        let scale = greatest_element(&self.linear);
        if scale == 0.0 || condition_number(&self.linear) > SINGULAR_CONDITION {
            return Err(FrameError::Singular);
        }
        let m = self.linear / scale;
        let adjugate = Matrix3::new(
            m.m22 * m.m33 - m.m23 * m.m32,
            m.m13 * m.m32 - m.m12 * m.m33,
            m.m12 * m.m23 - m.m13 * m.m22,
            m.m23 * m.m31 - m.m21 * m.m33,
            m.m11 * m.m33 - m.m13 * m.m31,
            m.m13 * m.m21 - m.m11 * m.m23,
            m.m21 * m.m32 - m.m22 * m.m31,
            m.m12 * m.m31 - m.m11 * m.m32,
            m.m11 * m.m22 - m.m12 * m.m21,
        );
        let linear = adjugate / determinant(&m) / scale;
        Self::new(linear, -(linear * self.translation))
    }

    /// By how much volumes grow; negative if right-handed coordinates become left-handed.
    pub fn determinant(&self) -> f64 {
        determinant(&self.linear)
    }

    /// Greatest over smallest scale in any direction, at least 1; infinite for a singular map.
    pub fn condition_number(&self) -> f64 {
        condition_number(&self.linear)
    }

    /// Whether directions of turning in a plane are kept, by the sign of the map's part within the
    /// plane: `Left` means that G2 and G3, G41 and G42 change places. `None` if the plane is turned
    /// on edge (its part within the plane has no area).
    pub fn handedness_in_plane(&self, plane: Plane) -> Option<Handedness> {
        let images = plane.images(&self.linear);
        let first = plane.components(&images.first);
        let second = plane.components(&images.second);
        let area = first.first * second.second - first.second * second.first;
        // A plane on edge leaves rounding errors, not an exact zero.
        let full = images.first.norm() * images.second.norm();
        if area.abs() <= SIMILARITY_TOLERANCE * full {
            return None;
        }
        Handedness::of_determinant(area)
    }

    /// The common scale of a plane, if circles in it stay circles (maybe in a tilted plane); `None`
    /// if they become ellipses. Lengths and right angles are compared to 1e-9.
    pub fn is_similarity_of_plane(&self, plane: Plane) -> Option<f64> {
        let images = plane.images(&self.linear);
        let (first, second) = (images.first.norm(), images.second.norm());
        let scale = first.max(second);
        let tolerance = SIMILARITY_TOLERANCE * scale;
        let equal = (first - second).abs() <= tolerance;
        let perpendicular = images.first.dot(&images.second).abs() <= tolerance * scale;
        (scale > 0.0 && equal && perpendicular).then_some(scale)
    }

    /// Whether a plane stays parallel to itself and its normal perpendicular to it, to 1e-9: only
    /// then are G17 to G19 arcs and helices still arcs and helices of that plane.
    pub fn keeps_plane(&self, plane: Plane) -> bool {
        let images = plane.images(&self.linear);
        let first = plane.components(&images.first);
        let second = plane.components(&images.second);
        let normal = plane.components(&images.normal);
        let tolerance = SIMILARITY_TOLERANCE * greatest_element(&self.linear);
        [first.normal, second.normal, normal.first, normal.second]
            .iter()
            .all(|part| part.abs() <= tolerance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::rotation::roll_pitch_yaw;

    fn scaled(x: f64, y: f64, z: f64) -> AffineMap {
        AffineMap::from_linear(Matrix3::from_diagonal(&Vector3::new(x, y, z)))
    }

    #[test]
    fn rows_go_in_and_out() {
        let rows = [
            [1.0, 2.0, 3.0, 4.0],
            [5.0, 6.0, 7.0, 8.0],
            [9.0, 1.5, 2.5, 3.5],
        ];
        let map = AffineMap::from_rows(&rows).unwrap();
        assert_eq!(map.to_rows(), rows);
        let image = map.apply(&Vector3::new(1.0, 0.0, 0.0));
        assert_eq!(image, Vector3::new(5.0, 13.0, 12.5));
        let vector = map.apply_to_vector(&Vector3::new(0.0, 1.0, 0.0));
        assert_eq!(vector, Vector3::new(2.0, 6.0, 1.5));
    }

    #[test]
    fn numbers_that_are_none_are_refused() {
        let mut rows = AffineMap::identity().to_rows();
        rows[1][3] = f64::NAN;
        assert_eq!(AffineMap::from_rows(&rows), Err(FrameError::NotFinite));
        rows[1][3] = 0.0;
        rows[2][0] = f64::INFINITY;
        assert_eq!(AffineMap::from_rows(&rows), Err(FrameError::NotFinite));
    }

    #[test]
    fn singular_maps_have_no_inverse() {
        assert_eq!(scaled(1.0, 0.0, 1.0).inverse(), Err(FrameError::Singular));
        assert_eq!(scaled(0.0, 0.0, 0.0).inverse(), Err(FrameError::Singular));
        assert_eq!(scaled(1.0, 1e-13, 1.0).inverse(), Err(FrameError::Singular));
        assert!(scaled(1e-200, 1e-200, 1e-200).inverse().is_ok());
        assert_eq!(
            scaled(1e-320, 1e-320, 1e-320).inverse(),
            Err(FrameError::NotFinite)
        );
    }

    #[test]
    fn handedness_of_planes() {
        let mirrored = scaled(-1.0, 1.0, 1.0);
        assert_eq!(
            mirrored.handedness_in_plane(Plane::Xy),
            Some(Handedness::Left)
        );
        assert_eq!(
            mirrored.handedness_in_plane(Plane::Zx),
            Some(Handedness::Left)
        );
        assert_eq!(
            mirrored.handedness_in_plane(Plane::Yz),
            Some(Handedness::Right)
        );
        let twice = scaled(-2.0, -1.0, 1.0);
        assert_eq!(twice.determinant(), 2.0);
        assert_eq!(
            twice.handedness_in_plane(Plane::Xy),
            Some(Handedness::Right)
        );
        assert_eq!(twice.handedness_in_plane(Plane::Zx), Some(Handedness::Left));
        let upright = AffineMap::from_linear(roll_pitch_yaw(&Vector3::new(90.0, 0.0, 30.0)));
        assert_eq!(upright.handedness_in_plane(Plane::Xy), None);
    }

    #[test]
    fn circles_that_stay_circles() {
        let flat = scaled(-2.0, 2.0, 3.0);
        assert_eq!(flat.is_similarity_of_plane(Plane::Xy), Some(2.0));
        assert_eq!(flat.is_similarity_of_plane(Plane::Zx), None);
        assert!(flat.keeps_plane(Plane::Xy) && flat.keeps_plane(Plane::Yz));
        let tilted = AffineMap::from_linear(roll_pitch_yaw(&Vector3::new(30.0, 20.0, 10.0)));
        let scale = tilted.is_similarity_of_plane(Plane::Xy).unwrap();
        assert!((scale - 1.0).abs() < 1e-15);
        assert!(!tilted.keeps_plane(Plane::Xy));
        let sheared = AffineMap::from_rows(&[
            [1.0, 1e-6, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ]);
        assert_eq!(sheared.unwrap().is_similarity_of_plane(Plane::Xy), None);
        assert_eq!(
            scaled(0.0, 0.0, 1.0).is_similarity_of_plane(Plane::Xy),
            None
        );
    }
}
