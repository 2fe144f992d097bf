//! What the jerk limits leave over one servo period.
//!
//! The machine sees positions at the ends of the servo periods, and its jerk is their third
//! difference: the mean of the jerk over three periods, weighted by a quadratic B-spline. A period
//! counts 1, 4 or 1 sixth in it, by its mean jerk, which is exactly the difference of the
//! accelerations at its ends. What remains is how the jerk is spread within the period: where the
//! reference's own jumps by `R` there, a third difference may exceed the mean by 0.064 R (the
//! greatest value of (p - p^3) / 6 over the place p of the jump).
//!
//! Hence three rows for each axis: the mean jerk within the limit, less an allowance for a jump in
//! the reference; and the jerk at both ends of the period, without the jump, not far above it.

use super::stored_cell::StoredCell;
use crate::lanes::{LANE_COUNT, Lanes, ROUNDING, ZEROS, greater, lesser};

/// By how much less mean jerk makes up for the jump of the reference's own: 6 * 0.064 of it, since
/// the period counts a sixth.
const JUMP_ALLOWANCE: f32 = 0.384;

/// Part of the limit that may be missing from the allowance: third differences then exceed the
/// limit by less than 1 %.
const UNALLOWED_PART: f32 = 0.05;

/// How far the jerk at an instant may exceed the limit, which holds in the mean.
const INSTANT_PART: f32 = 1.2;

/// The check after the rows allows this much more: the rows only predict the end of the period.
pub const MEAN_TOLERANCE: f32 = 1.01;
/// The same for an instant.
pub const INSTANT_TOLERANCE: f32 = 1.05;

/// What is promised of all of it, at any moment and whatever the operator does: the third difference of an axis's positions over its
/// jerk limit, at most. Ten thousands of random programs are held to it (`tests/planner/programs.rs`), and so is what `framepath`
/// says of a plan or a recording.
pub const JERK_KEPT: f64 = 1.05;

/// What a jump of the reference's own jerk by at most `range` takes from the mean jerk.
#[inline(always)]
pub fn allowance(range: f32, limit: f32) -> f32 {
    greater(JUMP_ALLOWANCE * range - UNALLOWED_PART * limit, 0.0)
}

/// The reference's own jerk over one period, and the limit that holds.
pub struct Jerk {
    /// In the mean over the cell that the period starts in, units per period cubed.
    start: Lanes,
    /// In the mean over the cell that it ends in.
    end: Lanes,
    /// The greatest magnitude in both.
    greatest: Lanes,
    /// What a jump takes from the mean jerk that may be used, at a rate of 1.
    allowance: Lanes,
    limit: Lanes,
}

impl Jerk {
    /// Over two cells, each given with the one behind it.
    #[inline(always)]
    pub fn new(start: [&StoredCell; 2], end: [&StoredCell; 2], limit: &Lanes) -> Self {
        let mut jerk = Self {
            start: ZEROS,
            end: ZEROS,
            greatest: ZEROS,
            allowance: ZEROS,
            limit: *limit,
        };
        let ([a, behind_a], [b, behind_b]) = (start, end);
        for lane in 0..LANE_COUNT {
            let low = lesser(a.jerk_min[lane], b.jerk_min[lane]);
            let high = greater(a.jerk_max[lane], b.jerk_max[lane]);
            jerk.start[lane] = behind_a.acceleration[lane] - a.acceleration[lane];
            jerk.end[lane] = behind_b.acceleration[lane] - b.acceleration[lane];
            jerk.greatest[lane] = greater(high, -low);
            jerk.allowance[lane] = allowance(high - low, jerk.limit[lane]);
        }
        jerk
    }

    /// The greatest magnitude of the reference's own jerk.
    #[inline(always)]
    pub fn greatest(&self, lane: usize) -> f32 {
        self.greatest[lane]
    }

    /// The reference's own jerk at the start, in the middle and at the end of the period.
    #[inline(always)]
    pub fn own(&self, lane: usize) -> [f32; 3] {
        let (start, end) = (self.start[lane], self.end[lane]);
        [start, 0.5 * (start + end), end]
    }

    /// What the mean jerk of the period may be where the reference's own counts `cube` times. No
    /// less than `needed`, its mean at a constant rate, so that this is always allowed, even after
    /// the limits have been lowered.
    #[inline(always)]
    pub fn mean_limit(&self, lane: usize, cube: f32, needed: f32) -> f32 {
        let limit = self.limit[lane] - cube * self.allowance[lane];
        ROUNDING * greater(limit, needed.abs())
    }

    /// What the jerk at an instant may be; no less than `needed`, as above.
    #[inline(always)]
    pub fn instant_limit(&self, lane: usize, needed: f32) -> f32 {
        INSTANT_PART * ROUNDING * greater(self.limit[lane], needed.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Position, velocity and acceleration after a time with constant jerk.
    fn advance([x, v, a]: [f64; 3], jerk: f64, t: f64) -> [f64; 3] {
        [
            x + t * (v + t * (a / 2.0 + t * jerk / 6.0)),
            v + t * (a + t * jerk / 2.0),
            a + t * jerk,
        ]
    }

    /// Third difference over three periods: the mean jerk is 1 in two of them; in the other one it
    /// jumps by `range` at `place`, with what is left of its mean.
    fn third_difference(jumping: usize, place: f64, range: f64) -> f64 {
        let mean = 1.0 - f64::from(allowance(range.abs() as f32, 1.0));
        let mut state = [0.0; 3];
        let mut positions = vec![0.0];
        for period in 0..3 {
            if period == jumping {
                state = advance(state, mean - range * (1.0 - place), place);
                state = advance(state, mean + range * place, 1.0 - place);
            } else {
                state = advance(state, 1.0, 1.0);
            }
            positions.push(state[0]);
        }
        positions[3] - 3.0 * positions[2] + 3.0 * positions[1] - positions[0]
    }

    #[test]
    fn a_jump_of_the_reference_is_made_up_for_by_less_mean_jerk() {
        let mut greatest = 0.0_f64;
        for period in 0..3 {
            for place in (0..=100).map(|i| f64::from(i) * 0.01) {
                for range in (-40..=40).map(|i| f64::from(i) * 0.05) {
                    greatest = greatest.max(third_difference(period, place, range));
                }
            }
        }
        assert!((1.005..1.01).contains(&greatest), "{greatest}");
    }
}
