//! The programmable frame: a checked map and the rotation that a tool follows.

use nalgebra::{Matrix3, Vector3};

use super::affine::{AffineMap, MAX_TRANSLATION};
use super::error::FrameError;
use super::matrix::{columns, determinant};
use super::operation::check_translation;
use super::singular_values::singular_values;

/// Smallest and greatest scale of a frame in any direction. Micrometres to millimetres is 1e-3;
/// beyond that a factor is a slip.
pub const SCALE_RANGE: [f64; 2] = [1e-3, 1e3];

/// Greatest over smallest scale that a frame may have. Rounding errors grow with it: up to here
/// there and back is exact to 1e-9 within a metre.
pub const MAX_CONDITION: f64 = 100.0;

/// Rounding must not refuse a factor that stands exactly on a bound, nor take an upright plane for
/// one that is turned over.
const BOUND_TOLERANCE: f64 = 1e-9;

/// A frame F that can be used: finite, invertible, within [`SCALE_RANGE`] and [`MAX_CONDITION`].
///
/// Its *rotation* is where a tool points that follows the frame: the z axis of the rotation is the
/// normal of the frame's XY plane, its x axis the image of the frame's x axis, scale and mirrors
/// taken away. It is found from the map by orthogonalising its columns in the order x, y (Gram and
/// Schmidt) and turning those of mirrored axes back. For shifts, rotations, equal or final scales
/// and mirrors that is the product of the rotations, each seen through the mirrors before it; for a
/// rotation after unequal scales, which shears, it is the rotation that stays normal to the plane
/// being cut. The length of a tool is therefore turned, but never mirrored nor scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProgrammableFrame {
    map: AffineMap,
    rotation: Matrix3<f64>,
}

impl ProgrammableFrame {
    /// The frame that changes nothing.
    pub fn identity() -> Self {
        Self {
            map: AffineMap::identity(),
            rotation: Matrix3::identity(),
        }
    }

    /// A frame from its map and from which of its axes X Y Z are mirrored.
    ///
    /// The map alone does not tell: two mirrors look like a rotation by 180 degrees, but the length
    /// of a tool follows only the latter.
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`], [`FrameError::TranslationTooLarge`], [`FrameError::Singular`],
    /// [`FrameError::IllConditioned`], [`FrameError::ScaleOutOfRange`], and
    /// [`FrameError::MirrorMismatch`] if the number of mirrors does not fit the map.
    pub fn new(map: AffineMap, mirrored: [bool; 3]) -> Result<Self, FrameError> {
        check_map(&map)?;
        let odd = mirrored.iter().fold(false, |odd, &axis| odd ^ axis);
        if odd != (determinant(map.linear()) < 0.0) {
            return Err(FrameError::MirrorMismatch);
        }
        let [x, y, _] = orthogonalised(map.linear());
        let [mirrored_x, mirrored_y, _] = mirrored;
        let x = if mirrored_x { -x } else { x };
        let y = if mirrored_y { -y } else { y };
        Ok(Self {
            map,
            rotation: Matrix3::from_columns(&[x, y, x.cross(&y)]),
        })
    }

    /// A frame from a ready map, where it is not known which axes are mirrored.
    ///
    /// The z axis counts as mirrored if its image points down, so that the length of a tool never
    /// changes its side; if the map still needs a mirror, it is that of x or y which leaves less
    /// rotation. A frame that really turns the tool by more than 90 degrees is to be given to
    /// [`Self::new`], without mirrors.
    ///
    /// # Errors
    ///
    /// Those of [`Self::new`].
    pub fn from_map(map: AffineMap) -> Result<Self, FrameError> {
        check_map(&map)?;
        let left_handed = determinant(map.linear()) < 0.0;
        let [x, y, z] = orthogonalised(map.linear());
        let mirrored_z = z.z < -BOUND_TOLERANCE;
        let mirrored = if left_handed == mirrored_z {
            [false, false, mirrored_z]
        } else {
            [x.x <= y.y, x.x > y.y, mirrored_z]
        };
        Self::new(map, mirrored)
    }

    /// The map from program coordinates to those of the work offset.
    pub fn map(&self) -> &AffineMap {
        &self.map
    }

    /// The rotation that a tool follows, a proper one.
    pub fn rotation(&self) -> &Matrix3<f64> {
        &self.rotation
    }

    /// Whether the frame changes nothing at all.
    pub fn is_identity(&self) -> bool {
        *self == Self::identity()
    }
}

fn check_map(map: &AffineMap) -> Result<(), FrameError> {
    if !map.is_finite() {
        return Err(FrameError::NotFinite);
    }
    check_translation(map.translation().iter())?;
    let scales = singular_values(map.linear());
    let (greatest, smallest) = (scales.x, scales.z);
    let condition = greatest / smallest;
    // Zero by zero is not a number.
    if condition.is_nan() || condition > 1.0 / f64::EPSILON {
        return Err(FrameError::Singular);
    }
    if condition > MAX_CONDITION * (1.0 + BOUND_TOLERANCE) {
        return Err(FrameError::IllConditioned { condition });
    }
    let [least, most] = SCALE_RANGE;
    if smallest < least * (1.0 - BOUND_TOLERANCE) || greatest > most * (1.0 + BOUND_TOLERANCE) {
        return Err(FrameError::ScaleOutOfRange { smallest, greatest });
    }
    Ok(())
}

/// Unit columns, perpendicular to one another: x keeps its direction, y its side of x, z its side
/// of both. Expects a map that passed [`check_map`].
fn orthogonalised(linear: &Matrix3<f64>) -> [Vector3<f64>; 3] {
    let [x, y, z] = columns(linear);
    let x = x / x.norm();
    let y = y - x * x.dot(&y);
    let y = y / y.norm();
    // What rounding left of x would be up to the condition number times larger than it should.
    let y = y - x * x.dot(&y);
    let y = y / y.norm();
    let normal = x.cross(&y);
    let z = if normal.dot(&z) < 0.0 {
        -normal
    } else {
        normal
    };
    [x, y, z]
}

const _: () = assert!(MAX_TRANSLATION * f64::EPSILON < 1e-9);
