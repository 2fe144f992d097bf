//! How well the executed path follows the programmed path.
//!
//! Both paths are passed in order. A row of the recording may therefore be compared only with
//! those pieces of the contour that can have been reached by then: going forward on both paths at
//! once without ever being farther apart than a search radius. This is the decision procedure of
//! the Fréchet distance (H. Alt, M. Godau: Computing the Fréchet distance between two polygonal
//! curves, 1995), on pieces instead of exact intervals. So a path that crosses itself, or runs
//! back over itself, is never compared with a pass that is not its turn. The radius starts small
//! and doubles until the whole recording is matched: the time is linear in rows and moves.

use serde::Serialize;

use crate::path::between::{around, way};
use crate::path::pieces::{Piece, Point, cut, distance, distance_to_segment, length_bound};
use crate::program::contour::ContourMove;

/// Pieces are at most this many search radii long.
const PIECE_LENGTH: f64 = 4.0;

/// Pieces of the contour at most, beside those that arcs and short moves need.
const GREATEST_PIECE_COUNT: f64 = 5e5;

/// The search radius ends at this share of the contour's extent.
const GREATEST_RADIUS_SHARE: f64 = 0.25;

/// The greatest distance of one path from the other, and where.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Farthest {
    /// Machine units.
    pub distance: f64,
    /// Row of the recording, at the point or closest to it.
    #[serde(skip)]
    pub row: usize,
    /// The point on the path that was measured, machine units.
    pub point: Point,
    /// Index of the programmed move.
    pub move_index: usize,
}

/// The comparison of the two paths.
#[derive(Clone, Debug, PartialEq)]
pub struct Following {
    /// The executed path, measured from the programmed path.
    pub executed: Farthest,
    /// The programmed path (ends of moves and points between), measured from the executed path.
    pub programmed: Farthest,
    /// Distance of each row from the programmed path, machine units.
    pub distances: Vec<f32>,
    /// The programmed move that each row belongs to.
    pub moves: Vec<u32>,
    /// Length of the programmed path that was not reached, machine units: 0 after a full run.
    pub not_reached: f64,
    /// From the last row to the end of the programmed path, machine units.
    pub final_position_error: f64,
}

/// The executed path leaves the programmed path altogether.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Departure {
    /// First row that has no counterpart.
    #[serde(skip)]
    pub row: usize,
    /// It is farther away than this, machine units.
    pub farther_than: f64,
    /// Index of the last programmed move that was matched.
    pub move_index: usize,
}

/// Compares the executed points (shape (rows), machine units) with the contour.
///
/// `radius` (above 0, machine units) is the search radius to begin with: a distance that is
/// expected between the paths. The result is exact at the rows; between rows the executed path
/// counts as straight, or as bent by a constant acceleration ([`between`](crate::path::between))
/// where that leads nearer. `None` without rows or moves.
pub fn compare(
    points: &[Point],
    contour: &[ContourMove],
    radius: f64,
) -> Option<Result<Following, Departure>> {
    if points.is_empty() || contour.is_empty() {
        return None;
    }
    let total: f64 = contour.iter().map(|m| length_bound(&m.shape)).sum();
    let greatest_radius = radius.max(GREATEST_RADIUS_SHARE * extent(contour));
    let mut radius = radius;
    loop {
        let piece_length = (PIECE_LENGTH * radius).max(total / GREATEST_PIECE_COUNT);
        let pieces = cut(contour, piece_length);
        match follow(points, &pieces, radius) {
            Ok(following) => return Some(Ok(following)),
            Err(departure) if radius >= greatest_radius => return Some(Err(departure)),
            Err(_) => radius = (2.0 * radius).min(greatest_radius),
        }
    }
}

/// The diagonal of the box around the contour's pieces.
fn extent(contour: &[ContourMove]) -> f64 {
    let mut least = [f64::INFINITY; 3];
    let mut greatest = [f64::NEG_INFINITY; 3];
    for m in contour {
        for t in [0.0, 0.25, 0.5, 0.75, 1.0] {
            for (axis, value) in m.shape.point(t).into_iter().enumerate() {
                least[axis] = least[axis].min(value);
                greatest[axis] = greatest[axis].max(value);
            }
        }
    }
    distance(least, greatest)
}

/// Distance and row of the executed path nearest to a sample of the contour.
#[derive(Clone, Copy)]
struct Nearest {
    distance: f64,
    row: usize,
}

impl Nearest {
    fn update(&mut self, sample: Point, from: Point, to: Point, row: usize) {
        let (distance, _) = distance_to_segment(sample, from, to);
        if distance < self.distance {
            *self = Nearest { distance, row };
        }
    }

    /// How far the sample is from the way around that row.
    fn beside_way(&self, points: &[Point], sample: Point) -> f64 {
        let lines = way(around(points.len(), self.row, |row| points[row]));
        let distances = lines.map(|[from, to]| distance_to_segment(sample, from, to).0);
        distances.fold(self.distance, f64::min)
    }
}

