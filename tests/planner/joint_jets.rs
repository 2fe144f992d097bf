//! How joints move: exact and numerical derivatives say the same.

use crate::joint_models::{
    EXACT_TABLE, NUMERICAL_ROBOT, NUMERICAL_TABLE, REACH, joints_of, robot, table,
};
use framepath::axes::Axes;
use framepath::frame::{ActiveFrame, LinearAxis, Operation, OperationList, ToolLength, WorkOffset};
use framepath::machine::{JOINT_COUNT, Machine, RotaryDirection, TableTiltingParameters};
use framepath::machine_map::JointJet;
use framepath::numerical_jet::{numerical_estimate, numerical_jet};
use nalgebra::Vector3;
use proptest::prelude::*;

/// What the two may differ by, over the limits.
const ALIKE: f64 = 1e-4;

/// Three derivatives by time of which none takes an axis beyond 100, 1000 and 20000.
fn any_derivatives() -> impl Strategy<Value = [Axes; 3]> {
    let of = |most: f64| prop::array::uniform9(-most..most).prop_map(Axes::from);
    (of(100.0), of(1000.0), of(20_000.0)).prop_map(|(first, second, third)| [first, second, third])
}

fn any_position() -> impl Strategy<Value = Axes> {
    prop::array::uniform9(-150.0..150.0f64).prop_map(Axes::from)
}

