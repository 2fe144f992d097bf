//! The work offset: G54 to G59.3 with its rotation, and G92 or G52.

use nalgebra::Vector3;

use super::affine::AffineMap;
use super::error::FrameError;
use super::operation::check_translation;
use crate::axes::Axes;

/// The work offset W, in LinuxCNC's order: world = T + G5x + Rz(r) (p + G92), with the tool offset
/// T left out, which is not part of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorkOffset {
    g5x: Axes,
    g92: Axes,
    rotation: f64,
}

impl WorkOffset {
    /// No offset.
    pub fn none() -> Self {
        Self {
            g5x: Axes::zeros(),
            g92: Axes::zeros(),
            rotation: 0.0,
        }
    }

    /// `g5x`: offset of the active system G54 to G59.3; `g92`: offset of G92 (or G52); both in
    /// machine units and degrees, shape (9). `rotation`: about Z, degrees (R of G10 L2).
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`], [`FrameError::TranslationTooLarge`].
    pub fn new(g5x: Axes, g92: Axes, rotation: f64) -> Result<Self, FrameError> {
        check_translation(g5x.iter())?;
        check_translation(g92.iter())?;
        if !rotation.is_finite() {
            return Err(FrameError::NotFinite);
        }
        Ok(Self { g5x, g92, rotation })
    }

    /// The map of X Y Z from coordinates of the work offset to the machine, tool left out.
    pub fn map(&self) -> AffineMap {
        let [g5x, g92] = [&self.g5x, &self.g92].map(linear_axes);
        let turn = AffineMap::turned_and_shifted(self.rotation, g5x);
        AffineMap::turned_and_shifted(self.rotation, turn.apply(&g92))
    }

    /// The inverse of [`Self::map`], which a rigid map always has.
    pub fn inverse_map(&self) -> AffineMap {
        let back = AffineMap::turned_and_shifted(-self.rotation, Vector3::zeros());
        let shift = -back.apply(self.map().translation());
        AffineMap::turned_and_shifted(-self.rotation, shift)
    }

    /// Where the zero of each axis lies on the machine: exact for A B C U V W, which nothing turns.
    pub fn origin(&self) -> Axes {
        let mut origin = self.g5x + self.g92;
        let turned = *self.map().translation();
        for (axis, value) in origin.iter_mut().zip(turned.iter()) {
            *axis = *value;
        }
        origin
    }
}

/// X Y Z of nine axes.
pub(super) fn linear_axes(axes: &Axes) -> Vector3<f64> {
    let [x, y, z, ..]: [f64; 9] = (*axes).into();
    Vector3::new(x, y, z)
}
