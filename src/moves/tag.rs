//! The interpreter's state that travels with a move.

/// Size of LinuxCNC's `struct state_tag_t` in bytes: 5 floats, 9 ints and an unsigned long.
pub const STATE_TAG_SIZE: usize = 64;

/// The bytes of a `struct state_tag_t`, never looked into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StateTag(pub [u8; STATE_TAG_SIZE]);

impl StateTag {
    /// The tag of no move: all bytes zero.
    pub const EMPTY: Self = Self([0; STATE_TAG_SIZE]);
}
