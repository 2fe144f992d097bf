//! Programs that touch a soft limit: the path leads to the limit and never beyond it, whatever the tolerance allows.

use std::f64::consts::TAU;

use proptest::prelude::*;
use proptest::test_runner::Config as ProptestConfig;

use crate::common::seeded_runner::seeded_runner;
use crate::common::{Machine, at, equal_limits, feed_move, joints_at, with_room};
use framepath::axes::Axes;
use framepath::machine::JOINT_COUNT;
use framepath::moves::TerminationCondition;
use framepath::moves::shape::Circle;
use framepath::planner::range::{JointRange, JointSolver, Joints};
use nalgebra::{Vector2, Vector3};

/// What rounding takes a position beyond a limit by at most, mm.
pub const ROUNDING: f64 = 1e-12;

/// A machine whose joints are its axes, behind a frame that may scale.
pub struct Cartesian {
    pub scale: f64,
}

impl Cartesian {
    pub fn joints(&self, position: &Axes) -> Joints {
        joints_at(&(self.scale * position))
    }
}

impl JointSolver for Cartesian {
    fn begin(&mut self, _position: &Axes, _joints: &Joints) {}

    fn solve(&mut self, position: &Axes, _near: &Joints) -> Option<Joints> {
        Some(self.joints(position))
    }

    fn calls_a_cycle(&self) -> usize {
        16
    }

    fn keeps_lines(&self) -> bool {
        self.scale == 1.0
    }
}

type Point = Vector2<f64>;

/// A move of a program in the XY plane, from where the one before ends.
#[derive(Clone, Copy, Debug)]
enum Step {
    Line(Point),
    /// About a centre by an angle, radians, positive to the left.
    Arc(Point, f64),
}

/// How a program runs.
#[derive(Clone, Copy, Debug)]
struct Setting {
    /// How the moves end, five by one and five by the other in turn.
    modes: [TerminationCondition; 2],
    /// mm/s.
    feed: f64,
    /// mm/s^3.
    jerk: f64,
    /// Moves in a servo period.
    supply: usize,
    /// How far the limits are from what the program reaches, mm.
    gap: f64,
}

/// Where an arc from `start` leads to.
fn arc_point(start: Point, centre: Point, angle: f64) -> Point {
    let (sine, cosine) = angle.sin_cos();
    let arm = start - centre;
    centre + Point::new(cosine * arm.x - sine * arm.y, sine * arm.x + cosine * arm.y)
}

/// The greatest X and Y of a program.
fn reached(start: Point, steps: &[Step]) -> Point {
    let mut here = start;
    let mut greatest = start;
    for step in steps {
        match *step {
            Step::Line(end) => here = end,
            Step::Arc(centre, angle) => {
                let arm = here - centre;
                let begin = arm.y.atan2(arm.x);
                for (axis, top) in [(0, 0.0), (1, 0.25 * TAU)] {
                    let way = (top - begin) * angle.signum();
                    if way.rem_euclid(TAU) <= angle.abs() {
                        greatest[axis] = greatest[axis].max(centre[axis] + arm.norm());
                    }
                }
                here = arc_point(here, centre, angle);
            }
        }
        greatest = greatest.sup(&here);
    }
    greatest
}

/// How far a program leads beyond its limits in X and in Y, mm.
fn beyond(start: Point, steps: &[Step], setting: &Setting) -> Point {
    let limit = reached(start, steps).add_scalar(setting.gap);
    let mut range = JointRange {
        least: [f64::NEG_INFINITY; JOINT_COUNT],
        greatest: [f64::INFINITY; JOINT_COUNT],
        count: 3,
        ..JointRange::NONE
    };
    (range.greatest[0], range.greatest[1]) = (limit.x, limit.y);
    let mut machine = Machine::new(equal_limits(setting.jerk));
    let origin = at(start.x, start.y);
    machine.planner.set_position(&origin).expect("a position");
    machine.planner.wait_for_range_check(true);
    let request = feed_move(setting.feed);
    let mut here = start;
    let mut waiting = steps.iter().enumerate();
    let mut greatest = Point::repeat(f64::NEG_INFINITY);
    loop {
        for (number, step) in waiting.by_ref().take(setting.supply) {
            machine
                .planner
                .set_termination(setting.modes[number / 5 % 2]);
            match *step {
                Step::Line(end) => {
                    here = end;
                    machine.line(at(end.x, end.y), &request).expect("a line");
                }
                Step::Arc(centre, angle) => {
                    here = arc_point(here, centre, angle);
                    let circle = Circle {
                        center: Vector3::new(centre.x, centre.y, 0.0),
                        normal: Vector3::z(),
                        revolutions: if angle > 0.0 { 0 } else { -1 },
                    };
                    machine
                        .circle(at(here.x, here.y), &circle, &request)
                        .expect("an arc");
                }
            }
        }
        let joints = joints_at(&machine.planner.status().position);
        let mut plain = Cartesian { scale: 1.0 };
        let finding = machine.planner.check_range(&range, &joints, &mut plain);
        assert!(finding.is_none(), "{finding:?}");
        let status = machine.cycle();
        greatest = greatest.sup(&Point::new(status.position[0], status.position[1]));
        if status.done && waiting.len() == 0 {
            break greatest - limit;
        }
    }
}

