//! The machines' own kinematics, and the rotary angles for a frame, against matrices written out
//! here.

use framepath::axes::Axes;
use framepath::frame::{ActiveFrame, FrameError, Operation, OperationList, ToolLength, WorkOffset};
use framepath::kinematics::{AngleRange, OrientationError, RotaryAngles, tool_angles};
use framepath::machine::{
    Coordinates, CoordinatesError, Identity, JOINT_COUNT, Machine, RotaryDirection, TableTilting,
    TableTiltingParameters, TiltAxis,
};
use nalgebra::{Matrix4, Rotation3, Vector3, Vector4};
use proptest::prelude::*;

const ORIGIN: RotaryAngles = RotaryAngles {
    tilt: 0.0,
    rotary: 0.0,
};

fn table(tilt_axis: TiltAxis, parameters: TableTiltingParameters) -> TableTilting {
    let letters: &[u8] = match tilt_axis {
        TiltAxis::A => b"XYZAC",
        TiltAxis::B => b"XYZBC",
    };
    let coordinates = Coordinates::parse(letters).unwrap();
    let mut machine = TableTilting::new(tilt_axis, coordinates).unwrap();
    machine.set_parameters(parameters).unwrap();
    machine
}

/// A pose of LinuxCNC for a tilt and rotary angle.
fn pose(tilt_axis: TiltAxis, point: [f64; 3], tilt: f64, rotary: f64) -> Axes {
    let [x, y, z] = point;
    let (a, b) = match tilt_axis {
        TiltAxis::A => (tilt, 0.0),
        TiltAxis::B => (0.0, tilt),
    };
    Axes::from([x, y, z, a, b, rotary, 0.0, 0.0, 0.0])
}

fn shift(by: Vector3<f64>) -> Matrix4<f64> {
    Matrix4::new_translation(&by)
}

/// The machine by homogeneous matrices, each joint for itself: the tip of the tool in coordinates
/// of the machine, for a tip fixed to the workpiece.
fn workpiece_to_machine(
    tilt_axis: TiltAxis,
    parameters: &TableTiltingParameters,
    tilt: f64,
    rotary: f64,
) -> Matrix4<f64> {
    let sign = match parameters.direction {
        RotaryDirection::Table => 1.0,
        RotaryDirection::Conventional => -1.0,
    };
    let about = |axis: Vector3<f64>, angle: f64| Matrix4::new_rotation(axis * angle.to_radians());
    let tilting_axis = match tilt_axis {
        TiltAxis::A => Vector3::x(),
        TiltAxis::B => Vector3::y(),
    };
    let c_point = parameters.rotation_point;
    let tilt_point = c_point + parameters.offset;
    let c_joint = shift(c_point) * about(Vector3::z(), sign * rotary) * shift(-c_point);
    let tilt_joint = shift(tilt_point) * about(tilting_axis, sign * tilt) * shift(-tilt_point);
    tilt_joint * c_joint
}

fn parameters() -> impl Strategy<Value = TableTiltingParameters> {
    let direction = prop_oneof![
        Just(RotaryDirection::Table),
        Just(RotaryDirection::Conventional)
    ];
    (
        prop::array::uniform3(-300.0..300.0),
        prop::array::uniform3(-100.0..100.0),
        0.0..200.0,
        direction,
    )
        .prop_map(
            |(point, offset, tool_offset, direction)| TableTiltingParameters {
                rotation_point: Vector3::from(point),
                offset: Vector3::from(offset),
                tool_offset,
                direction,
                tool_centre_point: true,
            },
        )
}

