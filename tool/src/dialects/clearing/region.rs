//! What lies inside of a contour and outside of its islands.

use super::pieces::{Piece, between};
use cavalier_contours::polyline::{
    PlineOrientation, PlineSource, PlineSourceMut, Polyline, seg_bounding_box,
};
use cavalier_contours::shape_algorithms::{IndexedPolyline, Shape, ShapeOffsetOptions};

/// Vertices of loops that are nearer to each other are one.
const SAME_VERTEX: f64 = 1e-8;

/// A region with at least one wall.
#[derive(Debug)]
pub struct Region(Shape<f64>);

impl Region {
    /// Of closed contours that do not touch each other or themselves, the islands inside of the outline.
    pub fn new(mut outline: Polyline, islands: Vec<Polyline>) -> Region {
        if outline.orientation() == PlineOrientation::Clockwise {
            outline.invert_direction_mut();
        }
        let islands = islands.into_iter().map(|mut island| {
            if island.orientation() == PlineOrientation::CounterClockwise {
                island.invert_direction_mut();
            }
            island
        });
        Region(Shape::from_plines(std::iter::once(outline).chain(islands)))
    }

    fn walls(&self) -> impl Iterator<Item = &IndexedPolyline<f64>> {
        self.0.ccw_plines.iter().chain(&self.0.cw_plines)
    }

    /// The pieces of its walls.
    pub fn pieces(&self) -> impl Iterator<Item = Piece> {
        self.walls().flat_map(|wall| wall.polyline.iter_segments())
    }

    /// The loops on which all places lie so deep: so far from the nearest wall. The deeper ones are to the left
    /// of each.
    pub fn loops(&self, depth: f64) -> Vec<Polyline> {
        let options = ShapeOffsetOptions {
            pos_equal_eps: SAME_VERTEX,
            offset_dist_eps: 1e-7,
            slice_join_eps: 1e-6,
        };
        let inner = self.0.parallel_offset(depth, &options);
        let loops = inner.ccw_plines.into_iter().chain(inner.cw_plines);
        let clean = |round: IndexedPolyline<f64>| {
            let round = round.polyline;
            round.remove_repeat_pos(SAME_VERTEX).unwrap_or(round)
        };
        let loops = loops.map(clean);
        loops.filter(|round| round.vertex_count() > 1).collect()
    }

    /// Whether no part of a piece is nearer to a wall.
    pub fn is_clear(&self, piece: Piece, clearance: f64) -> bool {
        let bounds = seg_bounding_box(piece.0, piece.1);
        self.walls().all(|wall| {
            let near = wall.spatial_index.query(
                bounds.min_x - clearance,
                bounds.min_y - clearance,
                bounds.max_x + clearance,
                bounds.max_y + clearance,
            );
            let mut near = near.into_iter().map(|from| {
                let to = wall.polyline.next_wrapping_index(from);
                (wall.polyline.at(from), wall.polyline.at(to))
            });
            near.all(|other| between(piece, other) >= clearance)
        })
    }
}
