//! What is left between two rounds that are more than a tool radius apart.
//!
//! A place between them lies on a way from the middle to its nearest wall, and this way crosses the outer
//! round: up to a tool radius from it all is gone. Behind that, what the inner round does not reach is left: in
//! sharp corners of it and where there is none any more. Samples of loops there tell, so close that
//! no place between them can be missed.

use super::Trouble;
use super::pieces::from_place;
use super::region::Region;
use super::rounds::Tool;
use cavalier_contours::core::math::Vector2;
use cavalier_contours::polyline::{
    PlineSource, PlineVertex, Polyline, seg_arc_radius_and_center, seg_length,
};

/// How many loops are looked at.
const LOOPS: usize = 8;

/// How far samples on a loop are apart, over the radius of the tool.
const APART: f64 = 0.05;

/// How many samples count as a round.
const COUNTED: usize = 256;

/// The further rounds that are needed between the round at a depth and those next to it towards the middle.
/// `go_on`: see [`clear`](super::rounds::clear).
///
/// # Errors
///
/// [`Trouble::Endless`].
pub fn rests(
    region: &Region,
    tool: &Tool,
    depth: f64,
    inner: &[Polyline],
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Vec<Polyline>, Trouble> {
    let width = tool.step - tool.radius;
    if width <= 0.0 {
        return Ok(Vec::new());
    }
    let first = depth + tool.radius;
    let further = region.loops(first);
    let mut needed = vec![false; further.len()];
    let gap = width / LOOPS as f64;
    let reach = tool.radius * (1.0 - APART / 2.0) - gap;
    for number in 0..LOOPS {
        for line in region.loops(first + gap * number as f64) {
            for (index, place) in samples(&line, tool.radius * APART).enumerate() {
                if (index + 1).is_multiple_of(COUNTED) && !go_on() {
                    return Err(Trouble::Endless);
                }
                if inner.iter().any(|inner| reaches(inner, place, reach)) {
                    continue;
                }
                let nearest = nearest(&further, place);
                if let Some(needed) = nearest.and_then(|at| needed.get_mut(at)) {
                    *needed = true;
                }
            }
        }
    }
    let further = further.into_iter().zip(needed);
    let further = further.filter(|(_, needed)| *needed);
    Ok(further.map(|(line, _)| line).collect())
}

fn reaches(line: &Polyline, place: Vector2, reach: f64) -> bool {
    let mut pieces = line.iter_segments();
    pieces.any(|piece| from_place(piece, place) <= reach)
}

/// The index of the line that is nearest to a place.
pub fn nearest(lines: &[Polyline], place: Vector2) -> Option<usize> {
    let away = |at: &usize| distance(&lines[*at], place);
    (0..lines.len()).min_by(|a, b| away(a).total_cmp(&away(b)))
}

fn distance(line: &Polyline, place: Vector2) -> f64 {
    let distances = line.iter_segments().map(|piece| from_place(piece, place));
    distances.fold(f64::INFINITY, f64::min)
}

/// Places on a line, at most so far apart.
fn samples(line: &Polyline, apart: f64) -> impl Iterator<Item = Vector2> {
    line.iter_segments().flat_map(move |(from, to)| {
        let count = (seg_length(from, to) / apart).ceil().max(1.0);
        (0..count as u64).map(move |number| on_piece(from, to, number as f64 / count))
    })
}

/// The place at a share of the length of a piece.
fn on_piece(from: PlineVertex, to: PlineVertex, share: f64) -> Vector2 {
    let chord = to.pos() - from.pos();
    let straight = from.pos() + chord.scale(share);
    if from.bulge_is_zero() {
        return straight;
    }
    let (_, centre) = seg_arc_radius_and_center(from, to);
    let angle = 4.0 * from.bulge.atan() * share;
    from.pos().rotate_about(centre, angle)
}
