//! What a candidate works with.

use super::rest_arc::{LASTING, PROVISIONAL, RestArcSearch};
use super::route::Route;
use super::rows::AxisRows;
use super::spline::Spline;

/// How many vertices tell how dense the path is.
const VERTICES_COUNTED: usize = 12;

/// The path, the limits, and the plan that a candidate continues.
pub(super) struct PlanContext<'a, R: Route> {
    pub route: &'a R,
    pub rows: &'a AxisRows,
    pub plan: &'a Spline,
    /// Square of what the program's caps are multiplied by.
    pub raise_squared: f64,
    /// The first interval that is still needed.
    pub oldest: usize,
}

impl<R: Route> PlanContext<'_, R> {
    /// The search for an arc between the spline and a rest, see [`RestArcSearch::new`].
    pub fn search(&self, place: f64, direction: f64, most: f64, share: f64) -> RestArcSearch {
        let raise = self.raise_squared;
        RestArcSearch::new(self.rows, self.route, place, direction, most, share, raise)
    }

    /// The share of the greatest acceleration for the arc to the rest at `end`.
    pub fn end_share(&self, end: f64) -> f64 {
        if self.route.is_complete() && end >= self.route.known_end() {
            LASTING
        } else {
            PROVISIONAL
        }
    }

    /// How many kernels overlap before `end`, in the mean.
    pub fn kernels_before(&self, end: f64) -> f64 {
        let (mut place, mut reaches) = (end, 0.0);
        for _ in 0..VERTICES_COUNTED {
            let Some(vertex) = self.route.vertex_before(place) else {
                break;
            };
            place = vertex.position;
            reaches += 2.0 * vertex.reach;
        }
        if place < end {
            reaches / (end - place)
        } else {
            0.0
        }
    }
}
