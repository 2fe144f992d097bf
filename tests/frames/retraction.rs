//! The tool drawn back along itself: by tables, heads and one axis of each.

use crate::common::Motion;
use crate::inner_tool::{Formula, about, head, joints, mixed};
use framepath::axes::Axes;
use framepath::kinematics::inner::InnerKinematics;
use framepath::kinematics::inner_normal::angles;
use framepath::kinematics::inner_tool::tool_turning;
use framepath::kinematics::retraction::{along_tool, chain_of_table};
use framepath::kinematics::{Retraction, RetractionError, ToolAxes};
use framepath::machine::{Machine, RotaryDirection, TableTiltingParameters};
use nalgebra::Vector3;
use proptest::prelude::*;

/// X Y Z of the joints.
fn place(inner: &mut impl InnerKinematics, axes: &Axes) -> Vector3<f64> {
    let mut found = [0.0; 16];
    inner.inverse(axes, &mut found);
    Vector3::new(found[0], found[1], found[2])
}

/// Where the joints go while Z rises by one, as the kinematics themselves say it, in a frame or without.
fn drawn_back(
    inner: &mut impl InnerKinematics,
    position: Axes,
    motion: &Motion,
) -> Result<Vector3<f64>, RetractionError> {
    let found = tool_turning(inner, &position, &[0.0; 16], &ToolAxes::Unsaid).expect("known");
    let chain = found.chain.expect("something turns");
    let frame = motion.control.active();
    let retraction = along_tool(&chain, angles(&chain, &position), frame, 7.0)?;
    let Retraction::AlongTool { way, z } = retraction else {
        panic!("{retraction:?}");
    };
    assert_eq!((z, found.z_joint), (7.0, Some(2)));
    let to_world = |axes: &Axes| frame.map_or(*axes, |frame| frame.to_world(axes));
    let to_machine = |axes: &Axes| frame.map_or(*axes, |frame| frame.to_machine(axes));
    let mut world = to_world(&position);
    for (axis, along) in way.iter().enumerate() {
        world[axis] += along;
    }
    let (there, here) = (to_machine(&world), position);
    Ok(place(inner, &there) - place(inner, &here))
}

fn frames() -> [Motion; 2] {
    let mut framed = Motion::new("identity", "XYZ");
    assert_eq!(framed.send(2, [20.0, -35.0, 50.0]), None);
    assert_eq!(framed.send(107, [2.0, 2.0, 2.0]), None);
    [Motion::new("identity", "XYZ"), framed]
}

#[test]
fn a_head_that_lies_level_is_not_drawn_back_by_z() {
    let [plain, _] = frames();
    let mut level = Formula(head(Vector3::y(), 250.0));
    for angle in [86.0, 95.0, 180.0] {
        let position = Axes::from([0.0, 0.0, 0.0, 0.0, angle, 0.0, 0.0, 0.0, 0.0]);
        let answer = drawn_back(&mut level, position, &plain);
        assert_eq!(answer, Err(RetractionError::Level), "{angle}");
    }
}

proptest! {
    /// Z rises by one, and the head goes where the tool points.
    #[test]
    fn the_tool_goes_along_itself(a in -80.0_f64..80.0, c in -300.0_f64..300.0, x in -100.0_f64..100.0) {
        let position = Axes::from([x, -5.0, 30.0, 0.0, a, c, 0.0, 0.0, 0.0]);
        for motion in frames() {
            let way = drawn_back(&mut Formula(head(Vector3::y(), 250.0)), position, &motion);
            let tool = about(Vector3::z(), c) * about(Vector3::y(), a) * Vector3::z();
            prop_assert!((way.unwrap() - tool / tool.z).norm() < 1e-9);
            let way = drawn_back(&mut Formula(mixed), position, &motion);
            let tool = about(-Vector3::y(), a) * Vector3::z();
            prop_assert!((way.unwrap() - tool / tool.z).norm() < 1e-9);
            let table = |tip: Vector3<f64>, [a, b, c]: [f64; 3]| {
                joints(about(Vector3::y(), b) * about(Vector3::z(), c) * tip, [a, b, c])
            };
            let way = drawn_back(&mut Formula(table), position, &motion);
            prop_assert!((way.unwrap() - Vector3::z()).norm() < 1e-9);
        }
    }

    /// Our own tables need not be asked.
    #[test]
    fn tables_of_ours_are_known(tilt in -80.0_f64..80.0, rotary in -300.0_f64..300.0, is_a in any::<bool>(),
                                conventional in any::<bool>()) {
        let (name, letters) = if is_a { ("xyzac", "XYZAC") } else { ("xyzbc", "XYZBC") };
        let mut machine = Machine::configured(name.as_bytes(), letters.as_bytes()).expect("a machine");
        let direction = if conventional { RotaryDirection::Conventional } else { RotaryDirection::Table };
        machine.set_parameters(&TableTiltingParameters {
            direction,
            tool_centre_point: true,
            ..TableTiltingParameters::default()
        }).expect("dimensions");
        let Machine::TableTilting(table) = &machine else { unreachable!() };
        let chain = chain_of_table(table);
        let (a, b) = if is_a { (tilt, 0.0) } else { (0.0, tilt) };
        let position = Axes::from([3.0, -5.0, 30.0, a, b, rotary, 0.0, 0.0, 0.0]);
        let Ok(Retraction::AlongTool { way, .. }) = along_tool(&chain, angles(&chain, &position), None, 0.0) else {
            panic!("not along the tool");
        };
        let there = Axes::from([3.0 + way.x, -5.0 + way.y, 30.0 + way.z, a, b, rotary, 0.0, 0.0, 0.0]);
        let (mut from, mut to) = ([0.0; 16], [0.0; 16]);
        machine.inverse(&position, &mut from);
        machine.inverse(&there, &mut to);
        let moved = Vector3::new(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
        prop_assert!((moved - Vector3::z()).norm() < 1e-9, "{moved}");
    }
}
