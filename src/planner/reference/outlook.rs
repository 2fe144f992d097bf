//! What a reference has to know while it is extended.

use crate::axes::AxisLimits;
use crate::machine_map::MachineMap;
use crate::moves::{Move, MoveQueue};

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
            // What the spindle asks for is a matter of the executor; no override, and in a thread
            // no slider, changes what it may need.
            let planned = queued.feed.min(queued.max_velocity);
            return if with.follows_angle() {
                planned
            } else {
                planned.min(self.now.velocity_limit.max(planned * LEAST_PLANNED_SHARE))
            };
        }
        let scale = if !queued.override_enabled() {
            1.0
        } else if queued.motion_type.is_rapid() {
            self.now.rapid_scale.max(1.0)
        } else {
            self.now.feed_scale.max(1.0)
        };
        let wanted = (queued.feed * scale).min(queued.max_velocity);
        let slider = if queued.shape.is_rotary() {
            queued.max_velocity * self.now.velocity_share
        } else {
            self.now.velocity_limit
        };
        wanted.min(slider.max(wanted * LEAST_PLANNED_SHARE))
    }
}
