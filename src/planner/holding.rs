//! What holds the machine.

use super::inputs::CycleInputs;
use super::planner::Planner;
use crate::moves::Move;

impl Planner {
    /// The operator's slider for the running move.
    pub(super) fn slider_for(&self, running: Option<&Move>) -> f64 {
        match running {
            Some(running) if running.shape.is_rotary() => {
                running.max_velocity * self.slider.share(self.axes.reach())
            }
            _ => self.slider.limit(),
        }
    }

    /// Whether pause, abort, feed hold, a slider at 0 or a single step that is to be planned first hold the machine, unless
    /// it is in a thread.
    pub(super) fn is_held(&self, inputs: &CycleInputs) -> bool {
        let held = inputs.net_feed_scale.is_nan() || inputs.net_feed_scale <= 0.0;
        let slider = self.slider_for(self.queue.front());
        let stopped = self.status.pausing || self.status.aborting;
        stopped || held || slider <= 0.0 || self.awaits_step(inputs)
    }
}
