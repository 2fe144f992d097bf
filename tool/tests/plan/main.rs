//! `framepath plan` as its users run it.

mod above_joints;
mod arrivals;
#[path = "../common/bench.rs"]
mod bench;
#[path = "../common/browser.rs"]
mod browser;
mod errors;
#[path = "../common/fields.rs"]
mod fields;
mod figures;
mod files;
mod inputs;
mod joints;
mod long_programs;
mod machine_files;
mod overwriting;
mod page;
#[path = "../common/pages.rs"]
mod pages;
#[path = "../common/processes.rs"]
mod processes;
mod read_only;
mod signals;
mod soft_limits;
mod start;
mod support;
#[path = "../common/surface.rs"]
mod surface;
#[path = "../common/table.rs"]
mod table;
mod text;
