//! Which rate jerks the limits of the axes allow over the next servo period.
//!
//! For every axis the limits of acceleration and jerk are linear in the rate jerk:
//! `|offset + rate_jerk * slope| <= width`, a row. Each row allows an interval of it; the executor picks
//! from what all rows have in common. The rows look at both ends of the period, linearised around
//! a predicted rate jerk; what was picked is then checked once more, in the middle of the period too.

use super::jerk::{INSTANT_TOLERANCE, Jerk, MEAN_TOLERANCE};
use super::rate_derivative_interval::{RATE_JERK_LIMIT, RateDerivativeInterval};
use super::state::State;
use super::table::{Node, Table};
use crate::axes::AxisLimits;
use crate::lanes::{
    LANE_COUNT, Lanes, ROUNDING, ZEROS, greater, greatest, least, lesser, scaled_limits,
};

/// Part of the acceleration limit that is used. The reference itself may use all of it.
const ACCELERATION_PART: f32 = 0.9985;

/// Rows of acceleration stay below the check by this factor, so that the check does not refuse
/// what the rows have put on the limit.
const ACCELERATION_ROW_PART: f32 = 0.9995;

/// Slope, units per period, below which an axis does not move and its rows mean nothing.
const LEAST_SLOPE: f32 = 1e-12;

/// Limits of the axes in units of the servo period.
#[derive(Clone, Debug)]
pub struct PeriodLimits {
    acceleration: Lanes,
    jerk: Lanes,
    least_jerk: f64,
}

impl PeriodLimits {
    pub const UNLIMITED: Self = Self {
        acceleration: [crate::lanes::UNLIMITED; LANE_COUNT],
        jerk: [crate::lanes::UNLIMITED; LANE_COUNT],
        least_jerk: f64::INFINITY,
    };

    /// `period` in seconds. A limit of jerk that one period cannot use up is none.
    pub fn new(limits: &AxisLimits, period: f64) -> Self {
        let mut acceleration = scaled_limits(&limits.acceleration, period * period);
        for lane in &mut acceleration {
            *lane *= ACCELERATION_PART;
        }
        let third = period * period * period;
        let jerk = limits.jerk_of_use(period);
        Self {
            acceleration,
            jerk: scaled_limits(&jerk, third),
            least_jerk: jerk.min() * third,
        }
    }

    /// The same with a part of the jerk limits.
    pub fn with_jerk_part(&self, part: f32) -> Self {
        let mut limits = self.clone();
        for lane in &mut limits.jerk {
            *lane *= part;
        }
        limits
    }

    /// Whether any axis has a limit of jerk.
    pub fn limit_jerk(&self) -> bool {
        self.least_jerk.is_finite()
    }

    /// The least jerk limit of all axes, units per period cubed; may be infinite.
    pub fn least_jerk(&self) -> f64 {
        self.least_jerk
    }
}

/// What one servo period sees of the reference: its ends, and bounds over the cells it touches.
pub struct Span {
    start: Node,
    end: Node,
    acceleration: DerivativeBounds,
    jerk: Jerk,
}

/// Bounds of a derivative, as centre and half width, and the limit that holds.
struct DerivativeBounds {
    centre: Lanes,
    half: Lanes,
    limit: Lanes,
}

impl DerivativeBounds {
    /// Bounds over two cells.
    #[inline(always)]
    fn new(min: [&Lanes; 2], max: [&Lanes; 2], limit: &Lanes) -> Self {
        let mut bounds = Self {
            centre: ZEROS,
            half: ZEROS,
            limit: ZEROS,
        };
        for lane in 0..LANE_COUNT {
            let low = lesser(min[0][lane], min[1][lane]);
            let high = greater(max[0][lane], max[1][lane]);
            bounds.centre[lane] = 0.5 * (high + low);
            bounds.half[lane] = 0.5 * (high - low);
            bounds.limit[lane] = limit[lane];
        }
        bounds
    }

    /// The limit where the derivative counts `power` times: raised to what the reference needs by
    /// itself, so that a constant rate is always allowed, even after the limits have been lowered.
    /// No more than that: bounds may be wider than what lies inside.
    #[inline(always)]
    fn limit_at(&self, lane: usize, power: f32) -> f32 {
        let needed = power * (self.centre[lane].abs() + self.half[lane]);
        ROUNDING * greater(self.limit[lane], needed)
    }
}

