//! Tests of `framepath compare` and `framepath generate` as a user runs them.

mod bad_modules;
#[path = "../common/bench.rs"]
mod bench;
mod canon;
mod errors;
#[path = "../common/fields.rs"]
mod fields;
mod joints;
mod json;
mod measuring;
mod operator;
mod optimum;
mod other_linuxcnc;
#[path = "../common/processes.rs"]
mod processes;
mod programs;
mod signals;
mod stock;
mod support;
#[path = "../common/table.rs"]
mod table;
mod tube;
