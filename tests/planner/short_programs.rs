//! Short programs of all kinds of moves, from a nanometre on, on machines of all kinds: no fault, no limit
//! exceeded, none left unfinished. What they found is kept in `regressions`.

use crate::common::seeded_runner::seeded_runner;
use crate::common::{Extremes, with_room};
use crate::program::checked;
use crate::program::run::run;
use crate::short_program::any_program;
use proptest::test_runner::{Config, RngSeed, TestRunner};

/// Threads that share the programs: not one for each processor, or a seed would mean others on each computer.
const WORKERS: u32 = 2;

/// As many programs as FRAMEPATH_CASES says.
#[test]
fn short_programs_keep_all_limits() {
    let cases =
        std::env::var("FRAMEPATH_CASES").map_or(3_000, |cases| cases.parse().expect("a number"));
    let config = Config {
        cases,
        failure_persistence: None,
        ..Config::default()
    };
    let seed = match seeded_runner(config.clone()).config().rng_seed {
        RngSeed::Fixed(seed) => seed,
        RngSeed::Random => 0,
    };
    let work = |worker: u32| {
        with_room(|| {
            let mut greatest = Extremes::default();
            let sum = std::cell::RefCell::new(&mut greatest);
            let mut runner = TestRunner::new(Config {
                cases: (cases + worker) / WORKERS,
                rng_seed: RngSeed::Fixed(seed.wrapping_add(u64::from(worker) << 32)),
                ..config.clone()
            });
            let result = runner.run(&any_program(), |program| {
                sum.borrow_mut().join(&run(&program)?.extremes);
                Ok(())
            });
            checked(result);
            greatest
        })
    };
    let mut greatest = Extremes::default();
    std::thread::scope(|scope| {
        let started: Vec<_> = (0..WORKERS)
            .map(|worker| scope.spawn(move || work(worker)))
            .collect();
        for worker in started {
            match worker.join() {
                Ok(extremes) => greatest.join(&extremes),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
    });
    println!("greatest over the limits: {greatest:?}");
}
