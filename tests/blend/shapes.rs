//! Programs whose blended path is known: corners, dense code, easements, G61, stops, merging.

use crate::common::*;
use framepath::axes::Axes;
use framepath::moves::TerminationCondition;
use framepath::moves::shape::measure::Measure;
use framepath::moves::shape::{Line9, PathPoint, Shape};
use framepath::path::{BlendError, BlendedPath, GREATEST_EXCESS, ProgrammedMove};

/// A corner of lines of 10 mm at 90 degrees with P .05, which may swing out or not.
fn corner(may_swing_out: bool) -> [ProgrammedMove; 2] {
    let moves = [
        line(1, (0.0, 0.0), (10.0, 0.0), 0.05),
        line(2, (10.0, 0.0), (10.0, 10.0), 0.05),
    ];
    moves.map(|one| ProgrammedMove {
        may_swing_out,
        ..one
    })
}

#[test]
fn a_corner_uses_its_tolerance() {
    with_path(|path| {
        complete(path, &corner(false));
        let corner = path.point(10.0).position;
        let cut = Axes::from([10.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]) - corner;
        assert!((cut.norm() - 0.97 * 0.05).abs() < 1e-12);
        let vertex = path.vertices(5.0).next().expect("the corner");
        // At 20 m/s^3 the kernel is peaked: phi in its middle is 0.1367 of its width.
        let peak = 0.15625 - 2.0 / 9.0 * (0.15625 - 0.068359375);
        assert!((vertex.reach - 0.97 * 0.05 / (peak * 2f64.sqrt())).abs() < 1e-12);
        assert!(!vertex.stop);
        // Outside of the kernel the path is that of the program, to the last digit.
        assert_eq!(
            path.point(10.0 - vertex.reach).position,
            path.programmed_point(10.0 - vertex.reach).position
        );
    });
}

#[test]
fn a_corner_that_swings_out_uses_it_on_both_sides() {
    with_path(|path| {
        complete(path, &corner(false));
        let sharp = path.point(10.0).second.amax();
        path.restart(&settings(), &Axes::zeros());
        complete(path, &corner(true));
        // To the inner side in the middle, to the outer side before it and behind it.
        let middle = path.point(10.0).position;
        assert!((10.0 - middle[0]).hypot(middle[1]) < 0.97 * 0.05 + 1e-12);
        // From the first leg, which leads along X.
        let outer = |s: f64| -path.point(s).position[1];
        let greatest = (0..1000)
            .map(|k| outer(0.01 * f64::from(k)))
            .fold(0.0, f64::max);
        assert!((0.85..0.97).contains(&(greatest / 0.05)), "{greatest}");
        assert!(path.point(10.0).second.amax() < 0.55 * sharp);
        let vertex = path.vertices(5.0).next().expect("the corner");
        assert!(
            vertex.reach > 3.6 && vertex.reach < 3.7 && vertex.core > 0.8 && vertex.core < 0.9,
            "{vertex:?}"
        );
    });
}

/// Where a corner of two lines reaches, and its path and what is final of it, where the second line is known at once or later.
fn corner_of(angle: f64, tolerance: f64, later: bool) -> (f64, Vec<Axes>, f64) {
    let (sine, cosine) = angle.to_radians().sin_cos();
    let end = (30.0 + 40.0 * cosine, 40.0 * sine);
    let moves = [
        line(1, (0.0, 0.0), (30.0, 0.0), tolerance),
        line(2, (30.0, 0.0), end, tolerance),
    ];
    with_path(move |path| {
        for queued in moves {
            let may_swing_out = true;
            path.add(&ProgrammedMove {
                may_swing_out,
                ..queued
            })
            .expect("room");
            if later || queued.serial == 2 {
                path.flush();
                path.step(10_000);
            }
        }
        let corner = path.vertices(5.0).next().expect("the corner");
        let places = (2100..3900).step_by(10).map(|k| 0.01 * f64::from(k));
        let positions = places.map(|s| path.point(s).position).collect();
        (corner.reach, positions, path.final_end())
    })
}

#[test]
fn a_corner_does_not_depend_on_when_its_second_leg_comes() {
    // One rounded over more than the 8 mm of a swing has what the machine has left of its first leg.
    let mut swing_out = 0;
    for angle in [10.0, 20.0, 45.0, 90.0, 120.0, 150.0, 175.0] {
        for tolerance in [0.01, 0.05, 0.15] {
            let at_once = corner_of(angle, tolerance, false);
            let later = corner_of(angle, tolerance, true);
            assert!(at_once == later, "{angle} degrees, P {tolerance}");
            swing_out += usize::from(at_once.0 > 7.9);
        }
    }
    assert!(swing_out > 10, "{swing_out}");
}

