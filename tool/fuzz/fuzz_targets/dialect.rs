//! Any bytes as a program of the dialect that the variable DIALECT names: from decoding to both outputs.
#![no_main]

#[path = "../../tests/filter/front_end.rs"]
mod front_end;

use framepath_tool::dialects::Dialect;
use std::sync::LazyLock;

static DIALECT: LazyLock<Dialect> = LazyLock::new(|| {
    let wanted = std::env::var("DIALECT").unwrap_or_default();
    let found = Dialect::ALL.iter().find(|dialect| dialect.name() == wanted);
    *found.expect("DIALECT names a dialect")
});

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| front_end::run_all(*DIALECT, bytes));
