//! From rest and to rest: arcs of constant jerk.
//!
//! At rest b = v^2 has no bounded derivatives by s, so the spline begins and ends a little beside
//! it, and one phase of constant jerk does the rest: `a = j t`, `v = j t^2 / 2`, `s = j t^3 / 6`.

use super::route::{Route, RouteVertex};
use super::rows::AxisRows;
use super::sample::Sample;
use crate::axes::AXIS_COUNT;
use crate::cube_root::cube_root;

/// The share of the limits that an arc may take: less than what the interval beside it is held
/// to, so that the two fit together.
const MARGIN: f64 = 0.996;

/// The share of acceleration and jerk that curvature alone may take: a little less than what the
/// sweeps leave to it.
const CURVE_SHARE: f64 = 0.5;

/// The share of the greatest acceleration that an arc ends at, at the start and at the end of a run.
pub(super) const LASTING: f64 = 0.7;

/// The same at an end that is to be moved on: less, since it has to fit what comes before.
pub(super) const PROVISIONAL: f64 = 0.5;

/// Lengths that are tried; each is less than the one before.
const MOST_TRIES: usize = 16;

/// The share of the cap of v^2 that an arc may come to: beside it the speed goes on to change.
const CAP_SHARE: f64 = 0.25;

/// How many vertices an arc may lead over.
const MOST_VERTICES: usize = 32;

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
    fn fits<R: Route>(&self, rows: &AxisRows, route: &R, s: f64, direction: f64) -> f64 {
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

/// The search for an arc that fits: each try is shorter than the one before.
#[derive(Clone, Copy, Debug)]
pub(super) struct RestArcSearch {
    arc: RestArc,
    place: f64,
    direction: f64,
    cap: f64,
    raise_squared: f64,
    attempt: usize,
}

/// What the search has come to.
#[derive(Clone, Copy, Debug)]
pub(super) enum ArcStep {
    /// Nothing yet.
    More,
    /// This one fits.
    Found(RestArc),
    /// None does, or nothing limits the jerk along the path.
    Failed,
}

impl RestArcSearch {
    /// From the rest at `place` in the direction of growing s (`direction` 1) or falling s (-1),
    /// no longer than `most`, up to a share of the greatest acceleration.
    pub fn new<R: Route>(
        rows: &AxisRows,
        route: &R,
        place: f64,
        direction: f64,
        most: f64,
        acceleration_share: f64,
        raise_squared: f64,
    ) -> Self {
        let rest = rows.sample(route, place, 0.0);
        let jerk = MARGIN / rest.first.amax();
        let time = acceleration_share * rows.acceleration_from_rest(&rest) / jerk;
        let length = (jerk * time * time * time / 6.0).min(most);
        let sound = rest.is_sound() && jerk.is_finite() && length > 0.0;
        Self {
            arc: RestArc { length, jerk },
            place,
            direction,
            cap: rest.cap.raised(raise_squared),
            raise_squared,
            attempt: if sound { 0 } else { MOST_TRIES },
        }
    }

    /// One try: five evaluations of the path.
    pub fn advance<R: Route>(&mut self, rows: &AxisRows, route: &R) -> ArcStep {
        if self.attempt >= MOST_TRIES {
            return ArcStep::Failed;
        }
        let arc = self.arc;
        let fitting = arc.fits(rows, route, self.place, self.direction);
        let slow = arc.velocity() * arc.velocity() <= CAP_SHARE * self.cap;
        if fitting >= arc.jerk && slow && self.keeps_caps(rows, route) {
            return ArcStep::Found(arc);
        }
        if fitting < arc.jerk {
            self.arc.jerk = fitting.max(0.7 * arc.jerk);
        }
        self.arc.length *= if self.attempt < 2 { 0.6 } else { 0.35 };
        self.attempt += 1;
        ArcStep::More
    }
}

impl RestArcSearch {
    /// Whether the arc exceeds none of the caps that it leads over: the speed grows with the distance from
    /// the rest, so that each is kept if it is where the next one begins, and where the arc ends.
    fn keeps_caps<R: Route>(&self, rows: &AxisRows, route: &R) -> bool {
        let RestArc { length, .. } = self.arc;
        let square = self.arc.velocity() * self.arc.velocity();
        let cap = |s: f64| {
            let cap = rows.cap(route, s, &route.point(s), 0.0);
            cap.raised(self.raise_squared)
        };
        let mut s = self.place;
        for _ in 0..MOST_VERTICES {
            let next = if self.direction > 0.0 {
                route.vertex_after(s)
            } else {
                route.vertex_before(s)
            };
            let away = |vertex: &RouteVertex| (vertex.position - self.place) * self.direction;
            let Some(vertex) = next.filter(|vertex| away(vertex) < length) else {
                let end = self.place + self.direction * length;
                return s == self.place || square <= CAP_SHARE * cap(end);
            };
            s = vertex.position;
            let share = cube_root(away(&vertex) / length);
            // v^2 goes with the fourth power of time, the distance with the third.
            let there = square * share * share * share * share;
            if vertex.cap_changes && there > cap(s) {
                return false;
            }
        }
        false
    }
}

/// The longest arc that leaves the changes of shape beside a rest to the grid: a share of the way
/// to the next one, and of the way there is in total.
pub(super) fn free_length<R: Route>(route: &R, place: f64, total: f64) -> f64 {
    let mut free = 0.1 * total;
    let known = route.known_end();
    let mut consider = |vertex: &RouteVertex| {
        if vertex.reach > 0.0 && vertex.position - vertex.reach <= known {
            let gap = (vertex.position - place).abs() - vertex.reach;
            free = free.min((0.15 * gap).max(vertex.reach / 24.0));
        }
    };
    let (mut before, mut after) = (place, place);
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
