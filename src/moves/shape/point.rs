//! A point of a path, with derivatives.

use nalgebra::ArrayStorage;

use crate::axes::{AXIS_COUNT, Axes};

const ORIGIN: Axes = Axes::from_array_storage(ArrayStorage([[0.0; AXIS_COUNT]]));

/// A point of a shape.
#[derive(Clone, Copy, Debug)]
pub struct PathPoint {
    /// Machine units and degrees.
    pub position: Axes,
    /// dq/ds.
    pub first: Axes,
    /// d2q/ds2.
    pub second: Axes,
    /// d3q/ds3.
    pub third: Axes,
}

impl PathPoint {
    /// At the origin, without a direction.
    pub const ZERO: Self = Self {
        position: ORIGIN,
        first: ORIGIN,
        second: ORIGIN,
        third: ORIGIN,
    };

    /// The same place of the path, run through in the other direction.
    pub fn backwards(self) -> Self {
        Self {
            first: -self.first,
            third: -self.third,
            ..self
        }
    }
}