fn any_mode() -> impl Strategy<Value = TerminationCondition> {
    let tolerances = 0.005f64.ln()..0.2f64.ln();
    prop_oneof![
        8 => tolerances.prop_map(|tolerance| TerminationCondition::Continuous {
            tolerance: tolerance.exp(),
        }),
        1 => Just(TerminationCondition::Continuous { tolerance: 0.0 }),
        1 => Just(TerminationCondition::Exact),
    ]
}

fn any_setting() -> impl Strategy<Value = Setting> {
    let one = any_mode().prop_map(|mode| [mode; 2]);
    let modes = prop_oneof![3 => one, 1 => [any_mode(), any_mode()]];
    let jerks = prop_oneof![Just(20_000.0), Just(1e5), Just(f64::INFINITY)];
    let supplies = prop_oneof![Just(1usize), Just(100)];
    let gaps = prop_oneof![Just(0.0), 0.0..0.5];
    (modes, 10.0..100.0, jerks, supplies, gaps).prop_map(|(modes, feed, jerk, supply, gap)| {
        Setting {
            modes,
            feed,
            jerk,
            supply,
            gap,
        }
    })
}

/// Lengths of legs, mm.
fn any_length() -> impl Strategy<Value = f64> {
    (0.05f64.ln()..3f64.ln()).prop_map(f64::exp)
}

/// A polygon of chords of a circle, of as many turns as that.
fn chords(length: f64, turn: f64, phase: f64, count: usize) -> Vec<Point> {
    let radius = 0.5 * length / (0.5 * turn).sin();
    let corner = |k: usize| {
        let (sine, cosine) = (phase + turn * k as f64).sin_cos();
        radius * Point::new(cosine, sine)
    };
    (0..=count).map(corner).collect()
}

fn any_chords() -> impl Strategy<Value = Vec<Point>> {
    let shape = (any_length(), 0.02f64.ln()..1.5f64.ln(), 0.0..TAU);
    (shape, 10..80usize)
        .prop_map(|((length, turn, phase), count)| chords(length, turn.exp(), phase, count))
}

/// Legs that turn at random, held back at X 0.
fn any_walk() -> impl Strategy<Value = Vec<Point>> {
    let steps = prop::collection::vec((-1.0..1.0f64, 0.3..1.0f64), 10..80);
    (any_length(), 0.1..3.0f64, steps).prop_map(|(length, turn, steps)| {
        let mut here = Point::new(-length, 0.0);
        let mut direction = 0.25 * TAU;
        let mut points = vec![here];
        for (turned, share) in steps {
            direction += turn * turned;
            here += share * length * Point::new(direction.cos(), direction.sin());
            here.x = here.x.min(0.0);
            points.push(here);
        }
        points
    })
}

/// A zigzag along X 0.
fn any_zigzag() -> impl Strategy<Value = Vec<Point>> {
    let steps = prop::collection::vec((-0.7..1.0f64, 0.1..1.0f64), 10..80);
    (any_length(), steps).prop_map(|(length, steps)| {
        let mut y = 0.0;
        let place = |(depth, forward): (f64, f64)| {
            y += forward * length;
            Point::new(-length * depth.max(0.0), y)
        };
        steps.into_iter().map(place).collect()
    })
}

