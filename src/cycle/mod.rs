//! The servo cycle: runs the reference trajectory with a time of its own, within all limits.

pub mod cell;
