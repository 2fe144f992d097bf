//! By which piece of the program a place of the machine is judged while a move runs: the nearest one, or where that does not admit
//! it one of the move that runs or beside it that does. A path may pass nearer by a piece with another tolerance.

use crate::canon::call::PathMode;
use crate::layer::program::Piece;
use std::ops::Range;

/// Pieces on each side of one that belong to the same corner, at most.
pub(crate) const BESIDE: usize = 3;

/// Tolerances that a corner reaches along the path, at most: what lies farther on is not a part of it.
pub(crate) const REACH: f64 = 4.0;

/// P of a piece: `Some(0)` in exact modes, `None` without P.
pub(crate) fn tolerance(piece: &Piece) -> Option<f64> {
    match piece.mode {
        PathMode::Continuous if piece.tolerance <= 0.0 => None,
        PathMode::Continuous => Some(piece.tolerance),
        _ => Some(0.0),
    }
}

/// Of two that meet, what holds where they do.
pub(crate) fn wider(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    one.zip(other).map(|(one, other)| one.max(other))
}

/// A tolerance with how far merging may have taken the moves from the program; exact modes stay exact.
pub(crate) fn with_merging(tolerance: f64, merged: f64) -> f64 {
    match tolerance > 0.0 {
        true => tolerance + merged,
        false => 0.0,
    }
}

/// A place of the machine, and the pieces of the program around it in their order.
pub(crate) trait Around {
    /// How many there are.
    fn count(&self) -> usize;

    /// One of them.
    fn piece(&self, index: usize) -> Option<&Piece>;

    /// How far the place is from it, mm or degrees.
    fn distance(&self, index: usize) -> Option<f64>;

    /// How far the path may be from it where it is on its way: `Some(0)` in exact modes, `None` without P.
    fn allowed(&self, index: usize) -> Option<f64>;

    /// How far merging may have taken the path from it, mm.
    fn merged(&self, index: usize) -> f64;

    /// How long these are.
    fn length(&self, pieces: Range<usize>) -> f64;

    /// Whether a path with this tolerance may be so far off.
    fn admits(&self, distance: f64, tolerance: Option<f64>) -> bool;
}

/// The piece by which a place is judged, and how far that is from it; `first` and `last` are those of the move that runs.
pub(crate) fn judged(
    place: &impl Around,
    [first, last]: [usize; 2],
    nearest: (usize, f64),
) -> (usize, f64) {
    if place.admits(nearest.1, place.allowed(nearest.0)) {
        return nearest;
    }
    let beside = first.saturating_sub(BESIDE)..place.count().min(last + BESIDE + 1);
    let admitting = beside.filter_map(|index| {
        let tolerance = match (first..=last).contains(&index) {
            true => place.allowed(index),
            false => Some(between(place, [first, last], index)?),
        };
        let distance = place.distance(index)?;
        place
            .admits(distance, tolerance)
            .then_some((index, distance))
    });
    let nearer = admitting.min_by(|a, b| a.1.total_cmp(&b.1));
    nearer.unwrap_or(nearest)
}

/// How far the path may be from a piece beside the move that runs, on its way to it or from it: by the least P of what lies
/// between, as far as a corner of it reaches; `None` where not all of that has one.
fn between(place: &impl Around, [first, last]: [usize; 2], index: usize) -> Option<f64> {
    let (from, to) = match index < first {
        true => (index, first),
        false => (last, index),
    };
    let tolerances = (from..to).map(|index| {
        let tolerance = tolerance(place.piece(index)?);
        tolerance.filter(|tolerance| *tolerance > 0.0)
    });
    let least = tolerances.reduce(|a, b| Some(a?.min(b?)))??;
    let passed = place.length(from + 1..to);
    (passed <= REACH * least).then(|| least + place.merged(index))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::segment::Segment;

    /// Lines of 1 mm, by their tolerances and how far the place is from each.
    struct Lines(Vec<(Piece, f64)>);

    impl Lines {
        fn new(lines: &[(PathMode, f64, f64)]) -> Lines {
            let piece = |&(mode, tolerance, distance): &(PathMode, f64, f64)| {
                let piece = Piece {
                    segment: Segment::line([0.0; 9], [1.0; 9]),
                    line: 1,
                    move_index: 0,
                    mode,
                    tolerance,
                    merged_within: 0.0,
                    turns_left_away: 0,
                    stops: false,
                };
                (piece, distance)
            };
            Lines(lines.iter().map(piece).collect())
        }
    }

    impl Around for Lines {
        fn count(&self) -> usize {
            self.0.len()
        }

        fn piece(&self, index: usize) -> Option<&Piece> {
            self.0.get(index).map(|(piece, _)| piece)
        }

        fn distance(&self, index: usize) -> Option<f64> {
            self.0.get(index).map(|(_, distance)| *distance)
        }

        fn allowed(&self, index: usize) -> Option<f64> {
            tolerance(self.piece(index)?)
        }

        fn merged(&self, _: usize) -> f64 {
            0.0
        }

        fn length(&self, pieces: Range<usize>) -> f64 {
            pieces.len() as f64
        }

        fn admits(&self, distance: f64, tolerance: Option<f64>) -> bool {
            tolerance.is_none_or(|tolerance| distance <= tolerance)
        }
    }

    const P: PathMode = PathMode::Continuous;
    const EXACT: PathMode = PathMode::ExactPath;

    #[test]
    fn the_nearest_piece_that_admits_a_place_judges_it() {
        let lines = Lines::new(&[
            (EXACT, 0.0, 0.1),
            (P, 0.5, 0.3),
            (P, 0.5, 0.2),
            (P, 0.5, 0.9),
        ]);
        // The move that runs, a way to it over another one, and nothing behind an exact one.
        assert_eq!(judged(&lines, [1, 1], (0, 0.1)), (2, 0.2));
        assert_eq!(judged(&lines, [3, 3], (0, 0.1)), (2, 0.2));
        assert_eq!(judged(&lines, [0, 0], (0, 0.1)), (0, 0.1));
        // What admits it is asked no further.
        assert_eq!(judged(&lines, [3, 3], (1, 0.3)), (1, 0.3));
    }

    #[test]
    fn a_corner_reaches_no_farther_than_some_tolerances() {
        let lines = |least: f64| Lines::new(&[(P, 0.5, 0.3), (P, least, 0.9), (P, 0.5, 0.9)]);
        for (least, judge) in [(0.5, (0, 0.3)), (0.31, (0, 0.3)), (0.2, (2, 0.9))] {
            assert_eq!(judged(&lines(least), [2, 2], (2, 0.9)), judge, "{least}");
        }
        let none = Lines::new(&[(P, 0.0, 0.3), (P, 0.5, 0.9)]);
        assert_eq!(judged(&none, [1, 1], (1, 0.9)), (1, 0.9));
    }

    #[test]
    fn tolerances_of_pieces_that_meet() {
        assert_eq!(wider(Some(0.0), Some(0.2)), Some(0.2));
        assert_eq!(wider(None, Some(0.2)), None);
        assert_eq!(with_merging(0.2, 0.1), 0.2 + 0.1);
        assert_eq!(with_merging(0.0, 0.1), 0.0);
    }
}
