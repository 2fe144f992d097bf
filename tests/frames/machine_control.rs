//! Frames on a machine with a tilting table: dimensions and tool centre point change at switches only.

use crate::common::Motion;
use framepath::axes::Axes;
use framepath::frame::ToolLength;
use framepath::kinematics::control::FrameControl;
use framepath::kinematics::{AngleRange, FrameRefusal, RotaryLimits, ToolNormalError, tool_normal};
use framepath::machine::Machine;
use nalgebra::Vector3;
use proptest::prelude::*;

fn table() -> Motion {
    Motion::new("xyzac", "XYZAC")
}

#[test]
fn the_table_is_taken_over_at_a_switch_only() {
    let mut motion = table();
    motion.inputs.table.tool_centre_point = true;
    motion.inputs.table.rotation_point = Vector3::new(1.0, 2.0, 3.0);
    motion.period();
    assert!(motion.out.parameters_pending && !motion.out.tool_centre_point);
    // Without a frame before and after, and still a switch.
    assert_eq!(motion.send(11, [0.0; 3]), None);
    assert!(motion.out.tool_centre_point && !motion.out.parameters_pending);
    assert!(!motion.out.active);
    assert_ne!(motion.out.slot, 0);
    let before = *motion.control.behind();
    motion.inputs.table.tool_offset = f64::NAN;
    assert_eq!(
        motion.send(1, [1.0, 0.0, 0.0]),
        Some(FrameRefusal::MachineParameters)
    );
    assert!(motion.out.parameters_pending && !motion.out.active);
    assert_eq!(*motion.control.behind(), before);
    motion.inputs.table.tool_offset = 10.0;
    motion.inputs.in_position = false;
    assert_eq!(motion.send(11, [0.0; 3]), Some(FrameRefusal::Moving));
    assert_eq!(*motion.control.behind(), before);
    motion.inputs.in_position = true;
    assert_eq!(motion.send(11, [0.0; 3]), None);
    assert_ne!(*motion.control.behind(), before);
    motion.inputs.table.tool_centre_point = false;
    assert_eq!(motion.send(9, [0.0; 3]), None);
    assert!(!motion.out.tool_centre_point && !motion.out.parameters_pending);
    assert_eq!(motion.send(9, [0.0; 3]), None);
    assert!(!motion.out.active);
}

#[test]
fn wrong_dimensions_at_the_start_leave_the_tool_centre_point_off() {
    let machine = Machine::configured(b"xyzbc", b"XYZBC").unwrap();
    let mut inputs = table().inputs;
    inputs.table.tool_centre_point = true;
    inputs.table.offset = Vector3::new(0.0, 0.0, f64::INFINITY);
    let mut control = FrameControl::new(machine);
    let out = control.update(&inputs);
    assert_eq!(out.refusal, Some(FrameRefusal::MachineParameters));
    assert!(out.parameters_pending && !out.tool_centre_point);
    // The right ones are in force from the first period on.
    inputs.table.offset = Vector3::zeros();
    let out = FrameControl::new(machine).update(&inputs);
    assert_eq!(out.refusal, None);
    assert!(out.tool_centre_point && !out.parameters_pending);
}

#[test]
fn with_the_tool_centre_point_the_length_stays_along_the_machine() {
    let mut motion = table();
    motion.inputs.tool_offset = [0.0, 0.0, 20.0];
    assert_eq!(motion.send(2, [90.0, 0.0, 0.0]), None);
    // World position of the tip at the program's zero: the tool's length.
    assert_eq!(motion.machine([0.0, 0.0, 20.0]), [0.0, -20.0, 0.0]);
    motion.inputs.table.tool_centre_point = true;
    assert_eq!(motion.send(11, [0.0; 3]), None);
    assert_eq!(motion.machine([0.0, 0.0, 20.0]), [0.0, 0.0, 20.0]);
    motion.inputs.table.tool_centre_point = false;
    motion.inputs.tool_length = ToolLength::Machine;
    assert_eq!(motion.send(11, [0.0; 3]), None);
    assert_eq!(motion.machine([0.0, 0.0, 20.0]), [0.0, 0.0, 20.0]);
}

