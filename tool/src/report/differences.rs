//! The peaks of velocity, acceleration and jerk in a recording, and how they compare with the limits.

use super::recording::Recording;
use crate::machine::configuration::MemberLimits;
use crate::path::rates::{Quantity, crosses};
use framepath::cycle::JERK_KEPT;
use serde::Serialize;

/// How a peak compares with its limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Judgement {
    /// Not above the limit; jerk: not above it by more than blendtp promises.
    Within,
    /// Above the limit.
    Over,
    /// The limit lies within the rounding of the recording: more decimals are needed.
    Unresolved,
    /// There is no limit.
    NotLimited,
}

/// A limit of velocity or acceleration counts as kept up to this share above it: room for rounding in 64-bit numbers.
const LIMIT_ROUNDING: f64 = 1e-6;

impl Judgement {
    /// Compares `peak`, known to `uncertainty`, with `limit`; same units.
    pub fn of(quantity: Quantity, peak: f64, uncertainty: f64, limit: Option<f64>) -> Judgement {
        let Some(limit) = limit else {
            return Judgement::NotLimited;
        };
        let allowed = match quantity {
            Quantity::Jerk => limit * JERK_KEPT,
            Quantity::Velocity | Quantity::Acceleration => limit * (1.0 + LIMIT_ROUNDING),
        };
        if peak - uncertainty > allowed {
            Judgement::Over
        } else if peak + uncertainty <= allowed {
            Judgement::Within
        } else {
            Judgement::Unresolved
        }
    }
}

/// The greatest magnitude of a quantity, and how it compares with its limit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Peak {
    /// Which quantity.
    pub quantity: Quantity,
    /// Greatest magnitude, units per second to the order.
    pub peak: f64,
    /// How far `peak` can be off through the rounding of the recording, same units.
    pub uncertainty: f64,
    /// The limit, same units; `null`: not limited.
    pub limit: Option<f64>,
    /// `peak / limit`.
    pub share: Option<f64>,
    /// When, seconds, in the middle of the rows that the difference takes.
    pub time: f64,
    /// The program line at that time.
    pub line: i64,
    /// The comparison.
    pub judgement: Judgement,
}

/// Finds the peak of a quantity in `positions` (shape (rows), units).
///
/// No difference is taken across a row in `breaks` (rising): before it a servo cycle is missing,
/// or the coordinates have changed their meaning.
pub fn find_peak(
    recording: &Recording,
    positions: &[f64],
    breaks: &[usize],
    quantity: Quantity,
    limits: &MemberLimits,
    period: f64,
) -> Peak {
    let order = quantity.order();
    let mut peak = 0.0;
    let mut peak_row = 0;
    let mut greatest_position = 0f64;
    for row in 0..positions.len() {
        greatest_position = greatest_position.max(positions[row].abs());
        let Some(value) = quantity.at(positions, row, period) else {
            continue;
        };
        if value.abs() > peak && !crosses(breaks, row, order) {
            peak = value.abs();
            peak_row = row;
        }
    }
    let half_digit = (0.5 * recording.resolution).max(greatest_position * f64::EPSILON);
    let uncertainty = quantity.uncertainty(half_digit, period);
    let limit = quantity.limit(limits);
    Peak {
        quantity,
        peak,
        uncertainty,
        limit,
        share: limit.map(|limit| peak / limit),
        time: recording.times[peak_row] - 0.5 * period * order.min(peak_row) as f64,
        line: recording.lines[peak_row.saturating_sub(order / 2)],
        judgement: Judgement::of(quantity, peak, uncertainty, limit),
    }
}

#[cfg(test)]
mod tests {
    use super::super::recording::tests::recording_of;
    use super::*;
    use proptest::prelude::*;

    const LIMITS: MemberLimits = MemberLimits {
        velocity: 100.0,
        acceleration: 1000.0,
        jerk: Some(20000.0),
    };

