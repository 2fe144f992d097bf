//! Sweeps over the coefficients: as fast as possible from the start, as fast as possible from the
//! end backward, and the lower of both.
//!
//! The integration of the limits forward and backward (Bobrow, Dubowsky and Gibson, Time-optimal
//! control of robotic manipulators along specified paths, IJRR 4(3), 1985) with a third order:
//! the slope of the coefficients is an acceleration, its change over an interval a jerk.

use super::bounds::PathBounds;
use super::interval::GREATEST_BEND;
use crate::lanes::{greater, lesser};

/// A sweep at one coefficient.
#[derive(Clone, Copy, Debug)]
pub(super) struct Front {
    /// The coefficient.
    pub value: f64,
    /// The slope it was reached with in the direction of the sweep; `None` on the cap, from where
    /// acceleration starts again at 0.
    pub slope: Option<f64>,
}

/// What a step has to know of the two intervals it connects.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<'a> {
    /// Where the sweep is.
    pub here: &'a PathBounds,
    /// Where it goes.
    pub next: &'a PathBounds,
    /// Length of the interval where it is.
    pub length: f64,
    /// Length of the interval where it goes.
    pub next_length: f64,
    /// The cap at the coefficient where it goes.
    pub cap: f64,
}

impl Front {
    pub const NONE: Self = Self {
        value: 0.0,
        slope: None,
    };

    /// The greatest coefficient in the next interval; `before` is the one in the interval before.
    pub fn step(&self, before: f64, stretch: &Stretch) -> Self {
        let Stretch {
            here,
            next,
            length,
            next_length,
            cap,
        } = *stretch;
        let distance = length + next_length;
        let c = self.value;
        let free = match self.slope {
            // From the cap on the acceleration grows within half of an interval at first.
            None => lesser(
                greatest_change(c, length),
                0.5 * length * bend(here, c, 0.0, length),
            ),
            Some(slope) => {
                let fastest = if slope < 0.0 { greater(c, before) } else { c };
                let change = length * bend(here, fastest, slope, length);
                slope + lesser(greatest_change(lesser(c, before), length), change)
            }
        };
        let along = lesser(
            here.acceleration(c, distance),
            next.acceleration(c, distance),
        );
        let mut slope = lesser(along, free);
        if slope > 0.0 {
            let across = lesser(here.across, next.across);
            let fastest = greater(c, lesser(lesser(here.cap, next.cap), c + distance * slope));
            if slope * slope * fastest > across {
                slope = (across / fastest).sqrt();
            }
        }
        let value = c + distance * slope;
        if value > cap {
            let slope = (cap - c) / distance;
            Self {
                value: cap,
                slope: (slope > 0.0).then_some(slope),
            }
        } else {
            Self {
                value,
                slope: Some(slope),
            }
        }
    }
}

/// The share of what an interval may bend by that a sweep takes.
const BEND_SHARE: f64 = 0.9;

/// The greatest change of slope over an interval of this length on which v^2 is at least `b`, so that
/// three points still describe it (`Parabola::is_degenerate`): v^2 at both ends adds up to twice that.
///
/// Where a slow cap is left and jerk is no matter at such a speed, the sweep would grow many times over
/// in one interval. That is a ratio: neither lower bounds nor a slower feed would cure it.
fn greatest_change(b: f64, length: f64) -> f64 {
    2.0 * BEND_SHARE * GREATEST_BEND * b / length
}

/// The greatest change u of slope with `u sqrt(b)` within the jerk wherever an interval of this length
/// takes b, from three rounds of a fixed point that stays below it.
fn bend(bounds: &PathBounds, b: f64, slope: f64, length: f64) -> f64 {
    if b <= 0.0 {
        return 0.0;
    }
    let mut u = bounds.bend(b);
    if slope < 0.0 {
        return u;
    }
    for _ in 0..3 {
        u = bounds.bend(greater(b, b + length * (slope + length * u)));
    }
    u
}
