//! The operator's slider for the greatest velocity.

/// What no move may exceed along its path.
#[derive(Clone, Copy, Debug)]
pub(super) struct VelocitySlider {
    /// Machine units per second; 0 holds the machine.
    limit: f64,
    /// The greatest finite limit there has been: the range of the slider.
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
        if velocity.is_finite() {
            self.range = self.range.max(velocity);
        }
    }

    /// Machine units per second; 0 holds the machine.
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// The same as a share of the slider's range, 0 to 1.
    pub fn share(&self) -> f64 {
        if self.limit < self.range {
            self.limit / self.range
        } else {
            1.0
        }
    }
}
