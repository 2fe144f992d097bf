//! Any bytes as calls of the C interface: see tests/abi_calls.
#![no_main]

#[path = "../../tests/abi_calls/mod.rs"]
mod abi_calls;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| abi_calls::frames::run(bytes));
