//! The shape of a move over its length: lines, arcs, helices and spirals in nine axes.
//!
//! Every shape runs from `s = 0` to `s = length()`, where s is the distance that the feed F
//! counts (see [`measure`]), and gives position and three derivatives by s.

mod arc;
mod error;
mod line;
pub mod measure;
mod point;

pub use arc::{Arc9, ArcExtent, Circle};
pub use error::{GREATEST_COORDINATE, GREATEST_LENGTH, ShapeError};
pub use line::Line9;
pub use point::PathPoint;

use crate::axes::Axes;

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
