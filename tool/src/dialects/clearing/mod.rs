//! Clearing of regions with islands: where the centre of a round tool goes in one plane.
//!
//! A [`Region`](region::Region) is what lies inside of one closed contour and outside of others. The places that
//! lie a depth away from all its walls form loops, parallel to the contours; [`rounds`] lays them side by side
//! until nothing is left, and [`walls`] goes along the walls alone. No length has a unit: all are those of the
//! contours.

pub mod arrange;
pub mod pieces;
pub mod region;
mod rests;
pub mod rounds;
pub mod walls;

use cavalier_contours::core::math::Vector2;
use cavalier_contours::polyline::{
    PlineSource, PlineSourceMut, PlineVertex, Polyline, seg_arc_radius_and_center,
};
use region::Region;

/// Places that are nearer to each other are one, where a round begins.
const NEAR: f64 = 1e-7;

/// How far a cut may come too near to a wall by rounding.
const INEXACT: f64 = 1e-6;

/// Arcs with a shorter chord are lines: a control could take them for full circles.
const SHORTEST_ARC: f64 = 1e-4;

/// A way that the tool goes at one depth, from where it plunges to where it is withdrawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// Where it plunges.
    pub start: [f64; 2],
    /// The motions from there.
    pub steps: Vec<Step>,
}

/// A line, or an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Its end.
    pub to: [f64; 2],
    /// Of an arc: its centre from its start, and whether it goes clockwise.
    pub arc: Option<([f64; 2], bool)>,
}

/// Why a region cannot be cleared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// The tool fits in nowhere.
    Unfit,
    /// It would come nearer to a wall than it may.
    Inexact,
    /// It takes more rounds than the caller allows, who knows.
    Endless,
}

/// A way being put together.
#[derive(Debug)]
struct Way(Polyline);

impl Way {
    fn at(start: Vector2) -> Way {
        let mut line = Polyline::new();
        line.add(start.x, start.y, 0.0);
        Way(line)
    }

    fn end(&self) -> Vector2 {
        self.0
            .last()
            .map_or(Vector2::new(0.0, 0.0), |vertex| vertex.pos())
    }

    /// On to a place by a line, or by an arc whose quarter angle has the tangent `bulge`.
    fn go(&mut self, to: Vector2, bulge: f64) {
        if let Some(mut last) = self.0.last() {
            last.bulge = bulge;
            self.0.set_last(last);
        }
        self.0.add(to.x, to.y, 0.0);
    }

    /// Once round a loop that begins where the way ends.
    fn go_round(&mut self, round: &Polyline) {
        for (from, to) in round.iter_segments() {
            self.go(to.pos(), from.bulge);
        }
    }

    /// The finished way, if no part of it comes nearer to the walls than `clearance`.
    fn finish(self, region: &Region, clearance: f64) -> Result<Cut, Trouble> {
        let mut steps = Vec::with_capacity(self.0.vertex_count());
        for piece in self.0.iter_segments() {
            if piece.0.pos() == piece.1.pos() {
                continue;
            }
            if !region.is_clear(piece, clearance - INEXACT) {
                return Err(Trouble::Inexact);
            }
            steps.push(step(piece));
        }
        let start = self.0.at(0);
        Ok(Cut {
            start: [start.x, start.y],
            steps,
        })
    }
}

fn step((from, to): (PlineVertex, PlineVertex)) -> Step {
    let is_arc = !from.bulge_is_zero() && (to.pos() - from.pos()).length() >= SHORTEST_ARC;
    Step {
        to: [to.x, to.y],
        arc: is_arc.then(|| {
            let (_, centre) = seg_arc_radius_and_center(from, to);
            let offset = centre - from.pos();
            ([offset.x, offset.y], from.bulge < 0.0)
        }),
    }
}

#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
