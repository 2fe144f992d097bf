//! Runs of moves, and where their vertices are moved.

use super::super::leg::ProgrammedMove;
use super::super::metric::Metric;
use super::*;
use nalgebra::Vector3;

use crate::axes::{Axes, AxisLimits};
use crate::moves::shape::{Arc9, Circle, Line9, Shape};
use crate::moves::{NearLimit, TerminationCondition};
use core::f64::consts::PI;

const TOLERANCE: f64 = 0.05;

/// Lines through these points at 100 mm/s, faired while they come, one by one.
fn faired(points: &[[f64; 2]]) -> Vec<Leg> {
    faired_by(&mut Box::new(Fairing::new()), points, false)
}

fn faired_by(fairing: &mut Fairing, points: &[[f64; 2]], waits: bool) -> Vec<Leg> {
    let line = |ends: &[[f64; 2]]| {
        let line = Line9::new(&at(ends[0]), &at(ends[1]));
        Shape::Line(line.expect("a line"))
    };
    let lines: Vec<_> = points.windows(2).map(line).collect();
    faired_shapes(fairing, &lines, waits)
}

fn at(point: [f64; 2]) -> Axes {
    Axes::from_fn(|axis, _| point.get(axis).copied().unwrap_or(0.0))
}

/// `waits`: with nothing done before there is no room for another one.
fn faired_shapes(fairing: &mut Fairing, shapes: &[Shape], waits: bool) -> Vec<Leg> {
    let limits = AxisLimits {
        velocity: Axes::repeat(100.0),
        acceleration: Axes::repeat(1000.0),
        jerk: Axes::repeat(20_000.0),
    };
    let settings = BlendSettings::new(1.0, 0.1, 0.02, &limits).expect("sound");
    let metric = Metric::new(settings.rotary_weight());
    let mut legs = Vec::new();
    for (serial, shape) in (1..).zip(shapes) {
        let programmed = ProgrammedMove {
            serial,
            shape: *shape,
            feed: 100.0,
            feed_word: None,
            greatest_feed: 100.0,
            termination: TerminationCondition::Continuous {
                tolerance: TOLERANCE,
            },
            stop_before: false,
            separate: false,
            may_swing_out: true,
            near_limit: NearLimit::NONE,
        };
        fairing.take(Leg::new(&programmed, &settings, &metric), &settings);
        if !waits || fairing.is_full() {
            legs.extend(settled(fairing));
        }
    }
    fairing.flush(&settings);
    assert!(fairing.is_pressed());
    legs.extend(settled(fairing));
    assert!(!fairing.is_pressed());
    assert_eq!((fairing.waiting(), fairing.waiting_length()), (0, 0.0));
    let mut start = 0.0;
    for leg in &mut legs {
        leg.start = start;
        start = leg.end();
    }
    legs
}

/// What becomes final by all the work that there is.
fn settled(fairing: &mut Fairing) -> Vec<Leg> {
    let mut legs = Vec::new();
    while fairing.step() > 0 {
        legs.extend(core::iter::from_fn(|| fairing.next()));
    }
    legs
}

fn shifts(legs: &[Leg]) -> Vec<f64> {
    let ends = legs.iter().map(|leg| leg.shift_at(leg.end()).norm());
    ends.collect()
}

/// The sum over the third divided differences of the vertices, where they are and where the program has them.
fn sums(legs: &[Leg]) -> [f64; 2] {
    [false, true].map(|programmed| {
        let place = |leg: &Leg, s: f64| {
            if programmed {
                leg.programmed_point(s).position
            } else {
                leg.point(s).position
            }
        };
        let thirds = legs.windows(3).map(|legs| {
            let [one, two, three] = legs else {
                return 0.0;
            };
            let places = [
                place(one, one.start),
                place(two, two.start),
                place(three, three.start),
                place(three, three.end()),
            ];
            let counts = piece::third([one.length, two.length, three.length]);
            let terms = places.iter().zip(counts);
            terms
                .map(|(place, counts)| place * counts)
                .sum::<Axes>()
                .norm_squared()
        });
        thirds.sum()
    })
}

fn staircase(steps: u32) -> Vec<[f64; 2]> {
    let corner = |k: u32| [0.03 * f64::from(k.div_ceil(2)), 0.03 * f64::from(k / 2)];
    (0..=2 * steps).map(corner).collect()
}

#[test]
fn a_staircase_is_made_even_within_its_room() {
    let legs = faired(&staircase(60));
    let shifts = shifts(&legs);
    let greatest = shifts
        .iter()
        .fold(0.0, |greatest, shift| f64::max(greatest, *shift));
    assert!(greatest <= TOLERANCE, "{greatest}");
    assert_eq!(shifts.last(), Some(&0.0));
    let [moved, programmed] = sums(&legs);
    assert!(moved < 1e-3 * programmed, "{moved} {programmed}");
}

#[test]
fn what_was_moved_before_a_path_does_not_matter_to_it() {
    let mut fairing = Box::new(Fairing::new());
    for steps in [60, 63, 64, 65, 60] {
        fairing.clear();
        let again = faired_by(&mut fairing, &staircase(steps), false);
        assert_eq!(
            shifts(&again),
            shifts(&faired(&staircase(steps))),
            "{steps}"
        );
    }
}

