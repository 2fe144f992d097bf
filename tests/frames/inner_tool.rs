//! How kinematics of another module turn the tool: tables, heads, one of each, and those of which it cannot be known.

use framepath::axes::Axes;
use framepath::kinematics::inner::InnerKinematics;
use framepath::kinematics::inner_tool::{Unknown, tool_turning};
use framepath::kinematics::{
    AngleRange, OrientationError, RotaryAngles, RotaryChain, RotaryLimits, ToolAxes,
    ToolNormalError, inner_normal, tool_angles,
};
use framepath::machine::{Machine, TableTiltingParameters};
use nalgebra::{Rotation3, Unit, Vector3};
use proptest::prelude::*;

/// Joints for a tip and the angles A B C, by a formula.
pub struct Formula<F>(pub F);

impl<F: FnMut(Vector3<f64>, [f64; 3]) -> [f64; 6]> InnerKinematics for Formula<F> {
    fn inverse(&mut self, axes: &Axes, joints: &mut [f64; 16]) -> i32 {
        let [x, y, z, a, b, c, ..]: [f64; 9] = (*axes).into();
        joints[..6].copy_from_slice(&(self.0)(Vector3::new(x, y, z), [a, b, c]));
        0
    }

    fn forward(&mut self, _: &[f64; 16], _: &mut Axes) -> i32 {
        0
    }
}

pub fn about(line: Vector3<f64>, degrees: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Unit::new_normalize(line), degrees.to_radians())
}

pub fn joints(place: Vector3<f64>, [a, b, c]: [f64; 3]) -> [f64; 6] {
    [place.x, place.y, place.z, a, b, c]
}

/// A head that turns about Z by C and, carried by it, about this line by B, so far above the tip.
pub fn head(line: Vector3<f64>, reach: f64) -> impl FnMut(Vector3<f64>, [f64; 3]) -> [f64; 6] {
    move |tip, angles| {
        let tool = about(Vector3::z(), angles[2]) * about(line, angles[1]) * Vector3::z();
        joints(tip + reach * (tool - Vector3::z()), angles)
    }
}

/// A table turns about Z by C, a head about -Y by B.
pub fn mixed(tip: Vector3<f64>, angles: [f64; 3]) -> [f64; 6] {
    let tool = about(-Vector3::y(), angles[1]) * Vector3::z();
    let centre = Vector3::new(3.0, -2.0, 0.0);
    let turned = about(Vector3::z(), angles[2]) * (tip - centre) + centre;
    joints(turned + 80.0 * (tool - Vector3::z()), angles)
}

fn ask(inner: &mut impl InnerKinematics) -> Result<Option<RotaryChain>, Unknown> {
    let here = Axes::from([12.0, -5.0, 30.0, 7.0, -11.0, 23.0, 0.0, 0.0, 0.0]);
    tool_turning(inner, &here, &[0.0; 16], &ToolAxes::Unsaid).map(|found| found.chain)
}

/// What comes of it where a user says something.
fn said(
    text: &str,
    formula: impl FnMut(Vector3<f64>, [f64; 3]) -> [f64; 6],
) -> Result<Option<RotaryChain>, Unknown> {
    let axes = ToolAxes::from_text(text.as_bytes()).expect("axes");
    let found = tool_turning(&mut Formula(formula), &Axes::zeros(), &[0.0; 16], &axes);
    found.map(|found| found.chain)
}

/// Joints of an arm, which cannot be asked.
fn arm(tip: Vector3<f64>, angles: [f64; 3]) -> [f64; 6] {
    let (reach, bearing) = (
        tip.x.hypot(tip.y) + 10.0,
        tip.y.atan2(tip.x + 1.0).to_degrees(),
    );
    joints(Vector3::new(reach, bearing, tip.z), angles)
}

fn found(formula: impl FnMut(Vector3<f64>, [f64; 3]) -> [f64; 6]) -> RotaryChain {
    ask(&mut Formula(formula))
        .expect("known")
        .expect("something turns")
}

fn letters(chain: &RotaryChain) -> (usize, Option<usize>) {
    (chain.tilt.letter, chain.rotary.map(|axis| axis.letter))
}

const UNLIMITED: RotaryLimits = RotaryLimits {
    tilt: AngleRange::UNLIMITED,
    rotary: AngleRange::UNLIMITED,
};

