//! The shape of a move over its length: lines, arcs, helices and spirals in nine axes.
//!
//! Every shape runs from `s = 0` to `s = length()`, where s is the distance that the feed F
//! counts (see [`measure`]), and gives position and three derivatives by s.

mod arc;
pub mod blend;
mod line;
pub mod measure;

pub use arc::{Arc9, ArcExtent, Circle};
pub use line::Line9;

use nalgebra::ArrayStorage;

use crate::axes::{AXIS_COUNT, Axes};

/// Why a shape cannot be made of what the program gave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeError {
    /// Start and end are the same point: there is nothing to do. Not an error to LinuxCNC.
    ZeroLength,
    /// A coordinate is infinite or not a number, or so large that lengths overflow.
    NotFinite,
    /// The vector perpendicular to the plane of a circle has no direction.
    NoNormal,
    /// The start or the end of an arc lies on its axis, where it has no direction.
    RadiusTooSmall,
    /// More full turns than can be counted exactly.
    TooManyTurns,
}

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

/// The path of one move.
#[derive(Clone, Copy, Debug)]
#[allow(
    clippy::large_enum_variant,
    reason = "shapes lie in slots of equal size, without a heap"
)]
pub enum Shape {
    /// A straight line in nine axes.
    Line(Line9),
    /// An arc, helix or spiral in XYZ, the other axes in proportion.
    Arc(Arc9),
}

impl Shape {
    /// A line of length zero, what a slot of the queue holds before its first use.
    pub const VACANT: Self = Self::Line(Line9::VACANT);

    /// Greatest s, positive, in machine units, or in degrees if only A B C move.
    pub fn length(&self) -> f64 {
        match self {
            Self::Line(line) => line.length(),
            Self::Arc(arc) => arc.length(),
        }
    }

    /// The end point exactly as it was given, shape (9).
    pub fn end(&self) -> Axes {
        match self {
            Self::Line(line) => line.end(),
            Self::Arc(arc) => arc.end(),
        }
    }

    /// Whether nothing but A B C moves, so that s is in degrees.
    pub fn is_rotary(&self) -> bool {
        match self {
            Self::Line(line) => line.is_rotary(),
            Self::Arc(_) => false,
        }
    }

    /// Whether an axis, 0 to 8, moves at all.
    pub fn moves(&self, axis: usize) -> bool {
        match self {
            Self::Line(line) => line.moves(axis),
            Self::Arc(arc) => arc.moves(axis),
        }
    }

    /// The point at `s`, held within 0 and the length.
    pub fn position(&self, s: f64) -> Axes {
        match self {
            Self::Line(line) => line.position(s),
            Self::Arc(arc) => arc.position(s),
        }
    }

    /// The point at `s`, held within 0 and the length, with derivatives.
    pub fn point(&self, s: f64) -> PathPoint {
        match self {
            Self::Line(line) => line.point(s),
            Self::Arc(arc) => arc.point(s),
        }
    }
}
