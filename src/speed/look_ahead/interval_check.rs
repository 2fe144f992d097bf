//! Whether an interval keeps the limits of the axes.

use super::interval::Parabola;
use super::interval_samples::IntervalSamples;
use super::rows::{AxisRows, THIRD};
use super::sample::MovingAxes;
use crate::lanes::{QUAD_LANES, QUADS, Quad, greater, quad};

/// Between these places the acceleration may exceed what is allowed there by this share of its
/// limit ..
const ACCELERATION_BETWEEN: f32 = 1e-3;
/// .. and the jerk by this one: what is seen of it once a servo period is a mean.
const JERK_BETWEEN: f32 = 0.03;

/// Where the jerk bends by more than this share of its limit between three places, it is looked at there.
const JERK_BEND: f32 = 0.3;

impl AxisRows {
    /// Whether an interval keeps the share `margin` of all limits at its start, middle and end,
    /// hardly exceeds them in between, and may be described by these places.
    #[inline]
    pub fn keeps(
        &self,
        parabola: &Parabola,
        interval: &IntervalSamples,
        raise_squared: f64,
        margin: f64,
    ) -> bool {
        if parabola.is_degenerate() {
            return false;
        }
        let half = 0.5 * parabola.length;
        let places = [0.0, half, parabola.length].map(|x| parabola.at(x));
        let [b0, b1, b2] = places.map(|(b, _)| b);
        if !keeps_caps(
            [b0, b1, b2],
            parabola.u * half * half,
            interval,
            raise_squared,
        ) {
            return false;
        }
        let samples = interval.places();
        let places = places.map(|(b, a)| (b as f32, a as f32));
        let speeds = places.map(|(b, _)| b.sqrt());
        let (u, half, margin) = (parabola.u as f32, half as f32, margin as f32);
        let fastest = greater(greater(b0 as f32, b1 as f32), b2 as f32);
        let for_acceleration = margin - interval.departure.second * fastest;
        let for_jerk = margin - interval.departure.third * fastest * fastest.sqrt();
        let moving = MovingAxes::at_any(samples);
        // Without a branch, so that all lanes are looked at together: 1 where they keep their limits.
        let mut kept = [1u32; QUAD_LANES];
        for number in (0..QUADS).filter(|number| moving.in_quad(*number)) {
            let times = quad(&self.jerk_time_lanes, number);
            let first = samples.map(|sample| quad(&sample.lanes[0], number));
            let second = samples.map(|sample| quad(&sample.lanes[1], number));
            let third = samples.map(|sample| quad(&sample.lanes[2], number));
            let rows = [first, second, third];
            let mut bent = [0u32; QUAD_LANES];
            for lane in 0..QUAD_LANES {
                let time = times[lane];
                let [accelerations, changes, jerks] = taken(&rows, lane, time, &places, &speeds, u);
                let between = halves(accelerations, changes.map(|change| change * time * half));
                let within = is_within(accelerations, for_acceleration, ACCELERATION_BETWEEN)
                    & is_within(jerks, for_jerk, JERK_BETWEEN)
                    & (between <= for_acceleration + ACCELERATION_BETWEEN);
                kept[lane] &= u32::from(within);
                bent[lane] |= u32::from(is_bent(jerks));
            }
            if bent != [0; QUAD_LANES]
                && !keeps_jerk_between(parabola, rows, for_jerk + JERK_BETWEEN)
            {
                return false;
            }
        }
        kept == [1; QUAD_LANES]
    }
}

/// What the axis of a lane takes at start, middle and end: of the acceleration; the jerk over the velocity, which is by
/// how much the acceleration changes with s; of the jerk.
#[inline(always)]
fn taken(
    [first, second, third]: &[[&Quad; 3]; 3],
    lane: usize,
    time: f32,
    places: &[(f32, f32); 3],
    speeds: &[f32; 3],
    u: f32,
) -> [[f32; 3]; 3] {
    let [mut accelerations, mut changes, mut jerks] = [[0.0; 3]; 3];
    for place in 0..3 {
        let by_u = first[place][lane];
        let by_a = second[place][lane];
        let by_b = third[place][lane];
        let (b, a) = places[place];
        accelerations[place] = (by_u * a + by_a * (THIRD * b)) * time;
        changes[place] = by_u * u + by_a * a + by_b * b;
        jerks[place] = changes[place] * speeds[place];
    }
    [accelerations, changes, jerks]
}

/// Whether v^2 is above 0 and within its caps at start, middle and end, and between them. `bend`: u times the square
/// of half the length.
#[inline(always)]
fn keeps_caps(
    [b0, b1, b2]: [f64; 3],
    bend: f64,
    interval: &IntervalSamples,
    raise_squared: f64,
) -> bool {
    let caps = interval
        .places()
        .map(|sample| sample.cap.raised(raise_squared));
    let [cap0, cap1, cap2] = caps;
    let quarters = interval.quarters.map(|cap| cap.raised(raise_squared));
    let capped = b0 > 0.0 && b1 > 0.0 && b2 > 0.0 && b0 <= cap0 && b1 <= cap1 && b2 <= cap2;
    capped && keeps_caps_between([b0, b1, b2], bend, caps, quarters)
}

