//! The look along a move against a dense one: no joint leaves its soft limits unnoticed, and none
//! that stays is accused.

use crate::common::joints_at;
use crate::common::seeded_runner::seeded_runner;
use framepath::axes::Axes;
use framepath::machine::{
    Coordinates, JOINT_COUNT, RotaryDirection, TableTilting, TableTiltingParameters, TiltAxis,
};
use framepath::moves::shape::{Arc9, Circle, Line9, Shape};
use framepath::planner::range::{JointRange, JointSolver, Joints, OutOfRange, RangeVerdict, Sweep};
use nalgebra::Vector3;
use proptest::prelude::*;

/// What a joint may pass its limit by unnoticed.
const TOLERANCE: f64 = 1e-6;

/// A machine, and how often it was asked.
struct Counting<F> {
    inverse: F,
    calls: usize,
}

impl<F: FnMut(&Axes, &Joints) -> Option<Joints>> JointSolver for Counting<F> {
    fn begin(&mut self, _position: &Axes, _joints: &Joints) {}

    fn solve(&mut self, position: &Axes, near: &Joints) -> Option<Joints> {
        self.calls += 1;
        (self.inverse)(position, near)
    }

    fn calls_a_cycle(&self) -> usize {
        1
    }

    fn keeps_lines(&self) -> bool {
        false
    }
}

/// The verdict, and how many calls it took.
fn sweep(
    shape: &Shape,
    range: &JointRange,
    near: &Joints,
    inverse: impl FnMut(&Axes, &Joints) -> Option<Joints>,
) -> (RangeVerdict, usize) {
    let mut solver = Counting { inverse, calls: 0 };
    let mut sweep = Sweep::new(shape, range, near);
    for _ in 0..100_000 {
        if let Some(verdict) = sweep.step(shape, &mut solver) {
            return (verdict, solver.calls);
        }
    }
    panic!("the look never ends");
}

fn found(verdict: &RangeVerdict) -> Option<OutOfRange> {
    match verdict {
        RangeVerdict::Stays(_) => None,
        RangeVerdict::Leaves(found) => Some(*found),
        other => panic!("a machine with smooth joints everywhere: {other:?}"),
    }
}

fn range(reach: f64) -> JointRange {
    JointRange {
        least: [-reach; JOINT_COUNT],
        greatest: [reach; JOINT_COUNT],
        count: 5,
        ..JointRange::NONE
    }
}

fn line(from: [f64; 9], to: [f64; 9]) -> Shape {
    Shape::Line(Line9::new(&Axes::from(from), &Axes::from(to)).expect("a line"))
}

