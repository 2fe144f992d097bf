//! Rotations as the commands of part programs state them.

use nalgebra::{Matrix3, Vector3};

use super::angle::sin_cos_degrees;
use super::error::FrameError;
use super::plane::LinearAxis;

/// Which of its two angles ROTS gives to which axis.
///
/// Both have the same two rotations (for X and Y: about Y, then about the new X, so that the new
/// X axis lies in the old ZX plane); they differ in which letter states which angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RotsConvention {
    /// `X a`: the tilted XY plane meets the XZ plane at the angle a to the X axis, so that `X a Y0`
    /// is a rotation about Y.
    #[default]
    Seed,
    /// `X a`: the tilted XY plane meets the YZ plane at the angle a to the Y axis, so that `X a Y0`
    /// is a rotation about X (Siemens, Function Manual K2 "Axes, coordinate systems, frames",
    /// solid angles).
    K2,
}

/// Rotation about one axis, right-handed, `angle` in degrees.
pub fn about_axis(axis: LinearAxis, angle: f64) -> Matrix3<f64> {
    let (s, c) = sin_cos_degrees(angle);
    match axis {
        LinearAxis::X => Matrix3::new(
            1.0, 0.0, 0.0, //
            0.0, c, -s, //
            0.0, s, c,
        ),
        LinearAxis::Y => Matrix3::new(
            c, 0.0, s, //
            0.0, 1.0, 0.0, //
            -s, 0.0, c,
        ),
        LinearAxis::Z => Matrix3::new(
            c, -s, 0.0, //
            s, c, 0.0, //
            0.0, 0.0, 1.0,
        ),
    }
}

/// Roll, pitch and yaw: about Z, then about the new Y, then about the newest X
/// (Rz Ry Rx). `angles`: about X, Y and Z, degrees, shape (3).
pub fn roll_pitch_yaw(angles: &Vector3<f64>) -> Matrix3<f64> {
    let yaw = about_axis(LinearAxis::Z, angles.z);
    let pitch = about_axis(LinearAxis::Y, angles.y);
    let roll = about_axis(LinearAxis::X, angles.x);
    yaw * (pitch * roll)
}

/// Rotation of ROTS: one angle is a plain rotation about that axis, two are the angles at which the
/// tilted plane meets two of the old planes. Angles in degrees.
///
/// # Errors
///
/// [`FrameError::NoAngles`], [`FrameError::TooManyAngles`], [`FrameError::NotFinite`], and
/// [`FrameError::ImpossibleSolidAngles`] when the first rotation sets the plane upright (90 degrees
/// or 270) so that the second angle cannot be formed.
pub fn solid_angles(
    x: Option<f64>,
    y: Option<f64>,
    z: Option<f64>,
    convention: RotsConvention,
) -> Result<Matrix3<f64>, FrameError> {
    use LinearAxis::{X, Y, Z};
    match (x, y, z) {
        (None, None, None) => Err(FrameError::NoAngles),
        (Some(_), Some(_), Some(_)) => Err(FrameError::TooManyAngles),
        (Some(angle), None, None) => single_angle(X, angle),
        (None, Some(angle), None) => single_angle(Y, angle),
        (None, None, Some(angle)) => single_angle(Z, angle),
        // The three pairs are one another's cyclic permutations.
        (Some(x), Some(y), None) => two_angles(Y, X, x, y, convention),
        (Some(x), None, Some(z)) => two_angles(X, Z, z, x, convention),
        (None, Some(y), Some(z)) => two_angles(Z, Y, y, z, convention),
    }
}

fn single_angle(axis: LinearAxis, angle: f64) -> Result<Matrix3<f64>, FrameError> {
    if angle.is_finite() {
        Ok(about_axis(axis, angle))
    } else {
        Err(FrameError::NotFinite)
    }
}

/// `leading` and `trailing`: the angles of the pair in the order of the plane's axes (X Y, Z X, Y Z).
fn two_angles(
    first_axis: LinearAxis,
    second_axis: LinearAxis,
    leading: f64,
    trailing: f64,
    convention: RotsConvention,
) -> Result<Matrix3<f64>, FrameError> {
    if !(leading.is_finite() && trailing.is_finite()) {
        return Err(FrameError::NotFinite);
    }
    let (first, formed) = match convention {
        RotsConvention::Seed => (leading, trailing),
        RotsConvention::K2 => (trailing, leading),
    };
    let second = second_rotation(first, formed)?;
    Ok(about_axis(first_axis, first) * about_axis(second_axis, second))
}

/// Angle of the second rotation, within -90 and 90 degrees, so that the plane meets the other old
/// plane at `formed`: atan(tan(formed) cos(first)).
fn second_rotation(first: f64, formed: f64) -> Result<f64, FrameError> {
    let (sin_formed, cos_formed) = sin_cos_degrees(formed);
    let (_, cos_first) = sin_cos_degrees(first);
    if cos_first == 0.0 && sin_formed != 0.0 {
        return Err(FrameError::ImpossibleSolidAngles {
            first,
            second: formed,
        });
    }
    // At 90 degrees the quotient is infinite and the arc tangent its limit, an upright plane.
    Ok((sin_formed * cos_first / cos_formed).atan().to_degrees())
}
