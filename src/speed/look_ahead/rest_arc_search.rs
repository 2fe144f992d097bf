//! The search for an arc at rest that fits.

use super::context::PlanContext;
use super::rest_arc::{MARGIN, RestArc};
use super::route::{Route, RouteVertex};
use super::rows::AxisRows;
use crate::cube_root::cube_root;

/// The share of the greatest acceleration that an arc ends at, at the start and at the end of a run.
const LASTING: f64 = 0.7;

/// The same at an end that is to be moved on: less, since it has to fit what comes before.
const PROVISIONAL: f64 = 0.5;

/// Lengths that are tried; each is less than the one before.
const MOST_TRIES: usize = 16;

/// The share of the cap of v^2 that an arc may come to: beside it the speed goes on to change.
const CAP_SHARE: f64 = 0.25;

/// How many vertices an arc may lead over.
const MOST_VERTICES: usize = 32;

/// The search for an arc that fits: each try is shorter than the one before.
#[derive(Clone, Copy, Debug)]
pub(super) struct RestArcSearch {
    arc: RestArc,
    place: f64,
    direction: f64,
    cap: f64,
    /// Square of what the program's caps were multiplied by when it began.
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
    /// From the rest at `start` on, no longer than `most`.
    pub fn from_rest<R: Route>(context: &PlanContext<R>, start: f64, most: f64) -> Self {
        Self::new(context, start, 1.0, most, LASTING)
    }

    /// To the rest at `end`, no longer than `most`.
    pub fn to_rest<R: Route>(context: &PlanContext<R>, end: f64, most: f64) -> Self {
        let route = context.route;
        let share = if route.is_complete() && end >= route.known_end() {
            LASTING
        } else {
            PROVISIONAL
        };
        Self::new(context, end, -1.0, most, share)
    }

    /// From the rest at `place` in the direction of growing s (`direction` 1) or falling s (-1),
    /// no longer than `most`, up to a share of the greatest acceleration.
    fn new<R: Route>(
        context: &PlanContext<R>,
        place: f64,
        direction: f64,
        most: f64,
        acceleration_share: f64,
    ) -> Self {
        let PlanContext {
            rows,
            route,
            raise_squared,
            ..
        } = *context;
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
    pub fn advance<R: Route>(&mut self, context: &PlanContext<R>) -> ArcStep {
        let PlanContext { rows, route, .. } = *context;
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

    /// Whether the arc exceeds none of the caps that it leads over: the speed grows with the distance from
    /// the rest, so that each is kept if it is where the next one begins, and where the arc ends.
    fn keeps_caps<R: Route>(&self, rows: &AxisRows, route: &R) -> bool {
        let RestArc { length, .. } = self.arc;
        let square = self.arc.velocity() * self.arc.velocity();
        let cap = |s: f64| {
            let cap = rows.cap(route, s, &rows.place(&route.point(s)), 0.0);
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
