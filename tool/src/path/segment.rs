//! Shape of a move: a line, or an arc that may climb (helix) and change its radius (spiral).

use super::Position;
use std::f64::consts::TAU;
use std::ops::Range;

/// Shorter than this an angle counts as none, and an arc with it as a full turn, radians.
const SMALLEST_ANGLE: f64 = 1e-12;

/// A piece of path from u = 0 to u = 1; all that is not the shape in X Y Z is linear in u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segment {
    pub start: Position,
    pub end: Position,
    /// Length in X Y Z, mm.
    pub length: f64,
    pub arc: Option<Arc>,
}

/// An arc about `centre`, from the direction `first` towards `second`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arc {
    /// In the plane of the start.
    pub centre: [f64; 3],
    pub first: [f64; 3],
    pub second: [f64; 3],
    /// Right-handed with the sense of turning.
    pub axis: [f64; 3],
    pub start_radius: f64,
    pub end_radius: f64,
    /// Above 0, radians.
    pub sweep: f64,
    /// Travel along the axis.
    pub climb: f64,
}

impl Segment {
    pub(crate) fn line(start: Position, end: Position) -> Segment {
        Segment {
            start,
            end,
            length: distance(&start, &end),
            arc: None,
        }
    }

    /// The line that goes on at either end, ten times as far: a tap follows its spindle there while that turns back.
    pub(crate) fn beyond_both_ends(&self) -> Segment {
        let beyond = |from: &Position, to: &Position| -> Position {
            std::array::from_fn(|axis| to[axis] + 10.0 * (to[axis] - from[axis]))
        };
        Segment::line(
            beyond(&self.end, &self.start),
            beyond(&self.start, &self.end),
        )
    }

    /// `turns` as in the canonical call: its sign is the sense about the normal, its amount the
    /// turns begun.
    pub(crate) fn arc(
        start: Position,
        end: Position,
        centre: [f64; 3],
        normal: [f64; 3],
        turns: i32,
    ) -> Segment {
        let sign = if turns < 0 { -1.0 } else { 1.0 };
        let size = dot(&normal, &normal).sqrt();
        let axis = normal.map(|n| sign * n / size);
        let mut from = [0.0; 3];
        let mut to = [0.0; 3];
        for i in 0..3 {
            from[i] = start[i] - centre[i];
            to[i] = end[i] - centre[i];
        }
        let (low, high) = (dot(&from, &axis), dot(&to, &axis));
        let mut foot = centre;
        for i in 0..3 {
            foot[i] += low * axis[i];
            from[i] -= low * axis[i];
            to[i] -= high * axis[i];
        }
        let start_radius = dot(&from, &from).sqrt();
        let end_radius = dot(&to, &to).sqrt();
        let first = from.map(|x| {
            if start_radius > 0.0 {
                x / start_radius
            } else {
                0.0
            }
        });
        let second = cross(&axis, &first);
        let mut angle = dot(&to, &second).atan2(dot(&to, &first));
        if angle <= SMALLEST_ANGLE {
            angle += TAU;
        }
        let sweep = angle + TAU * f64::from(turns.abs().max(1) - 1);
        let climb = high - low;
        let round = 0.5 * (start_radius + end_radius) * sweep;
        let radial = end_radius - start_radius;
        Segment {
            start,
            end,
            length: (round * round + radial * radial + climb * climb).sqrt(),
            arc: Some(Arc {
                centre: foot,
                first,
                second,
                axis,
                start_radius,
                end_radius,
                sweep,
                climb,
            }),
        }
    }

    /// The same with so many whole turns less, from start to end.
    pub(crate) fn without_turns(mut self, turns: u32) -> Segment {
        if let Some(arc) = &mut self.arc {
            arc.sweep -= TAU * f64::from(turns);
        }
        self
    }

    pub(crate) fn point(&self, u: f64) -> Position {
        let mut point = [0.0; 9];
        for (i, coordinate) in point.iter_mut().enumerate() {
            *coordinate = self.start[i] + u * (self.end[i] - self.start[i]);
        }
        if let Some(arc) = &self.arc {
            let (sine, cosine) = (u * arc.sweep).sin_cos();
            let radius = arc.start_radius + u * (arc.end_radius - arc.start_radius);
            for (i, coordinate) in point.iter_mut().enumerate().take(3) {
                *coordinate = arc.centre[i]
                    + radius * (cosine * arc.first[i] + sine * arc.second[i])
                    + u * arc.climb * arc.axis[i];
            }
        }
        point
    }

