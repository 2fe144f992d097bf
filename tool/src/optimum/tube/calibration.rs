//! The optimum in the tube against what has a closed form, and against the optimum on a path.

use super::course::{Course, Place};
use super::matching::places;
use super::{InTube, Leg, NoTube, least_time_in_tube};
use crate::optimum::limits::{COORDINATES, PathLimits};
use crate::path::pieces::{Point, distance, distance_to_segment};
use std::array::from_fn;
use std::f64::consts::TAU;

const PERIOD: f64 = 1e-3;
const LIMITS: PathLimits = PathLimits {
    velocity: [100.0; COORDINATES],
    acceleration: [1000.0; COORDINATES],
    jerk: [20_000.0; COORDINATES],
};

fn legs(points: &[Point], radius: f64, speed: f64) -> Vec<Leg> {
    let leg = |pair: &[Point]| Leg {
        start: pair[0],
        end: pair[1],
        radius,
        speed,
    };
    points.windows(2).map(leg).collect()
}

/// From rest to rest along the legs, by a polynomial of the fifth degree, which is far from the optimum: `mean` is the
/// mean speed, mm/s, `stops` whether it is so in each leg.
fn executed(legs: &[Leg], mean: f64, stops: bool) -> Vec<Point> {
    let smooth = |t: f64| t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
    let lengths: Vec<f64> = legs
        .iter()
        .map(|leg| distance(leg.start, leg.end))
        .collect();
    let mut positions = vec![legs[0].start];
    if stops {
        for (leg, length) in legs.iter().zip(&lengths) {
            let count = (length / mean / PERIOD).ceil();
            positions.extend((1..=count as usize).map(|k| at(leg, smooth(k as f64 / count))));
        }
        return positions;
    }
    let whole: f64 = lengths.iter().sum();
    let count = (whole / mean / PERIOD).ceil();
    for k in 1..=count as usize {
        let mut left = whole * smooth(k as f64 / count);
        let mut index = 0;
        while left > lengths[index] && index + 1 < legs.len() {
            left -= lengths[index];
            index += 1;
        }
        positions.push(at(&legs[index], left / lengths[index]));
    }
    positions
}

fn at(leg: &Leg, share: f64) -> Point {
    from_fn(|axis| leg.start[axis] + share * (leg.end[axis] - leg.start[axis]))
}

/// What is found, after a look at it that is independent of the one that lets it count: its positions at close
/// distances, and their differences.
fn found(legs: &[Leg], positions: &[Point], limits: &PathLimits) -> InTube {
    let found = least_time_in_tube(legs, positions, PERIOD, limits).expect("an optimum");
    assert!(
        found.deviation <= 1.002 && found.limits <= 1.002,
        "{found:?}"
    );
    let motion = &found.motion;
    const PARTS: usize = 10;
    let fine: Vec<Point> = (0..motion.steps())
        .flat_map(|step| {
            (0..PARTS).map(move |part| motion.position(step, part as f64 / PARTS as f64))
        })
        .collect();
    for point in &fine {
        let far = legs
            .iter()
            .map(|leg| distance_to_segment(*point, leg.start, leg.end).0 / leg.radius)
            .fold(f64::INFINITY, f64::min);
        assert!(far <= 1.002, "{far} at {point:?}");
    }
    let h = found.step() / PARTS as f64;
    for four in fine.windows(4) {
        let velocity: Point = from_fn(|axis| (four[1][axis] - four[0][axis]) / h);
        assert!(distance(velocity, [0.0; 3]) <= 1.003 * legs[0].speed);
        let of_axes = limits.acceleration.iter().zip(&limits.jerk).take(3);
        for (axis, (most, most_jerk)) in of_axes.enumerate() {
            let [a, b, c, d]: [f64; 4] = from_fn(|k| four[k][axis]);
            let acceleration = (c - 2.0 * b + a).abs() / (h * h);
            let jerk = (d - 3.0 * c + 3.0 * b - a).abs() / h.powi(3);
            assert!(acceleration <= 1.003 * most, "{acceleration}");
            assert!(jerk <= 1.003 * most_jerk, "{jerk}");
        }
    }
    found
}

fn assert_between(found: f64, least: f64, most: f64) {
    assert!(
        found >= least && found <= most,
        "{found} not in {least} to {most}"
    );
}

/// Rest to rest on a line that reaches full acceleration and no speed.
fn line_time(length: f64, acceleration: f64, jerk: f64) -> f64 {
    let ramp = acceleration / jerk;
    ramp + (ramp * ramp + 4.0 * length / acceleration).sqrt()
}

#[test]
fn a_line_to_half_a_percent() {
    // Along (.6, 0, .8) X and Z allow 1250 mm/s2 and 25000 mm/s3.
    let line = legs(&[[0.0; 3], [6.0, 0.0, 8.0]], 0.01, 100.0);
    let exact = line_time(10.0, 1250.0, 25_000.0);
    let found = found(&line, &executed(&line, 25.0, true), &LIMITS);
    assert_between(found.time(), 0.995 * exact, 1.005 * exact);
}