/// Whether v^2 keeps its caps between start, middle and end: in the middle of both halves, where they are known, and
/// half of the way to there, where they are no less than the mean of those beside. `bend`: u times the square
/// of half the length.
fn keeps_caps_between(
    [start, middle, end]: [f64; 3],
    bend: f64,
    [cap_start, cap_middle, cap_end]: [f64; 3],
    quarters: [f64; 2],
) -> bool {
    // Half of the way between two places v^2 exceeds their mean by this.
    let bulge = -0.25 * bend;
    let [first, last] = [start + middle, middle + end].map(|sum| 0.5 * sum + bulge);
    let kept = first <= quarters[0] && last <= quarters[1];
    let twice_bulge = 0.5 * bulge;
    let between =
        |at: f64, next: f64, cap: f64, next_cap: f64| at + next + twice_bulge <= cap + next_cap;
    kept && between(start, first, cap_start, quarters[0])
        && between(first, middle, quarters[0], cap_middle)
        && between(middle, last, cap_middle, quarters[1])
        && between(last, end, quarters[1], cap_end)
}

/// Whether a parabola through these values at start, middle and end bends back between them so much that
/// it does not describe the jerk, which is no parabola.
#[inline(always)]
fn is_bent([start, middle, end]: [f32; 3]) -> bool {
    let slope = 0.5 * (end - start);
    let bend = start + end - 2.0 * middle;
    (bend.abs() > JERK_BEND) & (slope.abs() < bend.abs())
}

/// Whether four axes keep this share of the jerk in the middle of both halves: their rows by u, a and b, at start,
/// middle and end, are parabolas.
#[inline(never)]
fn keeps_jerk_between(parabola: &Parabola, rows: [[&Quad; 3]; 3], most: f32) -> bool {
    let mut kept = true;
    for (share, weights) in [(0.25, [0.375, 0.75, -0.125]), (0.75, [-0.125, 0.75, 0.375])] {
        let (b, a) = parabola.at(share * parabola.length);
        let factors = [parabola.u, a, b].map(|factor| (factor * b.sqrt()) as f32);
        for lane in 0..QUAD_LANES {
            let mut jerk = 0.0;
            for (row, factor) in rows.iter().zip(factors) {
                for (place, weight) in row.iter().zip(weights) {
                    jerk += place[lane] * (weight * factor);
                }
            }
            kept &= jerk.abs() <= most;
        }
    }
    kept
}

/// The greatest amount at three places in each half of what has these values at start, middle and end:
/// of the cubic with its slopes there (Hermite), given as changes over a half.
#[inline(always)]
fn halves([start, middle, end]: [f32; 3], [slope0, slope1, slope2]: [f32; 3]) -> f32 {
    let first = half([start, middle], [slope0, slope1]);
    let second = half([middle, end], [slope1, slope2]);
    greater(first, second)
}

/// The same of one half.
#[inline(always)]
fn half([start, end]: [f32; 2], [slope0, slope1]: [f32; 2]) -> f32 {
    let quarter = 0.84375 * start + 0.15625 * end + (0.140625 * slope0 - 0.046875 * slope1);
    let middle = 0.5 * (start + end) + 0.125 * (slope0 - slope1);
    let last = 0.15625 * start + 0.84375 * end + (0.046875 * slope0 - 0.140625 * slope1);
    greater(greater(quarter.abs(), middle.abs()), last.abs())
}

/// Whether the amounts of three values at start, middle and end are at most `most`, and those of the
/// parabola through them exceed it by `between` at most. Not if one is no number.
#[inline(always)]
fn is_within([start, middle, end]: [f32; 3], most: f32, between: f32) -> bool {
    let at_places = (start.abs() <= most) & (middle.abs() <= most) & (end.abs() <= most);
    let slope = 0.5 * (end - start);
    let bend = start + end - 2.0 * middle;
    let extremum = (middle - 0.5 * slope * slope / bend).abs();
    let outside = slope.abs() >= bend.abs();
    at_places & (outside | (extremum <= most + between))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_bent_where_it_turns_between_its_ends() {
        // 1 - x^2 from -1 to 1 turns in the middle; the same from 0 to 2 only falls.
        assert!(is_bent([0.0, 1.0, 0.0]));
        assert!(!is_bent([1.0, 0.0, -3.0]));
        // And from -.4 to 1.6 it rises a little first.
        assert!(is_bent([0.84, 0.64, -1.56]));
        // Turns, but so little that no jerk hides in it.
        assert!(!is_bent([0.0, 0.1, 0.0]));
        // What is the same at all places does not turn, however large it is.
        assert!(!is_bent([-5.0, -5.0, -5.0]));
    }

    #[test]
    fn what_a_parabola_reaches_between_its_places_counts() {
        assert!(is_within([0.5, -1.0, 0.5], 1.0, 0.0));
        for too_much in [[1.1, 0.0, 0.0], [0.0, -1.1, 0.0], [0.0, 0.0, 1.1]] {
            assert!(!is_within(too_much, 1.0, 0.0));
        }
        // Greatest, .968, shortly behind the start, where no place is.
        let hump = [0.96, 0.56, -0.9];
        assert!(!is_within(hump, 0.96, 0.0));
        assert!(is_within(hump, 0.96, 0.1));
        // Straight lines have no extremum.
        assert!(is_within([-1.0, 0.0, 1.0], 1.0, 0.0));
        assert!(!is_within([f32::NAN, 0.0, 0.0], 1.0, 1.0));
    }
}
