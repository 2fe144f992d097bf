//! What a frame does to a tool: its length is turned, never mirrored nor scaled.

use framepath::axes::Axes;
use framepath::frame::{
    ActiveFrame, AffineMap, FrameError, LinearAxis, Operation, OperationList, ProgrammableFrame,
    ToolLength, WorkOffset,
};
use nalgebra::{Matrix3, Vector3};

fn rotate(axis: LinearAxis, angle: f64) -> Operation {
    Operation::rotate(axis, angle).unwrap()
}

fn scale(x: f64, y: f64, z: f64) -> Operation {
    Operation::scale(Vector3::new(x, y, z)).unwrap()
}

fn fold(operations: &[Operation]) -> ProgrammableFrame {
    let mut list = OperationList::new();
    for operation in operations {
        list.append(operation).unwrap();
    }
    list.fold().unwrap()
}

const MIRROR_X: [bool; 3] = [true, false, false];
const MIRROR_Z: [bool; 3] = [false, false, true];

fn tool_axis(operations: &[Operation]) -> Vector3<f64> {
    fold(operations).rotation().column(2).into_owned()
}

fn assert_near(value: &Vector3<f64>, expected: [f64; 3]) {
    let error = (value - Vector3::from(expected)).amax();
    assert!(error < 1e-12, "{value} instead of {expected:?}");
}

#[test]
fn lengths_follow_rotations_and_nothing_else() {
    let (s, c) = 30.0_f64.to_radians().sin_cos();
    let tilt = rotate(LinearAxis::Y, 30.0);
    let mirror_x = Operation::mirror(MIRROR_X);
    let mirror_z = Operation::mirror(MIRROR_Z);
    assert_near(&tool_axis(&[tilt]), [s, 0.0, c]);
    assert_near(&tool_axis(&[tilt, scale(2.0, 0.5, 0.1)]), [s, 0.0, c]);
    assert_near(&tool_axis(&[scale(3.0, 3.0, 3.0), tilt]), [s, 0.0, c]);
    for mirror in [mirror_x, mirror_z] {
        assert_near(&tool_axis(&[mirror]), [0.0, 0.0, 1.0]);
        // A tilted plane seen in a mirror: the tool stands on the side of the spindle.
        assert_near(&tool_axis(&[mirror, tilt]), [-s, 0.0, c]);
        assert_near(&tool_axis(&[tilt, mirror]), [s, 0.0, c]);
    }
    // Two mirrors look like half a turn, but turn no tool over.
    let both = Operation::mirror([false, true, true]);
    assert_near(&tool_axis(&[both]), [0.0, 0.0, 1.0]);
    let half_turn = rotate(LinearAxis::X, 180.0);
    assert_near(&tool_axis(&[half_turn]), [0.0, 0.0, -1.0]);
    // Negative scales are mirrors.
    assert_near(&tool_axis(&[scale(2.0, 2.0, -2.0), tilt]), [-s, 0.0, c]);
}

#[test]
fn sheared_frames_keep_the_tool_normal_to_the_plane() {
    let frame = fold(&[scale(2.0, 1.0, 1.0), rotate(LinearAxis::Y, 30.0)]);
    let linear = frame.map().linear();
    let axis = frame.rotation().column(2);
    assert!(axis.dot(&linear.column(0)).abs() < 1e-12);
    assert!(axis.dot(&linear.column(1)).abs() < 1e-12);
    assert!(axis.z > 0.0);
    let unit = frame.rotation().transpose() * frame.rotation();
    assert!((unit - Matrix3::identity()).amax() < 1e-14);
}

#[test]
fn ready_maps_are_taken_for_mirrored_rather_than_turned_over() {
    for operations in [
        vec![rotate(LinearAxis::X, 70.0), rotate(LinearAxis::Z, 170.0)],
        vec![Operation::mirror(MIRROR_X), rotate(LinearAxis::Y, 30.0)],
        vec![Operation::mirror(MIRROR_Z), rotate(LinearAxis::Y, 30.0)],
        vec![Operation::mirror(MIRROR_Z), rotate(LinearAxis::Z, 170.0)],
        vec![Operation::mirror([false, true, true])],
        vec![Operation::mirror([true, false, true])],
        vec![rotate(LinearAxis::X, 90.0)],
        vec![scale(2.0, 3.0, 4.0), rotate(LinearAxis::Z, 10.0)],
    ] {
        let expected = fold(&operations);
        let found = ProgrammableFrame::from_map(*expected.map()).unwrap();
        let error = (found.rotation() - expected.rotation()).amax();
        assert!(error < 1e-12, "{operations:?}");
    }
    let over = fold(&[rotate(LinearAxis::X, 170.0)]);
    let found = ProgrammableFrame::from_map(*over.map()).unwrap();
    assert!(found.rotation().column(2).z > 0.98);
}

