//! The path as the look-ahead sees it on the way on.

use crate::axes::Axes;
use crate::moves::shape::PathPoint;
use crate::path::{BlendedPath, VertexView};
use crate::speed::look_ahead::{MOST_BREAKPOINTS, Route, RouteVertex, SpeedCap};

/// How near to a change of the speed cap is on it, share of the path distance.
const ON_CHANGE: f64 = 1e-12;

/// The path as the look-ahead sees it, up to the end of a run.
pub(super) struct PathRoute<'a> {
    pub path: &'a BlendedPath,
    /// Where the run ends, path distance.
    pub stop: f64,
}

impl Route for PathRoute<'_> {
    fn point(&self, s: f64) -> PathPoint {
        if s >= self.stop {
            self.path.point_before(s)
        } else {
            self.path.point(s)
        }
    }

    fn bend(&self, s: f64) -> [Axes; 2] {
        if s >= self.stop {
            let PathPoint { second, third, .. } = self.path.point_before(s);
            [second, third]
        } else {
            self.path.bend(s)
        }
    }

    fn known_end(&self) -> f64 {
        self.path.final_end().min(self.stop)
    }

    fn is_complete(&self) -> bool {
        self.path.final_end() >= self.stop
    }

    fn speed_cap(&self, s: f64, first: &Axes) -> SpeedCap {
        speed_cap(self.path, s, first)
    }

    fn vertex_after(&self, s: f64) -> Option<RouteVertex> {
        self.path.vertex_after(s).map(vertex)
    }

    fn vertex_before(&self, s: f64) -> Option<RouteVertex> {
        self.path.vertex_before(s).map(vertex)
    }

    fn greatest_reach(&self) -> f64 {
        self.path.greatest_reach()
    }

    fn turning(&self, s: f64) -> f64 {
        self.path.leg(s).map_or(0.0, |leg| leg.turning)
    }

    fn breakpoints(&self, from: f64, to: f64, places: &mut [f64; MOST_BREAKPOINTS]) -> usize {
        self.path.breakpoints(from, to, places)
    }
}

/// The speed cap at path distance `s`, see [`Route::speed_cap`].
pub(super) fn speed_cap(path: &BlendedPath, s: f64, first: &Axes) -> SpeedCap {
    let [programmed, greatest] = path.speeds_near(s, ON_CHANGE * (1.0 + s.abs()));
    // Where a corner is rounded the path is shorter than what s counts.
    let slope = path.distance(first);
    SpeedCap {
        programmed: programmed / slope,
        greatest: greatest / slope,
    }
}

/// A vertex as the look-ahead sees it.
pub(super) fn vertex(view: VertexView) -> RouteVertex {
    RouteVertex {
        position: view.s,
        reach: view.reach,
        core: view.core,
        cap_changes: view.speed_changes && !view.stop,
        may_jump: view.curvature_jumps,
    }
}