/// Each derivative is the slope of the one before, and the third does not jump between `from` and
/// `to`, seen at steps of `step`.
fn check_derivatives(path: &BlendedPath, from: f64, to: f64, step: f64) {
    let count = ((to - from) / step) as u32;
    let points: Vec<_> = (0..=count)
        .map(|k| path.point(from + step * f64::from(k)))
        .collect();
    let greatest =
        |of: fn(&PathPoint) -> Axes| points.iter().map(|p| of(p).amax()).fold(0.0, f64::max);
    let bounds = [
        greatest(|p| p.first),
        greatest(|p| p.second),
        greatest(|p| p.third),
    ];
    for three in points.windows(3) {
        let [before, here, after] = three else {
            panic!("windows of three");
        };
        let slope = |a: Axes, b: Axes| (b - a) / (2.0 * step);
        let errors = [
            slope(before.position, after.position) - here.first,
            slope(before.first, after.first) - here.second,
            slope(before.second, after.second) - here.third,
        ];
        for (order, (error, bound)) in errors.iter().zip(bounds).enumerate() {
            assert!(
                error.amax() <= 0.01 * bound + 1e-9,
                "{order}: {error} {bound}"
            );
        }
        let jump = (here.third - before.third).amax();
        assert!(
            jump <= 0.02 * bounds[2] + 1e-9,
            "the third derivative jumps by {jump}"
        );
    }
}

#[test]
fn derivatives_are_those_of_the_position_and_the_third_is_continuous() {
    with_path(|path| {
        let corner = [
            line(1, (0.0, 0.0), (10.0, 0.0), 0.05),
            line(2, (10.0, 0.0), (10.0, 10.0), 0.05),
        ];
        complete(path, &corner);
        check_derivatives(path, 9.5, 10.5, 2e-4);
        complete(path, &contour(0.2, 200, 0.01, 0.0025));
        check_derivatives(path, 10.0, 30.0, 1e-3);
        complete(path, &contour(1.0, 40, 0.02, 0.0));
        check_derivatives(path, 10.0, 30.0, 1e-3);
    });
}

#[test]
fn an_exact_reversal_is_rounded_too() {
    with_path(|path| {
        let moves = [
            line(1, (0.0, 0.0), (10.0, 0.0), 0.05),
            line(2, (10.0, 0.0), (0.0, 0.0), 0.05),
        ];
        complete(path, &moves);
        let turning = path.point(10.0);
        assert!((turning.position[0] - (10.0 - 0.97 * 0.05)).abs() < 1e-12);
        assert!(turning.first.norm() < 1e-12);
        assert!(turning.second.norm() > 1.0 && turning.third.norm() < 1e-9);
    });
}

#[test]
fn dense_code_is_smoothed_over_many_lines() {
    with_path(|path| {
        let moves = contour(0.2, 500, 0.01, 0.0025);
        complete(path, &moves);
        assert!(greatest_deviation(path) <= 1.0);
        let reach: Vec<f64> = path
            .vertices(0.0)
            .filter(|vertex| !vertex.stop)
            .map(|vertex| vertex.reach)
            .collect();
        let mean = reach.iter().sum::<f64>() / reach.len() as f64;
        assert!(mean > 1.0, "mean width {mean} mm on lines of 0.2 mm");
        // As bent as the contour itself, 0.3 per mm at most, not as its rounded points.
        for k in 100..900 {
            let s = 0.1 * f64::from(k);
            assert!(path.point(s).second.norm() < 0.5, "at {s}");
        }
    });
}

#[test]
fn what_is_final_follows_closely() {
    with_path(|path| {
        path.restart(&settings(), &Axes::zeros());
        for (k, queued) in contour(0.2, 500, 0.01, 0.0).iter().enumerate() {
            path.add(queued).expect("room");
            path.step(20_000);
            if k > 50 {
                let lag = path.programmed_end() - path.final_end();
                assert!(lag < 8.0, "{lag} mm behind after {k} lines");
            }
        }
    });
}