#[test]
fn a_line_without_a_limit_of_jerk_to_half_a_percent() {
    let mut limits = LIMITS;
    limits.jerk = [f64::INFINITY; COORDINATES];
    let line = legs(&[[0.0; 3], [9.0, 0.0, 0.0]], 0.01, 30.0);
    // 30 mm/s after 30 ms.
    let exact = 9.0 / 30.0 + 30.0 / 1000.0;
    let found = found(&line, &executed(&line, 20.0, true), &limits);
    assert_between(found.time(), 0.995 * exact, 1.005 * exact);
}

#[test]
fn a_corner_is_faster_with_more_tolerance_and_than_with_a_stop() {
    let corner = |radius| {
        let corner = legs(
            &[[0.0; 3], [10.0, 0.0, 0.0], [10.0, 10.0, 0.0]],
            radius,
            100.0,
        );
        found(&corner, &executed(&corner, 30.0, true), &LIMITS).time()
    };
    let (narrow, wide) = (corner(0.05), corner(0.5));
    let stop = 2.0 * line_time(10.0, 1000.0, 20_000.0);
    assert!(
        wide < 0.95 * narrow && narrow < 0.95 * stop,
        "{wide} {narrow} {stop}"
    );
    // The way over the diagonal of the tube, with the whole acceleration of both axes.
    assert!(wide > line_time(10.0, 1000.0, 20_000.0), "{wide}");
}

#[test]
fn a_point_of_return_is_not_left_out() {
    let there = [10.0, 0.0, 0.0];
    let back = legs(&[[0.0; 3], there, [0.0; 3]], 0.1, 100.0);
    let found = found(&back, &executed(&back, 30.0, true), &LIMITS);
    let motion = &found.motion;
    let farthest = motion
        .knots()
        .iter()
        .map(|point| point[0])
        .fold(0.0, f64::max);
    assert!(farthest > 9.89, "{farthest}");
    // It turns with the whole acceleration: the two ramps of jerk at the point are not needed.
    let stop = 2.0 * line_time(10.0, 1000.0, 20_000.0);
    assert_between(found.time(), 0.8 * stop, 0.96 * stop);
}

#[test]
fn a_circle_of_chords_at_its_feed_to_the_tolerance() {
    let (radius, tolerance, feed) = (2.0, 0.02, 20.0);
    let points: Vec<Point> = (0..=40)
        .map(|k| {
            let (sine, cosine) = (TAU * f64::from(k) / 40.0).sin_cos();
            [radius * sine, radius - radius * cosine, 0.0]
        })
        .collect();
    let circle = legs(&points, tolerance, feed);
    let found = found(&circle, &executed(&circle, 14.0, false), &LIMITS);
    // Each of both ramps takes half of its time more than the same distance at the feed; within the tolerance and the
    // chords' own .006 mm the circle is smaller.
    let exact = |radius: f64| TAU * radius / feed + 2.0 * (feed / 20_000.0_f64).sqrt();
    assert_between(
        found.time(),
        exact(radius - tolerance - 0.0065),
        exact(radius),
    );
}

#[test]
fn too_many_steps_are_refused() {
    let line = legs(&[[0.0; 3], [100.0, 0.0, 0.0]], 0.001, 100.0);
    let refused = least_time_in_tube(&line, &executed(&line, 20.0, true), PERIOD, &LIMITS);
    assert!(
        matches!(refused, Err(NoTube::TooLong { .. })),
        "{refused:?}"
    );
    assert_eq!(
        least_time_in_tube(&line[..0], &[], PERIOD, &LIMITS),
        Err(NoTube::NoMotion)
    );
}

#[test]
fn places_are_in_order_where_the_course_comes_back_on_itself() {
    let back = legs(&[[0.0; 3], [10.0, 0.0, 0.0], [0.0; 3]], 0.1, 100.0);
    let course = Course::new(&back).expect("a course");
    let points = [0.0, 5.0, 9.95, 5.0, 0.0].map(|x| [x, 0.05, 0.0]);
    let found = places(&course, &points);
    let legs: Vec<usize> = found.iter().map(|place| place.leg).collect();
    assert_eq!((legs[1], legs[3]), (0, 1));
    for (place, along) in found.iter().zip([0.0, 5.0]) {
        assert!((place.along - along).abs() < 1e-9, "{place:?}");
    }
    assert_eq!(
        found[4],
        Place {
            leg: 1,
            along: 10.0
        }
    );
}

#[test]
fn a_line_is_followed_while_the_course_turns_little() {
    let points = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.1, 0.0], [2.0, 1.1, 0.0]];
    let course = Course::new(&legs(&points, 0.1, 100.0)).expect("a course");
    let line = course.line(
        Place {
            leg: 0,
            along: 0.25,
        },
        10.0,
    );
    assert_eq!((line.back.reach, line.back.slope), (0.25, 0.0));
    // To the second vertex, .1 mm beside the line 1 mm behind the first; not around the corner.
    assert!((line.ahead.exactly - 0.75).abs() < 1e-12 && (line.ahead.reach - 1.75).abs() < 1e-12);
    assert!((line.ahead.slope - 0.1).abs() < 1e-12, "{line:?}");
    assert_eq!(course.line_at(2, 10.0), None);
    let middle = course.line_at(1, 10.0).expect("a line");
    assert!((middle.ahead.slope - middle.back.slope).abs() < 1e-12 && middle.ahead.slope < 0.051);
}
