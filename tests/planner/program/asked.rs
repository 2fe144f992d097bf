//! What a run is asked to keep. That it ends, at the end point of the program, is always asked.

use framepath::cycle::JERK_KEPT;
use proptest::prelude::*;

use crate::common::Extremes;

/// What a run is asked to keep; `None` asks nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Asked {
    /// The most over the limits of the axes.
    pub velocity: Option<f64>,
    pub acceleration: Option<f64>,
    pub jerk: Option<f64>,
    /// The most over F: asked only of X Y Z, without an operator.
    pub feed: Option<f64>,
    /// Whether the path is to be within tolerance of the program, both ways.
    pub path: bool,
    pub rests: RestsAsked,
    /// Servo periods to the end, from the last event on.
    pub periods: Option<usize>,
    /// Whether all programs of a file are to take as many servo periods.
    pub same_periods: bool,
}

/// Rests on the way to the end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum RestsAsked {
    #[default]
    Any,
    /// Only those that the program or the supply of moves explains.
    Explained,
    None,
}

/// Servo periods after which a run that has not ended never will.
const NEVER: usize = 1_000_000;

impl Asked {
    /// That limits are kept as closely as differences of positions show it.
    pub const LIMITS: Self = Self {
        velocity: Some(1.001),
        acceleration: Some(1.001),
        jerk: Some(JERK_KEPT),
        feed: None,
        path: false,
        rests: RestsAsked::Any,
        periods: None,
        same_periods: false,
    };

    /// The most servo periods, from the last event on.
    pub fn most_periods(&self) -> usize {
        self.periods.unwrap_or(NEVER)
    }

    /// Whether the limits were kept.
    ///
    /// # Errors
    /// What was exceeded.
    pub fn of_limits(&self, extremes: &Extremes) -> Result<(), TestCaseError> {
        for (asked, over) in [
            (self.velocity, extremes.velocity),
            (self.acceleration, extremes.acceleration),
            (self.jerk, extremes.jerk),
        ] {
            prop_assert!(asked.is_none_or(|most| over <= most), "{extremes:?}");
        }
        Ok(())
    }
}
