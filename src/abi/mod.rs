//! The edge to LinuxCNC's C: the only place with `unsafe` code and with C's types.
#![allow(unsafe_code)]

pub mod frame_pins;
pub mod inner;
pub mod inner_kinematics;
mod inner_normal;
pub mod kinematics;
pub mod kinematics_jet;
pub mod kinematics_words;
pub mod linuxcnc;
mod normal_pins;
pub mod planner;
pub mod pose;
mod retract_pins;
pub mod switch_place;
mod tool_pins;

use libc::c_uint;

/// Version of the library: major * 10000 + minor * 100 + patch.
pub const FRAMEPATH_VERSION: c_uint = 100;

const _: () = {
    let expected = env!("CARGO_PKG_VERSION").as_bytes();
    assert!(
        matches!(expected, b"0.1.0"),
        "FRAMEPATH_VERSION follows the version in Cargo.toml"
    );
};
