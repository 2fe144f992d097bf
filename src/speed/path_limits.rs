//! Limits along a path.

/// Greatest velocity, acceleration and jerk along a shape, all of them possible at the same time
/// without any axis exceeding its limits. Positive; acceleration and jerk may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathLimits {
    /// ds/dt, units of the shape's measure per second.
    pub velocity: f64,
    /// d2s/dt2.
    pub acceleration: f64,
    /// d3s/dt3.
    pub jerk: f64,
}