    /// Direction in X Y Z at u, not of unit length.
    pub(crate) fn direction(&self, u: f64) -> [f64; 3] {
        let mut direction = [0.0; 3];
        for (i, part) in direction.iter_mut().enumerate() {
            *part = self.end[i] - self.start[i];
        }
        if let Some(arc) = &self.arc {
            let (sine, cosine) = (u * arc.sweep).sin_cos();
            let grown = arc.end_radius - arc.start_radius;
            let round = (arc.start_radius + u * grown) * arc.sweep;
            for (i, part) in direction.iter_mut().enumerate() {
                *part = (grown * cosine - round * sine) * arc.first[i]
                    + (grown * sine + round * cosine) * arc.second[i]
                    + arc.climb * arc.axis[i];
            }
        }
        direction
    }

    /// Distance in X Y Z from `point` to the segment, and the u of the nearest place. A segment
    /// without travel in X Y Z is placed by its other axes.
    pub(crate) fn nearest(&self, point: &Position) -> (f64, f64) {
        match &self.arc {
            Some(arc) => self.nearest_on_arc(arc, point),
            None => {
                let axes = if self.length > 1e-9 { 0..3 } else { 3..9 };
                let (mut along, mut square) = (0.0, 0.0);
                for i in axes {
                    let travel = self.end[i] - self.start[i];
                    along += (point[i] - self.start[i]) * travel;
                    square += travel * travel;
                }
                let u = if square > 0.0 {
                    (along / square).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                (distance(&self.point(u), point), u)
            }
        }
    }

    /// How far `point` is from the segment, and the u of that place. With `all_axes` each of X Y Z,
    /// U V W and A B C has to be near at the same place: the largest of the three differences (mm and
    /// degrees alike) counts.
    pub(crate) fn deviation(&self, point: &Position, all_axes: bool) -> (f64, f64) {
        let (near, u) = self.nearest(point);
        if !all_axes {
            return (near, u);
        }
        let differ = |u: f64| largest_difference(&self.point(u), point);
        let places = [
            Some(u),
            self.nearest_of(point, 3..6),
            self.nearest_of(point, 6..9),
        ];
        let places = || places.iter().copied().flatten();
        // The largest of convex functions is least between their minima.
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let (mut low, mut high) = (places().fold(u, f64::min), places().fold(u, f64::max));
        for _ in 0..if high > low { 24 } else { 0 } {
            let (left, right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
            if differ(left) <= differ(right) {
                high = right;
            } else {
                low = left;
            }
        }
        places()
            .chain([(low + high) / 2.0])
            .map(|u| (differ(u), u))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((near, u))
    }

    /// The u where these axes come nearest; `None` if they stand still.
    fn nearest_of(&self, point: &Position, axes: Range<usize>) -> Option<f64> {
        let (mut along, mut square) = (0.0, 0.0);
        let ends = self.start.iter().zip(&self.end);
        for ((start, end), at) in ends.zip(point).take(axes.end).skip(axes.start) {
            let travel = end - start;
            along += (at - start) * travel;
            square += travel * travel;
        }
        (square > 1e-18).then(|| (along / square).clamp(0.0, 1.0))
    }

    fn nearest_on_arc(&self, arc: &Arc, point: &Position) -> (f64, f64) {
        let mut from_centre = [0.0; 3];
        for i in 0..3 {
            from_centre[i] = point[i] - arc.centre[i];
        }
        let angle = dot(&from_centre, &arc.second).atan2(dot(&from_centre, &arc.first));
        let mut best = (distance(&self.start, point), 0.0);
        let mut consider = |u: f64| {
            let found = distance(&self.point(u), point);
            if found < best.0 {
                best = (found, u);
            }
        };
        consider(1.0);
        let mut turned = angle.rem_euclid(TAU);
        while turned <= arc.sweep {
            consider(turned / arc.sweep);
            turned += TAU;
        }
        if arc.climb != 0.0 || arc.start_radius != arc.end_radius {
            let u = self.slide(point, best.1);
            let found = distance(&self.point(u), point);
            if found < best.0 {
                best = (found, u);
            }
        }
        best
    }

    /// Newton's method for the place where the connection to `point` is square to the path.
    fn slide(&self, point: &Position, start: f64) -> f64 {
        const STEP: f64 = 1e-6;
        let mut u = start;
        let slope = |u: f64| {
            let at = self.point(u);
            let along = self.direction(u);
            (0..3).map(|i| (at[i] - point[i]) * along[i]).sum::<f64>()
        };
        for _ in 0..8 {
            let curvature = (slope(u + STEP) - slope(u - STEP)) / (2.0 * STEP);
            let along = self.direction(u);
            let curvature = if curvature > 0.0 {
                curvature
            } else {
                dot(&along, &along)
            };
            if curvature <= 0.0 {
                break;
            }
            let next = (u - slope(u) / curvature).clamp(0.0, 1.0);
            if (next - u).abs() < 1e-12 {
                break;
            }
            u = next;
        }
        u
    }
}

/// Distance in X Y Z.
pub(crate) fn distance(a: &Position, b: &Position) -> f64 {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    (x * x + y * y + z * z).sqrt()
}

/// The largest of the distances in X Y Z, in U V W and in A B C.
pub(crate) fn largest_difference(a: &Position, b: &Position) -> f64 {
    let part = |first: usize| {
        let square = |i: usize| (a[i] - b[i]) * (a[i] - b[i]);
        (square(first) + square(first + 1) + square(first + 2)).sqrt()
    };
    part(0).max(part(3)).max(part(6))
}

/// Distance in X Y Z from `point` to the straight piece from `a` to `b`.
pub(crate) fn distance_to_chord(point: &Position, a: &Position, b: &Position) -> f64 {
    let (mut along, mut square) = (0.0, 0.0);
    for i in 0..3 {
        let travel = b[i] - a[i];
        along += (point[i] - a[i]) * travel;
        square += travel * travel;
    }
    let u = if square > 0.0 {
        (along / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let mut sum = 0.0;
    for i in 0..3 {
        let off = point[i] - a[i] - u * (b[i] - a[i]);
        sum += off * off;
    }
    sum.sqrt()
}

pub(crate) fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn at(x: f64, y: f64, z: f64) -> Position {
        [x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }

    #[test]
    fn quarter_helix() {
        let arc = Segment::arc(
            at(2.0, 0.0, 0.0),
            at(0.0, 2.0, 3.0),
            [0.0, 0.0, 3.0],
            [0.0, 0.0, 1.0],
            1,
        );
        assert!((arc.length - PI.hypot(3.0)).abs() < 1e-12);
        assert!(distance(&arc.point(1.0), &at(0.0, 2.0, 3.0)) < 1e-12);
        let (far, u) = arc.nearest(&arc.point(0.3));
        assert!(far < 1e-9 && (u - 0.3).abs() < 1e-6, "{far} {u}");
        assert!((arc.nearest(&at(1.0, 1.0, 1.5)).0 - (2.0 - 2f64.sqrt())).abs() < 1e-9);
    }

    /// Nearest to the one of A, to the other of U: 2 |u - .2| and |u - .8| are the same at .4.
    #[test]
    fn each_kind_of_axes_has_its_own_nearest_place() {
        let axes = |x, a, u| [x, 0.0, 0.0, a, 0.0, 0.0, u, 0.0, 0.0];
        let line = Segment::line(axes(0.0, 0.0, 0.0), axes(1.0, 2.0, 1.0));
        let (away, place) = line.deviation(&axes(0.32, 0.4, 0.8), true);
        assert!(
            (away - 0.4).abs() < 1e-4 && (place - 0.4).abs() < 1e-4,
            "{away} {place}"
        );
    }

    #[test]
    fn clockwise_and_full_turns() {
        let clockwise = Segment::arc(
            at(1.0, 0.0, 0.0),
            at(0.0, 1.0, 0.0),
            [0.0; 3],
            [0.0, 0.0, 1.0],
            -1,
        );
        assert!((clockwise.length - 3.0 * FRAC_PI_2).abs() < 1e-12);
        let twice = Segment::arc(
            at(1.0, 0.0, 0.0),
            at(1.0, 0.0, 0.0),
            [0.0; 3],
            [0.0, 0.0, 1.0],
            2,
        );
        assert!((twice.length - 4.0 * PI).abs() < 1e-12);
    }

    #[test]
    fn line_without_travel_in_space_is_placed_by_its_rotary_axis() {
        let mut end = at(0.0, 0.0, 0.0);
        end[3] = 90.0;
        let turn = Segment::line(at(0.0, 0.0, 0.0), end);
        let mut point = at(0.0, 0.5, 0.0);
        point[3] = 45.0;
        assert_eq!(turn.nearest(&point), (0.5, 0.5));
    }
}