impl Span {
    /// The period from `start` to about `end`.
    #[inline(always)]
    pub fn new(table: &Table, limits: &PeriodLimits, start: &Node, end: &Node) -> Self {
        let (a, b) = (table.cell(start.cell), table.cell(end.cell));
        let (behind_a, behind_b) = (table.cell(start.cell + 1), table.cell(end.cell + 1));
        Self {
            start: *start,
            end: *end,
            acceleration: DerivativeBounds::new(
                [&a.acceleration_min, &b.acceleration_min],
                [&a.acceleration_max, &b.acceleration_max],
                &limits.acceleration,
            ),
            jerk: Jerk::new([a, behind_a], [b, behind_b], &limits.jerk),
        }
    }

    /// The rate jerks that keep the jerk of all axes within its limits, in the mean over the period and at
    /// both ends of it, given the state at its start and the predicted state at its end.
    #[inline(always)]
    pub fn jerk_interval(&self, start: State, end: State) -> RateDerivativeInterval {
        let mut rows = Rows::within(RATE_JERK_LIMIT);
        let [square, cube, coupling, change] = powers(start);
        let end_rate = greater(end.rate as f32, 0.0);
        let (end_square, end_change) = (end_rate * end_rate, end.rate_acceleration as f32);
        let end_cube = end_square * end_rate;
        let end_coupling = 3.0 * end_rate * change;
        let predicted = end_change - change;
        for lane in 0..LANE_COUNT {
            let (v0, v1) = (self.start.velocity[lane], self.end.velocity[lane]);
            let (a0, a1) = (self.start.acceleration[lane], self.end.acceleration[lane]);
            let [own_start, _, own_end] = self.jerk.own(lane);
            // The rate jerk changes both the rate acceleration and the rate at the end of the period.
            let difference = end_square * a1 + end_change * v1 - square * a0 - change * v0;
            let slope = v1 + end_rate * a1;
            rows.narrow(
                lane,
                difference - predicted * slope,
                slope,
                self.jerk.mean_limit(lane, cube, square * (a1 - a0)),
            );
            let own = cube * own_start;
            rows.narrow(
                lane,
                own + coupling * a0,
                v0,
                self.jerk.instant_limit(lane, own),
            );
            // It also changes the coupling there.
            let own = end_cube * own_end;
            rows.narrow(
                lane,
                own + end_coupling * a1,
                v1 + 3.0 * end_rate * a1,
                self.jerk.instant_limit(lane, own),
            );
        }
        rows.interval()
    }

    /// The rate jerks that keep the acceleration of all axes within its limits at the end of the period.
    #[inline(always)]
    pub fn acceleration_interval(&self, start: State, end: State) -> RateDerivativeInterval {
        let mut rows = Rows::within(RATE_JERK_LIMIT);
        let end_rate = greater(end.rate as f32, 0.0);
        let square = end_rate * end_rate;
        let rate_acceleration = start.rate_acceleration as f32;
        for lane in 0..LANE_COUNT {
            let velocity = self.end.velocity[lane];
            rows.narrow(
                lane,
                square * self.acceleration.centre[lane] + rate_acceleration * velocity,
                velocity,
                ACCELERATION_ROW_PART * self.acceleration.limit_at(lane, square)
                    - square * self.acceleration.half[lane]
                    - rate_acceleration.abs() * self.slack(lane),
            );
        }
        rows.interval()
    }

    /// The rate accelerations that keep the acceleration of all axes within its limits at both ends of the period, if
    /// they are constant over it; `rate` is the one at its start, `predicted` the rate acceleration that is expected.
    pub fn rate_acceleration_interval(&self, rate: f64, predicted: f64) -> RateDerivativeInterval {
        let mut rows = Rows::within(1.0);
        let (rate, predicted) = (greater(rate as f32, 0.0), predicted as f32);
        let end_rate = greater(rate + predicted, 0.0);
        // The square of the rate at the end, (rate + m)^2 with the rate acceleration m, linearised around the
        // predicted one: how it changes with m.
        let ends = [
            (&self.start, rate * rate, 0.0),
            (&self.end, end_rate * end_rate, 2.0 * end_rate),
        ];
        for (node, square, change) in ends {
            for lane in 0..LANE_COUNT {
                let centre = self.acceleration.centre[lane];
                rows.narrow(
                    lane,
                    (square - change * predicted) * centre,
                    node.velocity[lane] + change * centre,
                    ACCELERATION_ROW_PART * self.acceleration.limit_at(lane, square)
                        - square * self.acceleration.half[lane]
                        - predicted.abs() * self.slack(lane),
                );
            }
        }
        rows.interval()
    }

