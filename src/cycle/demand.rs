//! What the executor is asked for in a servo period, and what it answers.

use super::follow::Follow;

/// What the operator and the motion controller ask for in one servo period.
///
/// Any values are safe, in any order from one period to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// Come to rest on the path and stay there: feed hold, pause, abort.
    pub hold: bool,
    /// Factor of the programmed feed, 0 and above; NaN and negative values count as 0. Above 1 it
    /// permits what the reference already does: making the reference faster is the planner's work.
    pub feed_override: f64,
    /// The same for rapid moves.
    pub rapid_override: f64,
    /// Turns of the spindle a second, 0 and above: what feed per turn counts with; infinite for no
    /// cap, NaN and negative values count as 0.
    pub turns: f64,
    /// Greatest path speed, units per second, whatever the override; infinite for none, NaN and
    /// negative values count as 0. It holds for moves without override, too.
    pub max_velocity: f64,
    /// Where to be along the path instead of all overrides and caps: in a thread. A hold comes
    /// first.
    pub follow: Option<Follow>,
}

impl Demand {
    /// Run the reference as it is.
    pub const RUN: Self = Self {
        hold: false,
        feed_override: 1.0,
        rapid_override: 1.0,
        turns: f64::INFINITY,
        max_velocity: f64::INFINITY,
        follow: None,
    };

    /// Come to rest.
    pub const HOLD: Self = Self {
        hold: true,
        ..Self::RUN
    };
}

/// What the executor did in one servo period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExecutorStep {
    /// How far the reference time advanced, seconds, from 0 to one servo period. Exactly one
    /// servo period at a rate of 1.
    pub advance: f64,
    /// Rate after the step, dtau/dt, 0 to 1.
    pub rate: f64,
    /// Its derivative by time after the step, 1 per second.
    pub rate_acceleration: f64,
    /// Whether the machine stands still after the step: rate and rate acceleration are 0, or the end is
    /// reached.
    pub at_rest: bool,
    /// Whether the end of the closed reference is reached. It stays reached until
    /// [`Executor::reset`](super::Executor::reset).
    pub end_reached: bool,
    /// Whether the executor wanted to see more cells than there are. It did something safe
    /// instead, but reacts better with more.
    pub wall: bool,
    /// Whether there was no cell left to run on and the reference was not closed: the caller did
    /// not keep to [`Executor::cells_wanted`](super::Executor::cells_wanted). The motion was cut
    /// off at the last known point, beyond all limits. Always an error of the caller.
    pub starved: bool,
}
