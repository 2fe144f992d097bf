//! One frame operation: what one command of a part program adds to the frame.

use nalgebra::{Matrix3, Vector3};

use super::affine::{AffineMap, MAX_TRANSLATION};
use super::error::FrameError;
use super::plane::{LinearAxis, Plane};
use super::rotation::{RotsConvention, about_axis, roll_pitch_yaw, solid_angles};

/// What an operation does, its numbers already checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OperationKind {
    /// Shift, machine units, shape (3).
    Translate(Vector3<f64>),
    /// Proper rotation about the origin, shape (3, 3).
    Rotate(Matrix3<f64>),
    /// Factor of each axis, never zero, shape (3).
    Scale(Vector3<f64>),
    /// Which of X Y Z change sign.
    Mirror([bool; 3]),
}

/// A frame operation. Made only by constructors that check their numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Operation {
    kind: OperationKind,
}

impl Operation {
    /// TRANS, ATRANS: shift of the origin, machine units, shape (3).
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`], [`FrameError::TranslationTooLarge`].
    pub fn translate(shift: Vector3<f64>) -> Result<Self, FrameError> {
        check_translation(shift.iter())?;
        Ok(Self {
            kind: OperationKind::Translate(shift),
        })
    }

    /// Right-handed rotation about one axis, degrees.
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`].
    pub fn rotate(axis: LinearAxis, angle: f64) -> Result<Self, FrameError> {
        check_finite(&[angle])?;
        Ok(Self::rotation(about_axis(axis, angle)))
    }

    /// ROT RPL=, AROT RPL=: rotation in the working plane, degrees, about that plane's normal
    /// (positive about +Y in G18).
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`].
    pub fn rotate_in_plane(plane: Plane, angle: f64) -> Result<Self, FrameError> {
        Self::rotate(plane.normal(), angle)
    }

    /// ROT X Y Z, AROT: about Z, then the new Y, then the newest X. `angles` about X, Y and Z,
    /// degrees, shape (3); an angle that was not programmed is 0.
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`].
    pub fn rotate_zyx(angles: Vector3<f64>) -> Result<Self, FrameError> {
        check_finite(angles.as_slice())?;
        Ok(Self::rotation(roll_pitch_yaw(&angles)))
    }

    /// ROTS, AROTS: one or two angles, degrees, at which the tilted plane meets the old ones; see
    /// [`solid_angles`].
    ///
    /// # Errors
    ///
    /// Those of [`solid_angles`].
    pub fn rotate_solid_angles(
        x: Option<f64>,
        y: Option<f64>,
        z: Option<f64>,
        convention: RotsConvention,
    ) -> Result<Self, FrameError> {
        solid_angles(x, y, z, convention).map(Self::rotation)
    }

    /// SCALE, ASCALE: factor of each axis, shape (3); 1 for an axis that was not programmed. A
    /// negative factor mirrors its axis as well.
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`], [`FrameError::ZeroScale`].
    pub fn scale(factors: Vector3<f64>) -> Result<Self, FrameError> {
        check_scale(&factors)?;
        Ok(Self {
            kind: OperationKind::Scale(factors),
        })
    }

    /// MIRROR, AMIRROR: the axes of X Y Z that change sign about the present origin.
    pub fn mirror(axes: [bool; 3]) -> Self {
        Self {
            kind: OperationKind::Mirror(axes),
        }
    }

    fn rotation(matrix: Matrix3<f64>) -> Self {
        Self {
            kind: OperationKind::Rotate(matrix),
        }
    }

    /// What it does.
    pub fn kind(&self) -> &OperationKind {
        &self.kind
    }

    /// The operation alone, as a map.
    pub fn map(&self) -> AffineMap {
        match self.kind {
            OperationKind::Translate(shift) => AffineMap::from_translation(shift),
            OperationKind::Rotate(matrix) => AffineMap::from_linear(matrix),
            OperationKind::Scale(factors) => {
                AffineMap::from_linear(Matrix3::from_diagonal(&factors))
            }
            OperationKind::Mirror(axes) => {
                let [x, y, z] = axes.map(|mirrored| if mirrored { -1.0 } else { 1.0 });
                AffineMap::from_linear(Matrix3::from_diagonal(&Vector3::new(x, y, z)))
            }
        }
    }
}

fn check_finite(values: &[f64]) -> Result<(), FrameError> {
    if values.iter().all(|value| value.is_finite()) {
        Ok(())
    } else {
        Err(FrameError::NotFinite)
    }
}

/// Shifts of the axes X, Y, Z, A ... in that order.
pub(crate) fn check_translation<'a>(
    shifts: impl Iterator<Item = &'a f64>,
) -> Result<(), FrameError> {
    for (axis, &value) in shifts.enumerate() {
        if !value.is_finite() {
            return Err(FrameError::NotFinite);
        }
        if value.abs() > MAX_TRANSLATION {
            return Err(FrameError::TranslationTooLarge { axis, value });
        }
    }
    Ok(())
}

/// Factors of X, Y and Z.
pub(super) fn check_scale(factors: &Vector3<f64>) -> Result<(), FrameError> {
    for (axis, &factor) in factors.iter().enumerate() {
        if !factor.is_finite() {
            return Err(FrameError::NotFinite);
        }
        if factor == 0.0 {
            return Err(FrameError::ZeroScale { axis });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_numbers_are_refused() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let vector = Vector3::new(1.0, bad, 1.0);
            for outcome in [
                Operation::translate(vector),
                Operation::rotate_zyx(vector),
                Operation::scale(vector),
                Operation::rotate(LinearAxis::Y, bad),
                Operation::rotate_in_plane(Plane::Zx, bad),
                Operation::rotate_solid_angles(Some(bad), None, None, RotsConvention::Seed),
                Operation::rotate_solid_angles(Some(1.0), Some(bad), None, RotsConvention::K2),
            ] {
                assert_eq!(outcome, Err(FrameError::NotFinite));
            }
        }
        assert_eq!(
            Operation::scale(Vector3::new(2.0, 1.0, -0.0)),
            Err(FrameError::ZeroScale { axis: 2 })
        );
        assert_eq!(
            Operation::translate(Vector3::new(0.0, -2e6, 0.0)),
            Err(FrameError::TranslationTooLarge {
                axis: 1,
                value: -2e6
            })
        );
    }

    #[test]
    fn solid_angles_need_one_or_two_that_are_possible() {
        let rots = |x, y, z| Operation::rotate_solid_angles(x, y, z, RotsConvention::Seed);
        assert_eq!(rots(None, None, None), Err(FrameError::NoAngles));
        assert_eq!(
            rots(Some(1.0), Some(2.0), Some(3.0)),
            Err(FrameError::TooManyAngles)
        );
        assert_eq!(
            rots(Some(90.0), Some(20.0), None),
            Err(FrameError::ImpossibleSolidAngles {
                first: 90.0,
                second: 20.0
            })
        );
        // An upright plane alone is a plain rotation.
        assert_eq!(
            rots(Some(90.0), Some(0.0), None),
            Operation::rotate(LinearAxis::Y, 90.0)
        );
        assert_eq!(
            rots(Some(0.0), Some(90.0), None),
            Operation::rotate(LinearAxis::X, 90.0)
        );
    }
}
