//! Properties of the algebra of frames, over random lists of operations.

use framepath::axes::Axes;
use framepath::frame::{
    ActiveFrame, AffineMap, LinearAxis, Operation, OperationKind, OperationList, Plane, ToolLength,
    WorkOffset,
};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

fn vector(range: std::ops::Range<f64>) -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(range).prop_map(Vector3::from)
}

fn axes(limit: f64) -> impl Strategy<Value = Axes> {
    prop::array::uniform9(-limit..limit).prop_map(Axes::from)
}

fn operation() -> impl Strategy<Value = Operation> {
    prop_oneof![
        vector(-200.0..200.0).prop_map(|shift| Operation::translate(shift).unwrap()),
        vector(-400.0..400.0).prop_map(|angles| Operation::rotate_zyx(angles).unwrap()),
        (-400.0..400.0).prop_map(|a| Operation::rotate_in_plane(Plane::Yz, a).unwrap()),
        vector(0.8..1.25).prop_map(|factors| Operation::scale(factors).unwrap()),
        prop::array::uniform3(any::<bool>()).prop_map(Operation::mirror),
    ]
}

fn operations() -> impl Strategy<Value = Vec<Operation>> {
    prop::collection::vec(operation(), 0..8)
}

fn list(operations: &[Operation]) -> OperationList {
    let mut list = OperationList::new();
    for operation in operations {
        list.append(operation).unwrap();
    }
    list
}

fn tool_length() -> impl Strategy<Value = ToolLength> {
    prop_oneof![Just(ToolLength::Frame), Just(ToolLength::Machine)]
}

