//! The C interface of both modules with random calls and values. The driver is the fuzzer's own (`make fuzz`).
#![allow(unsafe_code)]

mod abi_calls;
#[path = "planner/common/seeded_runner.rs"]
mod seeded_runner;

use std::path::PathBuf;

use proptest::prelude::*;
use seeded_runner::seeded_runner;

/// A case that takes longer has met an endless loop.
const MOST_SECONDS: u32 = 300;

/// Runs a driver on random bytes, as many cases as FRAMEPATH_CASES says or `cases`.
///
/// A panic inside a C function ends the process: the case that runs is kept in a file, which the fuzzer's program
/// takes as it is, and so does this test in FRAMEPATH_CASE.
fn random_calls(name: &str, cases: u32, longest: usize, run: fn(&[u8])) {
    if let Some(case) = std::env::var_os("FRAMEPATH_CASE") {
        run(&std::fs::read(case).expect("a case"));
        return;
    }
    let cases =
        std::env::var("FRAMEPATH_CASES").map_or(cases, |cases| cases.parse().expect("a number"));
    let config = ProptestConfig {
        cases,
        failure_persistence: None,
        max_shrink_iters: 300,
        ..ProptestConfig::default()
    };
    let kept = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    println!("the case that runs is in {}", kept.display());
    let bytes = prop::collection::vec(any::<u8>(), 0..longest);
    let result = seeded_runner(config).run(&bytes, |bytes| {
        std::fs::write(&kept, &bytes).expect("a file for the case");
        // SAFETY: no more than a signal that ends the process.
        unsafe { libc::alarm(MOST_SECONDS) };
        run(&bytes);
        // SAFETY: as above.
        unsafe { libc::alarm(0) };
        Ok(())
    });
    if let Err(error) = result {
        panic!("{error}");
    }
}

#[test]
fn the_planner_stands_any_calls() {
    random_calls("abi-planner-case", 60, 1500, abi_calls::planner::run);
}

#[test]
fn the_kinematics_stand_any_calls() {
    random_calls("abi-frames-case", 300, 1500, abi_calls::frames::run);
}