    /// How far the first derivative may be from its linear interpolation, since the second one jumps
    /// inside the cell (without a limit of jerk): an eighth of the jump.
    #[inline(always)]
    fn slack(&self, lane: usize) -> f32 {
        let explained = 2.0 * self.jerk.greatest(lane);
        0.125 * greater(2.0 * self.acceleration.half[lane] - explained, 0.0)
    }

    /// Whether the period from `start` to `end` with this rate jerk keeps the limits: acceleration at
    /// both ends and in the middle, jerk in the mean, in the middle and at the end (the rows hold it
    /// at the start).
    #[inline(always)]
    pub fn keeps_limits(&self, start: State, end: State, rate_jerk: f64) -> bool {
        let middle = start.half_step(rate_jerk);
        let mut excess = ZEROS;
        let rate_jerk = rate_jerk as f32;
        let [square_start, cube_start, _, change_start] = powers(start);
        let [square_middle, cube_middle, coupling_middle, change_middle] = powers(middle);
        let [square_end, cube_end, coupling_end, change_end] = powers(end);
        for (lane, excess) in excess.iter_mut().enumerate() {
            let (v0, v2) = (self.start.velocity[lane], self.end.velocity[lane]);
            let v1 = 0.5 * (v0 + v2);
            let (a0, a2) = (self.start.acceleration[lane], self.end.acceleration[lane]);
            let a1 = 0.5 * (a0 + a2);

            let over = |square: f32, further: f32| {
                let bounds = &self.acceleration;
                (square * bounds.centre[lane] + further).abs() + square * bounds.half[lane]
                    - bounds.limit_at(lane, square)
            };
            let change = greater(change_start.abs(), change_end.abs());
            let acceleration = change * self.slack(lane)
                + greater(
                    over(square_start, change_start * v0),
                    greater(
                        over(square_middle, change_middle * v1),
                        over(square_end, change_end * v2),
                    ),
                );

            let needed = square_start * (a2 - a0);
            let mean = square_end * a2 + change_end * v2 - square_start * a0 - change_start * v0;
            let mean_limit = self.jerk.mean_limit(lane, cube_start, needed);
            let over = |own: f32, further: f32| {
                let limit = self.jerk.instant_limit(lane, own);
                (own + further).abs() - INSTANT_TOLERANCE * limit
            };
            let [_, own_middle, own_end] = self.jerk.own(lane);
            let jerk = greater(
                mean.abs() - MEAN_TOLERANCE * mean_limit,
                greater(
                    over(
                        cube_middle * own_middle,
                        coupling_middle * a1 + rate_jerk * v1,
                    ),
                    over(cube_end * own_end, coupling_end * a2 + rate_jerk * v2),
                ),
            );
            *excess = greater(acceleration, jerk);
        }
        greatest(&excess) <= 0.0
    }
}

/// By what the derivatives of the reference count, with the rate l and its acceleration m: l^2, l^3, 3 l m and m.
#[inline(always)]
fn powers(state: State) -> [f32; 4] {
    let rate = state.rate as f32;
    let change = state.rate_acceleration as f32;
    let square = rate * rate;
    [square, square * rate, 3.0 * rate * change, change]
}

/// The interval that the rows leave, for each axis by itself.
struct Rows {
    low: Lanes,
    high: Lanes,
}

impl Rows {
    #[inline(always)]
    fn within(most: f64) -> Self {
        Self {
            low: [-most as f32; LANE_COUNT],
            high: [most as f32; LANE_COUNT],
        }
    }

    /// `|offset + x * slope| <= width`, for the x of the interval.
    #[inline(always)]
    fn narrow(&mut self, lane: usize, offset: f32, slope: f32, width: f32) {
        let scale = 1.0 / (slope.abs() + LEAST_SLOPE);
        let middle = -offset * 1.0_f32.copysign(slope);
        self.low[lane] = greater(self.low[lane], (middle - width) * scale);
        self.high[lane] = lesser(self.high[lane], (middle + width) * scale);
    }

