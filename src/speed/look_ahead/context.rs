//! What a candidate works with.

use super::cost;
use super::counted_route::CountedRoute;
use super::route::Route;
use super::rows::AxisRows;
use super::spline::Spline;

/// How many vertices tell how dense the path is.
const VERTICES_COUNTED: usize = 12;

/// The path, the limits, and the plan that a candidate continues.
pub(super) struct PlanContext<'a, R: Route> {
    pub route: &'a CountedRoute<'a, R>,
    pub rows: &'a AxisRows,
    pub plan: &'a Spline,
    /// Square of what the program's caps are multiplied by.
    pub raise_squared: f64,
    /// The first interval that is still needed.
    pub oldest: usize,
}

impl<R: Route> PlanContext<'_, R> {
    /// What an evaluation of the path before `end` costs.
    pub fn evaluation(&self, end: f64) -> u32 {
        cost::evaluation(self.kernels_before(end), self.rows.nanoseconds())
    }

    /// How many kernels overlap before `end`, in the mean.
    fn kernels_before(&self, end: f64) -> f64 {
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
