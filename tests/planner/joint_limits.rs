//! Joints behind kinematics that bend keep limits of their own.

use crate::common::lathe::{Lathe, SPINDLE, fast, spread};
use crate::common::{Extremes, Machine, PERIOD, equal_limits, feed_move, with_room};
use crate::joint_models::{
    EXACT_TABLE, NUMERICAL_ROBOT, NUMERICAL_TABLE, REACH, joint_limits, joints_of, robot, table,
};
use framepath::axes::Axes;
use framepath::cycle::JERK_KEPT;
use framepath::machine_map::JointMap;
use framepath::moves::TerminationCondition;
use framepath::moves::shape::Circle;
use framepath::planner::MoveRequest;
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;

/// Five axes and nothing else.
fn five([x, y, z, a, c]: [f64; 5]) -> Axes {
    Axes::from([x, y, z, a, 0.0, c, 0.0, 0.0, 0.0])
}

/// A machine with 100, 1000 and 20000 for axes and joints, at a place.
fn machine_at(start: &Axes, joints: Option<JointMap>) -> Machine {
    let mut machine = Machine::new(equal_limits(20_000.0));
    machine.planner.set_position(start).expect("a place");
    machine.positions = vec![*start; 4];
    assert!(machine.planner.set_joints(joints));
    machine
        .planner
        .set_termination(TerminationCondition::Continuous { tolerance: 0.05 });
    machine
}

/// What the joints did, instead of the axes.
fn of_joints(machine: &mut Machine, count: usize, inverse: fn(&Axes) -> Axes) -> Extremes {
    for position in &mut machine.positions {
        *position = inverse(position);
    }
    machine.limits = joint_limits(count, [100.0, 1000.0, 20_000.0]);
    machine.extremes()
}

fn keeps_limits(extremes: &Extremes) -> Result<(), TestCaseError> {
    prop_assert!(extremes.velocity <= 1.001, "{extremes:?}");
    prop_assert!(extremes.acceleration <= 1.001, "{extremes:?}");
    prop_assert!(extremes.jerk <= JERK_KEPT, "{extremes:?}");
    Ok(())
}

/// Where the moves lead, each relative to the one before and of a size between .1 and 30 or so.
fn any_way() -> impl Strategy<Value = Vec<Axes>> {
    let step = (prop::array::uniform5(-1.0..1.0f64), -1.0..1.5f64);
    prop::collection::vec(step, 1..40).prop_map(|steps| {
        let mut at = [0.0; 5];
        let mut way = vec![five(at)];
        for (step, size) in steps {
            let size = 10f64.powf(size);
            let most = [80.0, 80.0, 40.0, 80.0, 360.0];
            for ((at, by), most) in at.iter_mut().zip(step).zip(most) {
                *at = (*at + by * size).clamp(-most, most);
            }
            way.push(five(at));
        }
        way
    })
}

/// An operator: after so many servo periods each, the override, 0 for a hold.
fn any_operator() -> impl Strategy<Value = Vec<(usize, f64)>> {
    let scale = prop_oneof![Just(0.0), Just(1.0), 0.1..2.0f64];
    prop::collection::vec((50..500usize, scale), 0..6)
}

/// Runs lines in blocks that fit, as a program does.
fn run_lines(
    machine: &mut Machine,
    way: &[Axes],
    request: &MoveRequest,
    operator: &[(usize, f64)],
) {
    let mut left = way.iter().skip(1);
    let mut next = left.next();
    let mut changes = operator.iter();
    let (mut until, mut scale) = (0, 1.0);
    for cycle in 0..400_000 {
        while let Some(end) = next
            && !machine.planner.status().queue_full
        {
            machine.line(*end, request).expect("a line");
            next = left.next();
        }
        if cycle >= until {
            let change = changes.next();
            until = change.map_or(usize::MAX, |(periods, _)| cycle + periods);
            scale = change.map_or(1.0, |(_, scale)| *scale);
            machine.inputs.feed_scale = scale.max(0.1);
        }
        let status = machine.scaled_cycle(if scale > 0.0 { 1.0 } else { 0.0 });
        if status.done && next.is_none() {
            return;
        }
    }
    panic!("never done: {:?}", machine.planner.status());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn of_a_table_with_any_moves_and_operator(
        way in any_way(),
        operator in any_operator(),
        feed in prop_oneof![5.0..200.0f64, Just(1e5)],
        numerical in any::<bool>(),
    ) {
        let jet = if numerical { NUMERICAL_TABLE } else { EXACT_TABLE };
        let extremes = with_room(|| {
            let mut machine = machine_at(&way[0], Some(joints_of(jet, 5)));
            run_lines(&mut machine, &way, &feed_move(feed), &operator);
            of_joints(&mut machine, 5, table)
        });
        keeps_limits(&extremes)?;
    }

    #[test]
    fn of_a_table_from_rest_to_rest(way in any_way(), feed in 5.0..200.0f64, exact_stop in any::<bool>()) {
        let extremes = with_room(|| {
            let mut machine = machine_at(&way[0], Some(joints_of(EXACT_TABLE, 5)));
            let kind = if exact_stop { TerminationCondition::Stop } else { TerminationCondition::Exact };
            machine.planner.set_termination(kind);
            run_lines(&mut machine, &way[..way.len().min(8)], &feed_move(feed), &[]);
            of_joints(&mut machine, 5, table)
        });
        keeps_limits(&extremes)?;
    }
}

