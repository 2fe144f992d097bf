//! The operator's slider for the greatest velocity.

/// What no move may exceed along its path.
#[derive(Clone, Copy, Debug)]
pub(super) struct VelocitySlider {
    /// Machine units per second; 0 holds the machine.
    limit: f64,
    /// The greatest limit there has been: the range of the slider.
    range: f64,
}

impl VelocitySlider {
    pub const UNLIMITED: Self = Self {
        limit: f64::INFINITY,
        range: 0.0,
    };

    /// Machine units per second; what is negative or not a number counts as 0.
    pub fn set(&mut self, velocity: f64) {
        self.limit = velocity.max(0.0);
        self.range = self.range.max(velocity);
    }

    /// Machine units per second; 0 holds the machine.
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// The same as a share, 0 to 1, of the slider's range: as far as the axes are able to follow it, `reach` machine units
    /// per second. Without [TRAJ]MAX_LINEAR_VELOCITY LinuxCNC says 1e9 or more, of which no setting would leave anything.
    pub fn share(&self, reach: f64) -> f64 {
        if self.limit > 0.0 {
            (self.limit / self.range.min(reach)).min(1.0)
        } else {
            0.0
        }
    }
}
