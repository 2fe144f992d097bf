//! The edge of `compare` to C: loads a planner module into this process and drives it.
//!
//! The process is one of its own, started by [`super::supervise`] with `stubs.c` loaded before
//! everything else. [`functions`] are the functions of a planner module, [`stubs`] those of `stubs.c`;
//! [`machine`] holds the structures that module and motion controller share; [`drive`] is the servo
//! loop, [`task`] hands it the operations of the program, [`stop_watch`] measures the calls;
//! [`memory_file`] is a file without a name, [`progress`] a word that outlives a crash.
#![allow(unsafe_code)]

pub(crate) mod drive;
mod functions;
mod machine;
pub(crate) mod memory_file;
pub(crate) mod progress;
mod stop_watch;
mod stubs;
mod task;
