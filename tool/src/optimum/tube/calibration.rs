//! The optimum in the tube against what has a closed form, and against the optimum on a path.

use super::{InTube, Leg, least_time_in_tube};
use crate::optimum::limits::{AXES, AxisLimits};
use crate::path::pieces::Point;
use std::f64::consts::TAU;

const PERIOD: f64 = 1e-3;
const LIMITS: AxisLimits = AxisLimits {
    velocity: [100.0; AXES],
    acceleration: [1000.0; AXES],
    jerk: [20_000.0; AXES],
};
const SPEED: f64 = 100.0;

/// A motion along the legs from rest to rest in each of them, by a polynomial of the fifth degree: far from the
/// optimum. `mean` is its mean speed, mm/s.
fn executed(legs: &[Leg], mean: f64) -> Vec<Point> {
    let mut positions = vec![legs[0].start];
    for leg in legs {
        let travel: Point = std::array::from_fn(|axis| leg.end[axis] - leg.start[axis]);
        let length = travel.iter().map(|part| part * part).sum::<f64>().sqrt();
        let count = (length / mean / PERIOD).ceil();
        positions.extend((1..=count as usize).map(|k| {
            let t = k as f64 / count;
            let share = t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
            std::array::from_fn(|axis| leg.start[axis] + share * travel[axis])
        }));
    }
    positions
}

fn legs(points: &[Point], radius: f64) -> Vec<Leg> {
    let pairs = points.windows(2);
    pairs
        .map(|pair| Leg {
            start: pair[0],
            end: pair[1],
            radius,
            speed: SPEED,
        })
        .collect()
}

fn found(legs: &[Leg], mean: f64, limits: &AxisLimits, steps: usize) -> InTube {
    least_time_in_tube(legs, &executed(legs, mean), PERIOD, limits, steps).expect("an optimum")
}

#[test]
fn a_line_to_half_a_percent() {
    // .6 and .8 of it along X and Z: the tube lets a motion that is long against its radius gain nothing.
    for (length, exact) in [
        (10.0, 0.05 + (0.0025_f64 + 4.0 * 10.0 / 1250.0).sqrt()),
    ] {
        let line = legs(&[[0.0; 3], [0.6 * length, 0.0, 0.8 * length]], 0.01);
        let found = found(&line, 30.0, &LIMITS, 150);
        eprintln!("{found:?} {exact}");
        assert!((found.time / exact - 1.0).abs() < 5e-3, "{found:?} {exact}");
    }
}

#[test]
fn a_corner() {
    for radius in [0.05, 0.5] {
        let corner = legs(&[[0.0; 3], [10.0, 0.0, 0.0], [10.0, 10.0, 0.0]], radius);
        let start = std::time::Instant::now();
        let found = found(&corner, 25.0, &LIMITS, 200);
        eprintln!("{radius} {found:?} {:?}", start.elapsed());
    }
}

#[test]
fn a_circle_of_chords() {
    let points: Vec<Point> = (0..=60)
        .map(|k| {
            let (sine, cosine) = (TAU * f64::from(k) / 60.0).sin_cos();
            [5.0 * sine, 5.0 - 5.0 * cosine, 0.0]
        })
        .collect();
    let start = std::time::Instant::now();
    let found = found(&legs(&points, 0.05), 10.0, &LIMITS, 250);
    eprintln!("{found:?} {:?}", start.elapsed());
}