#[test]
fn a_head_points_where_its_angles_say() {
    let chain = found(head(Vector3::y(), 250.0));
    assert_eq!(letters(&chain), (1, Some(2)));
    let (tilt, rotary) = (30.0_f64, 90.0);
    let tool = chain.direction(RotaryAngles { tilt, rotary });
    // by hand: B leans the tool to X, C turns that to Y
    let expected = Vector3::new(0.0, 0.5, 0.75_f64.sqrt());
    assert!((tool - expected).norm() < 1e-12, "{tool}");
}

#[test]
fn a_head_beside_a_table() {
    let chain = found(mixed);
    assert_eq!(letters(&chain), (1, Some(2)));
    let tool = chain.direction(RotaryAngles {
        tilt: 30.0,
        rotary: 90.0,
    });
    // the workpiece has turned the other way round
    let expected = Vector3::new(0.0, 0.5, 0.75_f64.sqrt());
    assert!((tool - expected).norm() < 1e-12, "{tool}");
}

#[test]
fn a_head_with_a_slanting_axis_reaches_half_of_the_directions() {
    let chain = found(head(Vector3::new(0.0, 1.0, 1.0), 100.0));
    let level = RotaryAngles {
        tilt: 0.0,
        rotary: 0.0,
    };
    let [first, second] = chain.solutions(&Vector3::x(), level).expect("reached");
    for angles in [first, second] {
        assert!((chain.direction(angles) - Vector3::x()).norm() < 1e-9);
    }
    let below = chain.solutions(&Vector3::new(1.0, 0.0, -0.01), level);
    assert!(matches!(below, Err(OrientationError::Unreachable { .. })));
}

#[test]
fn one_axis_alone_reaches_its_circle() {
    let chain = found(|tip, angles| joints(about(Vector3::x(), angles[0]) * tip, angles));
    assert_eq!(letters(&chain), (0, None));
    let level = RotaryAngles {
        tilt: 0.0,
        rotary: 0.0,
    };
    let direction = Vector3::new(0.0, 1.0, 3.0_f64.sqrt());
    let [first, second] = chain.solutions(&direction, level).expect("reached");
    assert_eq!(first, second);
    assert!((first.tilt - 30.0).abs() < 1e-9);
    let beside = chain.solutions(&Vector3::new(0.1, 1.0, 1.0), level);
    assert!(matches!(beside, Err(OrientationError::Unreachable { .. })));
}

#[test]
fn two_tilting_axes_are_put_in_order() {
    // B carries A
    let table = |tip: Vector3<f64>, [a, b, c]: [f64; 3]| {
        joints(
            about(Vector3::y(), b) * about(Vector3::x(), a) * tip,
            [a, b, c],
        )
    };
    let chain = found(table);
    let tool = chain.direction(RotaryAngles {
        tilt: 20.0,
        rotary: 50.0,
    });
    let (tilt, rotary) = match letters(&chain) {
        (1, Some(0)) => (20.0, 50.0),
        other => panic!("{other:?}"),
    };
    let turn = about(Vector3::y(), tilt) * about(Vector3::x(), rotary);
    assert!((turn * tool - Vector3::z()).norm() < 1e-12);
}

#[test]
fn axes_that_turn_nothing_are_told_from_those_that_are_not_understood() {
    assert_eq!(ask(&mut Formula(joints)), Ok(None));
    // two arms
    let arms = |tip: Vector3<f64>, angles: [f64; 3]| {
        let (reach, bearing) = (tip.x.hypot(tip.y), tip.y.atan2(tip.x).to_degrees());
        joints(Vector3::new(reach, bearing, tip.z), angles)
    };
    assert_eq!(ask(&mut Formula(arms)), Err(Unknown::NotFound));
    let fails = |_, _| [f64::NAN; 6];
    assert_eq!(ask(&mut Formula(fails)), Err(Unknown::NotFound));
    // a head that shifts where it turns is no head
    let shifting = |tip: Vector3<f64>, angles: [f64; 3]| {
        let shift = Vector3::new(0.0, 0.3 * angles[1], 0.0);
        joints(
            tip + about(Vector3::y(), angles[1]) * Vector3::new(15.0, 0.0, 100.0) + shift,
            angles,
        )
    };
    assert_eq!(ask(&mut Formula(shifting)), Err(Unknown::NotFound));
}

