//! Random cases that can be had again.

use proptest::test_runner::{Config as ProptestConfig, RngSeed, TestRunner};

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