#[test]
fn when_the_work_is_done_does_not_matter() {
    // Runs of less than a window and of more, with lone corners between them.
    let mut points = Vec::new();
    for (run, steps) in (0u32..).zip([3, 40, 5, 13, 14, 15, 16, 1]) {
        let offset = 20.0 * f64::from(run);
        points.extend(staircase(steps).iter().map(|[x, y]| [x + offset, *y]));
        points.push([offset + 10.0, -5.0]);
    }
    let mut fairing = Box::new(Fairing::new());
    let waiting = faired_by(&mut fairing, &points, true);
    assert_eq!(shifts(&waiting), shifts(&faired(&points)));
}

#[test]
fn moved_lines_meet() {
    for legs in faired(&staircase(60)).windows(2) {
        let [before, after] = legs else {
            return;
        };
        assert_eq!(before.shift_at(before.end()), after.shift_at(after.start));
    }
}

#[test]
fn corners_that_stand_alone_stay_as_they_are() {
    let square = [[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 5.0], [0.0, 0.0]];
    let legs = faired(&square);
    assert_eq!(legs.len(), 4);
    assert_eq!(shifts(&legs), [0.0; 4]);
}

#[test]
fn corners_are_moved_together_with_denser_ones_before_them() {
    // Their kernels are a quarter as wide as the lines are long.
    let wave = |k: u32| [f64::from(k), 0.6 * f64::from(k % 2)];
    let alone: Vec<_> = (0..20).map(wave).collect();
    assert!(shifts(&faired(&alone)).iter().all(|shift| *shift == 0.0));
    let mut behind = staircase(10);
    let [x, y] = behind[behind.len() - 1];
    behind.extend((1..20).map(wave).map(|[dx, dy]| [x + dx, y + dy]));
    let legs = faired(&behind);
    let of_wave = legs.iter().filter(|leg| leg.serial > 21 && leg.serial < 39);
    assert!(of_wave.filter(|leg| leg.is_last_part).count() == 17);
    let moved = legs
        .iter()
        .filter(|leg| leg.serial > 21 && leg.is_last_part);
    let moved = moved.map(|leg| leg.shift_at(leg.end()).norm());
    assert!(moved.take(17).all(|shift| shift > 0.1 * TOLERANCE));
}

/// An arc of a radius of 1 mm about a place, counter-clockwise between two angles.
fn arc([x, y]: [f64; 2], from: f64, to: f64) -> Shape {
    let place = |angle: f64| at([x + angle.cos(), y + angle.sin()]);
    let circle = Circle {
        center: Vector3::new(x, y, 0.0),
        normal: Vector3::new(0.0, 0.0, 1.0),
        revolutions: 0,
    };
    Shape::Arc(Arc9::new(&place(from), &place(to), &circle).expect("an arc"))
}

#[test]
fn arcs_are_divided_beside_corners_and_moved() {
    // A scalloped edge.
    let scallops: Vec<_> = (0..12)
        .map(|k| {
            arc(
                [-2.0 * 0.4f64.sin() * f64::from(k), 0.0],
                PI / 2.0 - 0.4,
                PI / 2.0 + 0.4,
            )
        })
        .collect();
    let mut fairing = Box::new(Fairing::new());
    let legs = faired_shapes(&mut fairing, &scallops, false);
    assert!(legs.len() > 3 * scallops.len());
    assert!(legs.iter().all(|leg| leg.turning * leg.length < 0.6));
    let shifts = shifts(&legs);
    assert!(shifts.iter().all(|shift| *shift <= TOLERANCE));
    assert!(shifts.iter().filter(|shift| **shift > 0.0).count() > 2 * scallops.len());
    for legs in legs.windows(2) {
        let [before, after] = legs else {
            return;
        };
        let gap = before.point(before.end()).position - after.point(after.start).position;
        assert!(gap.norm() < 1e-12, "{gap}");
    }
}

#[test]
fn a_circle_stays_as_it_is() {
    let halves = [arc([0.0, 0.0], 0.0, PI), arc([0.0, 0.0], PI, 2.0 * PI)];
    let mut fairing = Box::new(Fairing::new());
    let legs = faired_shapes(&mut fairing, &halves, false);
    assert_eq!(shifts(&legs), [0.0; 2]);
}

#[test]
fn a_circle_of_chords_does_not_shrink() {
    let point = |k: u32| {
        let angle = f64::from(k) * 0.05;
        [10.0 * angle.cos(), 10.0 * angle.sin()]
    };
    let circle: Vec<_> = (0..200).map(point).collect();
    let shifts = shifts(&faired(&circle));
    assert!(
        shifts.iter().all(|shift| *shift < 0.1 * TOLERANCE),
        "{shifts:?}"
    );
}

#[test]
fn the_parts_of_a_line_make_up_the_whole_one() {
    let bend = [[0.0, 0.0], [2.0, 0.0], [2.02, 0.3], [2.0, 0.6], [0.0, 0.6]];
    let legs = faired(&bend);
    let first: Vec<_> = legs.iter().filter(|leg| leg.serial == 1).collect();
    assert!(first.len() > 2);
    assert!(first.iter().all(|leg| leg.whole == 2.0));
    let mut lead = 0.0;
    for (number, leg) in first.iter().enumerate() {
        assert!((leg.lead - lead).abs() < 1e-12);
        assert_eq!(leg.is_last_part, number + 1 == first.len());
        assert!((leg.measured(leg.start) - lead).abs() < 1e-12);
        lead += leg.length;
    }
    assert!((lead - 2.0).abs() < 1e-12);
    let last = first[first.len() - 1];
    assert_eq!(last.measured(last.end()), 2.0);
}
