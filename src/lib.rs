//! The real-time core of framepath.
//!
//! Two programs share it. A move goes through the folders of blendtp in this order: [`moves`] (what
//! LinuxCNC queues) -> [`path`] (what the machine follows, rounded within the tolerance) ->
//! [`speed`] (how fast it may be run) -> [`cycle`] (how far the machine gets in a servo period);
//! [`planner`] holds the four together. In framekins a position goes through [`frame`] (the
//! programmed frame) -> [`machine`] (joints), and [`kinematics`] holds the two together. `abi` is
//! the edge to C of both, the only place with `unsafe` code, and there with the feature `linuxcnc`
//! only. No folder imports one that comes later, and no file leads back to itself: `tests/order.rs`
//! has the order and holds it.
//!
//! Principles:
//!
//! - Nothing here allocates, locks, blocks, panics or loops without a bound.
//! - Check once at the edge, trust inside. Errors are small `Copy` enums with numbers; the words
//!   for them are at the edge.
//! - Simple and clear over fast and clever, until a measurement says otherwise.

#[cfg(feature = "linuxcnc")]
pub mod abi;
pub mod axes;
mod cube_root;
pub mod cycle;
pub mod frame;
pub mod kinematics;
mod lanes;
pub mod machine;
pub mod machine_map;
pub mod moves;
pub mod numerical_jet;
pub mod path;
pub mod planner;
mod ring;
pub mod speed;
#[cfg(test)]
mod test_room;