fn tilt_axis() -> impl Strategy<Value = TiltAxis> {
    prop_oneof![Just(TiltAxis::A), Just(TiltAxis::B)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn table_tilting_is_the_chain_of_its_joints(
        tilt_axis in tilt_axis(), parameters in parameters(),
        point in prop::array::uniform3(-500.0..500.0), tilt in -180.0..180.0,
        rotary in -720.0..720.0
    ) {
        let machine = Machine::TableTilting(table(tilt_axis, parameters));
        let tool = Vector3::new(0.0, 0.0, parameters.tool_offset);
        let tip = Vector3::from(point) - tool;
        let chain = workpiece_to_machine(tilt_axis, &parameters, tilt, rotary);
        let moved = chain * Vector4::new(tip.x, tip.y, tip.z, 1.0);
        let expected = moved.xyz() + tool;
        let mut joints = [0.0; JOINT_COUNT];
        let axes = pose(tilt_axis, point, tilt, rotary);
        machine.inverse(&axes, &mut joints);
        let found = Vector3::new(joints[0], joints[1], joints[2]);
        prop_assert!((found - expected).amax() < 1e-9, "{found} {expected}");
        prop_assert_eq!([joints[3], joints[4]], [tilt, rotary]);
        prop_assert!((machine.forward(&joints) - axes).amax() < 1e-9);
    }

    #[test]
    fn off_it_is_the_identity(
        tilt_axis in tilt_axis(), parameters in parameters(),
        point in prop::array::uniform3(-500.0..500.0), tilt in -180.0..180.0
    ) {
        let parameters = TableTiltingParameters { tool_centre_point: false, ..parameters };
        let machine = table(tilt_axis, parameters);
        let mut joints = [0.0; JOINT_COUNT];
        let axes = pose(tilt_axis, point, tilt, 33.0);
        machine.inverse(&axes, &mut joints);
        prop_assert_eq!(joints[..5].to_vec(), [&point[..], &[tilt, 33.0]].concat());
        prop_assert_eq!(machine.forward(&joints), axes);
    }

    #[test]
    fn any_coordinates_go_there_and_back(
        letters in prop::collection::vec(
            prop::sample::select(b"XYZABCUVWxyzabcuvw".to_vec()), 1..=JOINT_COUNT
        ),
        values in prop::array::uniform9(-1000.0..1000.0)
    ) {
        let coordinates = Coordinates::parse(&letters).unwrap();
        let machine = Machine::Identity(Identity::new(coordinates));
        let mut axes = Axes::from(values);
        for (axis, value) in axes.iter_mut().enumerate() {
            if coordinates.joint_of_axis(axis).is_none() {
                *value = 0.0;
            }
        }
        let mut joints = [f64::NAN; JOINT_COUNT];
        machine.inverse(&axes, &mut joints);
        prop_assert_eq!(machine.forward(&joints), axes);
        // Unused joints are not touched, used ones have their axis' value.
        let named = b"XYZABCUVW";
        for (joint, value) in joints.iter().enumerate() {
            match letters.get(joint) {
                None => prop_assert!(value.is_nan()),
                Some(letter) => {
                    let axis = named.iter().position(|n| *n == letter.to_ascii_uppercase());
                    prop_assert_eq!(*value, axes[axis.unwrap()]);
                }
            }
        }
    }

    #[test]
    fn tool_angles_stand_the_frame_upright(
        tilt_axis in tilt_axis(), parameters in parameters(),
        angles in prop::array::uniform3(-180.0..180.0), turn in -180.0..180.0,
        now in prop::array::uniform2(-300.0..300.0), mirror in prop::array::uniform3(any::<bool>())
    ) {
        let mut list = OperationList::new();
        list.set(&Operation::mirror(mirror));
        list.append(&Operation::rotate_zyx(Vector3::from(angles)).unwrap()).unwrap();
        let frame = list.fold().unwrap();
        let work = WorkOffset::new(Axes::repeat(12.0), Axes::zeros(), turn).unwrap();
        let rule = ToolLength::Machine;
        let active = ActiveFrame::new(&frame, [false; 6], &work, &Axes::zeros(), rule).unwrap();
        let machine = table(tilt_axis, parameters);
        let [tilt, rotary] = now;
        let current = RotaryAngles { tilt, rotary };
        let free = AngleRange::UNLIMITED;
        let found = tool_angles(&machine, &active.tool_axis(), current, free, free).unwrap();

        // By the kinematics: two joint positions one above the other are one along the tool axis.
        let joints_at = |z: f64| {
            let mut joints = [0.0; JOINT_COUNT];
            joints[..5].copy_from_slice(&[7.0, 8.0, z, found.tilt, found.rotary]);
            machine.forward(&joints).fixed_rows::<3>(0).into_owned()
        };
        let direction = joints_at(1.0) - joints_at(0.0);
        prop_assert!((direction - active.tool_axis()).amax() < 1e-9);
        // And it is the normal of the plane that the frame cuts.
        let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), turn.to_radians());
        for column in [0, 1] {
            let image = turned * frame.map().linear().column(column).into_owned();
            prop_assert!(image.dot(&direction).abs() < 1e-9);
        }
        // Both are the nearest turns.
        prop_assert!((found.tilt - current.tilt).abs() <= 360.0);
        prop_assert!((found.rotary - current.rotary).abs() <= 180.0 + 1e-9);
    }

    #[test]
    fn tool_angles_respect_limits(
        tilt_axis in tilt_axis(), parameters in parameters(),
        direction in prop::array::uniform3(-1.0..1.0), now in prop::array::uniform2(-300.0..300.0),
        lows in prop::array::uniform2(-400.0..100.0), widths in prop::array::uniform2(0.0..500.0)
    ) {
        let direction = Vector3::from(direction);
        prop_assume!(direction.norm() > 1e-3);
        let machine = table(tilt_axis, parameters);
        let current = RotaryAngles { tilt: now[0], rotary: now[1] };
        let [tilts, rotaries] = [0, 1].map(|i| AngleRange { min: lows[i], max: lows[i] + widths[i] });
        let within = |range: AngleRange, angle: f64| (range.min..=range.max).contains(&angle);
        let distance = |a: RotaryAngles| {
            (a.tilt - current.tilt).hypot(a.rotary - current.rotary)
        };
        let both = framepath::kinematics::tool_angles::solutions(&machine, &direction, current).unwrap();
        // Every solution that the limits allow, by counting.
        let turns = || (-4..=4).map(|n| 360.0 * f64::from(n));
        let best = both
            .iter()
            .flat_map(|s| turns().flat_map(move |t| turns().map(move |r| RotaryAngles {
                tilt: s.tilt + t, rotary: s.rotary + r
            })))
            .filter(|s| within(tilts, s.tilt) && within(rotaries, s.rotary))
            .map(distance)
            .reduce(f64::min);
        match tool_angles(&machine, &direction, current, tilts, rotaries) {
            Ok(found) => {
                prop_assert!(within(tilts, found.tilt) && within(rotaries, found.rotary));
                prop_assert!((distance(found) - best.unwrap()).abs() < 1e-6);
            }
            Err(error) => {
                let [first, second] = both;
                prop_assert_eq!(best, None);
                prop_assert_eq!(error, OrientationError::Unreachable { first, second });
            }
        }
    }
}