/// The way of both arms to `beside` straight and on, radially or past it.
fn towards_straight(beside: f64, radially: bool) -> (usize, Extremes) {
    with_room(|| {
        let far = REACH - beside;
        let way: Vec<Axes> = if radially {
            vec![[500.0, 0.0], [far, 0.0], [500.0, 30.0]]
        } else {
            vec![[far, 0.0], [0.0, far], [-300.0, 300.0]]
        }
        .into_iter()
        .map(|[x, y]| five([x, y, 0.0, 0.0, 0.0]))
        .collect();
        let mut machine = machine_at(&way[0], Some(joints_of(NUMERICAL_ROBOT, 4)));
        run_lines(&mut machine, &way, &feed_move(100.0), &[]);
        let periods = machine.positions.len();
        (periods, of_joints(&mut machine, 4, robot))
    })
}

#[test]
fn of_a_robot_that_comes_near_to_straight_arms() {
    for beside in [10.0, 1.0, 0.1, 0.01, 1e-3] {
        for radially in [true, false] {
            let (periods, extremes) = towards_straight(beside, radially);
            println!("{beside} {radially}: {periods} {extremes:?}");
            let within = extremes.velocity <= 1.001
                && extremes.acceleration <= 1.001
                && extremes.jerk <= JERK_KEPT;
            assert!(
                within && periods < 30_000,
                "{beside} {radially}: {periods} {extremes:?}"
            );
        }
    }
}

/// A circle about the axis C, which turns along: the tip stays where it is in the machine.
#[test]
fn of_arcs() {
    let extremes = with_room(|| {
        let mut machine = machine_at(
            &five([40.0, 0.0, 0.0, -30.0, 0.0]),
            Some(joints_of(EXACT_TABLE, 5)),
        );
        let circle = Circle {
            center: Vector3::zeros(),
            normal: Vector3::z(),
            revolutions: 0,
        };
        machine
            .circle(
                five([0.0, 40.0, 5.0, 10.0, 200.0]),
                &circle,
                &feed_move(150.0),
            )
            .expect("an arc");
        machine
            .circle(
                five([-40.0, 0.0, 0.0, -60.0, -90.0]),
                &circle,
                &feed_move(150.0),
            )
            .expect("an arc");
        machine.run(100_000);
        of_joints(&mut machine, 5, table)
    });
    keeps_limits(&extremes).expect("within limits");
}

/// Back along the way, and forth again.
#[test]
fn of_the_way_back() {
    let extremes = with_room(|| {
        let mut machine = machine_at(&Axes::zeros(), Some(joints_of(EXACT_TABLE, 5)));
        let way = [
            [30.0, 20.0, 5.0, -60.0, 80.0],
            [60.0, -40.0, 0.0, 20.0, -70.0],
            [0.0; 5],
        ];
        for end in way.map(five) {
            machine.line(end, &feed_move(100.0)).expect("a line");
        }
        for _ in 0..2500 {
            machine.cycle();
        }
        for backwards in [true, false] {
            while machine.planner.run_backwards(backwards).is_err() {
                machine.scaled_cycle(0.0);
            }
            for _ in 0..1500 {
                machine.cycle();
            }
        }
        machine.run(100_000);
        of_joints(&mut machine, 5, table)
    });
    keeps_limits(&extremes).expect("within limits");
}

