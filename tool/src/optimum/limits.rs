//! What the axes are able to do.

/// Number of axes: X Y Z A B C U V W.
pub(crate) const AXES: usize = 9;

/// Limits of each axis, mm or degrees and seconds; all positive, infinite where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AxisLimits {
    pub velocity: [f64; AXES],
    pub acceleration: [f64; AXES],
    pub jerk: [f64; AXES],
}

impl AxisLimits {
    /// Whether the jerk of an axis is limited.
    pub(crate) fn limit_jerk(&self) -> bool {
        self.jerk.iter().any(|jerk| jerk.is_finite())
    }
}

/// How fast the program lets a place of the path be run: the speed that these axes together may
/// have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SpeedCap {
    /// First of the three axes that the feed counts.
    pub first_axis: usize,
    /// mm/s or degrees per second; infinite where the program does not say.
    pub speed: f64,
}

impl SpeedCap {
    /// Where the program leaves it to the axes.
    pub(crate) const NONE: SpeedCap = SpeedCap {
        first_axis: 0,
        speed: f64::INFINITY,
    };

    /// The greatest ds/dt, with `first` = dq/ds.
    pub(crate) fn along(&self, first: &[f64; AXES]) -> f64 {
        let counted = first.iter().skip(self.first_axis).take(3);
        let slope = counted.map(|part| part * part).sum::<f64>().sqrt();
        if slope > 0.0 {
            self.speed / slope
        } else {
            f64::INFINITY
        }
    }
}