#[test]
fn numbers_worked_by_hand() {
    // Table tilted by +90 about X: +Y of the workpiece points up, +Z to the back (-Y).
    let machine = table(
        TiltAxis::A,
        TableTiltingParameters {
            rotation_point: Vector3::new(100.0, 50.0, 20.0),
            offset: Vector3::new(0.0, 3.0, 5.0),
            tool_offset: 10.0,
            tool_centre_point: true,
            ..TableTiltingParameters::default()
        },
    );
    let mut joints = [0.0; JOINT_COUNT];
    // Tip (101, 52, 24): (1, 2, 4) from the rotation point, (1, -1, -1) from the tilting axis;
    // turned: (1, 1, -1); so the tip is at (101, 54, 24) and the position 10 above.
    let axes = pose(TiltAxis::A, [101.0, 52.0, 34.0], 90.0, 0.0);
    machine.inverse(&axes, &mut joints);
    assert_eq!(joints[..5], [101.0, 54.0, 34.0, 90.0, 0.0]);
    assert_eq!(machine.forward(&joints), axes);
    // C by 90 first: (1, 2) becomes (-2, 1).
    let axes = pose(TiltAxis::A, [101.0, 52.0, 34.0], 0.0, 90.0);
    machine.inverse(&axes, &mut joints);
    assert_eq!(joints[..5], [98.0, 51.0, 34.0, 0.0, 90.0]);
}

