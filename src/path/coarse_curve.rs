//! How wide kernels may be on a coarse curve, where what they want at its speed is less than its legs are long.

/// A kernel may be so many legs wide, however slow the curve is run ..
const LEGS: f64 = 2.0;

/// .. and so many where both legs of its vertex are about as long and are not divided: kernels no wider than two show where legs meet.
const LEGS_AS_LONG: f64 = 2.5;

/// There one leg is no more than so many times as long as the other ..
const AS_LONG: f64 = 1.1;

/// .. and the direction turns by no more than this, length of the difference of unit vectors.
const LITTLE_TURN: f64 = 0.4;

/// How many legs wide a kernel may be on a coarse curve, where the direction turns by `turn`, length of the difference of unit
/// vectors, and the longer leg is `ratio` times as long as the shorter one.
pub(super) fn most_legs(turn: f64, ratio: f64) -> f64 {
    if turn <= LITTLE_TURN && ratio <= AS_LONG {
        LEGS_AS_LONG
    } else {
        LEGS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legs_that_are_as_long_and_turn_little_may_have_wider_kernels() {
        for (turn, ratio, legs) in [
            (0.1, 1.0, LEGS_AS_LONG),
            (0.1, 1.2, LEGS),
            (0.5, 1.0, LEGS),
            (0.5, 1.2, LEGS),
        ] {
            assert_eq!(most_legs(turn, ratio), legs);
        }
    }
}