/// The greatest difference over the limits of the joints.
fn difference(one: &[Axes; 3], other: &[Axes; 3], shares: &[Axes; 3]) -> f64 {
    let pairs = one.iter().zip(other).zip(shares);
    pairs.fold(0.0, |most, ((one, other), share)| {
        most.max((one - other).component_mul(share).amax())
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_numbers_are_those_of_the_formulas(
        (position, derivatives) in (any_position(), any_derivatives()),
        (tilts_b, conventional) in any::<(bool, bool)>(),
        (point, offset, tool) in (prop::array::uniform3(-80.0..80.0f64), prop::array::uniform3(-40.0..40.0f64), 0.0..150.0f64),
        slowness in 0.0..6.0f64,
    ) {
        let (name, letters): (&[u8], &[u8]) = if tilts_b { (b"xyzbc", b"XYZBC") } else { (b"xyzac", b"XYZAC") };
        let mut machine = Machine::configured(name, letters).expect("a machine");
        let parameters = TableTiltingParameters {
            rotation_point: Vector3::from(point),
            offset: Vector3::from(offset),
            tool_offset: tool,
            direction: if conventional { RotaryDirection::Conventional } else { RotaryDirection::Table },
            tool_centre_point: true,
        };
        machine.set_parameters(&parameters).expect("dimensions");
        // By the path instead of by time a unit is another one.
        let unit = (-slowness).exp();
        let derivatives = [derivatives[0] * unit, derivatives[1] * (unit * unit), derivatives[2] * unit.powi(3)];
        let shares = *joints_of(EXACT_TABLE, 5).shares();
        let joints = |axes: &Axes| {
            let mut joints = [0.0; JOINT_COUNT];
            machine.inverse(axes, &mut joints);
            Axes::from_fn(|joint, _| joints[joint])
        };
        let exact = machine.joint_derivatives(&position, &derivatives);
        let numerical = numerical_jet(joints, &position, &derivatives, &shares);
        let differs = difference(&exact, &numerical, &shares);
        prop_assert!(differs < ALIKE, "{differs} {exact:?} {numerical:?}");
    }

    /// Each order by itself may be as small as it likes beside the others: a corner bends where it hardly moves. The places of
    /// the numbers lie where the joints are not off by the products of these, over the limits at the speed that all allow.
    #[test]
    fn the_numbers_hold_where_the_path_bends_more_than_it_moves(
        (position, derivatives) in (any_position(), any_derivatives()),
        smaller in prop::array::uniform3(0.0..3.0f64),
    ) {
        let mut scaled = derivatives;
        for (derivative, smaller) in scaled.iter_mut().zip(smaller) {
            *derivative *= 10f64.powf(-smaller);
        }
        let shares = *joints_of(EXACT_TABLE, 5).shares();
        let exact = EXACT_TABLE(&position, &scaled, &shares);
        let numerical = NUMERICAL_TABLE(&position, &scaled, &shares);
        let differs = difference(&exact, &numerical, &at_speed(&exact, &shares));
        prop_assert!(differs < ALIKE, "{differs} {exact:?} {numerical:?}");
    }

    #[test]
    fn a_frame_turns_derivatives_as_it_turns_ways(
        position in any_position(),
        way in any_position(),
        (angle, scale, mirrored) in (-180.0..180.0f64, 0.3..3.0f64, any::<[bool; 6]>()),
    ) {
        let mut list = OperationList::new();
        for operation in [
            Operation::translate(Vector3::new(3.0, -7.0, 11.0)),
            Operation::rotate(LinearAxis::X, angle),
            Operation::scale(Vector3::new(scale, 1.0, 1.0)),
        ] {
            list.append(&operation.expect("an operation")).expect("room");
        }
        let frame = list.fold().expect("a frame");
        let tool = Axes::z() * 20.0;
        let frame = ActiveFrame::new(&frame, mirrored, &WorkOffset::none(), &tool, ToolLength::Frame).expect("a frame");
        let moved = frame.to_machine(&(position + way)) - frame.to_machine(&position);
        prop_assert!((frame.derivative_to_machine(&way) - moved).amax() < 1e-9);
    }
}

/// Both arms at this angle to each other, degrees, moving radially at 10 mm/s.
fn elbow_speed(jet: JointJet, elbow: f64) -> (f64, f64) {
    let upright = Axes::x() * (REACH * (elbow / 2.0).to_radians().cos());
    let along = [Axes::x() * 10.0, Axes::zeros(), Axes::zeros()];
    let joints = joints_of(jet, 4);
    let [first, ..] = jet(&upright, &along, joints.shares());
    let h = 1e-7 * elbow;
    let beside = robot(&(upright + Axes::x() * h)) - robot(&(upright - Axes::x() * h));
    (first[1], beside[1] / (2.0 * h) * 10.0)
}

#[test]
fn near_a_singular_place_the_step_becomes_smaller() {
    for elbow in [60.0, 20.0, 6.0, 2.0, 1.2] {
        let (jet, difference) = elbow_speed(NUMERICAL_ROBOT, elbow);
        assert!(
            (jet / difference - 1.0).abs() < 1e-3,
            "{elbow}: {jet} {difference}"
        );
    }
}

/// The jet, and how often the joints were asked for.
fn counted(
    joints: impl Fn(&Axes) -> Axes,
    position: &Axes,
    derivatives: &[Axes; 3],
    shares: &[Axes; 3],
) -> ([Axes; 3], usize) {
    let calls = std::cell::Cell::new(0);
    let asked = |axes: &Axes| {
        calls.set(calls.get() + 1);
        joints(axes)
    };
    let jet = numerical_jet(asked, position, derivatives, shares);
    (jet, calls.get())
}

/// What a unit of each derivative is of the limits at the speed that they allow.
fn at_speed(jet: &[Axes; 3], shares: &[Axes; 3]) -> [Axes; 3] {
    let share = |order: usize| jet[order].component_mul(&shares[order]).amax();
    let taken = share(0).max(share(1).sqrt()).max(share(2).cbrt());
    core::array::from_fn(|order| shares[order] / taken.powi(order as i32 + 1))
}

/// Along this way on a circle of this radius at least, or on a line.
fn along(way: [f64; 9], radius: f64, bends: &[[f64; 9]; 2]) -> [Axes; 3] {
    let way = Axes::from(way);
    let curvature = way.amax() / radius;
    let [second, third] = bends.map(Axes::from);
    [
        way,
        second * (way.amax() * curvature),
        third * (way.amax() * curvature * curvature),
    ]
}

fn any_way() -> impl Strategy<Value = [Axes; 3]> {
    let signs = || prop::array::uniform9(-1.0..1.0f64);
    let radius = prop_oneof![Just(f64::INFINITY), 9.0..300.0f64];
    (signs(), radius, [signs(), signs()])
        .prop_map(|(way, radius, bends)| along(way.map(|part| part * 100.0), radius, &bends))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn four_places_say_the_same_where_nothing_bends((position, derivatives) in (any_position(), any_way())) {
        let shares = *joints_of(EXACT_TABLE, 5).shares();
        let (numerical, calls) = counted(table, &position, &derivatives, &shares);
        prop_assert!(calls == 4 || calls == 9, "{calls}");
        let exact = EXACT_TABLE(&position, &derivatives, &shares);
        let differs = difference(&exact, &numerical, &at_speed(&exact, &shares));
        prop_assert!(differs < ALIKE, "{differs} {exact:?} {numerical:?}");
    }

    /// Both arms nearly in line: what four places say there is what more of them say, or more are asked for.
    #[test]
    fn near_a_singular_place_four_places_are_not_enough(
        (below, angle) in ((-7.0..6.0f64).prop_map(f64::exp), -3.0..3.0f64),
        derivatives in any_way(),
    ) {
        let mut position = Axes::zeros();
        (position[0], position[1]) = ((REACH - below) * angle.cos(), (REACH - below) * angle.sin());
        let derivatives = derivatives.map(|axes| robot_axes().component_mul(&axes));
        let shares = *joints_of(NUMERICAL_ROBOT, 4).shares();
        let (jet, _) = counted(robot, &position, &derivatives, &shares);
        let sure = numerical_estimate(robot, &position, &derivatives, &shares).jet;
        let at_speed = at_speed(&sure, &shares);
        let differs = difference(&jet, &sure, &[0, 1, 2].map(|order| at_speed[order].inf(&shares[order])));
        let most = if below > 2.0 { ALIKE } else { 3.0 * ALIKE };
        prop_assert!(differs < most, "{differs} {below}");
    }
}

/// Those that move the robot.
fn robot_axes() -> Axes {
    Axes::from([1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
}

#[test]
fn four_places_are_enough_along_a_circle() {
    let shares = *joints_of(EXACT_TABLE, 5).shares();
    for turn in 0..100 {
        let (sine, cosine) = f64::from(turn).sin_cos();
        // Of 20 mm, while both rotary axes turn.
        let mut position = Axes::from([cosine, sine, 0.0, 1.0, 0.0, 2.0, 0.0, 0.0, 0.0]) * 20.0;
        position[2] = f64::from(turn);
        let around = Axes::from([-sine, cosine, 0.2, 0.5, 0.0, 1.0, 0.0, 0.0, 0.0]);
        let inwards = Axes::from([-cosine, -sine, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]) / 20.0;
        let back = Axes::from([sine, -cosine, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]) / 400.0;
        let (_, calls) = counted(table, &position, &[around, inwards, back], &shares);
        assert_eq!(calls, 4, "{turn}");
    }
}

/// Beside the end of what the machine reaches the places are taken nearer.
#[test]
fn where_joints_end_they_are_looked_for_nearer() {
    let ends = |axes: &Axes| {
        if axes[0] > 1.0 {
            Axes::repeat(f64::NAN)
        } else {
            axes * 2.0
        }
    };
    let along = [Axes::x(), Axes::zeros(), Axes::zeros()];
    let shares = *joints_of(EXACT_TABLE, 5).shares();
    let [first, ..] = numerical_jet(ends, &(Axes::x() * 0.99), &along, &shares);
    assert!((first[0] - 2.0).abs() < 1e-9, "{}", first[0]);
}

#[test]
fn where_arms_are_nearly_in_line_more_places_are_asked_for() {
    let shares = *joints_of(NUMERICAL_ROBOT, 4).shares();
    for below in [100.0, 30.0, 3.0, 0.3, 0.03] {
        let position = Axes::x() * (REACH - below);
        let outwards = [Axes::x(), Axes::zeros(), Axes::zeros()];
        let (_, calls) = counted(robot, &position, &outwards, &shares);
        assert_eq!(calls > 4, below < 5.0, "{below}: {calls}");
    }
}

#[test]
fn where_rounding_is_in_the_way_no_smaller_step_is_tried() {
    let calls = std::cell::Cell::new(0);
    let far = |axes: &Axes| {
        calls.set(calls.get() + 1);
        axes.add_scalar(1e7) * 1.1
    };
    let shares = *joints_of(EXACT_TABLE, 5).shares();
    let along = [Axes::x(), Axes::zeros(), Axes::zeros()];
    let found = numerical_estimate(far, &Axes::repeat(1.0 / 3.0), &along, &shares);
    let [first, ..] = found.jet;
    assert!((first[0] - 1.1).abs() < 1e-6, "{}", first[0]);
    assert_eq!(calls.get(), 7);
}

#[test]
fn what_stands_still_has_joints_that_stand_still() {
    let shares = *joints_of(EXACT_TABLE, 5).shares();
    let nothing = [Axes::zeros(); 3];
    assert_eq!(
        NUMERICAL_TABLE(&Axes::repeat(7.0), &nothing, &shares),
        nothing
    );
}

#[test]
fn where_there_are_no_joints_nothing_is_said() {
    let nowhere = |_: &Axes| Axes::repeat(f64::NAN);
    let along = [Axes::x(), Axes::zeros(), Axes::zeros()];
    let shares = *joints_of(EXACT_TABLE, 5).shares();
    let [first, ..] = numerical_jet(nowhere, &Axes::zeros(), &along, &shares);
    assert!(first[0].is_nan());
}