    #[inline(always)]
    fn interval(&self) -> RateDerivativeInterval {
        RateDerivativeInterval {
            low: f64::from(greatest(&self.low)),
            high: f64::from(least(&self.high)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::cell::Cell;
    use super::super::jerk::allowance;
    use super::*;
    use crate::axes::Axes;
    use proptest::prelude::*;

    fn axes(values: std::ops::Range<f64>) -> impl Strategy<Value = Axes> {
        prop::array::uniform9(values).prop_map(Axes::from)
    }

    /// Cells of a constant acceleration, with bounds of the jerk around 0.
    fn table(velocity: Axes, acceleration: Axes, jerk: Axes) -> Box<Table> {
        let mut table = Box::new(Table::new());
        table.clear();
        for i in 0..6 {
            let cell = Cell {
                velocity: velocity + acceleration * f64::from(i),
                acceleration,
                acceleration_min: acceleration,
                acceleration_max: acceleration,
                jerk_min: -jerk,
                jerk_max: jerk,
                path_velocity: 1.0,
                path_acceleration: 0.0,
                feed_ratio: 1.0,
                programmed_feed: 1.0,
                feed_per_turn: None,
                rapid: false,
                override_enabled: true,
            };
            table.push(&cell, 1.0).unwrap();
        }
        table
    }

    proptest! {
        #[test]
        fn the_interval_is_what_the_limits_allow(
            velocity in axes(-10.0..10.0),
            acceleration in axes(-0.1..0.1),
            jerk in axes(0.0..0.01),
            rate in 0.0..1.0,
            rate_acceleration in -0.01..0.01,
        ) {
            let limits = AxisLimits {
                velocity: Axes::repeat(20.0),
                acceleration: Axes::repeat(0.2),
                jerk: Axes::repeat(0.02),
            };
            let limits = PeriodLimits::new(&limits, 1.0);
            let table = table(velocity, acceleration, jerk);
            let state = State { time: 0.3, rate, rate_acceleration };
            let predicted = state.step(0.0);
            let (start, end) = (table.node(state.time), table.node(predicted.time));
            let span = Span::new(&table, &limits, &start, &end);
            let interval = span.jerk_interval(state, predicted);
            // The mean jerk, which leaves room for jumps of the reference's own.
            let change = |rate_jerk: f64| {
                let at = |s: State| {
                    (velocity + acceleration * s.time) * s.rate_acceleration + acceleration * s.rate.powi(2)
                };
                let room = jerk.map(|jerk| f64::from(allowance(2.0 * jerk as f32, 0.02)));
                ((at(state.step(rate_jerk)) - at(state)).abs() + room * rate.powi(3)).amax()
            };
            let at_start = |rate_jerk: f64| {
                let now = velocity + acceleration * state.time;
                (acceleration * (3.0 * rate * rate_acceleration) + now * rate_jerk).amax()
            };
            if !interval.is_empty() {
                for rate_jerk in [interval.low, interval.high] {
                    prop_assert!(change(rate_jerk) <= 0.02 * 1.001, "{}", change(rate_jerk));
                    prop_assert!(at_start(rate_jerk) <= 0.02 * 1.2001, "{}", at_start(rate_jerk));
                }
            }
            // A constant rate is always allowed.
            let steady = State { rate_acceleration: 0.0, ..state };
            let next = steady.step(0.0);
            let end = table.node(next.time);
            let span = Span::new(&table, &limits, &start, &end);
            prop_assert!(span.jerk_interval(steady, next).contains(0.0));
            prop_assert!(span.acceleration_interval(steady, next).contains(0.0));
            prop_assert!(span.keeps_limits(steady, next, 0.0));
            // And nothing that the check lets pass is far beyond a limit.
            for rate_jerk in [-0.2, -0.01, 0.003, 0.04] {
                let next = steady.step(rate_jerk);
                if span.keeps_limits(steady, next, rate_jerk) {
                    let at_end = (velocity + acceleration * next.time) * rate_jerk;
                    prop_assert!(at_end.amax() <= 0.0203, "{}", at_end.amax());
                }
            }
        }
    }

    #[test]
    fn axes_without_limits_do_not_count() {
        let unlimited = AxisLimits {
            velocity: Axes::repeat(f64::INFINITY),
            acceleration: Axes::repeat(f64::INFINITY),
            jerk: Axes::repeat(f64::INFINITY),
        };
        let limits = PeriodLimits::new(&unlimited, 1e-3);
        assert_eq!(limits.least_jerk(), f64::INFINITY);
        let infinite = Axes::repeat(f64::INFINITY);
        let table = table(Axes::repeat(5.0), Axes::repeat(0.1), infinite);
        let state = State {
            time: 0.0,
            rate: 0.5,
            rate_acceleration: 0.1,
        };
        let end = state.step(0.0);
        let (a, b) = (table.node(state.time), table.node(end.time));
        let span = Span::new(&table, &limits, &a, &b);
        let all = RateDerivativeInterval {
            low: -RATE_JERK_LIMIT,
            high: RATE_JERK_LIMIT,
        };
        assert_eq!(span.jerk_interval(state, end), all);
        assert_eq!(span.acceleration_interval(state, end), all);
        assert!(span.keeps_limits(state, end, 0.0));
    }
}
