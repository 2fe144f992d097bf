//! Frames as Sinumerik-like commands make them, against worked numbers (to 1e-4).

use framepath::frame::{FrameError, LinearAxis, Operation, OperationList, Plane, RotsConvention};
use nalgebra::Vector3;

/// Half a unit of the last printed digit.
const PRINTED: f64 = 5.1e-5;

fn vector(values: [f64; 3]) -> Vector3<f64> {
    Vector3::from(values)
}

fn trans(x: f64, y: f64, z: f64) -> Operation {
    Operation::translate(Vector3::new(x, y, z)).unwrap()
}

fn rpl(plane: Plane, angle: f64) -> Operation {
    Operation::rotate_in_plane(plane, angle).unwrap()
}

fn rot(x: f64, y: f64, z: f64) -> Operation {
    Operation::rotate_zyx(Vector3::new(x, y, z)).unwrap()
}

fn rots(x: Option<f64>, y: Option<f64>, z: Option<f64>) -> Operation {
    Operation::rotate_solid_angles(x, y, z, RotsConvention::Seed).unwrap()
}

fn scale(x: f64, y: f64, z: f64) -> Operation {
    Operation::scale(Vector3::new(x, y, z)).unwrap()
}

fn mirror_x() -> Operation {
    Operation::mirror([true, false, false])
}

/// The first operation absolute, the others additive.
fn list(operations: &[Operation]) -> OperationList {
    let mut list = OperationList::new();
    list.set(&trans(99.0, 99.0, 99.0));
    let (first, others) = operations.split_first().unwrap();
    list.set(first);
    for operation in others {
        list.append(operation).unwrap();
    }
    list
}