#[test]
fn very_short_lines_are_merged_within_the_tolerance() {
    with_path(|path| {
        let moves = contour(0.0185, 1500, 0.005, 0.0001);
        complete(path, &moves);
        let legs = path.vertices(0.0).count();
        assert!(legs < moves.len() / 2, "{legs} legs");

        let samples: Vec<Axes> = (0..30_000)
            .map(|k| {
                path.point(path.known_end() * f64::from(k) / 29_999.0)
                    .position
            })
            .collect();
        let to_chord = |point: &Axes, from: &Axes, to: &Axes| {
            let (way, chord) = (point - from, to - from);
            let share = (way.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            (way - chord * share).norm()
        };
        let ends: Vec<Axes> = core::iter::once(Axes::zeros())
            .chain(moves.iter().map(|queued| queued.shape.end()))
            .collect();
        let near = |k: usize, of: usize, count: usize| {
            let middle = k * count / of;
            middle.saturating_sub(60)..(middle + 60).min(count - 1)
        };
        for (k, sample) in samples.iter().enumerate() {
            let distance = near(k, samples.len(), ends.len())
                .map(|j| to_chord(sample, &ends[j], &ends[j + 1]))
                .fold(f64::INFINITY, f64::min);
            assert!(distance <= 0.005, "leaves the program by {distance}");
        }
        for (k, end) in ends.iter().enumerate() {
            let middle = k * samples.len() / ends.len();
            let distance = (middle.saturating_sub(1000)..(middle + 1000).min(samples.len() - 1))
                .map(|j| to_chord(end, &samples[j], &samples[j + 1]))
                .fold(f64::INFINITY, f64::min);
            assert!(distance <= 0.005, "misses a point by {distance}");
        }
        let last = path.progress(path.known_end()).expect("moves");
        assert_eq!(last.serial, moves.last().expect("moves").serial);
        assert_eq!(last.distance_to_go, 0.0);
    });
}

#[test]
fn a_move_that_must_stay_separate_does() {
    with_path(|path| {
        let mut moves = vec![line(1, (0.0, 0.0), (0.01, 0.0), 0.05)];
        for k in 2..6u32 {
            let x = 0.01 * f64::from(k);
            let mut queued = line(u64::from(k), (x - 0.01, 0.0), (x, 0.0), 0.05);
            queued.separate = k == 4;
            moves.push(queued);
        }
        complete(path, &moves);
        let starts: Vec<u64> = path
            .vertices(0.0)
            .map(|vertex| path.leg(vertex.s).expect("a leg").serial)
            .collect();
        assert_eq!(starts, [3, 5]);
    });
}

#[test]
fn far_from_the_start_the_path_is_the_same() {
    with_path(|path| {
        let moves = contour(0.2, 200, 0.01, 0.0025);
        complete(path, &moves);
        let near: Vec<PathPoint> = (0..400).map(|k| path.point(0.09 * f64::from(k))).collect();
        // Up and down a line of 2 km first.
        let mut far = vec![
            line(1, (0.0, 0.0), (-2e6, 0.0), 0.01),
            line(2, (-2e6, 0.0), (0.0, 0.0), 0.01),
        ];
        far[1].termination = TerminationCondition::Stop;
        far.extend(moves.iter().map(|queued| ProgrammedMove {
            serial: queued.serial + 3,
            ..*queued
        }));
        complete(path, &far);
        for (k, near) in near.iter().enumerate() {
            let here = path.point(4e6 + 0.09 * k as f64);
            for (a, b, error) in [
                (here.position, near.position, 1e-8),
                (here.first, near.first, 1e-8),
                (here.second, near.second, 1e-6),
                (here.third, near.third, 1e-5),
            ] {
                assert!((a - b).amax() < error, "{k}: {}", a - b);
            }
        }
    });
}

#[test]
fn the_end_of_what_is_known_is_on_the_program_until_more_comes() {
    with_path(|path| {
        let moves = [
            line(1, (0.0, 0.0), (10.0, 0.0), 0.05),
            line(2, (10.0, 0.0), (10.0, 10.0), 0.05),
            line(3, (10.0, 10.0), (0.0, 10.0), 0.05),
        ];
        fill(path, &moves[..2]);
        path.flush();
        path.step(10_000);
        assert_eq!(path.known_end(), 20.0);
        assert!(path.final_end() < 20.0 && path.final_end() > 10.1);
        assert_eq!(path.point(20.0).position, path.goal());
        // In time: the corner is blended.
        path.add(&moves[2]).expect("room");
        path.flush();
        path.step(10_000);
        assert!((path.point(20.0).position - moves[1].shape.end()).norm() > 0.04);
        // Too late: the machine stops there.
        path.finish();
        path.step(10_000);
        assert_eq!(path.final_end(), 30.0);
        path.add(&line(4, (0.0, 10.0), (0.0, 0.0), 0.05))
            .expect("room");
        path.finish();
        path.step(10_000);
        assert_eq!(stops(path), [0.0, 30.0]);
        assert_eq!(path.point(30.0).position, moves[2].shape.end());
    });
}

#[test]
fn feeds_and_distances_are_those_that_f_counts() {
    with_path(|path| {
        let mut end = Axes::zeros();
        end[3] = 50.0;
        let turn = ProgrammedMove {
            shape: Shape::Line(Line9::new(&Axes::zeros(), &end).expect("a line")),
            ..line(1, (0.0, 0.0), (1.0, 0.0), 0.05)
        };
        let mut both = end;
        both[0] = 12.0;
        both[3] = 100.0;
        let mixed = ProgrammedMove {
            serial: 2,
            shape: Shape::Line(Line9::new(&end, &both).expect("a line")),
            ..turn
        };
        complete(path, &[turn, mixed]);
        // 50 degrees count as 5 mm, and 100 degrees a second are 10 mm/s.
        let leg = path.leg(1.0).expect("a leg");
        assert!((leg.end - 5.0).abs() < 1e-12 && (leg.speed - 10.0).abs() < 1e-12);
        assert_eq!(leg.measure, Measure::Rotary);
        let progress = path.progress(1.0).expect("moves");
        assert!((progress.distance - 10.0).abs() < 1e-12);
        assert!((progress.distance_to_go - 40.0).abs() < 1e-12);
        // 12 mm and 50 degrees are 13 mm of path.
        let leg = path.leg(6.0).expect("a leg");
        assert!((leg.end - 18.0).abs() < 1e-12);
        assert!((leg.speed * leg.measure_rate - 100.0).abs() < 1e-10);
        assert_eq!(leg.measure, Measure::Linear);
    });
}

#[test]
fn moves_that_do_not_fit_are_refused() {
    with_path(|path| {
        path.restart(&settings(), &Axes::zeros());
        let good = line(5, (0.0, 0.0), (10.0, 0.0), 0.05);
        assert_eq!(
            path.add(&line(5, (1.0, 0.0), (2.0, 0.0), 0.05)),
            Err(BlendError::Gap)
        );
        for feed in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(
                path.add(&ProgrammedMove { feed, ..good }),
                Err(BlendError::Feed)
            );
        }
        assert_eq!(path.add(&good), Ok(()));
        let again = line(5, (10.0, 0.0), (20.0, 0.0), 0.05);
        assert_eq!(path.add(&again), Err(BlendError::Serial));
        assert_eq!(path.added_end(), 10.0);
    });
}