/// No program of these leads beyond a limit that it only touches.
fn stays_within(programs: impl Strategy<Value = (Point, Vec<Step>)>) {
    let mut runner = seeded_runner(ProptestConfig {
        cases: 60,
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    let result = runner.run(&(programs, any_setting()), |((start, steps), setting)| {
        let way = with_room(|| beyond(start, &steps, &setting));
        prop_assert!(way.max() <= ROUNDING, "{} {}", way.x, way.y);
        Ok(())
    });
    result.unwrap_or_else(|failure| panic!("{failure}"));
}

fn as_lines(points: Vec<Point>) -> (Point, Vec<Step>) {
    let lines = points.iter().skip(1).map(|end| Step::Line(*end));
    (points[0], lines.collect())
}

#[test]
fn chords_of_a_circle() {
    stays_within(any_chords().prop_map(as_lines));
}

#[test]
fn legs_that_turn_at_random() {
    stays_within(any_walk().prop_map(as_lines));
}

#[test]
fn a_zigzag_along_a_limit() {
    stays_within(any_zigzag().prop_map(as_lines));
}

/// Where the moves of an outline turn, and how far.
#[derive(Clone, Copy, Debug)]
struct Bend {
    /// Length of a line, mm.
    length: f64,
    /// Radius of the arc behind it, mm, and its angle, radians.
    radius: f64,
    angle: f64,
    /// How far the direction turns at its beginning and at its end, radians.
    corners: [f64; 2],
}

/// Lines with arcs between them, turned so that the first line runs along a limit.
fn outline(bends: &[Bend]) -> (Point, Vec<Step>) {
    let unit = |direction: f64| Point::new(direction.cos(), direction.sin());
    let (mut here, mut direction) = (Point::zeros(), 0.25 * TAU);
    let mut steps = Vec::new();
    for bend in bends {
        here += bend.length * unit(direction);
        steps.push(Step::Line(here));
        direction += bend.corners[0];
        let side = bend.angle.signum();
        let centre = here + bend.radius * unit(direction + 0.25 * TAU * side);
        steps.push(Step::Arc(centre, bend.angle));
        here = arc_point(here, centre, bend.angle);
        direction += bend.angle + bend.corners[1];
    }
    // From inside.
    let start = Point::new(-1.0, -1.0);
    steps.insert(0, Step::Line(Point::zeros()));
    (start, steps)
}

fn any_outline(
    turns: impl Strategy<Value = f64> + Clone,
) -> impl Strategy<Value = (Point, Vec<Step>)> {
    let corner = prop_oneof![Just(0.0), turns.clone()];
    let bend = (
        0.05f64.ln()..5f64.ln(),
        0.1f64.ln()..10f64.ln(),
        turns,
        [corner.clone(), corner],
    )
        .prop_map(|(length, radius, angle, corners)| Bend {
            length: length.exp(),
            radius: radius.exp(),
            angle,
            corners,
        });
    prop::collection::vec(bend, 1..12).prop_map(|bends| outline(&bends))
}

#[test]
fn an_outline_with_arcs_to_one_side() {
    stays_within(any_outline(0.05..1.6f64));
}

#[test]
fn an_outline_with_arcs_to_both_sides() {
    stays_within(any_outline(prop_oneof![0.05..1.6f64, -1.6..-0.05f64]));
}

fn smooth(tolerance: f64) -> Setting {
    Setting {
        modes: [TerminationCondition::Continuous { tolerance }; 2],
        feed: 50.0,
        jerk: 20_000.0,
        supply: 1,
        gap: 0.0,
    }
}

/// Where a line along a limit passes into an arc, an easement leads to the outer side.
#[test]
fn a_rounded_side_along_a_limit() {
    let bend = Bend {
        length: 5.0,
        radius: 4.0,
        angle: 0.25 * TAU,
        corners: [0.0; 2],
    };
    let (start, steps) = outline(&[bend; 4]);
    let far = Setting {
        gap: 10.0,
        ..smooth(0.05)
    };
    let without = with_room(|| beyond(start, &steps, &far)).add_scalar(far.gap);
    assert!(without.x > 0.01, "{without}");
    let way = with_room(|| beyond(start, &steps, &smooth(0.05)));
    assert!(way.max() <= ROUNDING, "{way}");
    // Not farther to the inner side than P.
    assert!(way.min() > -0.05, "{way}");
}

/// A limit that the tolerance does not reach changes nothing.
#[test]
fn what_keeps_away_from_a_limit_is_run_as_ever() {
    let points = chords(0.5, 0.1, 0.0, 60);
    let (start, steps) = as_lines(points);
    let reach = |gap: f64| {
        let setting = Setting {
            gap,
            ..smooth(0.05)
        };
        with_room(|| beyond(start, &steps, &setting)).add_scalar(gap)
    };
    let (near, far) = (reach(0.201), reach(50.0));
    assert!((near - far).amax() < 1e-12, "{near} {far}");
    assert!(reach(0.199) != near);
}
