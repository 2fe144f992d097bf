//! A rotary axis that turns little beside X and Y takes away nothing of what the tolerance gives them.

use crate::common::zigzag;

#[test]
fn a_rotary_axis_that_turns_little_costs_no_time() {
    // C turns by so many degrees.
    let periods = |leg, jerk, turn: f64| {
        zigzag::periods(leg, jerk, |number, end| {
            end[5] = turn * f64::from(number % 3);
        }) as f64
    };
    for jerk in [f64::INFINITY, 1e5, 2e4] {
        for leg in [0.5, 1.0, 2.0] {
            let alone = periods(leg, jerk, 0.0);
            for turn in [1e-5, 0.001, 0.003] {
                let beside = periods(leg, jerk, turn);
                let fits = beside <= 1.02 * alone + 2.0;
                assert!(
                    fits,
                    "{turn} degrees on {leg} mm, jerk {jerk}: {beside}, alone {alone}"
                );
            }
        }
    }
}
