//! One round along each wall, entered and left on quarters of circles.

use super::pieces::{Piece, from_place};
use super::region::Region;
use super::{Cut, Trouble, Way};
use cavalier_contours::core::math::Vector2;
use cavalier_contours::polyline::{
    PlineSource, PlineSourceMut, PlineVertex, Polyline, seg_midpoint, seg_tangent_vector,
};

/// A quarter of a circle: the tangent of a quarter of its angle.
const QUARTER: f64 = std::f64::consts::SQRT_2 - 1.0;

/// The radii of the quarters that are tried, over that of the tool.
const ENTRIES: [f64; 5] = [1.0, 0.5, 0.25, 0.1, 0.03];

/// The ways along the walls.
#[derive(Debug)]
pub struct Walls {
    /// One for each round.
    pub cuts: Vec<Cut>,
    /// How many rounds have no room for the quarters of circles.
    pub without_entry: usize,
}

/// Goes along the walls with the centre of the tool `radius` away from them; around the region clockwise
/// or counterclockwise, and around islands the other way. `near`: where the rounds begin, or next to it.
///
/// # Errors
///
/// See [`Trouble`].
pub fn follow(
    region: &Region,
    radius: f64,
    clockwise: bool,
    near: &[Vector2],
) -> Result<Walls, Trouble> {
    let mut walls = Walls {
        cuts: Vec::new(),
        without_entry: 0,
    };
    for mut round in region.loops(radius) {
        if clockwise {
            round.invert_direction_mut();
        }
        let entered = entered(&round, region, radius, clockwise, near);
        walls.without_entry += usize::from(entered.is_none());
        let way = entered.unwrap_or_else(|| {
            let mut way = Way::at(round.at(0).pos());
            way.go_round(&round);
            way
        });
        walls.cuts.push(way.finish(region, radius)?);
    }
    match walls.cuts.is_empty() {
        true => Err(Trouble::Unfit),
        false => Ok(walls),
    }
}

/// The index of the first of some pieces of the walls to whose middle a tool does not come that goes round
/// at a depth.
pub fn not_reached(region: &Region, depth: f64, pieces: &[Piece]) -> Option<usize> {
    let loops = region.loops(depth);
    let touched = |place: Vector2| {
        let mut pieces = loops.iter().flat_map(|round| round.iter_segments());
        pieces.any(|piece| from_place(piece, place) <= depth + super::INEXACT)
    };
    let mut pieces = pieces.iter();
    pieces.position(|(from, to)| !touched(seg_midpoint(*from, *to)))
}

/// The round with the largest quarters of circles that fit in at the middle of one of its pieces, the nearest to the
/// wanted places first.
fn entered(
    round: &Polyline,
    region: &Region,
    radius: f64,
    clockwise: bool,
    near: &[Vector2],
) -> Option<Way> {
    let mut places: Vec<(f64, usize)> = round
        .iter_segment_indexes()
        .map(|(from, to)| {
            let middle = seg_midpoint(round.at(from), round.at(to));
            let away = near.iter().map(|place| (*place - middle).length());
            (away.fold(f64::INFINITY, f64::min), from)
        })
        .collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut tries = ENTRIES.iter().flat_map(|share| {
        places
            .iter()
            .map(move |(_, index)| (share * radius, *index))
    });
    tries.find_map(|(size, index)| enter(round, index, size, region, radius, clockwise))
}

fn enter(
    round: &Polyline,
    index: usize,
    size: f64,
    region: &Region,
    radius: f64,
    clockwise: bool,
) -> Option<Way> {
    let (from, to) = (round.at(index), round.at(round.next_wrapping_index(index)));
    let place = seg_midpoint(from, to);
    let along = seg_tangent_vector(from, to, place).normalize();
    // The region is to the left of rounds that go counterclockwise.
    let (inward, bulge) = match clockwise {
        true => (along.perp().scale(-1.0), -QUARTER),
        false => (along.perp(), QUARTER),
    };
    let middle = place + inward.scale(size);
    let [start, end] = [-size, size].map(|ahead| middle + along.scale(ahead));
    let vertex = |place: Vector2, bulge: f64| PlineVertex::new(place.x, place.y, bulge);
    let arcs = [
        (vertex(start, bulge), vertex(place, 0.0)),
        (vertex(place, bulge), vertex(end, 0.0)),
    ];
    let clear = |piece| region.is_clear(piece, radius - super::INEXACT);
    if !arcs.into_iter().all(clear) {
        return None;
    }
    let mut way = Way::at(start);
    way.go(place, bulge);
    way.go_round(&round.rotate_start(index, place, super::NEAR)?);
    way.go(end, bulge);
    Some(way)
}
