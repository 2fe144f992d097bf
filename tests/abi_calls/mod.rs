//! The whole C interface, called in any order with any values: bytes decide what is called and with what, so that a
//! fuzzer and the random cases of an ordinary test drive the same calls. After each of them everything that is
//! reported is judged.
#![allow(unsafe_code)]
#![allow(dead_code, reason = "each front end uses its own part")]

pub mod choices;
pub mod frames;
mod judge;
pub mod motion;
pub mod moves;
pub mod planner;
mod settings;
mod standing;

/// Whether a fault of the planner itself fails a case: none may happen, whatever is asked for. Off while faults are known
/// that have not been mended; nothing else depends on it.
pub const FAULTS_FAIL: bool = false;

/// What an axis may go beyond its velocity limit, as a share of it. Where the limits of the axes are unequal, .53 % too
/// much is known; 1e-3 is what is promised.
pub const VELOCITY_EXCESS: f64 = 1e-3;
