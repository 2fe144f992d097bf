//! Joints that have limits of their own may not jump on the way of a move, and there have to be joints all along.

use crate::common::{at, feed_move, joints_at, with_machine};
use framepath::axes::Axes;
use framepath::cycle::JERK_KEPT;
use framepath::machine::JOINT_COUNT;
use framepath::moves::TerminationCondition;
use framepath::moves::shape::{Line9, Shape};
use framepath::planner::AddError;
use framepath::planner::range::{
    Finding, JointRange, JointSolver, Joints, Jump, RangeVerdict, Sweep,
};

/// Kinematics that make two joints of X and Y, how often they were asked, and whether joints lead to their place.
struct Kinematics<F> {
    joints: F,
    calls: usize,
    leads_back: fn(&Axes) -> bool,
}

impl<F: Fn(f64, f64) -> Option<[f64; 2]>> Kinematics<F> {
    fn new(joints: F) -> Self {
        Self {
            joints,
            calls: 0,
            leads_back: |_| true,
        }
    }
}

impl<F: Fn(f64, f64) -> Option<[f64; 2]>> JointSolver for Kinematics<F> {
    fn begin(&mut self, _position: &Axes, _joints: &Joints) {}

    fn solve(&mut self, position: &Axes, _near: &Joints) -> Option<Joints> {
        self.calls += 1;
        let [first, second] = (self.joints)(position[0], position[1])?;
        let mut joints = [0.0; JOINT_COUNT];
        (joints[0], joints[1]) = (first, second);
        Some(joints)
    }

    fn reaches(&mut self, position: &Axes, _joints: &Joints) -> bool {
        (self.leads_back)(position)
    }

    fn calls_a_cycle(&self) -> usize {
        16
    }

    fn keeps_lines(&self) -> bool {
        false
    }
}

/// Soft limits that nothing comes near.
fn range(may_not_jump: bool) -> JointRange {
    JointRange {
        least: [-1e6; JOINT_COUNT],
        greatest: [1e6; JOINT_COUNT],
        count: 2,
        may_not_jump,
    }
}

/// The look along a line.
fn look<F: Fn(f64, f64) -> Option<[f64; 2]>>(
    kinematics: &mut Kinematics<F>,
    from: [f64; 2],
    to: [f64; 2],
    may_not_jump: bool,
) -> RangeVerdict {
    let line = Line9::new(&at(from[0], from[1]), &at(to[0], to[1])).expect("a line");
    let shape = Shape::Line(line);
    let near = kinematics
        .solve(&shape.position(0.0), &[0.0; JOINT_COUNT])
        .expect("joints at the start");
    let mut sweep = Sweep::new(&shape, &range(may_not_jump), &near);
    for _ in 0..100_000 {
        if let Some(verdict) = sweep.step(&shape, kinematics) {
            return verdict;
        }
    }
    panic!("the look never ends");
}

fn jump(verdict: &RangeVerdict) -> Jump {
    match verdict {
        RangeVerdict::Jumps(jump) => *jump,
        other => panic!("{other:?}"),
    }
}

/// The first joint looks from the origin to the place, as that of a robot: beyond the negative X axis it is a turn off.
fn polar(x: f64, y: f64) -> Option<[f64; 2]> {
    Some([y.atan2(x).to_degrees(), x.hypot(y)])
}

/// A wrist that is straight at X0 Y0.
fn wrist(x: f64, y: f64) -> Option<[f64; 2]> {
    Some([x.atan2(y).to_degrees(), 0.0])
}

#[test]
fn a_turn_that_a_joint_goes_back_is_found_with_its_place() {
    let found = jump(&look(
        &mut Kinematics::new(polar),
        [-400.0, 100.0],
        [-380.0, -90.0],
        true,
    ));
    assert_eq!(found.joint, 0);
    assert!((found.way + 360.0).abs() < 0.01, "{found:?}");
    let x = -400.0 + 20.0 * 100.0 / 190.0;
    assert!((found.place - at(x, 0.0)).amax() < 1e-3, "{found:?}");
    // Joints without limits of their own may.
    let verdict = look(
        &mut Kinematics::new(polar),
        [-400.0, 100.0],
        [-380.0, -90.0],
        false,
    );
    assert!(matches!(verdict, RangeVerdict::Stays(_)), "{verdict:?}");
}

