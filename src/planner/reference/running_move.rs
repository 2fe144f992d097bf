//! Which move runs at a place of the path.

use crate::moves::MoveQueue;
use crate::path::BlendedPath;

/// How far behind the end of a line that was merged with the next one the machine rests, path distance: the number is
/// that of the next one there, in spite of rounding.
const BEHIND_END: f64 = 1e-8;

/// Serial number of the move at path distance `s`, and what F will count until its end.
///
/// Where lines were merged it is told by their lengths.
pub(super) fn running(path: &BlendedPath, queue: &MoveQueue, s: f64) -> Option<(u64, f64)> {
    let progress = path.progress(s)?;
    let first = progress.first.max(queue.oldest());
    if first >= progress.serial {
        return Some((progress.serial, progress.distance_to_go));
    }
    let lengths = |from: u64| {
        (from..=progress.serial)
            .filter_map(|serial| queue.get(serial))
            .map(|queued| queued.shape.length())
    };
    // Counted from the end, since the moves at the start may be forgotten.
    let mut left: f64 = lengths(first).sum();
    for serial in first..progress.serial {
        let length = queue.get(serial)?.shape.length();
        if progress.distance_to_go > left - length {
            return Some((serial, progress.distance_to_go - (left - length)));
        }
        left -= length;
    }
    Some((progress.serial, progress.distance_to_go.min(left)))
}

/// Where the line ends, path distance, that is under way at `s`, if it was merged with the next one.
pub(super) fn end_of_merged_line(path: &BlendedPath, queue: &MoveQueue, s: f64) -> Option<f64> {
    let leg = path.leg(s)?;
    let (serial, distance_to_go) = running(path, queue, s)?;
    (serial < leg.serial).then(|| s + distance_to_go / leg.measure_rate + BEHIND_END)
}
