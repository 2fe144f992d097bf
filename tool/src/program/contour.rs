//! The path that a part program describes, in machine coordinates, as exact shapes.

/// One move of a part program after all frames and offsets, as the tip of the tool is to follow it.
#[derive(Clone, Debug, PartialEq)]
pub struct ContourMove {
    /// Line of the source (1 for the first) of the file with index `file` in the program's list of files.
    pub line: u32,
    /// Index of the source file: 0 is the program itself, the others are subprogram files.
    pub file: usize,
    /// Whether this is a rapid move (G0).
    pub rapid: bool,
    /// Feed in machine units per minute; 0 for rapid moves.
    pub feed: f64,
    /// The shape.
    pub shape: Shape,
}

/// A straight line, or an arc: circle, helix, or the ellipse that a circle becomes under unequal scales.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// From `start` to `end`, machine units.
    Line {
        /// Where the move begins.
        start: [f64; 3],
        /// Where it ends.
        end: [f64; 3],
    },
    /// `centre + cos(angle) u + sin(angle) v + rise t`, angle = `sweep * t`, t from 0 to 1.
    Arc {
        /// Centre at the height of the start.
        centre: [f64; 3],
        /// From the centre to the start.
        u: [f64; 3],
        /// Where the arc is after a quarter turn in the direction of motion, seen from the centre.
        v: [f64; 3],
        /// Total angle, radians, positive, more than 2 pi for several turns.
        sweep: f64,
        /// Travel along the axis of a helix from start to end.
        rise: [f64; 3],
    },
}

impl Shape {
    /// The point at `t`, 0 at the start and 1 at the end.
    pub fn point(&self, t: f64) -> [f64; 3] {
        match self {
            Shape::Line { start, end } => {
                std::array::from_fn(|i| start[i] + t * (end[i] - start[i]))
            }
            Shape::Arc {
                centre,
                u,
                v,
                sweep,
                rise,
            } => {
                let (sin, cos) = (sweep * t).sin_cos();
                std::array::from_fn(|i| centre[i] + cos * u[i] + sin * v[i] + t * rise[i])
            }
        }
    }
}