#[test]
fn mirrors_that_do_not_fit_the_map_are_refused() {
    let map = *fold(&[Operation::mirror(MIRROR_X)]).map();
    for mirrored in [[false; 3], [true, true, false]] {
        assert_eq!(
            ProgrammableFrame::new(map, mirrored),
            Err(FrameError::MirrorMismatch)
        );
    }
    let plain = AffineMap::identity();
    assert_eq!(
        ProgrammableFrame::new(plain, MIRROR_Z),
        Err(FrameError::MirrorMismatch)
    );
}

#[test]
fn both_rules_of_tool_length() {
    let frame = fold(&[
        Operation::translate(Vector3::new(10.0, 0.0, 0.0)).unwrap(),
        rotate(LinearAxis::Y, 90.0),
    ]);
    let tool = Axes::from([0.0, 0.0, 100.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let offset = Axes::from([1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let work = WorkOffset::new(offset, Axes::zeros(), 0.0).unwrap();
    let position = |rule| {
        let active = ActiveFrame::new(&frame, [false; 6], &work, &tool, rule).unwrap();
        // Program position (5, 6, 7): the tip on the machine is (18, 8, -2).
        let mut world = tool + offset;
        world += Axes::from([5.0, 6.0, 7.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        active.to_machine(&world)
    };
    let turned = position(ToolLength::Frame);
    assert_near(&turned.fixed_rows::<3>(0).into_owned(), [118.0, 8.0, -2.0]);
    let straight = position(ToolLength::Machine);
    assert_near(&straight.fixed_rows::<3>(0).into_owned(), [18.0, 8.0, 98.0]);
}

#[test]
fn whether_a_changed_length_matters_is_said_by_the_rule() {
    let shift = Operation::translate(Vector3::new(10.0, 20.0, 30.0)).unwrap();
    let turn = rotate(LinearAxis::Y, 30.0);
    let offset = Axes::from([1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let work = WorkOffset::new(offset, Axes::zeros(), 20.0).unwrap();
    let rules = [ToolLength::Frame, ToolLength::Machine];
    for (operations, expected) in [
        (vec![shift], [false, false]),
        (vec![turn, shift], [false, true]),
        (vec![turn, scale(1.0, 2.0, 1.0)], [true, true]),
        (vec![scale(1.0, 1.0, 0.5)], [true, true]),
        (vec![Operation::mirror(MIRROR_X)], [true, true]),
    ] {
        let frame = fold(&operations);
        let matters = rules.map(|rule| {
            let tool = Axes::zeros();
            let active = ActiveFrame::new(&frame, [false; 6], &work, &tool, rule).unwrap();
            active.tool_length_matters()
        });
        assert_eq!(matters, expected, "{operations:?}");
    }
}

#[test]
fn the_other_axes_are_mirrored_about_the_work_offset() {
    let g5x = Axes::from([0.0, 0.0, 0.0, 10.0, 0.0, 0.0, 100.0, 0.0, 0.0]);
    let g92 = Axes::from([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let tool = Axes::from([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 5.0, 0.0, 7.0]);
    let work = WorkOffset::new(g5x, g92, 0.0).unwrap();
    let mirrored = [true, false, false, true, false, true];
    let frame = ProgrammableFrame::identity();
    let rule = ToolLength::Frame;
    let active = ActiveFrame::new(&frame, mirrored, &work, &tool, rule).unwrap();
    let program = Axes::from([1.0, 2.0, 3.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0]);
    let world = program + g5x + g92 + tool;
    let machine = active.to_machine(&world);
    let expected = Axes::from([1.0, 2.0, 3.0, -19.0, 40.0, 50.0, 45.0, 70.0, -73.0]);
    assert_eq!(machine, expected);
    assert_eq!(active.to_world(&machine), world);
}

#[test]
fn bad_tools_and_offsets_are_refused() {
    let mut bad = Axes::zeros();
    bad[8] = f64::NAN;
    assert_eq!(
        WorkOffset::new(bad, Axes::zeros(), 0.0),
        Err(FrameError::NotFinite)
    );
    assert_eq!(
        WorkOffset::new(Axes::zeros(), Axes::zeros(), f64::INFINITY),
        Err(FrameError::NotFinite)
    );
    bad[8] = 3e6;
    assert_eq!(
        WorkOffset::new(Axes::zeros(), bad, 0.0),
        Err(FrameError::TranslationTooLarge {
            axis: 8,
            value: 3e6
        })
    );
    let frame = ProgrammableFrame::identity();
    let none = WorkOffset::none();
    assert_eq!(
        ActiveFrame::new(&frame, [false; 6], &none, &bad, ToolLength::Frame),
        Err(FrameError::TranslationTooLarge {
            axis: 8,
            value: 3e6
        })
    );
    // A factor of 1000 about a work offset a kilometre away.
    let far = WorkOffset::new(Axes::repeat(9e5), Axes::zeros(), 0.0).unwrap();
    let large = fold(&[scale(1000.0, 1000.0, 1000.0)]);
    assert!(matches!(
        ActiveFrame::new(&large, [false; 6], &far, &Axes::zeros(), ToolLength::Frame),
        Err(FrameError::TranslationTooLarge { axis: 0, .. })
    ));
}