/// With the table as it is the joints of a thread run straight: as close to the spindle as without limits of joints.
#[test]
fn of_threads() {
    let (phases, extremes) = with_room(|| {
        let start = five([10.0, 0.0, 0.0, 0.0, 30.0]);
        let mut machine = machine_at(&start, Some(joints_of(EXACT_TABLE, 5)));
        machine.planner.set_termination(TerminationCondition::Stop);
        let mut lathe = Lathe::new(&mut machine, 8.0);
        lathe
            .machine
            .planner
            .set_spindle_synchronisation(SPINDLE as i32, 1.5, false);
        lathe
            .machine
            .line(five([10.0, 0.0, -30.0, 0.0, 30.0]), &fast())
            .expect("a thread");
        lathe.run(100_000);
        let phases = lathe.phases(-5.0, -25.0, -1.5);
        (phases, of_joints(&mut machine, 5, table))
    });
    assert!(spread(&phases) < 1e-3, "{}", spread(&phases));
    keeps_limits(&extremes).expect("within limits");
}

/// Positions of the axes while long turns run with these joints, on a machine to which something is done before.
fn turns(joints: Option<JointMap>, prepare: impl FnOnce(&mut Machine) + Send) -> Vec<Axes> {
    with_room(|| {
        let mut machine = machine_at(&Axes::zeros(), joints);
        prepare(&mut machine);
        let way = [
            [0.0; 5],
            [30.0, 20.0, 5.0, -60.0, 180.0],
            [60.0, -40.0, 0.0, 20.0, -170.0],
        ];
        run_lines(&mut machine, &way.map(five), &feed_move(100.0), &[]);
        machine.positions
    })
}

#[test]
fn a_frame_does_not_take_them_away() {
    let joints = || Some(joints_of(EXACT_TABLE, 5));
    let framed = turns(joints(), |machine| {
        assert!(machine.planner.set_machine_map(&Matrix3::identity()));
    });
    assert_eq!(turns(joints(), |_| {}), framed);
}

#[test]
fn joints_without_limits_change_nothing() {
    let without = turns(None, |_| {});
    let joints = || Some(joints_of(EXACT_TABLE, 5));
    assert_ne!(without, turns(joints(), |_| {}));
    let again = turns(joints(), |machine| {
        assert!(machine.planner.set_joints(None));
    });
    assert_eq!(without, again);
}

#[test]
fn limits_that_are_none_are_refused() {
    with_room(|| {
        let mut machine = machine_at(&Axes::zeros(), None);
        for limits in [
            [0.0, 1000.0, 1e4],
            [100.0, f64::NAN, 1e4],
            [100.0, 1000.0, -1.0],
        ] {
            let joints = JointMap::new(EXACT_TABLE, &joint_limits(5, limits), 100.0);
            assert!(!machine.planner.set_joints(Some(joints)));
        }
        // In force from the next rest on: half of the speed for the second line only.
        let (near, far) = (
            five([0.0, 0.0, 60.0, 0.0, 0.0]),
            five([0.0, 0.0, 120.0, 0.0, 0.0]),
        );
        machine.planner.set_termination(TerminationCondition::Stop);
        machine.line(near, &feed_move(80.0)).expect("a line");
        for _ in 0..200 {
            machine.cycle();
        }
        let slow = joint_limits(5, [40.0, 1000.0, 20_000.0]);
        assert!(
            machine
                .planner
                .set_joints(Some(JointMap::new(EXACT_TABLE, &slow, 100.0)))
        );
        machine.line(far, &feed_move(80.0)).expect("a line");
        machine.run(10_000);
        let speed = |from: f64, to: f64| {
            let inside = |pair: &&[Axes]| (from..to).contains(&pair[0][2]);
            let speeds = machine
                .positions
                .windows(2)
                .filter(inside)
                .map(|pair| (pair[1][2] - pair[0][2]) / PERIOD);
            speeds.fold(0.0, f64::max)
        };
        assert!(
            (speed(0.0, 59.0) - 80.0).abs() < 0.1,
            "{}",
            speed(0.0, 59.0)
        );
        assert!(
            (speed(61.0, 119.0) - 40.0).abs() < 0.1,
            "{}",
            speed(61.0, 119.0)
        );
    });
}
