//! A cell as the table keeps it.

use super::cell::Cell;
use crate::lanes::{Lanes, ZEROS, scaled, single};

/// A [`Cell`] in single precision, in units of the servo period.
#[derive(Clone, Copy, Debug)]
pub struct StoredCell {
    pub velocity: Lanes,
    pub acceleration: Lanes,
    pub acceleration_min: Lanes,
    pub acceleration_max: Lanes,
    pub jerk_min: Lanes,
    pub jerk_max: Lanes,
    pub path_velocity: f32,
    pub path_acceleration: f32,
    pub feed_ratio: f32,
    pub programmed_feed: f32,
    pub override_kind: OverrideKind,
    /// Of feed per turn the number of the spindle ..
    pub spindle: u8,
    /// .. and for how many turns a second it is planned, 0 where the feed is by time.
    pub planned_turns: f32,
}

/// Which override applies to a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OverrideKind {
    /// The feed override.
    Feed,
    /// The rapid override.
    Rapid,
    /// None: the programmed feed holds as it is.
    None,
    /// Feed per turn, with the feed override.
    Turns,
    /// Feed per turn, without it.
    TurnsOnly,
}

impl OverrideKind {
    /// Whether the feed is one per turn.
    pub fn follows_spindle(self) -> bool {
        matches!(self, Self::Turns | Self::TurnsOnly)
    }
}

impl StoredCell {
    pub const STANDSTILL: Self = Self {
        velocity: ZEROS,
        acceleration: ZEROS,
        acceleration_min: ZEROS,
        acceleration_max: ZEROS,
        jerk_min: ZEROS,
        jerk_max: ZEROS,
        path_velocity: 0.0,
        path_acceleration: 0.0,
        feed_ratio: 1.0,
        programmed_feed: 0.0,
        override_kind: OverrideKind::None,
        spindle: 0,
        planned_turns: 0.0,
    };

    pub fn new(cell: &Cell, period: f64) -> Self {
        let (second, third) = (period * period, period * period * period);
        let override_kind = match (
            cell.feed_per_turn.is_some(),
            cell.override_enabled,
            cell.rapid,
        ) {
            (true, false, _) => OverrideKind::TurnsOnly,
            (true, true, _) => OverrideKind::Turns,
            (false, false, _) => OverrideKind::None,
            (false, true, true) => OverrideKind::Rapid,
            (false, true, false) => OverrideKind::Feed,
        };
        Self {
            velocity: scaled(&cell.velocity, period),
            acceleration: scaled(&cell.acceleration, second),
            acceleration_min: scaled(&cell.acceleration_min, second),
            acceleration_max: scaled(&cell.acceleration_max, second),
            jerk_min: scaled(&cell.jerk_min, third),
            jerk_max: scaled(&cell.jerk_max, third),
            path_velocity: single(cell.path_velocity * period),
            path_acceleration: single(cell.path_acceleration * second),
            feed_ratio: single(cell.feed_ratio),
            programmed_feed: single(cell.programmed_feed * period),
            override_kind,
            spindle: cell.feed_per_turn.map_or(0, |with| with.spindle as u8),
            planned_turns: cell
                .feed_per_turn
                .map_or(0.0, |with| single(with.planned_turns)),
        }
    }

    /// The feed at the start of the cell, at a rate of 1.
    pub fn feed(&self) -> f64 {
        f64::from(self.path_velocity) * f64::from(self.feed_ratio)
    }

    /// Lets the reference stand still in a part of the cell.
    pub fn include_standstill(&mut self) {
        for bound in [&mut self.acceleration_min, &mut self.jerk_min] {
            for lane in bound.iter_mut() {
                *lane = lane.min(0.0);
            }
        }
        for bound in [&mut self.acceleration_max, &mut self.jerk_max] {
            for lane in bound.iter_mut() {
                *lane = lane.max(0.0);
            }
        }
    }
}