/// Program, operations, pairs of program position and position in the work offset.
type Row = (&'static str, Vec<Operation>, Vec<([f64; 3], [f64; 3])>);

fn table() -> Vec<Row> {
    const X10: [f64; 3] = [10.0, 0.0, 0.0];
    const Y10: [f64; 3] = [0.0, 10.0, 0.0];
    const Z10: [f64; 3] = [0.0, 0.0, 10.0];
    const ZERO: [f64; 3] = [0.0, 0.0, 0.0];
    vec![
        (
            "TRANS X55 Y35, AROT RPL=45",
            vec![trans(55.0, 35.0, 0.0), rpl(Plane::Xy, 45.0)],
            vec![
                (X10, [62.0711, 42.0711, 0.0]),
                (Y10, [47.9289, 42.0711, 0.0]),
            ],
        ),
        (
            "TRANS X20 Y40, AROT RPL=60",
            vec![trans(20.0, 40.0, 0.0), rpl(Plane::Xy, 60.0)],
            vec![(X10, [25.0, 48.6603, 0.0]), (Y10, [11.3397, 45.0, 0.0])],
        ),
        (
            "G18, ROT RPL=-50",
            vec![rpl(Plane::Zx, -50.0)],
            vec![(X10, [6.4279, 0.0, 7.6604]), (Z10, [-7.6604, 0.0, 6.4279])],
        ),
        (
            "ROT X30 Y20 Z10",
            vec![rot(30.0, 20.0, 10.0)],
            vec![
                (X10, [9.2542, 1.6318, -3.4202]),
                (Y10, [0.1803, 8.8256, 4.6985]),
                (Z10, [3.7852, -4.4097, 8.1380]),
            ],
        ),
        (
            "ROT X90 Y90 Z90",
            vec![rot(90.0, 90.0, 90.0)],
            vec![
                (X10, [0.0, 0.0, -10.0]),
                (Y10, [0.0, 10.0, 0.0]),
                (Z10, [10.0, 0.0, 0.0]),
            ],
        ),
        (
            "ROT X30, AROT Z-50, AROT Y15",
            vec![
                rot(30.0, 0.0, 0.0),
                rot(0.0, 0.0, -50.0),
                rot(0.0, 15.0, 0.0),
            ],
            vec![
                (X10, [6.2089, -5.1140, -5.9411]),
                (Y10, [7.6604, 5.5667, 3.2139]),
                (Z10, [1.6637, -6.5467, 7.3738]),
            ],
        ),
        (
            "TRANS X10 Y10, ATRANS X35, AROT Y30, ATRANS X5",
            vec![
                trans(10.0, 10.0, 0.0),
                trans(35.0, 0.0, 0.0),
                rot(0.0, 30.0, 0.0),
                trans(5.0, 0.0, 0.0),
            ],
            vec![
                (ZERO, [49.3301, 10.0, -2.5]),
                (X10, [57.9904, 10.0, -7.5]),
                (Z10, [54.3301, 10.0, 6.1603]),
            ],
        ),
        (
            "ROTS X30 Y20",
            vec![rots(Some(30.0), Some(20.0), None)],
            vec![
                (X10, [8.6603, 0.0, -5.0]),
                (Y10, [1.5031, 9.5374, 2.6035]),
                (Z10, [4.7687, -3.0063, 8.2596]),
            ],
        ),
        (
            "TRANS X40 Y20, AROT RPL=35, ASCALE X.7 Y.7",
            vec![
                trans(40.0, 20.0, 0.0),
                rpl(Plane::Xy, 35.0),
                scale(0.7, 0.7, 1.0),
            ],
            vec![
                (X10, [45.7341, 24.0150, 0.0]),
                (Y10, [35.9850, 25.7341, 0.0]),
            ],
        ),
        (
            "SCALE X2 Y2, ATRANS X2.5 Y18",
            vec![scale(2.0, 2.0, 1.0), trans(2.5, 18.0, 0.0)],
            vec![(ZERO, [5.0, 36.0, 0.0])],
        ),
        (
            "MIRROR X0, ATRANS X10",
            vec![mirror_x(), trans(10.0, 0.0, 0.0)],
            vec![([5.0, 0.0, 0.0], [-15.0, 0.0, 0.0])],
        ),
        (
            "TRANS X10, AMIRROR X0",
            vec![trans(10.0, 0.0, 0.0), mirror_x()],
            vec![([5.0, 0.0, 0.0], [5.0, 0.0, 0.0])],
        ),
        (
            "MIRROR X0, AROT RPL=30",
            vec![mirror_x(), rpl(Plane::Xy, 30.0)],
            vec![(X10, [-8.6603, 5.0, 0.0])],
        ),
        (
            "SCALE X2, AROT RPL=45",
            vec![scale(2.0, 1.0, 1.0), rpl(Plane::Xy, 45.0)],
            vec![(X10, [14.1421, 7.0711, 0.0])],
        ),
    ]
}

#[test]
fn positions_of_the_table() {
    for (program, operations, points) in table() {
        let map = *list(&operations).fold().unwrap().map();
        for (from, to) in points {
            let image = map.apply(&vector(from));
            let error = (image - vector(to)).amax();
            assert!(error < PRINTED, "{program}: {from:?} -> {image:?}");
        }
    }
}

#[test]
fn rots_meets_the_old_planes_at_its_angles() {
    // The line in which the tilted XY plane meets an old plane is perpendicular to both normals.
    let meets = |operation: &Operation, first: usize, a: f64, b: f64| {
        let linear = *operation.map().linear();
        let second = (first + 1) % 3;
        let third = (first + 2) % 3;
        let normal = linear.column(third).into_owned();
        let old = |axis: usize| Vector3::ith(axis, 1.0);
        // Where it meets the plane of the first and third axis: angle a to the first.
        let line = old(second).cross(&normal);
        let turned = (-line[third]).atan2(line[first]).to_degrees();
        assert!((turned - a).abs() < 1e-9, "{turned} instead of {a}");
        // Where it meets the plane of the second and third: angle b to the second.
        let line = normal.cross(&old(first));
        let turned = line[third].atan2(line[second]).to_degrees();
        assert!((turned - b).abs() < 1e-9, "{turned} instead of {b}");
        // The new first axis lies in the old plane of the first and third axis.
        assert!(linear[(second, first)].abs() < 1e-12);
        assert!((linear.determinant() - 1.0).abs() < 1e-12);
    };
    for (a, b) in [(30.0, 20.0), (-40.0, 70.0), (5.0, -89.0), (0.0, 0.0)] {
        meets(&rots(Some(a), Some(b), None), 0, a, b);
        meets(&rots(None, Some(a), Some(b)), 1, a, b);
        meets(&rots(Some(b), None, Some(a)), 2, a, b);
        // The other convention exchanges the angles.
        let k2 = |x, y, z| Operation::rotate_solid_angles(x, y, z, RotsConvention::K2).unwrap();
        meets(&k2(Some(b), Some(a), None), 0, a, b);
        meets(&k2(None, Some(b), Some(a)), 1, a, b);
        meets(&k2(Some(a), None, Some(b)), 2, a, b);
    }
}

#[test]
fn rots_with_one_angle_is_rot() {
    for convention in [RotsConvention::Seed, RotsConvention::K2] {
        let one = |x, y, z| Operation::rotate_solid_angles(x, y, z, convention);
        assert_eq!(
            one(Some(20.0), None, None),
            Operation::rotate(LinearAxis::X, 20.0)
        );
        assert_eq!(
            one(None, Some(20.0), None),
            Operation::rotate(LinearAxis::Y, 20.0)
        );
        assert_eq!(
            one(None, None, Some(20.0)),
            Operation::rotate(LinearAxis::Z, 20.0)
        );
    }
}

#[test]
fn bare_ascale_drops_scales_only() {
    let mut list = list(&[
        trans(40.0, 20.0, 0.0),
        rpl(Plane::Xy, 35.0),
        scale(0.7, 0.7, 1.0),
    ]);
    list.drop_scales().unwrap();
    let map = *list.fold().unwrap().map();
    let image = map.apply(&vector([10.0, 0.0, 0.0]));
    assert!((image - vector([48.1915, 25.7358, 0.0])).amax() < PRINTED);
}

#[test]
fn frames_that_cannot_be_undone_are_refused() {
    let fold = |operations: &[Operation]| list(operations).fold().unwrap_err();
    assert!(matches!(
        fold(&[scale(0.1, 1.0, 20.0)]),
        FrameError::IllConditioned { condition } if (condition - 200.0).abs() < 1e-9
    ));
    assert!(matches!(
        fold(&[scale(1e-4, 1e-4, 1e-4)]),
        FrameError::ScaleOutOfRange { .. }
    ));
    assert!(matches!(
        fold(&[scale(1e4, 1e4, 1e4)]),
        FrameError::ScaleOutOfRange { .. }
    ));
    assert_eq!(fold(&[scale(1e-300, 1.0, 1.0)]), FrameError::Singular);
    assert!(matches!(
        fold(&[scale(1000.0, 1000.0, 1000.0), trans(1e5, 0.0, 0.0)]),
        FrameError::TranslationTooLarge { axis: 0, .. }
    ));
    // On the bounds.
    assert!(list(&[scale(1e-3, 1e-3, 1e-3)]).fold().is_ok());
    assert!(
        list(&[scale(1e3, 10.0, 1e3), rot(30.0, 20.0, 10.0)])
            .fold()
            .is_ok()
    );
}
