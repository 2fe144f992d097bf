//! The program as straight legs with a tolerance around each.

use crate::path::pieces::{Point, distance, distance_to_segment};

/// Shorter legs are left out, mm.
const SHORTEST: f64 = 1e-9;

/// A straight move, or a chord of an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Leg {
    pub start: Point,
    pub end: Point,
    /// How far the machine may be from it, mm, above 0.
    pub radius: f64,
    /// The greatest speed there, mm/s, above 0; infinite where the program does not say.
    pub speed: f64,
}

/// A place on the course; places are in the order of the program.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub(super) struct Place {
    pub leg: usize,
    /// From the start of the leg, mm.
    pub along: f64,
}

/// The course turns off a [`Line`] by no more than this, as a slope.
const GREATEST_SLOPE: f64 = 0.3;

/// A straight line through a place, which the course follows for a while.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    pub point: Point,
    /// Unit vector.
    pub direction: Point,
    pub ahead: Follows,
    pub back: Follows,
    /// The smallest that holds where the course follows, mm.
    pub radius: f64,
}

/// How long the course follows a line: exactly first, then it turns off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Follows {
    /// mm along the line.
    pub exactly: f64,
    /// mm along the line, altogether.
    pub reach: f64,
    /// Off the line, over what goes beyond `exactly`, at most.
    pub slope: f64,
}

/// The legs one after the other: vertex i lies between leg i - 1 and leg i.
#[derive(Clone, Debug)]
pub(super) struct Course {
    pub legs: Vec<Leg>,
    directions: Vec<Point>,
    lengths: Vec<f64>,
}

impl Course {
    /// `None` if no leg has a length.
    pub(super) fn new(legs: &[Leg]) -> Option<Course> {
        let length = |leg: &Leg| distance(leg.start, leg.end);
        let legs: Vec<Leg> = legs
            .iter()
            .copied()
            .filter(|leg| length(leg) > SHORTEST)
            .collect();
        let lengths: Vec<f64> = legs.iter().map(length).collect();
        let unit = |(leg, length): (&Leg, &f64)| {
            std::array::from_fn(|axis| (leg.end[axis] - leg.start[axis]) / length)
        };
        let directions = legs.iter().zip(&lengths).map(unit).collect();
        (!legs.is_empty()).then_some(Course {
            legs,
            directions,
            lengths,
        })
    }

    pub(super) fn length(&self, leg: usize) -> f64 {
        self.lengths[leg]
    }

    /// Of all legs, mm.
    pub(super) fn whole_length(&self) -> f64 {
        self.lengths.iter().sum()
    }

    pub(super) fn point(&self, place: Place) -> Point {
        let (start, direction) = (self.legs[place.leg].start, self.directions[place.leg]);
        std::array::from_fn(|axis| start[axis] + place.along * direction[axis])
    }

    /// The smallest tolerance, mm.
    pub(super) fn least_radius(&self) -> f64 {
        let radii = self.legs.iter().map(|leg| leg.radius);
        radii.fold(f64::INFINITY, f64::min)
    }

    /// Distance of `point` from the part of a leg between two lengths along it, mm, and the place there.
    pub(super) fn nearest(&self, point: Point, leg: usize, from: f64, to: f64) -> (f64, Place) {
        let end = |along: f64| self.point(Place { leg, along });
        let (found, share) = distance_to_segment(point, end(from), end(to));
        let along = from + share * (to - from);
        (found, Place { leg, along })
    }

    /// The largest of the distances over the radius: of `point` from the course between two places.
    pub(super) fn deviation(&self, point: Point, from: Place, to: Place) -> f64 {
        let ratio = |leg: usize| {
            let first = if leg == from.leg { from.along } else { 0.0 };
            let last = if leg == to.leg {
                to.along
            } else {
                self.lengths[leg]
            };
            self.nearest(point, leg, first, last).0 / self.legs[leg].radius
        };
        (from.leg..=to.leg).map(ratio).fold(f64::INFINITY, f64::min)
    }

