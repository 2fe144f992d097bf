//! Random programs of lines, arcs and helices while an operator does everything an operator can
//! do: always within the limits, always at the end point. What they found is kept in
//! `planner_found_limits.rs`, `planner_found_between.rs` and `planner_found_rests.rs`.

mod planner_common;
mod planner_random;

use std::cell::RefCell;

use planner_common::{Extremes, seeded_runner, with_room};
use planner_random::run::run;
use planner_random::{Programmed, any_curves, any_event, any_limits, any_move};
use proptest::prelude::*;

/// Runs programs of these moves, as many as FRAMEPATH_CASES says or `cases`.
fn keep_the_limits(moves: impl Strategy<Value = Vec<Programmed>>, cases: u32) {
    let strategy = (
        any_limits(),
        moves,
        prop::collection::vec((1usize..400, any_event()), 0..40),
        prop_oneof![Just(1usize), 1usize..300],
    );
    let sum = RefCell::new((Extremes::default(), 0));
    let cases =
        std::env::var("FRAMEPATH_CASES").map_or(cases, |cases| cases.parse().expect("a number"));
    let config = ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let mut runner = seeded_runner(config);
    let result = runner.run(&strategy, |(limits, moves, events, supply)| {
        let (extremes, cycles) = with_room(|| run(limits, &moves, &events, supply))?;
        let mut sum = sum.borrow_mut();
        sum.0.join(&extremes);
        sum.1 += cycles;
        Ok(())
    });
    let (greatest, cycles) = sum.into_inner();
    println!("{cycles} cycles, greatest over the limits: {greatest:?}");
    if let Err(error) = result {
        panic!("{error}");
    }
}

#[test]
fn programs_keep_the_limits_whatever_the_operator_does() {
    keep_the_limits(prop::collection::vec(any_move(), 1..60), 100);
}

#[test]
fn so_do_curves_of_short_lines() {
    keep_the_limits(any_curves(), 40);
}
