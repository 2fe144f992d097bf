//! Random cases that can be had again.

use std::fmt::Display;

use proptest::test_runner::{Config as ProptestConfig, RngSeed, TestError, TestRunner};

/// A runner whose cases can be had again: PROPTEST_RNG_SEED=<what it prints>.
pub fn seeded_runner(config: ProptestConfig) -> TestRunner {
    let seed = match config.rng_seed {
        RngSeed::Fixed(seed) => seed,
        RngSeed::Random => {
            let now = std::time::UNIX_EPOCH.elapsed().expect("a clock");
            u64::from(now.subsec_nanos()) ^ now.as_secs() << 30
        }
    };
    println!("PROPTEST_RNG_SEED={seed}");
    TestRunner::new(ProptestConfig {
        rng_seed: RngSeed::Fixed(seed),
        ..config
    })
}

/// Fails with the case that does, as text, which can be kept as it is: why is a comment in it.
pub fn checked<T: Display>(result: Result<(), TestError<T>>) {
    match result {
        Ok(()) => {}
        Err(TestError::Abort(why)) => panic!("no cases: {why}"),
        Err(TestError::Fail(why, case)) => {
            panic!("\n# {}\n\n{case}", why.to_string().replace('\n', "\n# "))
        }
    }
}