    /// The line along the leg of a place, as far as `most` mm to both sides.
    pub(super) fn line(&self, place: Place, most: f64) -> Line {
        let left = self.lengths[place.leg] - place.along;
        let exactly = (place.along.max(0.0), left.max(0.0));
        let direction = self.directions[place.leg];
        self.through(
            self.point(place),
            direction,
            (place.leg, place.leg),
            exactly,
            most,
        )
    }

    /// The line through a vertex in the middle between its legs, as far as `most` mm to both sides; `None` where the
    /// course turns by more than such a line follows.
    pub(super) fn line_at(&self, vertex: usize, most: f64) -> Option<Line> {
        let (one, other) = (self.directions[vertex - 1], self.directions[vertex]);
        let sum: Point = std::array::from_fn(|axis| one[axis] + other[axis]);
        let length = distance(sum, [0.0; 3]);
        // Half of the turn lies between a leg and the line: half of the sum is its cosine.
        if 0.5 * length < (1.0 - GREATEST_SLOPE * GREATEST_SLOPE).sqrt() {
            return None;
        }
        let direction = sum.map(|part| part / length);
        let point = self.legs[vertex].start;
        Some(self.through(point, direction, (vertex, vertex - 1), (0.0, 0.0), most))
    }

    /// `first` and `last` leg of those behind and ahead of the point.
    fn through(
        &self,
        point: Point,
        direction: Point,
        (ahead, back): (usize, usize),
        (before, left): (f64, f64),
        most: f64,
    ) -> Line {
        let ends = (ahead..self.legs.len()).map(|leg| (leg, self.legs[leg].end));
        let (ahead, last) = follows(ends, (point, direction), left, most);
        let starts = (0..=back).rev().map(|leg| (leg, self.legs[leg].start));
        let opposite = direction.map(|part| -part);
        let (behind, first) = follows(starts, (point, opposite), before, most);
        let radii = self.legs[first.unwrap_or(back)..=last.unwrap_or(back)].iter();
        Line {
            point,
            direction,
            ahead,
            back: behind,
            radius: radii.map(|leg| leg.radius).fold(f64::INFINITY, f64::min),
        }
    }

    /// Cosine of the turn at a vertex between two legs.
    pub(super) fn cosine(&self, vertex: usize) -> f64 {
        let (one, other) = (self.directions[vertex - 1], self.directions[vertex]);
        (0..3).map(|axis| one[axis] * other[axis]).sum()
    }

    /// What holds around a vertex: the smaller radius of its legs, mm.
    pub(super) fn radius_at(&self, vertex: usize) -> f64 {
        self.legs[vertex - 1].radius.min(self.legs[vertex].radius)
    }
}

/// How long the vertices, each with its leg, follow a line from a point on; and the last leg that does.
fn follows(
    vertices: impl Iterator<Item = (usize, Point)>,
    (point, direction): (Point, Point),
    exactly: f64,
    most: f64,
) -> (Follows, Option<usize>) {
    let mut follows = Follows {
        exactly,
        reach: exactly,
        slope: 0.0,
    };
    let mut last = None;
    for (leg, vertex) in vertices {
        let along: f64 = (0..3)
            .map(|axis| (vertex[axis] - point[axis]) * direction[axis])
            .sum();
        let foot: Point = std::array::from_fn(|axis| point[axis] + along * direction[axis]);
        let beyond = along - exactly;
        let slope = if beyond > SHORTEST {
            distance(vertex, foot) / beyond
        } else {
            0.0
        };
        if along < follows.reach - SHORTEST || slope > GREATEST_SLOPE || follows.reach >= most {
            break;
        }
        follows.reach = along;
        follows.slope = follows.slope.max(slope);
        last = Some(leg);
    }
    follows.reach = follows.reach.clamp(0.0, most);
    (follows, last)
}
