//! The linear axes, the working planes G17 to G19, and their orientation.

use nalgebra::{Matrix3, Vector3};

use super::matrix::columns;

/// One of the three linear axes that a frame turns and stretches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearAxis {
    /// X.
    X,
    /// Y.
    Y,
    /// Z.
    Z,
}

/// Working plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// G17: X and Y, normal Z.
    Xy,
    /// G18: Z and X, normal Y.
    Zx,
    /// G19: Y and Z, normal X.
    Yz,
}

/// Whether a map keeps the orientation of space (or of a plane).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Handedness {
    /// Kept.
    Right,
    /// Turned round: clockwise arcs become counter-clockwise, left of the path becomes right of it.
    Left,
}

impl Handedness {
    /// The orientation that belongs to a determinant; `None` if it is zero or not a number.
    pub fn of_determinant(determinant: f64) -> Option<Self> {
        if determinant > 0.0 {
            Some(Self::Right)
        } else if determinant < 0.0 {
            Some(Self::Left)
        } else {
            None
        }
    }
}

/// Parts of a vector or a matrix relative to a plane: its first axis, its second, its normal.
/// The order is cyclic, so that first x second = normal.
pub(super) struct InPlane<T> {
    pub first: T,
    pub second: T,
    pub normal: T,
}

impl Plane {
    /// The axis perpendicular to the plane, about which `ROT RPL=` turns.
    pub fn normal(self) -> LinearAxis {
        match self {
            Self::Xy => LinearAxis::Z,
            Self::Zx => LinearAxis::Y,
            Self::Yz => LinearAxis::X,
        }
    }

    fn arrange<T>(self, x: T, y: T, z: T) -> InPlane<T> {
        let (first, second, normal) = match self {
            Self::Xy => (x, y, z),
            Self::Zx => (z, x, y),
            Self::Yz => (y, z, x),
        };
        InPlane {
            first,
            second,
            normal,
        }
    }

    /// The components of a vector.
    pub(super) fn components(self, vector: &Vector3<f64>) -> InPlane<f64> {
        self.arrange(vector.x, vector.y, vector.z)
    }

    /// The columns of a matrix: where the plane's axes and its normal go.
    pub(super) fn images(self, matrix: &Matrix3<f64>) -> InPlane<Vector3<f64>> {
        let [x, y, z] = columns(matrix);
        self.arrange(x, y, z)
    }
}