#[test]
fn small_jumps_of_any_joint_count() {
    let steps = |x: f64, _: f64| Some([x, if x > 33.3 { x + 0.6 } else { x }]);
    let found = jump(&look(
        &mut Kinematics::new(steps),
        [0.0, 0.0],
        [100.0, 0.0],
        true,
    ));
    assert_eq!(found.joint, 1);
    assert!((found.way - 0.6).abs() < 1e-3, "{found:?}");
    assert!((found.place[0] - 33.3).abs() < 1e-3, "{found:?}");
}

/// Where joints are fast a machine becomes slow, but no motion leads through a singular place.
#[test]
fn joints_may_pass_a_singular_place_but_not_go_through_it() {
    for beside in [30.0, 1.0, 0.01, 0.002] {
        let mut kinematics = Kinematics::new(wrist);
        let verdict = look(&mut kinematics, [-500.0, beside], [500.0, beside], true);
        assert!(
            matches!(verdict, RangeVerdict::Stays(_)),
            "{beside} {verdict:?}"
        );
        assert!(kinematics.calls < 1500, "{} calls", kinematics.calls);
    }
    for beside in [0.0, 1e-5, 3e-4] {
        let found = jump(&look(
            &mut Kinematics::new(wrist),
            [-500.0, beside],
            [501.0, beside],
            true,
        ));
        assert_eq!(found.joint, 0);
        assert!(found.place.amax() < 1e-3, "{found:?}");
    }
    // Straight arms: the joints bend without end, and do not jump.
    let arms = |x: f64, _: f64| Some([(x / 500.0).clamp(-1.0, 1.0).acos().to_degrees(), 0.0]);
    let verdict = look(&mut Kinematics::new(arms), [100.0, 0.0], [500.0, 0.0], true);
    assert!(matches!(verdict, RangeVerdict::Stays(_)), "{verdict:?}");
}

#[test]
fn a_place_without_joints_that_lead_to_it_is_named() {
    let hole = |x: f64, y: f64| (x.hypot(y) > 40.0).then_some([x, y]);
    let verdict = look(
        &mut Kinematics::new(hole),
        [-100.0, 0.0],
        [100.0, 0.0],
        true,
    );
    let RangeVerdict::Unreached(place) = verdict else {
        panic!("{verdict:?}");
    };
    assert!(place[0] >= -40.0 && place[0] < -30.0, "{place:?}");
    let mut elsewhere = Kinematics::new(polar);
    elsewhere.leads_back = |position| position.norm() > 40.0;
    let verdict = look(&mut elsewhere, [100.0, 0.0], [20.0, 0.0], true);
    assert!(matches!(verdict, RangeVerdict::Unreached(_)), "{verdict:?}");
    let verdict = look(&mut elsewhere, [100.0, 0.0], [20.0, 0.0], false);
    assert!(matches!(verdict, RangeVerdict::Stays(_)), "{verdict:?}");
}

/// The machine stops before the move, within its limits, and takes no more before an abort.
#[test]
fn a_move_that_makes_a_joint_jump_stops_the_machine_before_it() {
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        machine
            .planner
            .set_termination(TerminationCondition::Continuous { tolerance: 0.5 });
        let start = at(-400.0, 100.0);
        machine.planner.set_position(&start).expect("finite");
        machine.positions.fill(start);
        for (id, y) in [(3, 60.0), (4, 20.0), (5, -60.0)] {
            machine.planner.set_id(id);
            machine
                .line(at(-400.0, y), &feed_move(90.0))
                .expect("a line");
        }
        let mut solver = Kinematics::new(polar);
        let mut found = Vec::new();
        for _ in 0..3000 {
            let joints = joints_at(&machine.planner.status().position);
            found.extend(
                machine
                    .planner
                    .check_range(&range(true), &joints, &mut solver),
            );
            let status = machine.cycle();
            assert!(status.position[1] >= 20.0, "{}", status.position[1]);
            if !found.is_empty() && status.done {
                break;
            }
        }
        let [Finding::Jumps { jump, id: 5 }] = found[..] else {
            panic!("{found:?}");
        };
        assert_eq!(jump.joint, 0);
        let extremes = machine.extremes();
        assert!(extremes.velocity <= 1.001 && extremes.acceleration <= 1.001);
        assert!(extremes.jerk <= JERK_KEPT, "{extremes:?}");
        let more = machine.line(at(-400.0, 90.0), &feed_move(50.0));
        assert_eq!(more, Err(AddError::Tripped));
    });
}
