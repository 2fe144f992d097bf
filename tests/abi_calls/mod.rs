//! The whole C interface, called in any order with any values: bytes decide what is called and with what, so that a
//! fuzzer and the random cases of an ordinary test drive the same calls. After each of them everything that is
//! reported is judged.
#![allow(unsafe_code)]
#![allow(dead_code, reason = "each front end uses its own part")]

use std::ffi::{CStr, c_char};

pub mod choices;
pub mod frames;
mod judge;
pub mod motion;
pub mod moves;
pub mod planner;
mod settings;
mod standing;

/// A text of the library.
pub fn words<'a>(text: *const c_char) -> &'a str {
    assert!(!text.is_null());
    // SAFETY: the library answers with static strings.
    unsafe { CStr::from_ptr(text) }
        .to_str()
        .expect("plain words")
}

/// What an axis may go beyond its velocity limit, as a share of it. Where the limits of the axes are unequal, .53 % too
/// much is known; 1e-3 is what is promised.
pub const VELOCITY_EXCESS: f64 = 1e-3;
