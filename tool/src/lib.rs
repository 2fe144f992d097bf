//! The command line tool of framepath: reads part programs of other controls and writes them for
//! LinuxCNC, and shows what the planner did with them.

pub(crate) mod arguments;
pub mod canon;
pub mod compare;
pub mod diagnostics;
pub mod dialects;
pub mod encoding;
pub mod filter;
pub mod generate;
pub(crate) mod optimum;
pub(crate) mod output;
pub(crate) mod page;
pub mod plan;
pub mod program;
pub mod report;
pub mod source;
pub mod write;
