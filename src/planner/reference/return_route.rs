//! The path as the look-ahead sees it on the way back.

use super::path_route::{speed_cap, vertex};
use crate::axes::Axes;
use crate::moves::shape::PathPoint;
use crate::moves::{MotionType, MoveQueue};
use crate::path::{BlendedPath, LegView, VertexView};
use crate::speed::look_ahead::{MOST_BREAKPOINTS, Route, RouteVertex, SpeedCap};

/// The leg that leads to `s`, if the machine may go back over it.
///
/// Not over what is forgotten, nor over moves that belong to something else than the path: those
/// that follow the angle of a spindle, that probe, and that turn an unlocked indexer.
pub(super) fn may_go_back(path: &BlendedPath, queue: &MoveQueue, s: f64) -> Option<LegView> {
    let leg = path.leg_before(s)?;
    queue.get(leg.first)?;
    // Merged moves are of one kind.
    let last = queue.get(leg.serial)?;
    let coupled = last.follows_angle()
        || last.indexer_joint.is_some()
        || last.motion_type == MotionType::Probing;
    (!coupled).then_some(leg)
}

/// The path as the look-ahead sees it on the way back: its distance is path distance with the other
/// sign.
pub(super) struct ReturnRoute<'a> {
    pub path: &'a BlendedPath,
    /// How far back the machine may go as far as is known, path distance.
    pub end: f64,
    /// Whether it comes to rest there.
    pub complete: bool,
}

impl Route for ReturnRoute<'_> {
    fn point(&self, distance: f64) -> PathPoint {
        let s = -distance;
        let point = if s <= self.end {
            self.path.point(s)
        } else {
            self.path.point_before(s)
        };
        point.backwards()
    }

    fn known_end(&self) -> f64 {
        -self.end
    }

    fn is_complete(&self) -> bool {
        self.complete
    }

    fn speed_cap(&self, distance: f64, first: &Axes) -> SpeedCap {
        speed_cap(self.path, -distance, first)
    }

    fn vertex_after(&self, distance: f64) -> Option<RouteVertex> {
        self.path.vertex_before(-distance).map(mirrored)
    }

    fn vertex_before(&self, distance: f64) -> Option<RouteVertex> {
        self.path.vertex_after(-distance).map(mirrored)
    }

    fn greatest_reach(&self) -> f64 {
        self.path.greatest_reach()
    }

    fn turning(&self, distance: f64) -> f64 {
        self.path
            .leg_before(-distance)
            .map_or(0.0, |leg| leg.turning)
    }

    fn breakpoints(&self, from: f64, to: f64, places: &mut [f64; MOST_BREAKPOINTS]) -> usize {
        let count = self.path.breakpoints(-to, -from, places);
        for place in places {
            *place = -*place;
        }
        count
    }
}

fn mirrored(view: VertexView) -> RouteVertex {
    let vertex = vertex(view);
    RouteVertex {
        position: -vertex.position,
        ..vertex
    }
}
