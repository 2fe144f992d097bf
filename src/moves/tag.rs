//! The interpreter's state that travels with a move.

use core::mem::MaybeUninit;

/// LinuxCNC's `struct state_tag_t` as its headers have it: 64 bytes in 2.9, 384 in 2.10.
#[cfg(feature = "linuxcnc")]
#[allow(missing_docs, non_camel_case_types, dead_code)]
mod headers {
    include!(concat!(env!("OUT_DIR"), "/state_tag.rs"));
}

/// Size of LinuxCNC's `struct state_tag_t` in bytes.
#[cfg(feature = "linuxcnc")]
pub const STATE_TAG_SIZE: usize = size_of::<headers::state_tag_t>();
/// Without LinuxCNC moves have no tag.
#[cfg(not(feature = "linuxcnc"))]
pub const STATE_TAG_SIZE: usize = 0;

/// The bytes of a `struct state_tag_t`, never looked into. Some lie between its fields and say nothing.
#[derive(Clone, Copy, Debug)]
pub struct StateTag(pub [MaybeUninit<u8>; STATE_TAG_SIZE]);

impl StateTag {
    /// The tag of no move: all bytes zero.
    pub const EMPTY: Self = Self([MaybeUninit::new(0); STATE_TAG_SIZE]);
}
