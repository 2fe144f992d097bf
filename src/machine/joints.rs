//! The joints of a machine.

/// How many joints LinuxCNC's motion controller handles at most.
pub const JOINT_COUNT: usize = 16;
