//! The C interface of framekins before the kinematics of another module: what is handed on to its functions and back.
#![allow(unsafe_code)]

mod abi_calls;

use std::ffi::{CStr, c_double, c_int, c_ulong};
use std::ptr::{null, null_mut};

use abi_calls::words;
use framepath::abi::inner_kinematics::{
    framepath_kinematics_configure_inner, framepath_kinematics_inner_forward,
    framepath_kinematics_inner_functions, framepath_kinematics_inner_inverse,
    framepath_kinematics_take_inner_type,
};
use framepath::abi::kinematics::{
    framepath_frame_inputs, framepath_frame_outputs, framepath_kinematics_configure_text,
    framepath_kinematics_forward, framepath_kinematics_inverse, framepath_kinematics_switch,
    framepath_kinematics_tilt_axis, framepath_kinematics_update,
};
use framepath::abi::kinematics_jet::framepath_kinematics_tool_tilt_axis;
use framepath::abi::kinematics_words::framepath_kinematics_refusal_text;
use framepath::abi::linuxcnc::EmcPose;

/// Joints are twice the axes, one is where it was before, from .75 on; flags are handed back increased.
unsafe extern "C" fn inverse(
    world: *const EmcPose,
    joints: *mut c_double,
    read: *const c_ulong,
    written: *mut c_ulong,
) -> c_int {
    // SAFETY: called with a pose, 16 numbers and flags.
    unsafe {
        *joints = (*world).tran.x * 2.0;
        *joints.add(1) = (*world).tran.y * 2.0;
        *joints.add(2) = (*world).tran.z * 2.0;
        *joints.add(3) = (*joints.add(3)).max(0.75);
        *written = *read + 1;
    }
    0
}

/// The way back; U is a guess that is left. Fails for a first joint beyond 1000.
unsafe extern "C" fn forward(
    joints: *const c_double,
    world: *mut EmcPose,
    read: *const c_ulong,
    written: *mut c_ulong,
) -> c_int {
    // SAFETY: called with 16 numbers, a pose and flags.
    unsafe {
        (*world).tran.x = *joints / 2.0;
        (*world).tran.y = *joints.add(1) / 2.0;
        (*world).tran.z = *joints.add(2) / 2.0;
        *written = *read + 10;
        if *joints > 1000.0 { -7 } else { 0 }
    }
}

/// A table that A tilts and C turns.
unsafe extern "C" fn table(
    world: *const EmcPose,
    joints: *mut c_double,
    _: *const c_ulong,
    _: *mut c_ulong,
) -> c_int {
    // SAFETY: called with a pose and 16 numbers.
    unsafe {
        let (a, c) = ((*world).a.to_radians(), (*world).c.to_radians());
        let (x, y, z) = ((*world).tran.x, (*world).tran.y, (*world).tran.z);
        let (turned_x, turned_y) = (c.cos() * x - c.sin() * y, c.sin() * x + c.cos() * y);
        *joints = turned_x;
        *joints.add(1) = a.cos() * turned_y - a.sin() * z;
        *joints.add(2) = a.sin() * turned_y + a.cos() * z;
    }
    0
}

/// As `inverse`, of an arm with a straight wrist: beside the place where it is, the fifth joint turns over.
unsafe extern "C" fn wrist(
    world: *const EmcPose,
    joints: *mut c_double,
    read: *const c_ulong,
    written: *mut c_ulong,
) -> c_int {
    // SAFETY: called with a pose, 16 numbers and flags.
    unsafe {
        let before = *joints;
        let answer = inverse(world, joints, read, written);
        *joints.add(4) += if *joints == before { 0.0 } else { 80.0 };
        answer
    }
}

/// Types 0 and 1.
unsafe extern "C" fn switch(kind: c_int) -> c_int {
    if kind < 2 { 0 } else { -1 }
}

fn zeroed_pose() -> EmcPose {
    // SAFETY: plain numbers.
    unsafe { std::mem::zeroed() }
}

fn joints_of(world: &EmcPose, near: [f64; 16], flags: c_ulong) -> (c_int, [f64; 16], c_ulong) {
    let (mut joints, mut written) = (near, 0);
    // SAFETY: a pose, 16 numbers and flags.
    let answer = unsafe {
        framepath_kinematics_inner_inverse(world, joints.as_mut_ptr(), &flags, &mut written)
    };
    (answer, joints, written)
}

fn configure(types: &CStr) -> c_int {
    // SAFETY: a string.
    unsafe { framepath_kinematics_configure_inner(types.as_ptr(), c"".as_ptr()) }
}

type Answer =
    unsafe extern "C" fn(*const EmcPose, *mut c_double, *const c_ulong, *mut c_ulong) -> c_int;

