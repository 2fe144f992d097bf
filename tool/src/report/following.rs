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
/// counts as straight, which is right to `a T^2 / 8`. `None` without rows or moves.
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
        programmed: farthest_sample(pieces, &samples[..seen], !at_end),
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
fn farthest_sample(pieces: &[Piece], samples: &[[Nearest; 3]], unfinished: bool) -> Farthest {
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
            if nearest.distance.is_finite() && nearest.distance > farthest.distance {
                farthest = Farthest {
                    distance: nearest.distance,
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
mod tests {
    use super::*;
    use crate::path::pieces::tests::{arc, line};

    /// Points along a contour, `step` apart at most, moved by `shift(arc length)`.
    fn executed(
        contour: &[ContourMove],
        step: f64,
        shift: impl Fn(f64, Point) -> Point,
    ) -> Vec<Point> {
        let mut length = 0.0;
        let mut points = Vec::new();
        for m in contour {
            let own = length_bound(&m.shape);
            let count = (own / step).ceil().max(1.0) as usize;
            for index in 0..=count {
                let t = index as f64 / count as f64;
                points.push(shift(length + t * own, m.shape.point(t)));
            }
            length += own;
        }
        points
    }

    fn compared(points: &[Point], contour: &[ContourMove]) -> Following {
        compare(points, contour, 0.05)
            .expect("rows and moves")
            .expect("the path is followed")
    }

    fn square() -> Vec<ContourMove> {
        vec![
            line(1, [0.0; 3], [10.0, 0.0, 0.0]),
            line(2, [10.0, 0.0, 0.0], [10.0, 10.0, 0.0]),
            arc(3, [5.0, 10.0, 0.0], [5.0, 5.0], std::f64::consts::PI, 0.0),
            line(4, [0.0, 10.0, 0.0], [0.0; 3]),
        ]
    }

    #[test]
    fn an_exact_run_has_no_distance() {
        let contour = square();
        let found = compared(&executed(&contour, 0.1, |_, p| p), &contour);
        assert!(found.executed.distance < 1e-13, "{:?}", found.executed);
        // The middle of a chord of the arc: h^2 / 8 r.
        assert!(found.programmed.distance < 0.1f64.powi(2) / 39.0);
        assert!(found.not_reached == 0.0 && found.final_position_error < 1e-14);
        assert_eq!(found.moves.first(), Some(&0));
        assert_eq!(found.moves.last(), Some(&3));
    }

    #[test]
    fn five_micrometres_are_found_with_their_place() {
        let contour = square();
        // A smooth bump of 5 um on the arc, 30 mm along the path.
        let bump = |s: f64, p: Point| {
            let x = (s - 30.0) / 3.0;
            let height = if x.abs() < 1.0 {
                0.005 * (1.0 - x * x).powi(2)
            } else {
                0.0
            };
            let radius = distance(p, [5.0, 10.0, 0.0]);
            let scale = 1.0 + height / radius;
            [
                5.0 + (p[0] - 5.0) * scale,
                10.0 + (p[1] - 10.0) * scale,
                p[2],
            ]
        };
        let points = executed(&contour, 0.05, bump);
        let found = compared(&points, &contour);
        assert!(
            (found.executed.distance - 0.005).abs() < 1e-6,
            "{:?}",
            found.executed
        );
        assert_eq!(found.executed.move_index, 2);
        assert_eq!(contour[found.programmed.move_index].line, 3);
        assert!((found.programmed.distance - 0.005).abs() < 1e-4);
        let row = found.executed.row;
        assert!((f64::from(found.distances[row]) - found.executed.distance).abs() < 1e-9);
    }

    #[test]
    fn a_corner_that_is_cut_shows_from_the_programmed_side_only() {
        // The corner (10, 0) is rounded with radius 1: its vertex is sqrt 2 - 1 away.
        let contour = vec![
            line(1, [0.0; 3], [10.0, 0.0, 0.0]),
            line(2, [10.0, 0.0, 0.0], [10.0, 10.0, 0.0]),
        ];
        let mut points = executed(&[line(1, [0.0; 3], [9.0, 0.0, 0.0])], 0.02, |_, p| p);
        for index in 0..=1000 {
            let angle = -std::f64::consts::FRAC_PI_2 * (1.0 - f64::from(index) / 1000.0);
            points.push([9.0 + angle.cos(), 1.0 + angle.sin(), 0.0]);
        }
        let rest = [line(2, [10.0, 1.0, 0.0], [10.0, 10.0, 0.0])];
        points.extend(executed(&rest, 0.02, |_, p| p));
        let found = compared(&points, &contour);
        let vertex = 2f64.sqrt() - 1.0;
        assert!(
            (found.programmed.distance - vertex).abs() < 1e-5,
            "{:?}",
            found.programmed
        );
        assert!((found.programmed.point[0] - 10.0).abs() < 1e-12);
        // The arc's middle is 1 - sqrt 1/2 from both legs.
        let middle = 1.0 - 0.5f64.sqrt();
        assert!(
            (found.executed.distance - middle).abs() < 1e-5,
            "{:?}",
            found.executed
        );
    }

    #[test]
    fn a_pass_is_not_compared_with_its_neighbour() {
        // Three passes 0.1 mm apart. The second runs on the third: 0.1 mm wrong for 18 mm.
        let contour = vec![
            line(1, [0.0; 3], [20.0, 0.0, 0.0]),
            line(2, [20.0, 0.0, 0.0], [20.0, 0.1, 0.0]),
            line(3, [20.0, 0.1, 0.0], [0.0, 0.1, 0.0]),
            line(4, [0.0, 0.1, 0.0], [0.0, 0.2, 0.0]),
            line(5, [0.0, 0.2, 0.0], [20.0, 0.2, 0.0]),
        ];
        let points = executed(&contour, 0.05, |s, p| {
            let wrong = s > 21.1 && s < 39.1;
            [p[0], if wrong { 0.2 } else { p[1] }, p[2]]
        });
        let found = compared(&points, &contour);
        assert!(
            (found.executed.distance - 0.1).abs() < 1e-9,
            "{:?}",
            found.executed
        );
        assert_eq!(contour[found.executed.move_index].line, 3);
        assert!(
            (found.programmed.distance - 0.1).abs() < 2e-3,
            "{:?}",
            found.programmed
        );
    }

    #[test]
    fn a_pass_is_told_from_the_one_before_when_the_radius_is_wider_than_the_way_out() {
        // .4 mm beside the first line. Then passes with .3 mm out between them: the second, on which the third lies, is .1 mm off.
        let mut contour = vec![
            line(1, [-20.0, 0.0, 0.0], [0.0; 3]),
            line(2, [0.0; 3], [20.0, 0.0, 0.0]),
        ];
        for (number, depth) in [(3, 0.0), (7, -0.1)] {
            let places = [
                [20.0, depth],
                [20.0, 0.3],
                [0.0, 0.3],
                [0.0, -0.1],
                [20.0, -0.1],
            ];
            for (number, ends) in (number..).zip(places.windows(2)) {
                let [start, end] = [ends[0], ends[1]].map(|[x, y]| [x, y, 0.0]);
                contour.push(line(number, start, end));
            }
        }
        let points = executed(&contour, 0.05, |s, p| {
            let beside = if s < 15.0 && s > 5.0 { 0.4 } else { 0.0 };
            let wrong = s > 65.7 && s < 75.7;
            [p[0], if wrong { 0.0 } else { p[1] }, beside]
        });
        let found = compared(&points, &contour);
        assert!((found.executed.distance - 0.4).abs() < 1e-9);
        let rows = |pass: u32, off: f32| {
            let all = found.distances.iter().zip(&found.moves);
            all.filter(|row| *row.1 == pass && (row.0 - off).abs() < 1e-6)
                .count()
        };
        assert!((195..=201).contains(&rows(5, 0.1)), "{}", rows(5, 0.1));
        assert_eq!(rows(1, 0.1) + rows(9, 0.1), 0);
        assert!((395..=410).contains(&rows(1, 0.0)) && (395..=410).contains(&rows(9, 0.0)));
    }

    #[test]
    fn out_and_back_on_the_same_line_is_passed_in_order() {
        let contour = vec![
            line(1, [0.0; 3], [10.0, 0.0, 0.0]),
            line(2, [10.0, 0.0, 0.0], [0.0; 3]),
        ];
        // The run turns back at 9.9: 0.1 short of the end, and it is nowhere beside the path.
        let points: Vec<Point> = (0..=198)
            .chain((0..198).rev())
            .map(|i| [f64::from(i) * 0.05, 0.0, 0.0])
            .collect();
        let found = compared(&points, &contour);
        assert!(found.executed.distance < 1e-12);
        assert!((found.programmed.distance - 0.1).abs() < 1e-12);
        assert_eq!(found.programmed.point, [10.0, 0.0, 0.0]);
        assert_eq!(found.moves[100], 0);
        assert_eq!(found.moves[300], 1);
    }

    #[test]
    fn a_run_cut_short_says_what_is_left() {
        let contour = square();
        let points = executed(&contour[..2], 0.1, |_, p| p);
        let found = compared(&points, &contour);
        let left = 5.0 * std::f64::consts::PI + 10.0;
        assert!(
            (found.not_reached - left).abs() < 0.3,
            "{}",
            found.not_reached
        );
        assert!((found.final_position_error - 200f64.sqrt()).abs() < 1e-12);
        assert!(found.programmed.distance < 0.25);
    }

    #[test]
    fn a_path_that_goes_elsewhere_departs() {
        let contour = square();
        let points = executed(&contour, 0.1, |s, p| {
            [p[0], p[1], if s > 15.0 { 30.0 } else { 0.0 }]
        });
        let departure = compare(&points, &contour, 0.05)
            .expect("rows and moves")
            .expect_err("it leaves the path");
        assert_eq!(contour[departure.move_index].line, 2);
        assert!(departure.farther_than > 3.0);
    }
}
