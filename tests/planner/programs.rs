//! Random programs of lines, arcs and helices while an operator does everything an operator can
//! do: always within the limits, always at the end point. What they found is kept in
//! `regressions_limits.rs`, `regressions_between.rs` and `regressions_rests.rs`.

use std::cell::RefCell;

use crate::common::seeded_runner::seeded_runner;
use crate::common::{Extremes, with_room};
use crate::random_program::run::run;
use crate::random_program::{
    Programmed, any_corners, any_curves, any_event, any_limits, any_move, any_unequal_limits,
};
use framepath::axes::AxisLimits;
use proptest::prelude::*;

/// Runs programs of these moves, as many as FRAMEPATH_CASES says or `cases`.
fn keep_the_limits(
    limits: impl Strategy<Value = AxisLimits>,
    moves: impl Strategy<Value = Vec<Programmed>>,
    cases: u32,
) {
    let strategy = (
        limits,
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
    let moves = prop::collection::vec(any_move(), 1..60);
    keep_the_limits(any_limits(), moves, 100);
}

#[test]
fn so_do_curves_of_short_lines() {
    keep_the_limits(any_limits(), any_curves(), 40);
}

/// Before anything was set aside for what the path does between two places, one in twenty of these exceeded
/// a limit: jerk by up to 17 %, velocity by 1 %, acceleration by .7 %.
#[test]
fn machines_with_unequal_axes_keep_each_of_their_limits() {
    keep_the_limits(any_unequal_limits(), any_corners(), 120);
}
