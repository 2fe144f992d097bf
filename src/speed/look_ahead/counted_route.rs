//! A path that counts how often it is looked at: what that takes is nearly all of what placing nodes takes.

use core::cell::Cell;

use super::route::{MOST_BREAKPOINTS, Route, RouteVertex, SpeedCap};
use crate::axes::Axes;
use crate::moves::shape::PathPoint;

/// See the module.
#[derive(Debug)]
pub(super) struct CountedRoute<'a, R: Route> {
    route: &'a R,
    /// Points, with what the limits hold for there.
    points: Cell<u32>,
    /// The second and the third derivative alone.
    bends: Cell<u32>,
}

impl<'a, R: Route> CountedRoute<'a, R> {
    pub fn new(route: &'a R) -> Self {
        Self {
            route,
            points: Cell::new(0),
            bends: Cell::new(0),
        }
    }

    /// How often it was looked at since this was asked last: points, and bends alone.
    pub fn take_looks(&self) -> [u32; 2] {
        [&self.points, &self.bends].map(Cell::take)
    }
}

fn count(looks: &Cell<u32>) {
    looks.set(looks.get().saturating_add(1));
}

impl<R: Route> Route for CountedRoute<'_, R> {
    fn point(&self, s: f64) -> PathPoint {
        count(&self.points);
        self.route.point(s)
    }

    fn bend(&self, s: f64) -> [Axes; 2] {
        count(&self.bends);
        self.route.bend(s)
    }

    fn known_end(&self) -> f64 {
        self.route.known_end()
    }

    fn is_complete(&self) -> bool {
        self.route.is_complete()
    }

    fn speed_cap(&self, s: f64, first: &Axes) -> SpeedCap {
        self.route.speed_cap(s, first)
    }

    fn vertex_after(&self, s: f64) -> Option<RouteVertex> {
        self.route.vertex_after(s)
    }

    fn vertex_before(&self, s: f64) -> Option<RouteVertex> {
        self.route.vertex_before(s)
    }

    fn greatest_reach(&self) -> f64 {
        self.route.greatest_reach()
    }

    fn turning(&self, s: f64) -> f64 {
        self.route.turning(s)
    }

    fn breakpoints(&self, from: f64, to: f64, places: &mut [f64; MOST_BREAKPOINTS]) -> usize {
        self.route.breakpoints(from, to, places)
    }
}

#[cfg(test)]
mod tests {
    use super::super::test_route::TestRoute;
    use super::*;

    #[test]
    fn points_and_bends_are_counted_until_they_are_asked_for() {
        let route = TestRoute {
            point: |_| PathPoint::ZERO,
            breakpoints: Vec::new(),
            vertices: Vec::new(),
        };
        let counted = CountedRoute::new(&route);
        assert_eq!(counted.take_looks(), [0, 0]);
        for s in [1.0, 2.0, 3.0] {
            counted.point(s);
        }
        counted.bend(2.0);
        counted.vertex_after(0.0);
        assert_eq!(counted.take_looks(), [3, 1]);
        assert_eq!(counted.take_looks(), [0, 0]);
    }
}