/// Applies the operations one by one, the last one first, with nothing folded.
fn one_by_one(operations: &[Operation], point: Vector3<f64>) -> Vector3<f64> {
    operations
        .iter()
        .rev()
        .fold(point, |p, operation| match *operation.kind() {
            OperationKind::Translate(shift) => p + shift,
            OperationKind::Rotate(matrix) => matrix * p,
            OperationKind::Scale(factors) => p.component_mul(&factors),
            OperationKind::Mirror(flags) => p.component_mul(&Vector3::from(
                flags.map(|flag| if flag { -1.0 } else { 1.0 }),
            )),
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn folding_is_the_product_of_the_parts(
        operations in operations(), point in vector(-100.0..100.0)
    ) {
        let folded = list(&operations).fold().unwrap().map().apply(&point);
        let expected = one_by_one(&operations, point);
        prop_assert!((folded - expected).amax() < 1e-9, "{folded} {expected}");
    }

    #[test]
    fn dropping_scales_is_folding_without_them(
        operations in operations(), point in vector(-100.0..100.0)
    ) {
        let mut list = list(&operations);
        list.drop_scales().unwrap();
        let kept: Vec<_> = operations
            .iter()
            .copied()
            .filter(|operation| !matches!(operation.kind(), OperationKind::Scale(_)))
            .collect();
        let folded = list.fold().unwrap().map().apply(&point);
        let expected = one_by_one(&kept, point);
        prop_assert!((folded - expected).amax() < 1e-9);
    }

    #[test]
    fn rotations_are_those_of_an_independent_library(angles in vector(-400.0..400.0)) {
        let [x, y, z]: [f64; 3] = angles.map(f64::to_radians).into();
        // nalgebra's roll, pitch and yaw are about the fixed axes: the same product.
        let expected = Rotation3::from_euler_angles(x, y, z);
        let found = *Operation::rotate_zyx(angles).unwrap().map().linear();
        prop_assert!((found - expected.matrix()).amax() < 1e-13);
        for (axis, unit, angle) in [
            (LinearAxis::X, Vector3::x_axis(), x),
            (LinearAxis::Y, Vector3::y_axis(), y),
            (LinearAxis::Z, Vector3::z_axis(), z),
        ] {
            let expected = Rotation3::from_axis_angle(&unit, angle);
            let found = *Operation::rotate(axis, angle.to_degrees()).unwrap().map().linear();
            prop_assert!((found - expected.matrix()).amax() < 1e-13);
        }
    }

    #[test]
    fn inverse_maps_undo(operations in operations(), point in vector(-1000.0..1000.0)) {
        let map = *list(&operations).fold().unwrap().map();
        let inverse = map.inverse().unwrap();
        prop_assert!((inverse.apply(&map.apply(&point)) - point).amax() < 1e-9);
        prop_assert!((map.apply(&inverse.apply(&point)) - point).amax() < 1e-9);
        let both = map.compose(&inverse);
        prop_assert!((both.linear() - Matrix3::identity()).amax() < 1e-12);
    }

    #[test]
    fn a_tool_is_turned_by_a_proper_rotation(operations in operations()) {
        let frame = list(&operations).fold().unwrap();
        let rotation = frame.rotation();
        prop_assert!((rotation.transpose() * rotation - Matrix3::identity()).amax() < 1e-13);
        prop_assert!(rotation.determinant() > 0.0);
        // Normal to the plane that is cut.
        for column in [0, 1] {
            let image = frame.map().linear().column(column).normalize();
            prop_assert!(rotation.column(2).dot(&image).abs() < 1e-12);
        }
    }

    #[test]
    fn without_scales_a_tool_follows_the_rotations_seen_through_the_mirrors(
        operations in operations()
    ) {
        let mut mirror = Matrix3::identity();
        let mut expected = Matrix3::identity();
        let mut rigid = Vec::new();
        for operation in operations {
            match *operation.kind() {
                OperationKind::Scale(_) => continue,
                OperationKind::Translate(_) => {}
                OperationKind::Rotate(matrix) => expected *= mirror * matrix * mirror,
                OperationKind::Mirror(_) => mirror *= operation.map().linear(),
            }
            rigid.push(operation);
        }
        let found = *list(&rigid).fold().unwrap().rotation();
        prop_assert!((found - expected).amax() < 1e-12);
    }

    #[test]
    fn active_frames_are_exact_both_ways(
        operations in operations(), mirrored in prop::array::uniform6(any::<bool>()),
        g5x in axes(1000.0), g92 in axes(100.0), turn in -360.0..360.0, tool in axes(200.0),
        rule in tool_length(), world in axes(1000.0)
    ) {
        let frame = list(&operations).fold().unwrap();
        let work = WorkOffset::new(g5x, g92, turn).unwrap();
        let active = ActiveFrame::new(&frame, mirrored, &work, &tool, rule).unwrap();
        let machine = active.to_machine(&world);
        prop_assert!((active.to_world(&machine) - world).amax() < 1e-9);
        let back = active.to_machine(&active.to_world(&world));
        prop_assert!((back - world).amax() < 1e-9);
    }

    #[test]
    fn active_frames_put_the_tip_where_the_model_says(
        operations in operations(), g5x in axes(1000.0), g92 in axes(100.0),
        turn in -360.0..360.0, tool in axes(200.0), rule in tool_length(), program in axes(500.0)
    ) {
        let frame = list(&operations).fold().unwrap();
        let work = WorkOffset::new(g5x, g92, turn).unwrap();
        let active = ActiveFrame::new(&frame, [false; 6], &work, &tool, rule).unwrap();
        // LinuxCNC: + G92, rotation in XY, + G5x, + tool.
        let (sin, cos) = turn.to_radians().sin_cos();
        let offset_by = |p: Vector3<f64>| {
            let p = p + g92.fixed_rows::<3>(0);
            Vector3::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z)
                + g5x.fixed_rows::<3>(0)
        };
        let p = program.fixed_rows::<3>(0).into_owned();
        let length = tool.fixed_rows::<3>(0).into_owned();
        let mut world = program + g5x + g92 + tool;
        world.fixed_rows_mut::<3>(0).copy_from(&(offset_by(p) + length));

        let turned_length = match rule {
            ToolLength::Machine => length,
            ToolLength::Frame => {
                let work_turn = Rotation3::from_axis_angle(&Vector3::z_axis(), turn.to_radians());
                work_turn * (frame.rotation() * (work_turn.inverse() * length))
            }
        };
        let expected = offset_by(frame.map().apply(&p)) + turned_length;
        let machine = active.to_machine(&world);
        prop_assert!((machine.fixed_rows::<3>(0) - expected).amax() < 1e-9);
        let passing = machine.fixed_rows::<6>(3);
        prop_assert_eq!(passing.into_owned(), world.fixed_rows::<6>(3).into_owned());
    }

    #[test]
    fn extreme_scales_are_exact_on_the_machine(
        exponents in prop::array::uniform3(0.0..2.0), smallest in -3.0..1.0,
        angles in prop::array::uniform2(vector(-180.0..180.0)), position in axes(1000.0)
    ) {
        // All that is allowed: scales from 0.001 to 1000, in any direction, a factor of 100 apart.
        let factors = Vector3::from(exponents.map(|e: f64| 10.0_f64.powf(smallest + e)));
        let [first, second] = angles;
        let frame = list(&[
            Operation::rotate_zyx(first).unwrap(),
            Operation::scale(factors).unwrap(),
            Operation::rotate_zyx(second).unwrap(),
        ]).fold().unwrap();
        let work = WorkOffset::none();
        let rule = ToolLength::Frame;
        let active = ActiveFrame::new(&frame, [false; 6], &work, &Axes::zeros(), rule).unwrap();
        let back = active.to_machine(&active.to_world(&position));
        prop_assert!((back - position).amax() < 1e-9, "{}", (back - position).amax());
    }

    #[test]
    fn any_twelve_numbers_give_a_map_or_an_error(
        rows in prop::array::uniform3(prop::array::uniform4(any::<f64>()))
    ) {
        let finite = rows.iter().flatten().all(|value| value.is_finite());
        let map = AffineMap::from_rows(&rows);
        prop_assert_eq!(map.is_ok(), finite);
        if let Ok(map) = map {
            if let Ok(inverse) = map.inverse() {
                prop_assert!(inverse.is_finite());
            }
            if let Ok(frame) = framepath::frame::ProgrammableFrame::from_map(map) {
                prop_assert!(frame.rotation().iter().all(|value| value.is_finite()));
                prop_assert!(frame.map().condition_number() <= 100.1);
            }
        }
    }
}

#[test]
fn no_frame_changes_not_even_the_last_bit() {
    let odd = Axes::from([0.1, -0.7, 1e-300, 123.4, -5.6, 7.8, 9.1, 0.0, -2.3]);
    let work = WorkOffset::new(odd * 3.0, odd * 7.0, 33.3).unwrap();
    let frame = OperationList::new().fold().unwrap();
    let rule = ToolLength::Frame;
    let active = ActiveFrame::new(&frame, [false; 6], &work, &(odd * 0.3), rule).unwrap();
    assert_eq!(active, ActiveFrame::identity());
    assert_eq!(active.to_machine(&odd), odd);
    assert_eq!(active.to_world(&odd), odd);
}
