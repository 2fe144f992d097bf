//! From rest and to rest: arcs of constant jerk.
//!
//! At rest b = v^2 has no bounded derivatives by s, so the spline begins and ends a little beside
//! it, and one phase of constant jerk does the rest: `a = j t`, `v = j t^2 / 2`, `s = j t^3 / 6`.

use super::route::{Route, RouteVertex, before as just_before};
use super::rows::AxisRows;
use super::sample::Sample;
use crate::axes::AXIS_COUNT;
use crate::cube_root::cube_root;

/// The share of the limits that an arc may take: less than what the interval beside it is held
/// to, so that the two fit together.
pub(super) const MARGIN: f64 = 0.996;

/// The share of acceleration and jerk that curvature alone may take: a little less than what the
/// sweeps leave to it.
const CURVE_SHARE: f64 = 0.5;

/// How many vertices on each side of a rest are looked at.
const NEIGHBOURS: usize = 8;

/// A phase of constant jerk between rest and the spline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RestArc {
    /// In s, greater than 0.
    pub length: f64,
    /// Along the path, greater than 0.
    pub jerk: f64,
}

impl RestArc {
    pub const NONE: Self = Self {
        length: 0.0,
        jerk: 1.0,
    };

    /// Seconds.
    pub fn duration(&self) -> f64 {
        cube_root(6.0 * self.length / self.jerk)
    }

    /// Speed where it meets the spline.
    pub fn velocity(&self) -> f64 {
        let t = self.duration();
        0.5 * self.jerk * t * t
    }

    /// Amount of the acceleration where it meets the spline.
    pub fn acceleration(&self) -> f64 {
        self.jerk * self.duration()
    }

    /// The two coefficients of intervals of equal `length` that a node with the arc's speed lies
    /// between: first the one towards the rest.
    pub fn coefficients(&self, length: f64) -> [f64; 2] {
        let v = self.velocity();
        let slope = self.acceleration() * length;
        [v * v - slope, v * v + slope]
    }

    /// The jerk that the rows leave along the arc; at least its own if the arc fits.
    pub fn fits<R: Route>(&self, rows: &AxisRows, route: &R, s: f64, direction: f64) -> f64 {
        let mut jerk = self.jerk;
        for share in [1.0, 0.75, 0.5, 0.25, 0.1] {
            let sample = rows.sample(route, s + direction * self.length * share, 0.0);
            let root = cube_root(share);
            let v = self.velocity() * root * root;
            let a = self.acceleration() * root;
            jerk = jerk.min(jerk_left(&sample, v, a));
            // Motion away from the rest and towards it differ in the sign of a alone.
            let most = rows
                .acceleration_row(&sample, v * v, a)
                .max(rows.acceleration_row(&sample, v * v, -a));
            // The sweep gives a curve a share only.
            let curve = rows.acceleration_row(&sample, v * v, 0.0);
            let twist = sample.third.amax() * v * v * v;
            let slow = curve <= CURVE_SHARE && twist <= CURVE_SHARE;
            if !(most <= MARGIN && slow && sample.is_sound()) {
                return 0.7 * jerk.min(self.jerk);
            }
        }
        jerk
    }
}

/// The share of the whole way that an arc may be. Where jerk alone limits a move, the first of its four phases is a
/// twelfth of it; the sweeps with their careful bounds, and the intervals beside the arc, want a part of that. Of the
/// extensions in random short programs, which end at an arc, 45 of a hundred were made anew for a shorter one with a
/// tenth, 26 with this; 20 with .03, but squares of 5 mm take .5 % longer.
const FREE_SHARE: f64 = 0.05;

/// The longest arc that leaves the changes of shape beside a rest to the grid: a share of the way
/// to the next one, and of the way there is in total.
pub(super) fn free_length<R: Route>(route: &R, place: f64, total: f64) -> f64 {
    let mut free = FREE_SHARE * total;
    let known = route.known_end();
    let mut consider = |vertex: &RouteVertex| {
        if vertex.reach > 0.0 && vertex.position - vertex.reach <= known {
            let gap = (vertex.position - place).abs() - vertex.reach;
            free = free.min((0.15 * gap).max(vertex.reach / 24.0));
        }
    };
    // A machine that crept may rest in the middle of a change.
    let (mut before, mut after) = (place, just_before(place));
    for _ in 0..NEIGHBOURS {
        if let Some(vertex) = route.vertex_before(before) {
            before = vertex.position;
            consider(&vertex);
        }
        if let Some(vertex) = route.vertex_after(after) {
            after = vertex.position;
            consider(&vertex);
        }
    }
    free
}

/// The jerk along the path that all axes have left at a speed and an amount of acceleration.
fn jerk_left(sample: &Sample, v: f64, a: f64) -> f64 {
    let mut jerk = f64::INFINITY;
    for axis in 0..AXIS_COUNT {
        let slope = sample.first[axis].abs();
        let across = sample.second[axis].abs() * a * v + sample.third[axis].abs() * v * v * v;
        let left = MARGIN - across;
        if left < 0.0 {
            return 0.0;
        }
        if slope > 0.0 {
            jerk = jerk.min(left / slope);
        }
    }
    // Rounding of what the jerk was made of.
    jerk * (1.0 + 1e-12)
}
