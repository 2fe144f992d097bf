//! Whether an interval keeps the limits of the axes.

use wide::f32x4;

use super::interval::Parabola;
use super::interval_samples::IntervalSamples;
use super::rows::{AxisRows, THIRD};
use super::sample::MovingAxes;
use crate::lanes::{QUADS, greater, quad};

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
        // At each place by its own speed, as the barrier has it: an interval that is refused for what the barrier does not know
        // of stays where it is.
        let for_jerks: [f32; 3] = core::array::from_fn(|place| {
            margin - interval.departure.third * places[place].0 * speeds[place]
        });
        let for_jerk_between =
            JERK_BETWEEN + margin - interval.departure.third * fastest * fastest.sqrt();
        let moving = MovingAxes::at_any(samples);
        for number in (0..QUADS).filter(|number| moving.in_quad(*number)) {
            let times = f32x4::new(*quad(&self.jerk_time_lanes, number));
            let rows = [0, 1, 2]
                .map(|order| samples.map(|sample| f32x4::new(*quad(&sample.lanes[order], number))));
            let [accelerations, changes, jerks] = taken(&rows, times, &places, &speeds, u);
            let over_half = times * half;
            if !keeps_acceleration(accelerations, changes, over_half, for_acceleration) {
                return false;
            }
            match keeps_jerk(jerks, for_jerks, for_jerk_between) {
                JerkVerdict::Exceeded => return false,
                JerkVerdict::Bent if !keeps_jerk_between(parabola, rows, for_jerk_between) => {
                    return false;
                }
                JerkVerdict::Bent | JerkVerdict::Kept => {}
            }
        }
        true
    }
}

/// What four axes take at start, middle and end: of the acceleration; the jerk over the velocity, which is by
/// how much the acceleration changes with s; of the jerk.
#[inline(always)]
fn taken(
    [first, second, third]: &[[f32x4; 3]; 3],
    times: f32x4,
    places: &[(f32, f32); 3],
    speeds: &[f32; 3],
    u: f32,
) -> [[f32x4; 3]; 3] {
    let [mut accelerations, mut changes, mut jerks] = [[f32x4::ZERO; 3]; 3];
    for place in 0..3 {
        let (by_u, by_a, by_b) = (first[place], second[place], third[place]);
        let (b, a) = places[place];
        accelerations[place] = (by_u * a + by_a * (THIRD * b)) * times;
        changes[place] = by_u * u + by_a * a + by_b * b;
        jerks[place] = changes[place] * speeds[place];
    }
    [accelerations, changes, jerks]
}

/// Whether four axes keep this share of their acceleration at start, middle and end, and hardly exceed it between them,
/// where it changes over a half by `over_half` times these changes.
#[inline(always)]
fn keeps_acceleration(
    accelerations: [f32x4; 3],
    changes: [f32x4; 3],
    over_half: f32x4,
    most: f32,
) -> bool {
    let amounts = accelerations.map(f32x4::abs);
    if !are_within(amounts, [most; 3]) {
        return false;
    }
    // Neither a parabola through three places nor a cubic with these slopes exceeds them by more than this.
    let peak = greatest_of(amounts);
    let steepest = greatest_of(changes.map(f32x4::abs)) * over_half;
    let excess = peak.fast_max(steepest) * 0.25;
    if (peak + excess).simd_le(f32x4::splat(most)).all() {
        return true;
    }
    let most_between = f32x4::splat(most + ACCELERATION_BETWEEN);
    let Turn { slope, bend } = Turn::of(accelerations);
    let by_parabolas = slope.abs().simd_ge(bend.abs())
        | extremum(accelerations, slope, bend).simd_le(most_between);
    let slopes = changes.map(|change| change * over_half);
    let by_slopes = halves(accelerations, slopes).simd_le(most_between);
    (by_parabolas & by_slopes).all()
}

/// What is known of four jerks from three places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum JerkVerdict {
    /// More than is allowed.
    Exceeded,
    Kept,
    /// Kept, as far as three places tell.
    Bent,
}

