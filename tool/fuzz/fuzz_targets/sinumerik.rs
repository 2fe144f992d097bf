//! Any bytes as a program of this dialect: from decoding to both outputs.
#![no_main]

#[path = "../../tests/filter/front_end.rs"]
mod front_end;

use framepath_tool::dialects::Dialect;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| front_end::run_all(Dialect::Sinumerik, bytes));
