//! The command line tool of framepath: reads part programs of other controls and writes them for
//! LinuxCNC, and shows what the planner did with them.
//!
//! Each room imports only those before it; `tests/rooms.rs` has their order and what each is for.

pub(crate) mod arguments;
#[cfg(feature = "linuxcnc")]
pub mod canon;
pub mod check;
#[cfg(feature = "linuxcnc")]
pub mod compare;
pub mod completions;
pub mod configure;
pub mod diagnostics;
pub mod dialects;
pub mod encoding;
pub mod filter;
pub(crate) mod format;
pub mod generate;
pub mod generated;
pub(crate) mod hal;
#[cfg(feature = "linuxcnc")]
pub(crate) mod host;
#[cfg(feature = "linuxcnc")]
pub(crate) mod joints;
pub(crate) mod json;
#[cfg(feature = "linuxcnc")]
pub(crate) mod layer;
#[cfg(feature = "linuxcnc")]
pub(crate) mod loaded;
pub(crate) mod machine;
#[cfg(feature = "linuxcnc")]
pub(crate) mod memory_file;
#[cfg(feature = "optimum")]
pub(crate) mod optimum;
pub mod output;
pub(crate) mod page;
pub mod part_program;
pub(crate) mod path;
#[cfg(feature = "linuxcnc")]
pub mod plan;
pub mod program;
pub mod record;
pub mod report;
pub(crate) mod signals;
pub mod source;
pub(crate) mod wiring;
pub mod write;