#[test]
fn both_signs_of_rotation() {
    let parameters = TableTiltingParameters {
        tool_centre_point: true,
        ..TableTiltingParameters::default()
    };
    let conventional = TableTiltingParameters {
        direction: RotaryDirection::Conventional,
        ..parameters
    };
    let mut joints = [0.0; JOINT_COUNT];
    // B: a positive angle turns +Z towards +X.
    let axes = pose(TiltAxis::B, [0.0, 0.0, 10.0], 90.0, 0.0);
    table(TiltAxis::B, parameters).inverse(&axes, &mut joints);
    assert_eq!(joints[..3], [10.0, 0.0, 0.0]);
    table(TiltAxis::B, conventional).inverse(&axes, &mut joints);
    assert_eq!(joints[..3], [-10.0, 0.0, 0.0]);
}

#[test]
fn tables_need_their_axes() {
    let coordinates = Coordinates::parse(b"XYZAC").unwrap();
    assert_eq!(
        TableTilting::new(TiltAxis::B, coordinates).unwrap_err(),
        CoordinatesError::MissingAxis { axis: 4 }
    );
    let mut machine = TableTilting::new(TiltAxis::A, coordinates).unwrap();
    let before = machine;
    let mut parameters = TableTiltingParameters {
        tool_offset: f64::NAN,
        ..TableTiltingParameters::default()
    };
    assert_eq!(
        machine.set_parameters(parameters),
        Err(FrameError::NotFinite)
    );
    parameters.tool_offset = -2e6;
    assert_eq!(
        machine.set_parameters(parameters),
        Err(FrameError::TranslationTooLarge {
            axis: 2,
            value: -2e6
        })
    );
    assert_eq!(machine, before);
}

#[test]
fn a_vertical_tool_leaves_c_where_it_is() {
    let machine = table(TiltAxis::A, TableTiltingParameters::default());
    let current = RotaryAngles {
        tilt: 20.0,
        rotary: 77.0,
    };
    let free = AngleRange::UNLIMITED;
    let found = tool_angles(&machine, &Vector3::z(), current, free, free).unwrap();
    assert_eq!((found.tilt, found.rotary), (0.0, 77.0));
    let found = tool_angles(&machine, &-Vector3::z(), current, free, free).unwrap();
    assert_eq!((found.tilt, found.rotary), (180.0, 77.0));
    let ninety = AngleRange {
        min: -90.0,
        max: 90.0,
    };
    assert!(tool_angles(&machine, &-Vector3::z(), current, ninety, free).is_err());
    // Exactly on a limit, whatever the rounding.
    let (s, c) = 90.0_f64.to_radians().sin_cos();
    let found = tool_angles(&machine, &Vector3::new(0.0, s, -c), ORIGIN, ninety, free);
    assert_eq!(
        found,
        Ok(RotaryAngles {
            tilt: 90.0,
            rotary: 0.0
        })
    );
}

#[test]
fn nonsense_has_no_tool_angles() {
    let machine = table(TiltAxis::B, TableTiltingParameters::default());
    let free = AngleRange::UNLIMITED;
    let reversed = AngleRange {
        min: 1.0,
        max: -1.0,
    };
    let not_a_number = AngleRange {
        min: f64::NAN,
        max: 1.0,
    };
    let z = Vector3::z();
    let find =
        |direction: Vector3<f64>, tilts| tool_angles(&machine, &direction, ORIGIN, tilts, free);
    assert_eq!(
        find(Vector3::zeros(), free),
        Err(OrientationError::NotFinite)
    );
    assert_eq!(find(z * f64::NAN, free), Err(OrientationError::NotFinite));
    assert_eq!(find(z, not_a_number), Err(OrientationError::NotFinite));
    assert_eq!(find(z, reversed), Err(OrientationError::LimitsReversed));
}
