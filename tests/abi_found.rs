//! What random calls of the C interface have found.
#![allow(unsafe_code)]

use framepath::abi::kinematics::{
    framepath_frame_inputs, framepath_frame_outputs, framepath_kinematics_configure,
    framepath_kinematics_inverse, framepath_kinematics_update,
};
use framepath::abi::linuxcnc::EmcPose;

#[test]
fn a_position_that_the_table_turns_beyond_all_numbers_has_no_joints() {
    let mut letter = 0;
    // SAFETY: strings and a number.
    let configured = unsafe {
        framepath_kinematics_configure(
            c"XYZAC".as_ptr(),
            c"xyzac".as_ptr(),
            c"".as_ptr(),
            &mut letter,
        )
    };
    assert_eq!(configured, 0);
    // SAFETY: plain numbers.
    let (mut pins, mut out): (framepath_frame_inputs, framepath_frame_outputs) =
        unsafe { (std::mem::zeroed(), std::mem::zeroed()) };
    pins.tool_centre_point = 1;
    // SAFETY: structures of the interface. The first period takes over the dimensions of the table.
    unsafe { framepath_kinematics_update(&pins, &mut out) };
    assert_eq!(out.tool_centre_point, 1);
    let inverse = |coordinate: f64| {
        let mut joints = [f64::NAN; 16];
        joints[..5].fill(0.0);
        // SAFETY: plain numbers.
        let mut world: EmcPose = unsafe { std::mem::zeroed() };
        (world.tran.x, world.tran.y, world.c) = (coordinate, coordinate, 45.0);
        // SAFETY: a pose and 16 numbers.
        unsafe { framepath_kinematics_inverse(&world, joints.as_mut_ptr()) }
    };
    // Joints that belong to no axis are motion's own, whatever is in them.
    assert_eq!(inverse(1e300), 0);
    assert_eq!(inverse(f64::MAX), -1);
}
