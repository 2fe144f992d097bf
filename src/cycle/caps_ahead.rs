//! The caps that lie ahead of a machine that brakes.

use super::cap::{Caps, FORESIGHT};
use super::state::State;
use super::table::Table;

/// Greatest count of periods of braking that are looked through.
pub const BRAKING_PERIODS: usize = 160;

/// What is let pass, of the cap.
const TOLERANCE: f64 = 1e-4;

/// The same of the programmed feed where the cap is 0: the machine comes to rest there, not before.
const HELD_PART: f64 = 1e-3;

/// A rate up to this is as good as none.
const STANDSTILL: f64 = 1e-3;

/// Of the cells that are known, what has to lie ahead of a state for what is seen there to be trusted,
/// where the table is too short for all of [`FORESIGHT`].
const TRUSTED_SHARE: f64 = 0.5;

/// What the caps say of a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CapOutlook {
    /// It is above its cap.
    Exceeded,
    /// From here on all that is known may be run through at a rate that does not rise any more.
    Kept,
    /// It is below its cap; of what follows nothing can be said yet.
    Open,
}

/// Looks at the states of a machine that brakes, one after the other.
pub struct CapsAhead<'a> {
    caps: &'a Caps,
    table: &'a Table,
    /// Seconds.
    servo_period: f64,
    /// Greatest ratio to its cap of a reference that is as fast as programmed, in all that is known.
    as_programmed: f64,
    /// Of the state before.
    feed: f64,
}

impl<'a> CapsAhead<'a> {
    /// From `time` on; `servo_period` in seconds.
    pub fn new(caps: &'a Caps, table: &'a Table, time: f64, servo_period: f64) -> Self {
        Self {
            caps,
            table,
            servo_period,
            as_programmed: caps.ratio_at_programmed(table, time),
            feed: f64::NEG_INFINITY,
        }
    }

    /// The rate at which all that is known keeps its caps, however fast it is within what is programmed.
    pub fn steady_rate(&self) -> f64 {
        1.0 / self.as_programmed.max(1.0)
    }

    /// What the caps say of the next state.
    pub fn look(&mut self, state: State) -> CapOutlook {
        let feed = feed(self.table, state);
        if feed > self.most(state) {
            return CapOutlook::Exceeded;
        }
        let falls = feed <= self.feed;
        self.feed = feed;
        let keeps = |ratio: f64| state.rate * ratio <= 1.0 + TOLERANCE;
        let kept = state.rate <= STANDSTILL && 2.0 * state.rate + state.rate_acceleration >= 0.0
            || self.table.is_behind_end(state.time)
            || state.rate_acceleration <= 0.0 && keeps(self.as_programmed)
            || falls && self.sees_far(state.time) && {
                let (table, period) = (self.table, self.servo_period);
                keeps(self.caps.greatest_ratio(table, state.time, period))
            };
        if kept {
            CapOutlook::Kept
        } else {
            CapOutlook::Open
        }
    }

    /// Greatest feed that is let pass. What begins within a cell may not be exceeded in any of it.
    fn most(&self, state: State) -> f64 {
        let index = state.time as usize;
        let (cell, next) = (
            self.table.cell(index),
            self.table.cell(index.saturating_add(1)),
        );
        if self.caps.is_hold(cell) {
            return HELD_PART * f64::from(cell.programmed_feed);
        }
        let most = self.caps.feed(cell);
        // A machine comes to rest in a cell that nothing may move in, not before.
        let begins = next.programmed_feed > 0.0 && !self.caps.is_hold(next);
        (1.0 + TOLERANCE)
            * if begins {
                most.min(self.caps.feed(next))
            } else {
                most
            }
    }

    /// Whether enough is known behind `time`.
    fn sees_far(&self, time: f64) -> bool {
        let known = self.table.length() as f64;
        let enough = (FORESIGHT / self.servo_period).min(TRUSTED_SHARE * known);
        self.table.end().is_some() || known - time >= enough
    }
}

/// The feed of a state, units per servo period.
fn feed(table: &Table, state: State) -> f64 {
    let cell = state.time as usize;
    let (here, next) = (table.cell(cell), table.cell(cell.saturating_add(1)));
    let part = (state.time - cell as f64).clamp(0.0, 1.0);
    state.rate * (here.feed() + part * (next.feed() - here.feed()))
}
