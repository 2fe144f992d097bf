//! What the modes allow: G61, G64 P between lines and arcs, G64 without P.

use crate::common::*;
use framepath::axes::Axes;
use framepath::moves::TerminationCondition;
use framepath::moves::shape::{Arc9, Circle, Shape};
use framepath::path::{BlendedPath, ProgrammedMove};
use nalgebra::Vector3;

/// A line along X that goes over into a quarter circle of radius 5 about (10, 5).
fn line_and_arc(termination: TerminationCondition) -> [ProgrammedMove; 2] {
    let mut first = line(1, (0.0, 0.0), (10.0, 0.0), 0.0);
    first.termination = termination;
    let mut end = Axes::zeros();
    end[0] = 15.0;
    end[1] = 5.0;
    let circle = Circle {
        center: Vector3::new(10.0, 5.0, 0.0),
        normal: Vector3::z(),
        revolutions: 0,
    };
    let arc = Arc9::new(&first.shape.end(), &end, &circle).expect("an arc");
    let second = ProgrammedMove {
        serial: 2,
        shape: Shape::Arc(arc),
        ..first
    };
    [first, second]
}

#[test]
fn a_line_eases_into_an_arc() {
    with_path(|path| {
        complete(
            path,
            &line_and_arc(TerminationCondition::Continuous { tolerance: 0.01 }),
        );
        assert!(greatest_deviation(path) <= 1.0);
        let vertex = path.vertices(5.0).next().expect("the joint");
        assert!(vertex.reach > 1.0 && !vertex.stop);
        let step = 1e-4;
        let mut before = path.point(5.0).second;
        let mut s = 5.0;
        while s < 16.0 {
            s += step;
            let here = path.point(s).second;
            assert!(
                (here - before).norm() < 0.3 * step,
                "bends by a jump at {s}"
            );
            before = here;
        }
    });
}

#[test]
fn exact_paths_go_through_tangents_without_a_stop() {
    with_path(|path| {
        let moves = line_and_arc(TerminationCondition::Exact);
        complete(path, &moves);
        assert_eq!(stops(path), [0.0]);
        // Through the point itself, and within a micrometre beside it.
        assert_eq!(path.point(10.0).position, moves[0].shape.end());
        let mut greatest = 0.0f64;
        for k in 0..4000 {
            let s = 9.0 + 5e-4 * f64::from(k);
            let (here, next) = (path.point(s), path.point(s + 5e-4));
            let deviation = here.position - path.programmed_point(s).position;
            greatest = greatest.max(deviation.norm());
            assert!(
                (here.second - next.second).norm() < 1e-3,
                "bends by a jump at {s}"
            );
        }
        assert!((3e-4..=1e-3).contains(&greatest), "{greatest}");

        // Coordinates rounded to 4 decimals: not quite a tangent.
        let exact = |k: u64, from, to| ProgrammedMove {
            termination: TerminationCondition::Exact,
            ..line(k, from, to, 0.0)
        };
        let bent = [
            exact(1, (0.0, 0.0), (10.0, 0.0)),
            exact(2, (10.0, 0.0), (20.0, 1e-3)),
        ];
        complete(path, &bent);
        assert_eq!(stops(path), [0.0]);
        let beside = path.point(10.0).position - bent[0].shape.end();
        assert!(beside.norm() < 1e-5, "{beside}");
        // A corner is a corner.
        complete(path, &[bent[0], exact(2, (10.0, 0.0), (20.0, 0.2))]);
        assert_eq!(stops(path), [0.0, 10.0]);
    });
}

#[test]
fn a_tolerance_too_small_for_corners_holds_where_moves_meet_in_a_tangent() {
    with_path(|path| {
        for tolerance in [1e-5, 1e-6, 1e-7] {
            let mode = TerminationCondition::Continuous { tolerance };
            complete(path, &line_and_arc(mode));
            assert_eq!(stops(path), [0.0]);
            let mut greatest = 0.0f64;
            for k in 0..8000 {
                let s = 9.92 + 2e-5 * f64::from(k);
                let deviation = path.point(s).position - path.programmed_point(s).position;
                greatest = greatest.max(deviation.norm());
            }
            let used = greatest / tolerance;
            assert!((0.3..=1.0).contains(&used), "{used} of {tolerance}");
        }
    });
}

/// G64 without P.
fn free(moves: &[((f64, f64), f64)]) -> Vec<ProgrammedMove> {
    let mut from = (0.0, 0.0);
    let mut program = Vec::new();
    for (k, (to, feed)) in moves.iter().enumerate() {
        program.push(ProgrammedMove {
            feed: *feed,
            ..line(k as u64 + 1, from, *to, 0.0)
        });
        from = *to;
    }
    program
}

fn cut_at(path: &BlendedPath, s: f64) -> f64 {
    (path.point(s).position - path.programmed_point(s).position).norm()
}

