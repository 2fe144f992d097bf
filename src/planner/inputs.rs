//! What the planner has to know anew in each servo period.

/// Live values of one servo period. All factors are 0 and above, 1 for 100 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CycleInputs {
    /// The operator's feed override.
    pub feed_scale: f64,
    /// The operator's rapid override.
    pub rapid_scale: f64,
    /// The motion controller's product of everything that scales the running move: feed or rapid
    /// override, adaptive feed, and 0 for feed hold or inhibit. LinuxCNC computes it from the
    /// motion type and the enables that were reported in the last cycle.
    pub net_feed_scale: f64,
    /// Whether the motion controller runs a single move and will pause when the id changes.
    pub stepping: bool,
    /// Whether all spindles are at speed.
    pub spindles_at_speed: bool,
}

impl Default for CycleInputs {
    /// Everything at 100 %, nothing to wait for.
    fn default() -> Self {
        Self {
            feed_scale: 1.0,
            rapid_scale: 1.0,
            net_feed_scale: 1.0,
            stepping: false,
            spindles_at_speed: true,
        }
    }
}
