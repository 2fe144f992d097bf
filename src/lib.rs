//! The real-time core of framepath.
//!
//! A move travels through the folders in this order:
//! [`moves`] (what LinuxCNC queues) -> [`path`] (its shape over arc length) -> [`speed`] (how fast
//! it may be run) -> [`cycle`] (where the machine is in each servo period) -> [`frame`] (the
//! programmed frame) -> [`machine`] (joints). [`planner`] holds the first four together; `abi` is
//! the edge to C, the only place with `unsafe` code.
//!
//! Principles:
//!
//! - Nothing here allocates, locks, blocks, panics or loops without a bound.
//! - Check once at the edge, trust inside. Errors are small `Copy` enums with numbers; the words
//!   for them are at the edge.
//! - Simple and clear over fast and clever, until a measurement says otherwise.

pub mod abi;
pub mod axes;
mod cube_root;
pub mod cycle;
pub mod frame;
pub mod machine;
pub mod moves;
pub mod path;
pub mod planner;
pub mod speed;
