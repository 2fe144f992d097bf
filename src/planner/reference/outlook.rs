//! What a reference has to know while it is extended.

use crate::axes::AxisLimits;
use crate::machine_map::MachineMap;
use crate::moves::{Move, MoveQueue, SPINDLE_COUNT, Synchronisation};

/// Where the operator's slider stands near 0 moves are planned for this share of their feed; the
/// executor holds what is slower.
const LEAST_PLANNED_SHARE: f64 = 0.01;

/// What a reference has to know while it is extended.
#[derive(Clone, Copy, Debug)]
pub struct Outlook<'a> {
    /// The moves there are.
    pub queue: &'a MoveQueue,
    /// What the axes of the machine may do.
    pub limits: &'a AxisLimits,
    /// How the axes of the program lie to those of the machine, and to its joints where these have limits.
    pub map: &'a MachineMap,
    /// What holds in this servo period.
    pub now: Conditions,
}

/// What holds in a servo period.
#[derive(Clone, Copy, Debug)]
pub struct Conditions {
    /// Duration of a cell, seconds.
    pub period: f64,
    /// The feed override in effect, 0 and above.
    pub feed_scale: f64,
    /// The rapid override in effect, 0 and above.
    pub rapid_scale: f64,
    /// How fast each spindle turns, turns a second.
    pub spindle_speeds: [f64; SPINDLE_COUNT],
    /// What no move may exceed along its path, machine units per second: the operator's slider.
    pub velocity_limit: f64,
    /// The same as a share of the slider's whole range, for moves measured in degrees.
    pub velocity_share: f64,
    /// What no tolerance of a move may exceed, for the sake of rotary axes; machine units.
    pub greatest_tolerance: f64,
    /// Whether the machine is to come to rest at the next place where the program asks for a rest.
    pub stepping: bool,
    /// Whether other limits or tolerances are to be taken at the next rest.
    pub settings_changed: bool,
    /// Whether the machine stands still because it is held, or waits for a spindle: it uses up no path.
    pub held: bool,
}

impl Outlook<'_> {
    /// What the axes, or the joints where these have limits, are able to do now, where jerk that a period cannot use up is
    /// none.
    pub(super) fn limits_behind(&self) -> AxisLimits {
        let limits = self.map.limits(self.limits);
        AxisLimits {
            jerk: limits.jerk_of_use(self.now.period),
            ..*limits
        }
    }

    /// What the velocity along a move from rest to rest may not exceed, with the overrides of this
    /// moment.
    ///
    /// Overrides below 100 % are not planned for: the executor slows the reference down.
    pub(super) fn velocity_cap(&self, queued: &Move) -> f64 {
        if let Some(with) = queued.synchronisation {
            // In a thread no override and no slider changes what may be needed.
            let planned = queued.feed.min(queued.max_velocity);
            if with.follows_angle() {
                return planned;
            }
            // What the spindle asks for is a matter of the executor, as long as that is planned for.
            let wanted = match self.asked_by_spindle(queued) {
                Some(asked) if asked > planned => {
                    (Synchronisation::RESERVE * asked).min(queued.max_velocity)
                }
                _ => planned,
            };
            return wanted.min(self.now.velocity_limit.max(wanted * LEAST_PLANNED_SHARE));
        }
        let scale = queued.override_of(self.now.feed_scale, self.now.rapid_scale);
        let wanted = (queued.feed * scale.max(1.0)).min(queued.max_velocity);
        let slider = if queued.shape.is_rotary() {
            queued.max_velocity * self.now.velocity_share
        } else {
            self.now.velocity_limit
        };
        wanted.min(slider.max(wanted * LEAST_PLANNED_SHARE))
    }

    /// How many times as fast as planned the spindle asks the running move to be: above 1 where it has become faster than
    /// was expected when the move was queued. 0 where none asks.
    pub(super) fn asked_over_planned(&self) -> f64 {
        self.queue.front().map_or(0.0, |running| {
            let asked = self.asked_by_spindle(running).unwrap_or(0.0);
            asked / running.feed.min(running.max_velocity)
        })
    }

    /// What the spindle asks of a move with feed per turn at this moment, machine units per second, no more than its greatest
    /// velocity.
    fn asked_by_spindle(&self, queued: &Move) -> Option<f64> {
        let with = queued
            .synchronisation
            .filter(|with| !with.follows_angle())?;
        let scale = if queued.override_enabled() {
            self.now.feed_scale
        } else {
            1.0
        };
        let asked = with.per_turn * scale * self.now.spindle_speeds.get(with.spindle)?;
        // `min` answers with the other one if one is not a number.
        (!asked.is_nan()).then(|| asked.min(queued.max_velocity))
    }
}
