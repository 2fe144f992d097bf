//! The feed cap: what overrides and the greatest velocity leave of the programmed feed.
//!
//! A cap that the reference exceeds is approached softly, as a jerk-limited S-curve would, so
//! that the machine arrives at the cap with no acceleration left. Where caps lie ahead, the backup trajectory brakes
//! in time for all of them, see [`super::caps_ahead`]. What cannot be seen is taken for too fast: where the
//! reference is slow the rate may rise to 1, and where the reference then gathers speed at its limits, turning the
//! rate takes longer than any horizon.

use std::borrow::Borrow;

use super::demand::Demand;
use super::feed_block::FeedBlock;
use super::rate_derivative_interval::RateDerivativeInterval;
use super::rows::PeriodLimits;
use super::state::State;
use super::stored_cell::{OverrideKind, StoredCell};
use super::table::{Table, USABLE};

/// How far ahead caps are looked for, seconds.
pub const FORESIGHT: f64 = 0.2;

/// How long a rate acceleration is assumed to go on, seconds.
const RATE_ACCELERATION_FORESIGHT: f64 = 0.12;

/// Part of the path's jerk that a soft approach uses; the rest is for what lies ahead.
const APPROACH_PART: f64 = 0.85;

/// Least part of the least jerk limit for the approach, where the reference leaves almost none.
const LEAST_APPROACH_PART: f64 = 0.1;

/// Stands for no cap on feed per turn, turns a second.
const MOST_TURNS: f64 = 1e12;

/// Path speeds below this part of the cap are free.
const FREE_PART: f64 = 1e-3;

/// The overrides and the greatest velocity of a servo period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Caps {
    feed_override: f64,
    rapid_override: f64,
    /// Turns of the spindle a second.
    turns: f64,
    /// Units per servo period.
    max_velocity: f64,
}

impl Caps {
    pub const NONE: Self = Self {
        feed_override: 1.0,
        rapid_override: 1.0,
        turns: MOST_TURNS,
        max_velocity: f64::INFINITY,
    };

    /// `period` in seconds. Whatever is not a number, or negative, counts as 0.
    pub fn new(demand: &Demand, period: f64) -> Self {
        // `max` answers with the other one if one is NaN.
        Self {
            feed_override: demand.feed_override.max(0.0),
            rapid_override: demand.rapid_override.max(0.0),
            // Finite, since an override of 0 times infinity is not a number.
            turns: demand.turns.clamp(0.0, MOST_TURNS).max(0.0),
            max_velocity: demand.max_velocity.max(0.0) * period,
        }
    }

    fn scale(&self, kind: OverrideKind) -> f64 {
        match kind {
            OverrideKind::Feed => self.feed_override,
            OverrideKind::Rapid => self.rapid_override,
            OverrideKind::None => 1.0,
            OverrideKind::Turns => self.turns * self.feed_override,
            OverrideKind::TurnsOnly => self.turns,
        }
    }

    /// Whether nothing may move in this cell.
    pub fn is_hold(&self, cell: &StoredCell) -> bool {
        self.scale(cell.override_kind) <= 0.0 || self.max_velocity <= 0.0
    }

    /// Greatest feed in a cell, units per servo period.
    pub fn feed(&self, cell: &StoredCell) -> f64 {
        (self.scale(cell.override_kind) * f64::from(cell.programmed_feed)).min(self.max_velocity)
    }

    /// The same in several cells. Behind the end of the reference nothing is asked for: a cap of 0 there
    /// would keep the machine from ever coming to the end.
    fn feed_in(&self, cells: &[&StoredCell]) -> f64 {
        cells
            .iter()
            .filter(|cell| cell.programmed_feed > 0.0)
            .map(|cell| self.feed(cell))
            .fold(f64::INFINITY, f64::min)
    }

    /// Greatest ratio of the reference's feed to its cap from `time` on, as far as anything ahead
    /// matters now. Above 1 the reference has to be slowed down somewhere.
    pub fn greatest_ratio(&self, table: &Table, time: f64, period: f64) -> f64 {
        let cells = (FORESIGHT / period) as usize;
        self.ratio_in(table.blocks(time, cells))
    }

    /// The same as far as cells are known, and if the reference were as fast as programmed everywhere.
    pub fn ratio_at_programmed(&self, table: &Table, time: f64) -> f64 {
        let as_programmed = table.blocks(time, USABLE).map(FeedBlock::as_programmed);
        self.ratio_in(as_programmed)
    }

    fn ratio_in(&self, blocks: impl Iterator<Item = impl Borrow<FeedBlock>>) -> f64 {
        let velocity = 1.0 / self.max_velocity.max(1e-12);
        let feed = 1.0 / self.feed_override.max(1e-9);
        let rapid = 1.0 / self.rapid_override.max(1e-9);
        let fixed_turns = 1.0 / self.turns.max(1e-9);
        let turns = feed * fixed_turns;
        blocks.fold(0.0, |ratio: f64, block| {
            let block = block.borrow();
            ratio
                .max(f64::from(block.feed) * velocity)
                .max(f64::from(block.feed_over_programmed) * feed)
                .max(f64::from(block.rapid_over_programmed) * rapid)
                .max(f64::from(block.fixed_over_programmed))
                .max(f64::from(block.turns_over_programmed) * turns)
                .max(f64::from(block.fixed_turns_over_programmed) * fixed_turns)
        })
    }

