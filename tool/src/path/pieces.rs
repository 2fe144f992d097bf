//! The programmed path cut into short pieces, with the exact distance of a point from each.

use crate::program::contour::{ContourMove, Shape};

/// A point or vector, machine units.
pub type Point = [f64; 3];

/// No piece of an arc turns by more than this, radians: the distance to it then has one minimum.
const GREATEST_TURN: f64 = 0.4;

/// Length of the vector from `a` to `b`.
pub fn distance(a: Point, b: Point) -> f64 {
    dot(minus(a, b), minus(a, b)).sqrt()
}

fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|i| a[i] - b[i])
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Distance of `point` from the straight line between `start` and `end`, and where, 0 to 1.
pub fn distance_to_segment(point: Point, start: Point, end: Point) -> (f64, f64) {
    let along = minus(end, start);
    let square = dot(along, along);
    let t = if square > 0.0 {
        (dot(minus(point, start), along) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let foot = std::array::from_fn(|i| start[i] + t * along[i]);
    (distance(point, foot), t)
}

/// A part of one move of the contour.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a> {
    /// Index of the move in the contour.
    pub move_index: usize,
    shape: &'a Shape,
    from: f64,
    to: f64,
    /// First point.
    pub start: Point,
    /// Last point.
    pub end: Point,
}

impl Piece<'_> {
    /// The point in the middle of its parameter.
    pub fn middle(&self) -> Point {
        self.shape.point(0.5 * (self.from + self.to))
    }

    /// Distance of `point` from this piece, machine units.
    ///
    /// Lines in closed form. Arcs, helices and ellipses: a root of (c(t) - p) c'(t) by Newton's
    /// method with bisection as its guard; the ends count where the root is outside.
    pub fn distance(&self, point: Point) -> f64 {
        let Shape::Arc {
            centre,
            u,
            v,
            sweep,
            rise,
        } = self.shape
        else {
            return distance_to_segment(point, self.start, self.end).0;
        };
        // Half the derivative of the squared distance by t, and its own derivative.
        let slope = |t: f64| {
            let (sin, cos) = (sweep * t).sin_cos();
            let offset: Point = std::array::from_fn(|i| {
                centre[i] + cos * u[i] + sin * v[i] + t * rise[i] - point[i]
            });
            let first: Point = std::array::from_fn(|i| sweep * (cos * v[i] - sin * u[i]) + rise[i]);
            let second: Point = std::array::from_fn(|i| -sweep * sweep * (cos * u[i] + sin * v[i]));
            (dot(offset, first), dot(first, first) + dot(offset, second))
        };
        let ends = distance(point, self.start).min(distance(point, self.end));
        if slope(self.from).0 >= 0.0 || slope(self.to).0 <= 0.0 {
            return ends;
        }
        let (mut low, mut high) = (self.from, self.to);
        let mut t = 0.5 * (low + high);
        for _ in 0..60 {
            let (value, derivative) = slope(t);
            if value < 0.0 {
                low = t;
            } else {
                high = t;
            }
            let newton = t - value / derivative;
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            let step = (next - t).abs();
            t = next;
            if step <= 1e-15 * (1.0 + t.abs()) {
                break;
            }
        }
        ends.min(distance(point, self.shape.point(t)))
    }
}

/// An upper bound of the length of a shape, exact for lines and circles, machine units.
pub fn length_bound(shape: &Shape) -> f64 {
    match shape {
        Shape::Line { start, end } => distance(*start, *end),
        Shape::Arc {
            u, v, sweep, rise, ..
        } => {
            let radius = dot(*u, *u).max(dot(*v, *v)).sqrt();
            (sweep * radius).hypot(dot(*rise, *rise).sqrt())
        }
    }
}