/// A head on C and B, or on B and A, whose axes miss each other and the tool.
fn bent(
    [carrying, carried]: [usize; 2],
    lines: [Vector3<f64>; 2],
) -> impl FnMut(Vector3<f64>, [f64; 3]) -> [f64; 6] {
    move |tip, angles| {
        let arm = about(lines[0], angles[carrying]);
        let tool = arm * about(lines[1], angles[carried]);
        let (reach, offset) = (
            Vector3::new(3.0, -4.0, 100.0),
            Vector3::new(15.0, 6.0, 20.0),
        );
        joints(tip + tool * reach + arm * offset, angles)
    }
}

#[test]
fn a_head_whose_axes_do_not_meet() {
    let cases = [
        ([2, 1], [Vector3::z(), Vector3::y()]),
        ([2, 0], [-Vector3::z(), Vector3::x()]),
        ([2, 1], [Vector3::z(), Vector3::new(0.0, 1.0, 1.0)]),
        ([1, 0], [Vector3::y(), -Vector3::x()]),
        ([0, 1], [Vector3::x(), Vector3::y()]),
    ];
    for (axes, lines) in cases {
        let chain = found(bent(axes, lines));
        assert_eq!(letters(&chain), (axes[1], Some(axes[0])));
        let (tilt, rotary) = (-37.0, 71.0);
        let tool = chain.direction(RotaryAngles { tilt, rotary });
        let expected = about(lines[0], rotary) * about(lines[1], tilt) * Vector3::z();
        assert!((tool - expected).norm() < 1e-9, "{axes:?} {tool}");
    }
}

#[test]
fn a_bent_head_of_one_axis_alone_beside_a_table_or_with_a_spindle_that_turns() {
    let side = Vector3::new(15.0, 0.0, 100.0);
    let chain = found(|tip, angles| joints(tip + about(Vector3::y(), angles[1]) * side, angles));
    assert_eq!(letters(&chain), (1, None));
    let beside = |tip: Vector3<f64>, angles: [f64; 3]| {
        let turned = about(Vector3::z(), angles[2]) * (tip - Vector3::new(3.0, -2.0, 0.0));
        joints(turned + about(-Vector3::y(), angles[1]) * side, angles)
    };
    let chain = found(beside);
    assert_eq!(letters(&chain), (1, Some(2)));
    let (tilt, rotary) = (30.0, 90.0);
    let tool = chain.direction(RotaryAngles { tilt, rotary });
    // the workpiece has turned the other way round
    let expected = Vector3::new(0.0, 0.5, 0.75_f64.sqrt());
    assert!((tool - expected).norm() < 1e-9, "{tool}");
    // C turns the tool about itself, beside its line
    let spindle = |tip: Vector3<f64>, angles: [f64; 3]| {
        let off = about(Vector3::z(), angles[2]) * Vector3::new(2.0, 0.0, 0.0);
        joints(tip + about(Vector3::y(), angles[1]) * (side + off), angles)
    };
    assert_eq!(letters(&found(spindle)), (1, None));
}

#[test]
fn what_a_user_says_counts_where_nothing_can_be_found_and_has_to_be_so_where_it_can() {
    assert_eq!(said("", arm), Err(Unknown::NotFound));
    assert_eq!(said("none", arm), Ok(None));
    let chain = said("C,B", arm).expect("said").expect("axes");
    assert_eq!(letters(&chain), (1, Some(2)));
    // a head and a table that are asked
    let upright = || head(Vector3::y(), 250.0);
    assert!(said("C,B", upright()).is_ok_and(|chain| chain.is_some()));
    for wrong in ["-C,B", "C,-B", "C,A", "B", "none", "C,B:0:1:1"] {
        assert_eq!(said(wrong, upright()), Err(Unknown::NotAsSaid), "{wrong}");
    }
    assert!(said("-C,-B", mixed).is_ok_and(|chain| chain.is_some()));
    assert_eq!(said("C,-B", mixed), Err(Unknown::NotAsSaid));
    // a type without the tool centre point
    assert_eq!(said("C,B", joints), Ok(None));
}

