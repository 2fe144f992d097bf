//! U and V beside X and Y, as the two ends of a wire: each keeps the tolerance by itself, and takes away nothing of the other's.

use crate::common::zigzag;

#[test]
fn another_end_that_moves_no_more_costs_no_time() {
    // U and V move by so many times what X and Y do.
    let periods = |leg, jerk, times: [f64; 2]| {
        zigzag::periods(leg, jerk, |_, end| {
            end[6] = times[0] * end[0];
            end[7] = times[1] * end[1];
        }) as f64
    };
    for jerk in [f64::INFINITY, 1e5, 2e4] {
        for leg in [0.5, 1.0, 2.0] {
            let alone = periods(leg, jerk, [0.0; 2]);
            for times in [[1.0, 1.0], [1.0, -1.0], [0.8, 0.3]] {
                let both = periods(leg, jerk, times);
                let fits = both <= 1.03 * alone + 2.0;
                assert!(
                    fits,
                    "{times:?} on {leg} mm, jerk {jerk}: {both}, alone {alone}"
                );
            }
        }
    }
}