const FREE: RotaryLimits = RotaryLimits {
    tilt: AngleRange::UNLIMITED,
    rotary: AngleRange::UNLIMITED,
};

#[test]
fn the_tool_normal_is_asked_of_the_whole_machine() {
    let now = Axes::zeros();
    let normal = |motion: &Motion, limits: &RotaryLimits| {
        tool_normal(
            motion.control.behind(),
            motion.control.active(),
            &now,
            limits,
        )
    };
    let mut mill = Motion::new("identity", "XYZ");
    assert_eq!(normal(&mill, &FREE), Ok(None));
    assert_eq!(mill.send(2, [0.0, 0.0, 45.0]), None);
    assert_eq!(normal(&mill, &FREE), Ok(None));
    for tilted in [[0.0, 1e-3, 0.0], [180.0, 0.0, 0.0]] {
        assert_eq!(mill.send(2, tilted), None);
        assert_eq!(normal(&mill, &FREE), Err(ToolNormalError::NoRotaryAxes));
    }
    let mut five = table();
    assert_eq!(five.send(2, [30.0, 0.0, 0.0]), None);
    assert_eq!(
        normal(&five, &FREE),
        Err(ToolNormalError::ToolCentrePointOff)
    );
    five.inputs.table.tool_centre_point = true;
    five.inputs.mirror[0] = true;
    assert_eq!(five.send(11, [0.0; 3]), None);
    // ROT X30: the normal leans to -Y. A = -30 brings it up, and A is mirrored in the program.
    let found = normal(&five, &FREE).unwrap().unwrap();
    assert!(
        (found.tilt - 30.0).abs() < 1e-12 && found.rotary.abs() < 1e-12,
        "{found:?}"
    );
    let limited = |min, max| RotaryLimits {
        tilt: AngleRange { min, max },
        ..FREE
    };
    assert_eq!(
        normal(&five, &limited(-10.0, 10.0)),
        Err(ToolNormalError::Unreachable)
    );
    for wrong in [limited(10.0, -10.0), limited(f64::NAN, 10.0)] {
        assert_eq!(normal(&five, &wrong), Err(ToolNormalError::WrongLimits));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Whatever is sent, and whenever motion moves: what takes effect is finite and can be undone,
    /// and what is refused changes nothing.
    #[test]
    fn any_stream_of_commands_leaves_a_usable_frame(
        commands in prop::collection::vec(
            (0..14_i32, any::<bool>(), prop::array::uniform3(-400.0..400.0_f64), 0..8_u8, -500.0..500.0_f64),
            1..40,
        )
    ) {
        let mut motion = table();
        for (code, additive, value, state, offset) in commands {
            motion.inputs.in_position = state != 0;
            motion.inputs.teleop = state == 1;
            motion.inputs.table.tool_centre_point = state % 2 == 0;
            motion.inputs.table.offset.z = if state == 2 { f64::NAN } else { offset };
            motion.inputs.work_offset = [offset, -offset, 0.5 * offset];
            motion.inputs.work_rotation = offset;
            // Scales of a sensible size are wanted too.
            let value = if code == 7 { value.map(|v| 1.0 + v / 500.0) } else { value };
            let before = (motion.control.active().copied(), *motion.control.behind(), motion.out.operations);
            let refusal = motion.send(code + if additive { 100 } else { 0 }, value);
            if refusal.is_some() {
                let now = (motion.control.active().copied(), *motion.control.behind(), motion.out.operations);
                prop_assert_eq!(before, now);
            }
            let world = Axes::from([10.0, -20.0, 30.0, 40.0, 0.0, 50.0, 0.0, 0.0, 0.0]);
            if let Some(frame) = motion.control.active() {
                let machine = frame.to_machine(&world);
                prop_assert!(machine.iter().all(|axis| axis.is_finite()));
                let scale = 1.0 + machine.amax();
                prop_assert!((frame.to_world(&machine) - world).amax() < 1e-9 * scale);
            }
        }
    }
}