#[test]
fn without_a_tolerance_corners_are_cut_as_far_as_the_feed_wants() {
    with_path(|path| {
        // As far as half of the shorter leg.
        let moves = free(&[
            ((4.0, 0.0), 100.0),
            ((4.0, 10.0), 100.0),
            ((14.0, 10.0), 100.0),
        ]);
        complete(path, &moves);
        let reach: Vec<f64> = path.vertices(1.0).map(|vertex| vertex.reach).collect();
        assert_eq!(reach.len(), 2);
        assert!(
            (reach[0] - 2.0).abs() < 0.01 && (reach[1] - 5.0).abs() < 0.01,
            "{reach:?}"
        );
        for middle in [9.0, 19.0] {
            assert!(cut_at(path, middle) < 1e-12);
        }
        check_touched(path, &moves);
        // At 10 mm/s far less is wanted.
        let slow = free(&[((4.0, 0.0), 10.0), ((4.0, 10.0), 10.0)]);
        complete(path, &slow);
        let reach = path.vertices(1.0).next().expect("the corner").reach;
        assert!((0.1..0.5).contains(&reach), "{reach}");
    });
}

/// A hole that is drilled by G1 and G0 is as deep as programmed. LinuxCNC's planner rests there, too.
#[test]
fn without_a_tolerance_a_line_straight_back_is_reached_to_its_end() {
    with_path(|path| {
        for (degrees, length) in [(180.0f64, 4.0), (178.5, 4.0), (181.5, 4.0), (180.0, 0.1)] {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let back = (length + length * cosine, length * sine);
            for feeds in [[2.0, 100.0], [100.0, 100.0], [100.0, 2.0]] {
                let moves = free(&[((length, 0.0), feeds[0]), (back, feeds[1])]);
                complete(path, &moves);
                assert_eq!(stops(path), [0.0, length], "{degrees} {length}");
                assert_eq!(cut_at(path, length), 0.0);
            }
        }
        // What turns less is cut off as any corner, and so is what is less than the default tolerance.
        let spike = free(&[((4.0, 0.0), 100.0), ((0.0, 0.3), 100.0)]);
        complete(path, &spike);
        assert_eq!(stops(path), [0.0]);
        let tiny = free(&[((0.01, 0.0), 100.0), ((0.0, 0.0), 100.0)]);
        complete(path, &tiny);
        assert_eq!(stops(path), [0.0]);
        // P says what may be lost.
        let back = [
            line(1, (0.0, 0.0), (4.0, 0.0), 0.05),
            line(2, (4.0, 0.0), (0.0, 0.0), 0.05),
        ];
        complete(path, &back);
        assert_eq!(stops(path), [0.0]);
        assert!((0.01..=0.05).contains(&cut_at(path, 4.0)));
    });
}

#[test]
fn without_a_tolerance_runs_of_short_moves_stay_within_the_default() {
    with_path(|path| {
        let mut moves = contour(0.2, 500, 0.0, 0.0025);
        complete(path, &moves);
        assert!(greatest_deviation(path) <= 1.0);
        let reach: Vec<f64> = path.vertices(1.0).map(|vertex| vertex.reach).collect();
        let mean = reach.iter().sum::<f64>() / reach.len() as f64;
        assert!(mean > 1.0, "mean width {mean} mm on lines of 0.2 mm");
        // With next to none their corners are rounded nearly one by one.
        path.restart(&blend_settings(20_000.0, 0.0), &Axes::zeros());
        for queued in &mut moves {
            assert_eq!(path.add(queued), Ok(()));
            path.step(20_000);
        }
        path.finish();
        path.step(1_000_000);
        for vertex in path.vertices(0.0) {
            let leg = path.leg(vertex.s).expect("a leg");
            assert!(cut_at(path, 0.5 * (leg.start + leg.end)) <= 1e-3, "{leg:?}");
        }
    });
}

#[test]
fn exact_paths_stop_where_they_are_not_smooth() {
    with_path(|path| {
        let exact = |mut queued: ProgrammedMove| {
            queued.termination = TerminationCondition::Exact;
            queued
        };
        let straight = [
            exact(line(1, (0.0, 0.0), (10.0, 0.0), 0.0)),
            exact(line(2, (10.0, 0.0), (20.0, 0.0), 0.0)),
            exact(line(3, (20.0, 0.0), (20.0, 5.0), 0.0)),
            line(4, (20.0, 5.0), (20.0, 9.0), 0.05),
            line(5, (20.0, 9.0), (15.0, 9.0), 0.05),
        ];
        complete(path, &straight);
        assert_eq!(stops(path), [0.0, 20.0]);
        let before = path.point_before(20.0).first;
        let after = path.point(20.0).first;
        assert_eq!((before[0], before[1]), (1.0, 0.0));
        assert_eq!((after[0], after[1]), (0.0, 1.0));
    });
}
