//! A route for tests that says no more than how it bends.

use super::route::{MOST_BREAKPOINTS, Route, RouteVertex, SpeedCap};
use crate::axes::Axes;
use crate::moves::shape::PathPoint;

/// Without an end, 50 a second, 60 at most.
pub(super) struct TestRoute<P> {
    pub point: P,
    pub breakpoints: Vec<f64>,
    /// In the order of the path.
    pub vertices: Vec<RouteVertex>,
}

impl<P: Fn(f64) -> PathPoint> Route for TestRoute<P> {
    fn point(&self, s: f64) -> PathPoint {
        (self.point)(s)
    }
    fn known_end(&self) -> f64 {
        10.0
    }
    fn is_complete(&self) -> bool {
        true
    }
    fn speed_cap(&self, _: f64, _: &Axes) -> SpeedCap {
        SpeedCap {
            programmed: 50.0,
            greatest: 60.0,
        }
    }
    fn vertex_after(&self, s: f64) -> Option<RouteVertex> {
        let mut behind = self.vertices.iter();
        behind.find(|vertex| vertex.position > s).copied()
    }
    fn vertex_before(&self, s: f64) -> Option<RouteVertex> {
        let mut before = self.vertices.iter().rev();
        before.find(|vertex| vertex.position < s).copied()
    }
    fn greatest_reach(&self) -> f64 {
        let reaches = self.vertices.iter().map(|vertex| vertex.reach);
        reaches.fold(0.0, f64::max)
    }
    fn breakpoints(&self, from: f64, to: f64, places: &mut [f64; MOST_BREAKPOINTS]) -> usize {
        let inside = self.breakpoints.iter().filter(|s| (from..to).contains(s));
        places
            .iter_mut()
            .zip(inside)
            .map(|(free, place)| *free = *place)
            .count()
    }
}
