//! Modules of LinuxCNC's that are loaded into an ordinary process, which is the edge to C: `stubs.c` stands where RTAPI and HAL
//! stand for them, [`stubs`] are its functions; [`module`] opens one, and [`kinematics`] asks a kinematics module.
#![allow(unsafe_code)]

pub(crate) mod kinematics;
pub(crate) mod module;
pub(crate) mod stubs;
