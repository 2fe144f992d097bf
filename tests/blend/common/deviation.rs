//! How far path and program are from each other, both ways.

use framepath::axes::Axes;
use framepath::moves::TerminationCondition;
use framepath::path::{BlendedPath, ProgrammedMove};

use super::{DEFAULT_TOLERANCE, counted};

/// The greatest deviation over its tolerance, sampled densely.
pub fn greatest_deviation(path: &BlendedPath) -> f64 {
    deviation_where(path, |_| true)
}

/// The termination of a move.
fn termination(moves: &[ProgrammedMove], serial: u64) -> TerminationCondition {
    moves
        .iter()
        .find(|queued| queued.serial == serial)
        .expect("a move")
        .termination
}

const NO_TOLERANCE: TerminationCondition = TerminationCondition::Continuous { tolerance: 0.0 };

/// The same for the moves with a tolerance, or to be followed exactly.
pub fn greatest_deviation_with_tolerance(path: &BlendedPath, moves: &[ProgrammedMove]) -> f64 {
    deviation_where(path, |serial| termination(moves, serial) != NO_TOLERANCE)
}

/// Each move without a tolerance is touched in its middle, within the default tolerance, and cut
/// by no more than a quarter of half a leg for each unit of a corner's turn, which is 2 at most.
pub fn check_touched(path: &BlendedPath, moves: &[ProgrammedMove]) {
    for vertex in path.vertices(0.0) {
        let leg = path.leg(vertex.s).expect("a leg");
        if termination(moves, leg.serial) != NO_TOLERANCE {
            continue;
        }
        for k in 0..=16 {
            let s = leg.start + (leg.end - leg.start) * f64::from(k) / 16.0;
            let cut = if k == 8 {
                0.0
            } else {
                0.25 * (leg.end - leg.start)
            };
            let allowed = cut + DEFAULT_TOLERANCE + 1e-9;
            let deviation = deviation_at(path, s, allowed);
            assert!(deviation <= allowed, "{deviation} at {s}");
        }
    }
}

fn deviation_where(path: &BlendedPath, counts: impl Fn(u64) -> bool) -> f64 {
    let mut greatest = 0.0f64;
    let starts: Vec<f64> = path.vertices(0.0).map(|vertex| vertex.s).collect();
    for start in starts {
        if !counts(path.leg(start).expect("a leg").serial) {
            continue;
        }
        let leg = path.leg(start).expect("a leg");
        let tolerance = path.tolerance(start);
        for k in 0..24 {
            let s = leg.start + (leg.end - leg.start) * f64::from(k) / 24.0;
            let deviation = deviation_at(path, s, tolerance);
            // Rounding of the coordinates themselves, up to some metres.
            greatest = greatest.max((deviation - 1e-11) / tolerance);
        }
    }
    greatest
}

/// How far path and program are from each other at `s`: at equal path distance, and where that is more than is allowed on a line
/// in XYZ and UVW, from the nearest place.
fn deviation_at(path: &BlendedPath, s: f64, allowed: f64) -> f64 {
    let deviation = counted(&(path.point(s).position - path.programmed_point(s).position));
    if deviation > allowed && leads_along_a_line(path, s) {
        both_ways(path, s, deviation)
    } else {
        deviation
    }
}

/// Whether the program moves X, Y, Z or U, V, W there, on a line, and A, B and C little beside them.
fn leads_along_a_line(path: &BlendedPath, s: f64) -> bool {
    let point = path.programmed_point(s);
    let [linear, parallel] = [0, 6].map(|first| point.first.fixed_rows::<3>(first).norm());
    point.second == Axes::zeros() && linear > 0.0 && linear.hypot(parallel) > 0.8
}

/// How far the path at `s` is from the program at most, and the program from the path, where both are looked for nearby.
fn both_ways(path: &BlendedPath, s: f64, deviation: f64) -> f64 {
    let [on_path, on_program] = [path.point(s).position, path.programmed_point(s).position];
    let to_program = least_beside(path, s, deviation, |at| {
        counted(&(path.programmed_point(at).position - on_path))
    });
    let to_path = least_beside(path, s, deviation, |at| {
        counted(&(path.point(at).position - on_program))
    });
    to_program.max(to_path)
}

/// The least value within `room` of `s`.
fn least_beside(path: &BlendedPath, s: f64, room: f64, of: impl Fn(f64) -> f64) -> f64 {
    let end = path.known_end();
    let (mut middle, mut room) = (s, 2.0 * room);
    // Ever closer around the best of some places.
    for _ in 0..12 {
        let places = (-16..=16).map(|k| (middle + room * f64::from(k) / 16.0).clamp(0.0, end));
        middle = places
            .min_by(|a, b| of(*a).total_cmp(&of(*b)))
            .unwrap_or(middle);
        room *= 0.25;
    }
    of(middle)
}
