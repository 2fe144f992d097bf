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

    /// Unit vector along a leg.
    pub(super) fn direction(&self, leg: usize) -> Point {
        self.directions[leg]
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
