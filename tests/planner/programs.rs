//! Random programs of lines, arcs and helices while an operator does everything an operator can
//! do: always within the limits, always at the end point. What they found is kept in `regressions`.

use std::cell::RefCell;

use crate::common::seeded_runner::seeded_runner;
use crate::common::{Extremes, with_room};
use crate::program::run::run;
use crate::program::{Programmed, checked};
use crate::random_program::{
    any_corners, any_curves, any_limits, any_move, any_program, any_unequal_limits,
};
use framepath::axes::AxisLimits;
use proptest::prelude::*;

/// Runs programs of these moves, as many as FRAMEPATH_CASES says or `cases`.
fn keep_the_limits(
    limits: impl Strategy<Value = AxisLimits>,
    moves: impl Strategy<Value = Vec<Programmed>>,
    cases: u32,
) {
    let sum = RefCell::new((Extremes::default(), 0));
    let cases =
        std::env::var("FRAMEPATH_CASES").map_or(cases, |cases| cases.parse().expect("a number"));
    let config = ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let mut runner = seeded_runner(config);
    let result = runner.run(&any_program(limits, moves), |program| {
        let ran = with_room(|| run(&program))?;
        let mut sum = sum.borrow_mut();
        sum.0.join(&ran.extremes);
        sum.1 += ran.periods;
        Ok(())
    });
    let (greatest, periods) = sum.into_inner();
    println!("{periods} periods, greatest over the limits: {greatest:?}");
    checked(result);
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