    /// A move with four phases of constant jerk, positions of X at 1 ms.
    fn constant_jerk_move(jerk: f64, phase: f64) -> Vec<[f64; 3]> {
        let end_of = |[x, v, a]: [f64; 3], j: f64, t: f64| {
            [
                x + t * (v + t * (a / 2.0 + t * j / 6.0)),
                v + t * (a + t * j / 2.0),
                a + t * j,
            ]
        };
        let signs = [1.0, -1.0, -1.0, 1.0];
        (0..=(4.0 * phase / 0.001) as usize)
            .map(|row| {
                let mut left = row as f64 * 0.001;
                let mut state = [0.0; 3];
                for sign in signs {
                    let t = left.min(phase);
                    state = end_of(state, sign * jerk, t);
                    left -= t;
                }
                [state[0], 0.0, 0.0]
            })
            .collect()
    }

    fn peaks(points: &[[f64; 3]], breaks: &[usize]) -> Vec<Peak> {
        let recording = recording_of(points, |row| row as i64);
        Quantity::ALL
            .into_iter()
            .map(|q| find_peak(&recording, &recording.joints[0], breaks, q, &LIMITS, 0.001))
            .collect()
    }

    #[test]
    fn peaks_of_constant_jerk_have_their_closed_form() {
        // 20000 mm/s3 for 40 ms: 800 mm/s2, then v = j t^2 = 32 mm/s after 80 ms.
        let found = peaks(&constant_jerk_move(20000.0, 0.04), &[]);
        // The difference over one period is the mean of v, half a period beside its peak.
        assert!((found[0].peak - 32.0).abs() < 0.01, "{:?}", found[0]);
        assert!((found[1].peak - 800.0).abs() < 20.0, "{:?}", found[1]);
        assert!((found[2].peak - 20000.0).abs() < 0.1, "{:?}", found[2]);
        assert!((found[0].time - 0.08).abs() < 0.0011);
        assert!((found[0].line - 80).abs() <= 1);
        assert!(found.iter().all(|p| p.judgement == Judgement::Within));
        assert_eq!(found[2].share.map(|share| (share * 1e4).round()), Some(1e4));
    }

    #[test]
    fn a_broken_limit_is_over() {
        let judged = |jerk| peaks(&constant_jerk_move(jerk, 0.04), &[])[2].judgement;
        assert_eq!(judged(20900.0), Judgement::Within);
        let found = peaks(&constant_jerk_move(21100.0, 0.04), &[]);
        assert_eq!(found[2].judgement, Judgement::Over);
        assert!((found[2].peak - 21100.0).abs() < 0.1);
        assert_eq!(found[1].judgement, Judgement::Within);
    }

    #[test]
    fn no_difference_is_taken_across_a_break() {
        let mut points = constant_jerk_move(20000.0, 0.04);
        for point in &mut points[60..] {
            point[0] += 5.0;
        }
        assert!(peaks(&points, &[])[0].peak > 5000.0);
        let found = peaks(&points, &[60]);
        assert!((found[0].peak - 32.0).abs() < 0.01);
        assert!((found[2].peak - 20000.0).abs() < 0.1);
    }

    #[test]
    fn few_decimals_leave_the_jerk_unresolved() {
        let points: Vec<[f64; 3]> = constant_jerk_move(20000.0, 0.04)
            .iter()
            .map(|p| [(p[0] * 1e6).round() * 1e-6, 0.0, 0.0])
            .collect();
        let mut recording = recording_of(&points, |_| 1);
        recording.resolution = 1e-6;
        let jerk = find_peak(
            &recording,
            &recording.joints[0],
            &[],
            Quantity::Jerk,
            &LIMITS,
            0.001,
        );
        assert!((jerk.uncertainty - 4000.0).abs() < 1e-6);
        assert_eq!(jerk.judgement, Judgement::Unresolved);
    }

    proptest! {
        #[test]
        fn crossing_agrees_with_its_definition(
            breaks in proptest::collection::btree_set(1usize..60, 0..8),
            row in 0usize..60,
            order in 1usize..4,
        ) {
            let breaks: Vec<usize> = breaks.into_iter().collect();
            let expected = breaks.iter().any(|at| *at <= row && row < *at + order);
            prop_assert_eq!(crosses(&breaks, row, order), expected);
        }
    }
}