#[test]
fn a_full_path_goes_on_once_there_is_room() {
    with_path(|path| {
        path.restart(&settings(), &Axes::zeros());
        let zigzag = |k: u64| {
            let corner = |k: u64| ((k as f64), (k % 2) as f64);
            line(k, corner(k), corner(k + 1), 0.05)
        };
        let mut k = 0;
        while path.add(&zigzag(k)) == Ok(()) {
            // Enough to put it in its place, and nothing for widths.
            path.step(2);
            k += 1;
        }
        assert!(k > 2000);
        assert_eq!(path.add(&zigzag(k)), Err(BlendError::Full));
        path.discard_before(0.0);
        assert_eq!(path.add(&zigzag(k)), Err(BlendError::Full));
        // Nothing is dropped that the choice of widths still needs.
        path.discard_before(path.programmed_end());
        assert_eq!(path.add(&zigzag(k)), Err(BlendError::Full));

        let mut calls = 0;
        while !path.is_settled() {
            assert!(path.step(500) <= 500 + GREATEST_EXCESS);
            path.flush();
            calls += 1;
        }
        assert!(calls > 100);
        let middle = path.point(1000.0).position;
        path.discard_before(1000.0);
        assert_eq!(path.point(1000.0).position, middle);
        for k in k..5000 {
            assert_eq!(path.add(&zigzag(k)), Ok(()), "{k}");
            path.step(5000);
            path.discard_before(path.final_end() - 100.0);
        }
        assert!(greatest_deviation(path) <= 1.0);
    });
}

#[test]
fn an_empty_path_is_at_rest_where_it_starts() {
    with_path(|path| {
        let start = Axes::repeat(3.0);
        path.restart(&settings(), &start);
        path.flush();
        path.finish();
        assert_eq!(path.step(1000), 0);
        assert_eq!(path.point(5.0).position, start);
        assert_eq!(path.point_before(0.0).first, Axes::zeros());
        assert!(path.progress(0.0).is_none() && path.leg(0.0).is_none());
        assert!(path.vertices(0.0).next().is_none());
        path.discard_before(1.0);
        assert_eq!((path.known_end(), path.final_end()), (0.0, 0.0));
    });
}

#[test]
fn a_line_that_waits_to_be_merged_is_counted_at_the_end() {
    with_path(|path| {
        path.restart(&settings(), &Axes::zeros());
        for (serial, from, to) in [(0, 0.0, 10.0), (1, 10.0, 10.02)] {
            path.add(&line(serial, (from, 0.0), (to, 0.0), 0.05))
                .expect("a line");
        }
        assert_eq!(path.programmed_end(), 0.0);
        assert!((path.added_end() - 10.02).abs() < 1e-12);
        path.flush();
        path.step(1000);
        assert_eq!(path.programmed_end(), path.added_end());
    });
}