/// One pass over both paths with a fixed search radius.
fn follow(points: &[Point], pieces: &[Piece], radius: f64) -> Result<Following, Departure> {
    let mut distances = Vec::with_capacity(points.len());
    let mut moves = Vec::with_capacity(points.len());
    // For each piece its start, middle and end.
    let unseen = Nearest {
        distance: f64::INFINITY,
        row: 0,
    };
    let mut samples = vec![[unseen; 3]; pieces.len()];
    let mut executed = Farthest {
        distance: -1.0,
        row: 0,
        point: [0.0; 3],
        move_index: 0,
    };
    // Pieces first..first + reached.len() are the window; those marked can be where the machine is.
    let mut first = 0;
    let mut reached = vec![true];
    let mut next = Vec::new();
    let mut before = points[0];
    let mut matched = 0;
    for (row, &point) in points.iter().enumerate() {
        if row > 0 && point == before {
            distances.push(distances[row - 1]);
            moves.push(moves[row - 1]);
            continue;
        }
        // Within one step the programmed path may have advanced along the whole step.
        let allowed = radius + distance(before, point);
        next.clear();
        let mut nearest = (f64::INFINITY, first);
        let mut came_from_left = false;
        for (offset, piece) in pieces[first..].iter().enumerate() {
            let here = reached.get(offset).copied().unwrap_or(false);
            let left = offset > 0 && reached.get(offset - 1).copied().unwrap_or(false);
            if offset > reached.len() && !came_from_left {
                break;
            }
            came_from_left = if here || left || came_from_left {
                let distance = piece.distance(point);
                let free = distance <= allowed;
                if free && distance < nearest.0 {
                    nearest = (distance, first + offset);
                }
                free
            } else {
                false
            };
            next.push(came_from_left);
        }
        let Some(leading) = next.iter().position(|reachable| *reachable) else {
            return Err(Departure {
                row,
                farther_than: radius,
                move_index: pieces[matched].move_index,
            });
        };
        let trailing = next
            .iter()
            .rposition(|reachable| *reachable)
            .unwrap_or(leading);
        next.truncate(trailing + 1);
        next.drain(..leading);
        first += leading;
        std::mem::swap(&mut reached, &mut next);
        for (offset, _) in reached.iter().enumerate().filter(|(_, reached)| **reached) {
            let piece = &pieces[first + offset];
            let [start, middle, end] = &mut samples[first + offset];
            start.update(piece.start, before, point, row);
            middle.update(piece.middle(), before, point, row);
            end.update(piece.end, before, point, row);
        }
        matched = nearest.1;
        let move_index = pieces[matched].move_index;
        if nearest.0 > executed.distance {
            executed = Farthest {
                distance: nearest.0,
                row,
                point,
                move_index,
            };
        }
        distances.push(nearest.0 as f32);
        moves.push(u32::try_from(move_index).unwrap_or(u32::MAX));
        before = point;
    }

    // How far the run came: to the last piece that the last row can be at.
    let last = points[points.len() - 1];
    let at_end = first + reached.len() == pieces.len();
    let seen = if at_end { pieces.len() } else { matched + 1 };
    Ok(Following {
        executed,
        programmed: farthest_sample(points, pieces, &samples[..seen], !at_end),
        distances,
        moves,
        not_reached: pieces[seen..]
            .iter()
            .map(|p| distance(p.start, p.end))
            .sum(),
        final_position_error: distance(last, pieces[pieces.len() - 1].end),
    })
}

/// The sample of the contour that is farthest from the executed path.
///
/// Of the piece in which a run was cut short (`unfinished`) only the start counts.
fn farthest_sample(
    points: &[Point],
    pieces: &[Piece],
    samples: &[[Nearest; 3]],
    unfinished: bool,
) -> Farthest {
    let mut farthest = Farthest {
        distance: -1.0,
        row: 0,
        point: [0.0; 3],
        move_index: 0,
    };
    for (index, piece) in pieces.iter().enumerate().take(samples.len()) {
        let [mut start, middle, end] = samples[index];
        // Where two pieces meet, the point belongs to both: the nearer one counts.
        if index > 0 && pieces[index - 1].end == piece.start {
            let other = samples[index - 1][2];
            if other.distance < start.distance {
                start = other;
            }
        }
        let cut_short = unfinished && index + 1 == samples.len();
        let mut candidates = vec![(start, piece.start)];
        if !cut_short {
            candidates.push((middle, piece.middle()));
        }
        if index + 1 == pieces.len() {
            candidates.push((end, piece.end));
        }
        for (nearest, point) in candidates {
            if !nearest.distance.is_finite() || nearest.distance <= farthest.distance {
                continue;
            }
            let distance = nearest.beside_way(points, point);
            if distance > farthest.distance {
                farthest = Farthest {
                    distance,
                    row: nearest.row,
                    point,
                    move_index: piece.move_index,
                };
            }
        }
    }
    farthest
}

#[cfg(test)]
mod tests;
