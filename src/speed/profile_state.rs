//! Where a profile is.

/// State at an instant of a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileState {
    /// Distance from the start of the profile.
    pub distance: f64,
    /// Its derivative, 0 and above.
    pub velocity: f64,
    /// Its second derivative.
    pub acceleration: f64,
    /// Its third derivative, 0 where the acceleration jumps.
    pub jerk: f64,
}