/// Cuts a contour into pieces of at most `length` (above 0), in the order of the path.
pub fn cut(contour: &[ContourMove], length: f64) -> Vec<Piece<'_>> {
    let mut pieces = Vec::with_capacity(contour.len());
    for (move_index, programmed) in contour.iter().enumerate() {
        let shape = &programmed.shape;
        let turn = match shape {
            Shape::Line { .. } => 0.0,
            Shape::Arc { sweep, .. } => *sweep,
        };
        let count = (length_bound(shape) / length)
            .max(turn / GREATEST_TURN)
            .ceil()
            .max(1.0);
        let mut start = shape.point(0.0);
        for index in 1..=count as usize {
            let from = (index - 1) as f64 / count;
            let to = index as f64 / count;
            let end = shape.point(to);
            pieces.push(Piece {
                move_index,
                shape,
                from,
                to,
                start,
                end,
            });
            start = end;
        }
    }
    pieces
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A straight move.
    pub fn line(number: u32, start: Point, end: Point) -> ContourMove {
        ContourMove {
            line: number,
            file: 0,
            rapid: false,
            feed: 6000.0,
            shape: Shape::Line { start, end },
        }
    }

    /// An arc or helix in the XY plane, counterclockwise from the positive X direction.
    pub fn arc(number: u32, centre: Point, radii: [f64; 2], sweep: f64, rise: f64) -> ContourMove {
        ContourMove {
            line: number,
            file: 0,
            rapid: false,
            feed: 6000.0,
            shape: Shape::Arc {
                centre,
                u: [radii[0], 0.0, 0.0],
                v: [0.0, radii[1], 0.0],
                sweep,
                rise: [0.0, 0.0, rise],
            },
        }
    }

    fn nearest(contour: &[ContourMove], point: Point) -> f64 {
        cut(contour, 1.0)
            .iter()
            .map(|piece| piece.distance(point))
            .fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_line_of_no_length_is_a_point() {
        let contour = [line(1, [1.0, 2.0, 3.0], [1.0, 2.0, 3.0])];
        assert!((nearest(&contour, [1.0, 2.0, 5.0]) - 2.0).abs() < 1e-15);
    }

    #[test]
    fn pieces_join_and_cover_the_move() {
        let contour = [
            line(1, [0.0; 3], [10.0, 0.0, 0.0]),
            arc(2, [5.0, 0.0, 0.0], [5.0, 5.0], 7.0, 2.0),
        ];
        let pieces = cut(&contour, 0.3);
        assert!(
            pieces
                .iter()
                .all(|p| distance(p.start, p.end) <= 0.3 + 1e-12)
        );
        assert!(
            pieces
                .windows(2)
                .all(|pair| distance(pair[0].end, pair[1].start) < 1e-12)
        );
        assert_eq!(pieces.len(), 34 + 117);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn distance_from_a_circle_is_exact(
            radius in 0.01f64..500.0, at in 0.0f64..2.0, angle in -3.2f64..3.2, height in -5.0f64..5.0,
        ) {
            let contour = [arc(1, [1.0, -2.0, 0.0], [radius, radius], std::f64::consts::TAU, 0.0)];
            let point = [1.0 + at * radius * angle.cos(), -2.0 + at * radius * angle.sin(), height];
            let exact = (at * radius - radius).hypot(height);
            prop_assert!((nearest(&contour, point) - exact).abs() < 1e-10 * (1.0 + radius));
        }

        #[test]
        fn distance_from_helices_and_ellipses_agrees_with_dense_samples(
            a in 0.5f64..20.0, flat in 0.2f64..1.0, sweep in 0.1f64..15.0, rise in -10.0f64..10.0,
            x in -25.0f64..25.0, y in -25.0f64..25.0, z in -10.0f64..10.0,
        ) {
            let contour = [arc(1, [0.0; 3], [a, a * flat], sweep, rise)];
            let point = [x, y, z];
            let sampled = (0..=20_000)
                .map(|i| distance(point, contour[0].shape.point(f64::from(i) / 20_000.0)))
                .fold(f64::INFINITY, f64::min);
            let found = nearest(&contour, point);
            prop_assert!(found <= sampled + 1e-12 && sampled - found < 0.02, "{found} {sampled}");
        }
    }
}