/// Whether four axes keep these shares of their jerk at start, middle and end, and parabolas through these `most_between` them.
#[inline(always)]
fn keeps_jerk(jerks: [f32x4; 3], most: [f32; 3], most_between: f32) -> JerkVerdict {
    if !are_within(jerks.map(f32x4::abs), most) {
        return JerkVerdict::Exceeded;
    }
    let Turn { slope, bend } = Turn::of(jerks);
    let turns = slope.abs().simd_lt(bend.abs());
    // A turn exceeds the middle by half of the bend at most.
    if !(turns & bend.abs().simd_gt(f32x4::splat(JERK_BETWEEN))).any() {
        return JerkVerdict::Kept;
    }
    let within = extremum(jerks, slope, bend).simd_le(f32x4::splat(most_between));
    if (turns & !within).any() {
        JerkVerdict::Exceeded
    } else if (turns & bend.abs().simd_gt(f32x4::splat(JERK_BEND))).any() {
        JerkVerdict::Bent
    } else {
        JerkVerdict::Kept
    }
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

/// Whether four axes keep this share of the jerk in the middle of both halves: their rows by u, a and b, at start,
/// middle and end, are parabolas.
#[inline(never)]
fn keeps_jerk_between(parabola: &Parabola, rows: [[f32x4; 3]; 3], most: f32) -> bool {
    let mut kept = true;
    for (share, weights) in [(0.25, [0.375, 0.75, -0.125]), (0.75, [-0.125, 0.75, 0.375])] {
        let (b, a) = parabola.at(share * parabola.length);
        let factors = [parabola.u, a, b].map(|factor| (factor * b.sqrt()) as f32);
        let mut jerks = f32x4::ZERO;
        for (row, factor) in rows.iter().zip(factors) {
            for (place, weight) in row.iter().zip(weights) {
                jerks += *place * (weight * factor);
            }
        }
        kept &= jerks.abs().simd_le(f32x4::splat(most)).all();
    }
    kept
}

/// Whether amounts at start, middle and end are at most `most` there. Not if one is no number.
#[inline(always)]
fn are_within([start, middle, end]: [f32x4; 3], most: [f32; 3]) -> bool {
    let [at_start, at_middle, at_end] = most.map(f32x4::splat);
    (start.simd_le(at_start) & middle.simd_le(at_middle) & end.simd_le(at_end)).all()
}

#[inline(always)]
fn greatest_of([start, middle, end]: [f32x4; 3]) -> f32x4 {
    start.fast_max(middle).fast_max(end)
}

/// How parabolas through values at start, middle and end change from the middle on, over half of the way: they turn between the
/// ends where they bend by more than their slope.
struct Turn {
    slope: f32x4,
    bend: f32x4,
}

impl Turn {
    #[inline(always)]
    fn of([start, middle, end]: [f32x4; 3]) -> Self {
        Self {
            slope: (end - start) * 0.5,
            bend: start + end - middle * 2.0,
        }
    }
}

/// The amounts of parabolas where they turn.
#[inline(always)]
fn extremum([_, middle, _]: [f32x4; 3], slope: f32x4, bend: f32x4) -> f32x4 {
    (middle - slope * 0.5 * slope / bend).abs()
}

/// The greatest amount at three places in each half of what has these values at start, middle and end:
/// of the cubic with its slopes there (Hermite), given as changes over a half.
#[inline(always)]
fn halves([start, middle, end]: [f32x4; 3], [slope0, slope1, slope2]: [f32x4; 3]) -> f32x4 {
    let first = half([start, middle], [slope0, slope1]);
    let second = half([middle, end], [slope1, slope2]);
    first.fast_max(second)
}

/// The same of one half.
#[inline(always)]
fn half([start, end]: [f32x4; 2], [slope0, slope1]: [f32x4; 2]) -> f32x4 {
    let quarter = start * 0.84375 + end * 0.15625 + (slope0 * 0.140625 - slope1 * 0.046875);
    let middle = (start + end) * 0.5 + (slope0 - slope1) * 0.125;
    let last = start * 0.15625 + end * 0.84375 + (slope0 * 0.046875 - slope1 * 0.140625);
    greatest_of([quarter, middle, last].map(f32x4::abs))
}

#[cfg(test)]
mod tests {
    use super::super::departure::Departure;
    use super::super::test_route::TestRoute;
    use super::*;
    use crate::axes::{Axes, AxisLimits};
    use crate::machine_map::MachineMap;
    use crate::moves::shape::PathPoint;

    /// The verdict where one axis has these jerks, and the others none.
    fn verdict([start, middle, end]: [f32; 3], most: f32) -> JerkVerdict {
        keeps_jerk(
            [start, middle, end].map(|jerk| f32x4::new([0.0, 0.0, jerk, 0.0])),
            [most; 3],
            most + JERK_BETWEEN,
        )
    }

    #[test]
    fn a_parabola_is_bent_where_it_turns_between_its_ends() {
        for (jerks, expected) in [
            // 1 - x^2 from -1 to 1 turns in the middle; the same from 0 to 2 only falls.
            ([0.0, 1.0, 0.0], JerkVerdict::Bent),
            ([1.0, 0.0, -3.0], JerkVerdict::Kept),
            // And from -.4 to 1.6 it rises a little first.
            ([0.84, 0.64, -1.56], JerkVerdict::Bent),
            // Turns, but so little that no jerk hides in it.
            ([0.0, 0.1, 0.0], JerkVerdict::Kept),
            // What is the same at all places does not turn, however large it is.
            ([-5.0, -5.0, -5.0], JerkVerdict::Kept),
        ] {
            assert_eq!(verdict(jerks, 5.0), expected, "{jerks:?}");
        }
    }

    #[test]
    fn what_a_parabola_reaches_between_its_places_counts() {
        assert_eq!(verdict([0.5, -1.0, 0.5], 1.0), JerkVerdict::Bent);
        for too_much in [[1.1, 0.0, 0.0], [0.0, -1.1, 0.0], [0.0, 0.0, 1.1]] {
            assert_eq!(verdict(too_much, 1.0), JerkVerdict::Exceeded);
        }
        // Greatest, .968, shortly behind the start, where no place is.
        let hump = [0.96, 0.56, -0.9];
        assert_ne!(verdict(hump, 0.96), JerkVerdict::Exceeded);
        // And 1.093 here.
        let high = [0.96, 0.96, -0.1];
        assert_eq!(verdict(high, 0.96), JerkVerdict::Exceeded);
        // Straight lines have no extremum.
        assert_eq!(verdict([-1.0, 0.0, 1.0], 1.0), JerkVerdict::Kept);
        assert_eq!(verdict([f32::NAN, 0.0, 0.0], 1.0), JerkVerdict::Exceeded);
    }

    /// Whether an interval in which the speed doubles is kept with these shares of the jerk at its places, and a departure that
    /// takes .05, .2 and .4 of it there.
    fn keeps_beside_departure(shares: [f64; 3]) -> bool {
        let limits = AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(20_000.0),
        };
        let rows = AxisRows::new(&limits, &MachineMap::IDENTITY, 1e-3);
        let parabola = Parabola {
            b: 100.0,
            a: 150.0,
            u: 0.0,
            length: 1.0,
        };
        let along_x = |x: f64| Axes::from([x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let sample = |place: f64, share: f64| {
            let (b, _) = parabola.at(place);
            let route = TestRoute {
                point: |_| PathPoint {
                    position: Axes::zeros(),
                    first: along_x(1.0),
                    second: Axes::zeros(),
                    third: along_x(share * 20_000.0 / (b * b.sqrt())),
                },
                breakpoints: Vec::new(),
                vertices: Vec::new(),
            };
            rows.sample(&route, place, 0.0)
        };
        let [start, middle, end] = shares;
        let (start, end) = (sample(0.0, start), sample(1.0, end));
        let interval = IntervalSamples {
            start,
            middle: sample(0.5, middle),
            end,
            departure: Departure {
                second: 0.0,
                third: 5e-5,
            },
            quarters: [start.cap, end.cap],
        };
        rows.keeps(&parabola, &interval, 1.0, 1.0)
    }

    #[test]
    fn a_departure_takes_what_the_speed_of_each_place_asks_for() {
        assert!(keeps_beside_departure([0.9, 0.7, 0.5]));
        for too_much in [[0.96, 0.7, 0.5], [0.9, 0.81, 0.5], [0.7, 0.7, 0.61]] {
            assert!(!keeps_beside_departure(too_much), "{too_much:?}");
        }
    }

    #[test]
    fn accelerations_hold_between_their_places_too() {
        let keeps = |accelerations: [f32; 3], slopes: [f32; 3], most: f32| {
            let of_one = |value: f32| f32x4::new([0.0, value, 0.0, 0.0]);
            keeps_acceleration(
                accelerations.map(of_one),
                slopes.map(of_one),
                f32x4::ONE,
                most,
            )
        };
        assert!(keeps([0.5, 0.6, 0.5], [0.1, 0.0, -0.1], 1.0));
        for too_much in [
            [1.1, 0.0, 0.0],
            [0.0, -1.1, 0.0],
            [0.0, 0.0, 1.1],
            [f32::NAN; 3],
        ] {
            assert!(!keeps(too_much, [0.0; 3], 1.0));
        }
        // The parabola through these is .968 shortly behind the start.
        let hump = [0.96, 0.56, -0.9];
        assert!(!keeps(hump, [0.0, -0.9, -1.5], 0.96));
        assert!(keeps(hump, [0.0, -0.9, -1.5], 0.968));
        // Between two places that are the same the slopes alone tell of more.
        assert!(keeps([0.9; 3], [0.0; 3], 0.96));
        assert!(!keeps([0.9; 3], [0.3, -0.3, 0.3], 0.96));
    }
}