/// One after the other: the memory is one for the process.
#[test]
fn what_passes_between_motion_and_the_other_module() {
    assert_eq!(configure(c"0,x"), 7);
    assert!(words(framepath_kinematics_configure_text(7)).contains("tool_types=0,2"));
    // SAFETY: strings.
    let told = unsafe { framepath_kinematics_configure_inner(null(), c"B,C".as_ptr()) };
    assert_eq!(told, 8);
    assert!(words(framepath_kinematics_configure_text(8)).contains("tool_axes=C,B"));
    assert!(words(framepath_kinematics_refusal_text(18)).contains("framekins.inner-type"));
    assert_eq!(configure(c"1"), 0);
    assert_eq!(framepath_kinematics_tilt_axis(), 0);

    // Nothing is there yet, and the functions of our own machines have nothing to say.
    let mut world = zeroed_pose();
    (world.tran.x, world.tran.y, world.u) = (3.0, 4.0, 9.0);
    let mut near = [0.25; 16];
    assert_eq!(joints_of(&world, near, 5), (-1, near, 0));
    // SAFETY: a pose and 16 numbers.
    unsafe {
        assert_eq!(framepath_kinematics_inverse(&world, near.as_mut_ptr()), -1);
        assert_eq!(framepath_kinematics_forward(near.as_ptr(), &mut world), -1);
        assert_eq!(
            framepath_kinematics_inner_forward(null(), null_mut(), null(), null_mut()),
            -1
        );
        assert_eq!(
            framepath_kinematics_inner_inverse(null(), null_mut(), null(), null_mut()),
            -1
        );
        assert_eq!(framepath_kinematics_take_inner_type(null()), 0);
    }

    // Joints of before, guesses and flags arrive, and answers come back as they are.
    framepath_kinematics_inner_functions(Some(inverse), Some(forward), Some(switch));
    let (answer, joints, flags) = joints_of(&world, near, 5);
    assert_eq!((answer, flags), (0, 6));
    assert_eq!(joints[..5], [6.0, 8.0, 0.0, 0.75, 0.25]);
    let (read, mut written) = (30, 0);
    let mut there = world;
    // SAFETY: 16 numbers, a pose and flags.
    let mut back = |joints: &[f64; 16], there: &mut EmcPose| unsafe {
        framepath_kinematics_inner_forward(joints.as_ptr(), there, &read, &mut written)
    };
    assert_eq!(back(&joints, &mut there), 0);
    assert_eq!((there.tran.x, there.tran.y, there.u), (3.0, 4.0, 9.0));
    assert_eq!(back(&[2000.0; 16], &mut there), -7);
    assert_eq!(back(&joints, &mut there), 0);
    assert_eq!(written, 40);

    // The type on the pin is motion's number; one that is not there is refused by the module.
    // SAFETY: plain numbers.
    let (mut pins, mut shown): (framepath_frame_inputs, framepath_frame_outputs) =
        unsafe { (std::mem::zeroed(), std::mem::zeroed()) };
    (pins.in_position, pins.enabled) = (1, 1);
    (pins.map[0], pins.map[5], pins.map[10]) = (1.0, 1.0, 1.0);
    for (kind, answer) in [(1, 0), (0, 0), (5, 18)] {
        pins.inner_type = kind.into();
        // SAFETY: structures of the interface.
        unsafe {
            assert_eq!(framepath_kinematics_take_inner_type(&pins), kind);
            assert_eq!(framepath_kinematics_switch(kind, &pins), answer);
            framepath_kinematics_update(&pins, &mut shown);
        }
        assert_eq!(
            (shown.inner_refusal, shown.hold),
            (answer, (answer != 0).into())
        );
        assert_eq!(shown.inner_type, if answer == 0 { kind } else { 0 });
    }

    // A frame by hand: the module is asked for the framed place.
    pins.inner_type = 1.0;
    pins.map[3] = 100.0;
    // SAFETY: a structure of the interface.
    assert_eq!(unsafe { framepath_kinematics_switch(17, &pins) }, 0);
    assert_eq!(joints_of(&world, near, 0).1[0], 206.0);

    // How the tool turns is asked in a frame only, when the machine stands, and once for a frame.
    assert_eq!(shown.normal_refusal, 7);
    let mut asked = |pins: &framepath_frame_inputs| {
        // SAFETY: structures of the interface.
        unsafe { framepath_kinematics_update(pins, &mut shown) };
        let axes = (shown.normal_tilt_axis, shown.normal_rotary_axis);
        (shown.normal_refusal, axes, shown.normal_tilt.round())
    };
    framepath_kinematics_inner_functions(Some(table), Some(forward), Some(switch));
    pins.in_position = 0;
    assert_eq!(asked(&pins), (5, (0, 0), 0.0));
    pins.in_position = 1;
    assert_eq!(asked(&pins), (0, (1, 3), 0.0));
    // twice as far is not straight
    framepath_kinematics_inner_functions(Some(inverse), Some(forward), Some(switch));
    assert_eq!(asked(&pins), (0, (1, 3), 0.0));
    // SAFETY: a structure of the interface.
    assert_eq!(unsafe { framepath_kinematics_switch(33, &pins) }, 0);
    assert_eq!(asked(&pins), (5, (0, 0), 0.0));

    // While it is not known it is asked again at each rest, not while the machine stands.
    framepath_kinematics_inner_functions(Some(table), Some(forward), Some(switch));
    assert_eq!(asked(&pins), (5, (0, 0), 0.0));
    assert_eq!(framepath_kinematics_tool_tilt_axis(), -1);
    for stands in [0, 1] {
        pins.in_position = stands;
        let known = (5 - 5 * stands, (stands, 3 * stands), 0.0);
        assert_eq!(asked(&pins), known);
    }
    assert_eq!(framepath_kinematics_tool_tilt_axis(), 3);

    // From where the machine is these lead back to other joints, which would jump, unless the machine is off.
    pins.inner_type = 0.0;
    // SAFETY: a structure of the interface.
    assert_eq!(unsafe { framepath_kinematics_switch(0, &pins) }, 19);
    pins.enabled = 0;
    // SAFETY: a structure of the interface.
    assert_eq!(unsafe { framepath_kinematics_switch(0, &pins) }, 0);
    pins.enabled = 1;

    // A frame leads back beside the place, where a straight wrist turns over. Without one nothing jumps.
    framepath_kinematics_inner_functions(Some(wrist), Some(forward), Some(switch));
    let (_, at_rest, _) = joints_of(&world, near, 0);
    joints_of(&world, at_rest, 0);
    for (number, refused) in [(16, 19), (0, 0)] {
        // SAFETY: a structure of the interface.
        let answer = unsafe { framepath_kinematics_switch(number, &pins) };
        assert_eq!(answer, refused);
    }
    framepath_kinematics_inner_functions(Some(table), Some(forward), Some(switch));

    // Without a frame blendtp is told, too: of another type when the machine stands.
    pins.in_position = 0;
    assert_eq!(asked(&pins), (7, (0, 0), 0.0));
    assert_eq!(framepath_kinematics_tool_tilt_axis(), -1);
    pins.in_position = 1;
    assert_eq!(asked(&pins), (7, (0, 0), 0.0));
    assert_eq!(framepath_kinematics_tool_tilt_axis(), 3);

    // What cannot be known is said where the type turns the tool, else Z is enough.
    framepath_kinematics_inner_functions(Some(inverse), Some(forward), Some(switch));
    for (kind, answer) in [(1, -1), (0, 0)] {
        pins.inner_type = kind.into();
        // SAFETY: structures of the interface.
        unsafe {
            assert_eq!(framepath_kinematics_switch(kind, &pins), 0);
            framepath_kinematics_update(&pins, &mut shown);
        }
        assert_eq!((shown.retract_kind, shown.tool_centre_type), (answer, 1));
    }

    // Without a frame how the tool turns is asked if a program wants to know, which a table tells.
    assert_eq!(configure(c"1"), 0);
    framepath_kinematics_inner_functions(Some(inverse), Some(forward), Some(switch));
    // SAFETY: structures of the interface.
    unsafe { framepath_kinematics_update(&pins, &mut shown) };
    assert_eq!(shown.retract_kind, -3);
    assert_eq!((shown.tool_centre_type, shown.axes_type), (1, 0));
    // Kinematics that cannot be switched have no second type.
    let alone = || framepath_kinematics_inner_functions(Some(table), Some(forward), None);
    assert_eq!(alone(), -1);
    assert_eq!(configure(c""), 0);
    assert_eq!(alone(), 0);
    pins.command = 1014.0;
    // SAFETY: structures of the interface.
    unsafe { framepath_kinematics_update(&pins, &mut shown) };
    assert_eq!((shown.retract_kind, shown.retract_way[2]), (1, 1.0));
    assert_eq!((shown.tool_centre_type, shown.axes_type), (-1, 0));

    // What the user says of axes that cannot be found, and what is not so.
    for (said, kinematics, refusal, axes) in [
        (c"C,B", inverse as Answer, 0, (2, 3)),
        (c"none", inverse, 0, (0, 0)),
        (c"-C,-A", table, 0, (1, 3)),
        (c"C,A", table, 8, (0, 0)),
    ] {
        // SAFETY: strings, and structures of the interface.
        unsafe {
            let told = framepath_kinematics_configure_inner(c"0".as_ptr(), said.as_ptr());
            assert_eq!(told, 0);
            framepath_kinematics_inner_functions(Some(kinematics), Some(forward), Some(switch));
            assert_eq!(framepath_kinematics_switch(16, &pins), 0);
            framepath_kinematics_update(&pins, &mut shown);
        }
        let shown_axes = (shown.normal_tilt_axis, shown.normal_rotary_axis);
        assert_eq!(
            (shown.normal_refusal, shown_axes),
            (refusal, axes),
            "{said:?}"
        );
        let is_known = if said == c"-C,-A" {
            1
        } else if said == c"none" {
            0
        } else {
            -1
        };
        assert_eq!(shown.retract_kind, is_known, "{said:?}");
    }
}