    /// Whether a reference with these programmed feeds may have to be slowed down.
    pub fn may_bind(&self, greatest_programmed_feed: f64) -> bool {
        self.feed_override < 1.0
            || self.rapid_override < 1.0
            || self.turns < MOST_TURNS
            || self.max_velocity < greatest_programmed_feed
    }

    /// The rate jerk that approaches the cap softly: the acceleration along the path from which the cap
    /// is just reached with what is left of the path's jerk. `jerk_interval` is what the jerk
    /// limits allow. `None` where the reference is so slow that any rate is right.
    pub fn approach(
        &self,
        table: &Table,
        limits: &PeriodLimits,
        state: State,
        jerk_interval: &RateDerivativeInterval,
    ) -> Option<f64> {
        let index = state.time as usize;
        let part = (state.time - index as f64).clamp(0.0, 1.0);
        let (here, next) = (table.cell(index), table.cell(index + 1));
        let between = |a: f32, b: f32| f64::from(a) + part * (f64::from(b) - f64::from(a));
        let path_velocity = between(here.path_velocity, next.path_velocity);
        let own_acceleration = between(here.path_acceleration, next.path_acceleration);
        let own_jerk = f64::from(next.path_acceleration) - f64::from(here.path_acceleration);

        let feed_ratio = f64::from(here.feed_ratio.max(next.feed_ratio)).max(1e-3);
        let cap = self.feed_in(&[here, next]) / feed_ratio;
        if path_velocity < FREE_PART * cap || path_velocity < 1e-12 {
            return None;
        }

        // In a rounded corner the feed changes with its ratio to the path velocity too: without it the
        // machine lags behind a cap of the path velocity that falls towards the end of the corner.
        let growth = if next.programmed_feed > 0.0 {
            f64::from(next.feed_ratio - here.feed_ratio) / feed_ratio
        } else {
            0.0
        };
        let path_acceleration = own_acceleration + path_velocity * growth;
        let path_jerk = own_jerk + 2.0 * own_acceleration * growth;

        let (rate, change) = (state.rate, state.rate_acceleration);
        let velocity = rate * path_velocity;
        let acceleration = change * path_velocity + rate * rate * path_acceleration;
        let jerk_without_rate_jerk =
            rate * rate * rate * path_jerk + 3.0 * rate * change * path_acceleration;
        // What is missing to the cap in the middle of the period.
        let missing = cap - velocity - 0.5 * acceleration;
        // The approach ends by braking the acceleration: with jerk of the other sign.
        let available = if missing > 0.0 {
            -(jerk_without_rate_jerk + jerk_interval.low * path_velocity)
        } else {
            jerk_without_rate_jerk + jerk_interval.high * path_velocity
        };
        let jerk = (APPROACH_PART * available)
            .max(LEAST_APPROACH_PART * limits.least_jerk().min(1.0))
            .clamp(1e-15, 1e15);
        let half = 0.5 * jerk;
        let distance = 2.0 * jerk * missing.abs();
        // sqrt(half^2 + distance) - half, without the cancellation.
        let mut wanted = distance / (half + (half * half + distance).sqrt());
        if here.override_kind.follows_spindle() {
            // What a period's jerk ends takes the whole next period to end: up to twice as much as is missing would lead beyond
            // the cap and back, again and again where that moves in every period, until only hard braking is left.
            wanted = wanted.min(missing.abs());
        }
        let wanted = wanted.copysign(missing);
        Some((wanted - acceleration - jerk_without_rate_jerk) / path_velocity)
    }

    /// The rate at which the reference, a period later, is as fast as its cap: where jerk is not limited, a cap
    /// is reached with full acceleration.
    pub fn rate(&self, table: &Table, state: State) -> f64 {
        let here = table.cell(state.time as usize);
        let time = state.time + state.rate;
        let (from, to) = (
            table.cell(time as usize),
            table.cell((time as usize).saturating_add(1)),
        );
        let feed_ratio = f64::from(from.feed_ratio.max(to.feed_ratio)).max(1e-3);
        let cap = self.feed_in(&[here, from, to]) / feed_ratio;
        cap / table.along(time).velocity.max(1e-12)
    }

    /// Whether caps ahead have to be looked at: at this rate, or the one it is about to reach, the
    /// reference exceeds one somewhere ahead by `ratio`.
    pub fn lie_ahead(state: State, ratio: f64, period: f64) -> bool {
        let rising = state.rate_acceleration.max(0.0) * RATE_ACCELERATION_FORESIGHT / period;
        (state.rate + rising).min(1.0) * ratio > 1.0
    }
}
