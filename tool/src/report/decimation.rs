//! Makes long recordings short enough to draw, without losing peaks or corners.

use crate::page::Envelope;
use crate::path::pieces::{Point, distance_to_segment};
use crate::path::rates::{Quantity, crosses};

/// The first row of each bucket: at most `greatest_count` buckets of equal size.
pub fn bucket_starts(rows: usize, greatest_count: usize) -> Vec<usize> {
    let count = rows.min(greatest_count);
    (0..count).map(|bucket| bucket * rows / count).collect()
}

/// The envelope of `value(row)` over the buckets; `None` counts as nothing.
pub fn envelope(starts: &[usize], rows: usize, value: impl Fn(usize) -> Option<f64>) -> Envelope {
    let ends = starts.iter().skip(1).copied().chain([rows]);
    let (low, high) = starts
        .iter()
        .zip(ends)
        .map(|(start, end)| {
            let mut values = (*start..end).filter_map(&value);
            // A bucket without any difference (the first rows) is drawn as rest.
            let first = values.next().unwrap_or(0.0);
            let (low, high) = values.fold((first, first), |(low, high), value| {
                (low.min(value), high.max(value))
            });
            (low as f32, high as f32)
        })
        .unzip();
    Envelope { low, high }
}

/// The envelope of a derivative of `positions`, not taken across `breaks`.
pub fn derivative_envelope(
    starts: &[usize],
    positions: &[f64],
    breaks: &[usize],
    quantity: Quantity,
    period: f64,
) -> Envelope {
    envelope(starts, positions.len(), |row| {
        if crosses(breaks, row, quantity.order()) {
            None
        } else {
            quantity.at(positions, row, period)
        }
    })
}

/// Rows to keep so that a polyline through them shows path and speed.
///
/// A row is kept where the path would be off by more than `tolerance` (units) or the speed by more
/// than `speed_tolerance` without it, and where `mark` changes. If more than `greatest_count` rows
/// come out, marks no longer count and both tolerances double until it is enough.
pub fn keep_rows(
    points: &[Point],
    speeds: &[f64],
    marks: &[i64],
    tolerance: f64,
    speed_tolerance: f64,
    greatest_count: usize,
) -> Vec<usize> {
    let kept = thin(points, speeds, Some(marks), tolerance, speed_tolerance);
    if kept.len() <= greatest_count {
        return kept;
    }
    let mut factor = 1.0;
    loop {
        let kept = thin(
            points,
            speeds,
            None,
            factor * tolerance,
            factor * speed_tolerance,
        );
        // 2^40 times the tolerance is beyond any machine: from there on, equal steps.
        if kept.len() <= greatest_count {
            return kept;
        }
        if factor > 1e12 {
            return bucket_starts(points.len(), greatest_count);
        }
        factor *= 2.0;
    }
}

/// One pass: a chord grows from the last kept row while all it skips lies close to its direction.
fn thin(
    points: &[Point],
    speeds: &[f64],
    marks: Option<&[i64]>,
    tolerance: f64,
    speed_tolerance: f64,
) -> Vec<usize> {
    let mut kept = vec![0];
    // The chord so far: its first row, and some of the rows that it skips.
    let (mut start, mut probes) = (0, Vec::<usize>::new());
    for row in 2..points.len() {
        let before = row - 1;
        let off_path = probes.iter().chain([&before]).any(|&probe| {
            distance_to_segment(points[probe], points[start], points[row]).0 > tolerance
        });
        let share = (before - start) as f64 / (row - start) as f64;
        let straight = speeds[start] + share * (speeds[row] - speeds[start]);
        let off_speed = (speeds[before] - straight).abs() > speed_tolerance
            || (speeds[row] - speeds[start]).abs() > 4.0 * speed_tolerance;
        let marked = marks.is_some_and(|marks| marks[before] != marks[row]);
        if off_path || off_speed || marked {
            kept.push(before);
            start = before;
            probes.clear();
        } else if (before - start).is_power_of_two() {
            // A few skipped rows stand for all: at 1, 2, 4, 8.. rows behind the start.
            probes.push(before);
        }
    }
    if points.len() > 1 {
        kept.push(points.len() - 1);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_single_spike_survives() {
        let mut values = vec![0.0; 100_000];
        values[77_777] = 5.0;
        values[33_333] = -4.0;
        let starts = bucket_starts(values.len(), 500);
        let found = envelope(&starts, values.len(), |row| Some(values[row]));
        assert_eq!(found.low.len(), 500);
        assert_eq!(found.high.iter().copied().fold(0.0, f32::max), 5.0);
        assert_eq!(found.low.iter().copied().fold(0.0, f32::min), -4.0);
        assert_eq!(found.high[77_777 / 200], 5.0);
    }

    #[test]
    fn corners_are_kept_and_straight_runs_are_not() {
        let points: Vec<Point> = (0..=2000)
            .map(|i| {
                let s = f64::from(i) * 0.01;
                [s.min(10.0), (s - 10.0).max(0.0), 0.0]
            })
            .collect();
        let speeds = vec![10.0; points.len()];
        let marks = vec![1; points.len()];
        let kept = keep_rows(&points, &speeds, &marks, 1e-3, 1.0, 100);
        assert!(kept.contains(&1000) && kept.len() <= 4, "{kept:?}");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn what_is_kept_is_in_order_few_and_close(radius in 1.0f64..50.0, limit in 40usize..400) {
            let points: Vec<Point> = (0..3000)
                .map(|i| {
                    let angle = f64::from(i) * 0.004;
                    [radius * angle.cos(), radius * angle.sin(), 0.1 * angle]
                })
                .collect();
            let speeds = vec![1.0; points.len()];
            let marks: Vec<i64> = (0..3000).map(|i| i / 7).collect();
            let kept = keep_rows(&points, &speeds, &marks, 1e-3 * radius, 1.0, limit);
            prop_assert!(kept.len() <= limit.max(1));
            prop_assert!(kept.windows(2).all(|pair| pair[0] < pair[1]));
            let farthest = kept
                .windows(2)
                .flat_map(|pair| (pair[0]..pair[1]).map(|row| {
                    distance_to_segment(points[row], points[pair[0]], points[pair[1]]).0
                }))
                .fold(0.0, f64::max);
            prop_assert!(farthest < 0.3 * radius, "{farthest} of {radius}");
        }
    }
}