#[test]
fn another_axis_of_an_arm_may_turn_the_tool() {
    let at = |text: &str, angles: [f64; 3]| {
        let axes = ToolAxes::from_text(text.as_bytes()).expect("axes");
        let mut formula = Formula(arm);
        let turning = tool_turning(&mut formula, &Axes::zeros(), &[0.0; 16], &axes);
        let [a, b, c] = angles;
        let place = Axes::from([1.0, 2.0, 3.0, a, b, c, 0.0, 0.0, 0.0]);
        turning.expect("said").is_turned_by_another(&place)
    };
    for (text, angles, is_turned) in [
        ("C,B", [0.0, 40.0, 50.0], false),
        // the tool hangs down
        ("C,B", [180.0, 40.0, 50.0], false),
        ("C,B", [-540.0, 40.0, 50.0], false),
        ("C,B", [150.0, 40.0, 50.0], true),
        ("C,B", [0.01, 0.0, 0.0], true),
        ("C,A", [150.0, 0.0, 50.0], false),
        ("C,A", [150.0, 20.0, 50.0], true),
        ("C,A", [150.0, 360.0, 50.0], false),
        // what A has tilted, B turns to the other side
        ("C,A", [150.0, 180.0, 50.0], true),
        ("B", [20.0, 0.0, 0.0], true),
        ("B", [180.0, 30.0, 0.0], false),
        // and C, wherever the others are named without it
        ("B,A", [20.0, 30.0, 0.0], false),
        ("B,A", [20.0, 30.0, -360.0], false),
        ("B,A", [20.0, 30.0, 50.0], true),
        ("B,A", [20.0, 30.0, 180.0], true),
        ("A,B", [20.0, 30.0, 0.01], true),
        ("B", [0.0, 30.0, 50.0], true),
        ("none", [20.0, 30.0, 50.0], false),
    ] {
        assert_eq!(at(text, angles), is_turned, "{text} {angles:?}");
    }
}

#[test]
fn without_an_axis_that_turns_only_what_is_upright_is_normal() {
    let mut motion = crate::common::Motion::new("identity", "XYZ");
    let position = Axes::zeros();
    let normal = |motion: &crate::common::Motion| {
        inner_normal(None, motion.control.active(), &position, &UNLIMITED)
    };
    assert_eq!(normal(&motion), Ok(None));
    assert_eq!(motion.send(2, [10.0, 0.0, 0.0]), None);
    assert_eq!(normal(&motion), Err(ToolNormalError::NothingTurnsTool));
}

proptest! {
    /// Of our own table, asked as if it were another module's, come the angles that are known for it.
    #[test]
    fn a_table_has_the_angles_of_our_own(
        polar in 0.001_f64..1.5, bearing in -3.1_f64..3.1, tilt in -60.0_f64..60.0, rotary in -300.0_f64..300.0,
        is_a in any::<bool>(), conventional in any::<bool>(),
    ) {
        let (name, letters) = if is_a { ("xyzac", "XYZAC") } else { ("xyzbc", "XYZBC") };
        let mut machine = Machine::configured(name.as_bytes(), letters.as_bytes()).expect("a machine");
        let parameters = TableTiltingParameters {
            rotation_point: Vector3::new(10.0, -20.0, 30.0),
            offset: Vector3::new(if is_a { 0.0 } else { 5.0 }, if is_a { 20.0 } else { 0.0 }, 7.0),
            tool_offset: 50.0,
            direction: if conventional {
                framepath::machine::RotaryDirection::Conventional
            } else {
                framepath::machine::RotaryDirection::Table
            },
            tool_centre_point: true,
        };
        machine.set_parameters(&parameters).expect("dimensions");
        let mut inner = Table(machine);
        let chain = ask(&mut inner).expect("known").expect("something turns");
        let direction = Vector3::new(polar.sin() * bearing.cos(), polar.sin() * bearing.sin(), polar.cos());
        let current = RotaryAngles { tilt, rotary };
        let Machine::TableTilting(table) = &machine else { unreachable!() };
        let limits = AngleRange::UNLIMITED;
        let known = tool_angles(table, &direction, current, limits, limits).expect("reached");
        let [first, second] = chain.solutions(&direction, current).expect("reached");
        let near = |angles: &RotaryAngles| {
            let turns = (angles.rotary - known.rotary) / 360.0;
            (angles.tilt - known.tilt).abs() < 1e-7 && (turns - turns.round()).abs() < 1e-9
        };
        prop_assert!(near(&first) || near(&second), "{first:?} {second:?} {known:?}");
    }
}

struct Table(Machine);

impl InnerKinematics for Table {
    fn inverse(&mut self, axes: &Axes, joints: &mut [f64; 16]) -> i32 {
        self.0.inverse(axes, joints);
        0
    }

    fn forward(&mut self, joints: &[f64; 16], axes: &mut Axes) -> i32 {
        *axes = self.0.forward(joints);
        0
    }
}
