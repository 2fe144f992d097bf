//! Runs a planner module in a process of its own, which it may crash or hang.
//!
//! On this side: [`supervise`] starts the process, tells it a [`job`] with what the [`operator`] does, and
//! reads the [`recording`] that comes back. The process itself has `stubs.c` loaded before everything
//! else and is the edge to C: [`functions`] are the functions of a planner module, those of `stubs.c` are in [`crate::loaded`]; [`machine`] holds the structures that module and motion controller share, [`kinematics`] are those of
//! the machine where joints have limits; [`drive`] is the servo loop, [`task`] hands it the operations of the program, [`stop_watch`] measures the calls;
//! [`progress`] is a word that outlives a crash.
#![allow(unsafe_code)]

pub(crate) mod drive;
mod functions;
pub(crate) mod job;
mod kinematics;
mod machine;
pub(crate) mod operator;
mod progress;
pub(crate) mod recording;
mod stop_watch;
pub(crate) mod supervise;
mod task;