/// From (10, 0) over (0, 10) to (-10, 0).
fn half_circle() -> Shape {
    let end = |x: f64| Axes::from([x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let circle = Circle {
        center: Vector3::zeros(),
        normal: Vector3::z(),
        revolutions: 0,
    };
    Shape::Arc(Arc9::new(&end(10.0), &end(-10.0), &circle).expect("an arc"))
}

#[test]
fn the_middle_of_an_arc_counts() {
    let look = |range: &JointRange| {
        let near = [0.0; JOINT_COUNT];
        let (verdict, calls) = sweep(&half_circle(), range, &near, |at, _| Some(joints_at(at)));
        assert!(calls < 400, "{calls} calls");
        found(&verdict)
    };
    assert_eq!(look(&range(10.0)), None);
    let mut narrow = range(20.0);
    narrow.greatest[1] = 9.99999;
    let above = look(&narrow).expect("Y goes to 10");
    assert_eq!((above.joint, above.limit), (1, 9.99999));
    assert!((above.position - 10.0).abs() < TOLERANCE, "{above:?}");
    narrow = range(20.0);
    narrow.least[0] = -9.5;
    let below = look(&narrow).expect("X goes to -10");
    assert_eq!((below.joint, below.position, below.limit), (0, -10.0, -9.5));
}

/// Out of a forbidden place, as after a change of the limits, a move leads back.
#[test]
fn a_joint_beyond_its_limit_may_come_back_but_not_go_further() {
    let near = [0.0; JOINT_COUNT];
    let to = |x: f64| {
        let shape = line(
            [12.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            [x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        );
        found(&sweep(&shape, &range(10.0), &near, |at, _| Some(joints_at(at))).0)
    };
    assert_eq!(to(3.0), None);
    assert_eq!(to(13.0).map(|found| found.joint), Some(0));
}

/// An arm of two links of 340 and 250, as scarakins has it: joint 1 is below 0 with one flag, and
/// above with the other; here the joints of before tell which.
fn scara(position: &Axes, near: &Joints) -> Option<Joints> {
    let (inner, outer): (f64, f64) = (340.0, 250.0);
    let (x, y) = (position[0], position[1]);
    let cosine = (x * x + y * y - inner * inner - outer * outer) / (2.0 * inner * outer);
    if !(-1.0..=1.0).contains(&cosine) {
        return None;
    }
    let elbow = cosine.acos() * if near[1] < 0.0 { -1.0 } else { 1.0 };
    let shoulder = y.atan2(x) - (outer * elbow.sin()).atan2(inner + outer * elbow.cos());
    let mut joints = [0.0; JOINT_COUNT];
    joints[0] = shoulder.to_degrees();
    joints[1] = elbow.to_degrees();
    Some(joints)
}

#[test]
fn a_line_bends_an_elbow_between_its_ends() {
    // past the shoulder at a distance of 120: the elbow closes to 160.6 degrees
    let shape = line(
        [120.0, -400.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [120.0, 400.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    );
    let mut near = [0.0; JOINT_COUNT];
    near[1] = -90.0;
    let look = |limit: f64, near: &Joints| {
        let mut narrow = range(400.0);
        narrow.least[1] = -limit;
        found(&sweep(&shape, &narrow, near, scara).0)
    };
    let closed = scara(
        &Axes::from([120.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        &near,
    )
    .expect("within reach")[1];
    assert_eq!(look(-closed + 1e-3, &near), None);
    let beyond = look(-closed - 1e-3, &near).expect("the elbow closes too far");
    assert_eq!(beyond.joint, 1);
    assert!(
        (beyond.position - closed).abs() < TOLERANCE,
        "{beyond:?}, {closed}"
    );
    // the other arm
    near[1] = 90.0;
    assert_eq!(look(-closed - 1e-3, &near), None);
}

#[test]
fn a_place_out_of_reach_makes_a_move_unknown() {
    let shape = line(
        [500.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [700.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    );
    let (verdict, calls) = sweep(&shape, &range(400.0), &[0.0; JOINT_COUNT], scara);
    assert!(matches!(verdict, RangeVerdict::Unknown), "{verdict:?}");
    assert!(calls < 200, "{calls} calls");
}

/// Kinematics that iterate fail from too far away: the look then comes in smaller steps.
#[test]
fn what_is_not_found_from_afar_is_found_from_nearby() {
    let shape = line([0.0; 9], [180.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let shy = |at: &Axes, near: &Joints| {
        let joints = joints_at(at);
        (joints[0] - near[0]).abs().le(&9.0).then_some(joints)
    };
    let (verdict, _) = sweep(&shape, &range(400.0), &[0.0; JOINT_COUNT], shy);
    assert!(
        matches!(verdict, RangeVerdict::Stays(joints) if joints[0] == 180.0),
        "{verdict:?}"
    );
    let mut narrow = range(400.0);
    narrow.greatest[0] = 170.0;
    let (verdict, _) = sweep(&shape, &narrow, &[0.0; JOINT_COUNT], shy);
    assert_eq!(found(&verdict).map(|found| found.position), Some(180.0));
}

/// What jumps is looked at until nothing is left in between, and no further.
#[test]
fn a_jump_ends_the_look_too() {
    let shape = line([0.0; 9], [180.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let jump = |at: &Axes, _: &Joints| {
        let mut joints = joints_at(at);
        joints[1] = if at[0] < 77.7 { 180.0 } else { -180.0 };
        Some(joints)
    };
    let (verdict, calls) = sweep(&shape, &range(190.0), &[0.0; JOINT_COUNT], jump);
    assert_eq!(found(&verdict), None);
    assert!(calls < 1000, "{calls} calls");
}

/// A short move far from the limits takes four calls, and the one at its start.
#[test]
fn a_short_move_takes_five_calls() {
    let shape = line([0.0; 9], [0.3, 0.0, 0.0, 0.1, 0.0, 0.2, 0.0, 0.0, 0.0]);
    let (verdict, calls) = sweep(&shape, &range(100.0), &[0.0; JOINT_COUNT], |at, _| {
        Some(joints_at(at))
    });
    assert_eq!((found(&verdict), calls), (None, 5));
}

/// A machine with a tilting table, one of its moves, one of its joints XYZ and a direction of it,
/// and how far beyond the limit the move goes.
#[derive(Debug)]
struct Case {
    table: TableTilting,
    shape: Shape,
    joint: usize,
    sign: f64,
    excess: f64,
}

fn any_case() -> impl Strategy<Value = Case> {
    let place = || prop::array::uniform3(-400.0..400.0f64);
    let angles = || (-120.0..120.0f64, -720.0..720.0f64);
    (
        (prop::bool::ANY, place(), place(), -100.0..100.0f64),
        (place(), angles()),
        (place(), angles(), 1e-4..1.0f64),
        (place(), place(), -3..3i32, 0..4u8),
        (0..3usize, prop::bool::ANY, -6.0..1.5f64, prop::bool::ANY),
    )
        .prop_filter_map(
            "a move",
            |(machine, start, (way, turn, share), arc, limit)| {
                let (tilts_about_x, point, offset, tool) = machine;
                let (tilt_axis, letters): (_, &[u8]) = if tilts_about_x {
                    (TiltAxis::A, b"XYZAC")
                } else {
                    (TiltAxis::B, b"XYZBC")
                };
                let coordinates = Coordinates::parse(letters).ok()?;
                let mut table = TableTilting::new(tilt_axis, coordinates).ok()?;
                table
                    .set_parameters(TableTiltingParameters {
                        rotation_point: Vector3::from(point),
                        offset: Vector3::from(offset),
                        tool_offset: tool,
                        direction: RotaryDirection::Table,
                        tool_centre_point: true,
                    })
                    .ok()?;
                let pose = |[x, y, z]: [f64; 3], (tilt, c): (f64, f64)| {
                    let (a, b) = if tilts_about_x {
                        (tilt, 0.0)
                    } else {
                        (0.0, tilt)
                    };
                    Axes::from([x, y, z, a, b, c, 0.0, 0.0, 0.0])
                };
                let (center, normal, turns, kind) = arc;
                let first = pose(start.0, start.1);
                // long and short moves alike, and lines without rotary axes
                let turn = if kind == 0 { (0.0, 0.0) } else { turn };
                let last = first + pose(way, turn) * (share * share);
                let shape = if kind == 3 {
                    let circle = Circle {
                        center: Vector3::from(center),
                        normal: Vector3::from(normal),
                        revolutions: turns,
                    };
                    Shape::Arc(Arc9::new(&first, &last, &circle).ok()?)
                } else {
                    Shape::Line(Line9::new(&first, &last).ok()?)
                };
                let (joint, above, exponent, beyond) = limit;
                Some(Case {
                    table,
                    shape,
                    joint,
                    sign: if above { 1.0 } else { -1.0 },
                    excess: 10f64.powf(exponent) * if beyond { 1.0 } else { -1.0 },
                })
            },
        )
}

impl Case {
    fn joints(&self, position: &Axes) -> Joints {
        let mut joints = [0.0; JOINT_COUNT];
        self.table.inverse(position, &mut joints);
        joints
    }

    /// How far the joint goes at a place, in the direction.
    fn reach(&self, share: f64) -> f64 {
        let s = self.shape.length() * share;
        self.sign * self.joints(&self.shape.position(s))[self.joint]
    }

    /// The furthest of it, from dense places and a search around each that is not far from it.
    fn furthest(&self) -> f64 {
        const PLACES: usize = 4000;
        let at = |k: usize| self.reach(k as f64 / PLACES as f64);
        let dense: Vec<f64> = (0..=PLACES).map(at).collect();
        let best = dense.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mut furthest = best;
        for (k, place) in dense.iter().enumerate() {
            let neighbours = &dense[k.saturating_sub(1)..=(k + 1).min(PLACES)];
            if *place < best - 1.0 || neighbours.iter().any(|neighbour| neighbour > place) {
                continue;
            }
            let (mut low, mut high) = (k as f64 - 1.0, k as f64 + 1.0);
            for _ in 0..80 {
                let (one, other) = ((2.0 * low + high) / 3.0, (low + 2.0 * high) / 3.0);
                let [a, b] =
                    [one, other].map(|share| self.reach((share / PLACES as f64).clamp(0.0, 1.0)));
                furthest = furthest.max(a).max(b);
                if a < b {
                    low = one;
                } else {
                    high = other;
                }
            }
        }
        furthest
    }

    fn check(&self) -> Result<usize, TestCaseError> {
        let furthest = self.furthest();
        let limit = furthest - self.excess;
        let mut allowed = range(1e9);
        if self.sign > 0.0 {
            allowed.greatest[self.joint] = limit;
        } else {
            allowed.least[self.joint] = -limit;
        }
        let near = self.joints(&self.shape.position(0.0));
        let (verdict, calls) = sweep(&self.shape, &allowed, &near, |at, _| Some(self.joints(at)));
        let begun = self.reach(0.0);
        match found(&verdict) {
            None => prop_assert!(
                furthest <= limit.max(begun) + TOLERANCE,
                "{} beyond the limit and unnoticed",
                furthest - limit.max(begun)
            ),
            Some(found) => {
                prop_assert_eq!(found.joint, self.joint);
                prop_assert!(furthest > limit.max(begun), "accused");
                let position = self.sign * found.position;
                prop_assert!(
                    (position - furthest).abs() <= TOLERANCE,
                    "{} for {}",
                    position,
                    furthest
                );
            }
        }
        Ok(calls)
    }
}

#[test]
fn no_joint_of_a_tilting_table_leaves_its_limits_unnoticed() {
    let cases = std::env::var("FRAMEPATH_CASES").map_or(300, |n| n.parse().expect("a number"));
    let mut runner = seeded_runner(ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    let calls = std::cell::RefCell::new(Vec::new());
    runner
        .run(&any_case(), |case| {
            calls.borrow_mut().push(case.check()?);
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
    let mut calls = calls.into_inner();
    calls.sort_unstable();
    println!(
        "{cases} moves: {} calls in the median, {} at most",
        calls[calls.len() / 2],
        calls[calls.len() - 1]
    );
}

/// Kinematics that iterate answer a little differently each time; a joint that stays at its limit
/// is neither accused for that nor looked at without end.
#[test]
fn noise_at_a_limit_is_not_looked_into() {
    struct Noisy(u32);
    impl JointSolver for Noisy {
        fn begin(&mut self, _position: &Axes, _joints: &Joints) {}
        fn solve(&mut self, position: &Axes, _near: &Joints) -> Option<Joints> {
            self.0 += 1;
            let mut joints = joints_at(position);
            joints[1] = 10.0 + 5e-6 * f64::from(self.0).sin();
            Some(joints)
        }
        fn precision(&self) -> f64 {
            1e-5
        }
        fn calls_a_cycle(&self) -> usize {
            1
        }
        fn keeps_lines(&self) -> bool {
            false
        }
    }
    let end = [9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let shape = line([0.0; 9], end);
    let mut solver = Noisy(0);
    let mut sweep = Sweep::new(&shape, &range(10.0), &[0.0; JOINT_COUNT]);
    let verdict = (0..5).find_map(|_| sweep.step(&shape, &mut solver));
    assert!(
        matches!(verdict, Some(RangeVerdict::Stays(_))),
        "{verdict:?}"
    );
}

/// Kinematics that iterate may find another arm from too far away, which motion never gets to.
#[test]
fn another_arm_that_is_found_from_afar_does_not_count() {
    let shape = line([0.0; 9], [180.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let two_armed = |at: &Axes, near: &Joints| {
        let mut joints = joints_at(at);
        let far = (joints[0] - near[0]).abs() > 9.0;
        let other = (near[1] < 0.0) != far;
        joints[1] = if other { -100.0 } else { 100.0 };
        Some(joints)
    };
    let mut allowed = range(400.0);
    allowed.least[1] = -50.0;
    let mut near = [0.0; JOINT_COUNT];
    near[1] = 100.0;
    let (verdict, _) = sweep(&shape, &allowed, &near, two_armed);
    assert_eq!(found(&verdict), None);
}
