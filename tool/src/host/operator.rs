//! What the operator does while a program runs: overrides, the velocity slider, pauses, an abort.

use crate::arguments::not_negative;
use serde::{Deserialize, Serialize};

/// One action.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Action {
    /// Of moves at feed, not of rapids; 1 = 100 %.
    FeedOverride(f64),
    /// Pause for so many seconds.
    Pause(f64),
    /// Greatest velocity, mm/s.
    MaxVelocity(f64),
    Abort,
}

/// An action at its time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Event {
    /// Seconds from the start.
    pub time: f64,
    pub action: Action,
}

/// Reads `T:VALUE`.
pub(crate) fn at_time(text: &str) -> Result<(f64, f64), String> {
    let (time, value) = text
        .split_once(':')
        .ok_or_else(|| format!("`{text}`: TIME:VALUE is needed"))?;
    Ok((not_negative(time)?, not_negative(value)?))
}

/// Holds at random moments of the first `time` seconds, each for `duration` seconds, the same every
/// time.
#[cfg(feature = "optimum")]
pub(crate) fn random_holds(count: usize, time: f64, duration: f64) -> Vec<Event> {
    let mut random = crate::generated::random::Random::new(1);
    let mut moments: Vec<f64> = (0..count).map(|_| random.between(0.0, time)).collect();
    moments.sort_unstable_by(f64::total_cmp);
    let hold = |(before, moment): (usize, f64)| Event {
        time: moment + before as f64 * duration,
        action: Action::Pause(duration),
    };
    moments.into_iter().enumerate().map(hold).collect()
}

/// A restless operator: an action every 0.02 to 1.5 s, for ten minutes, the same for the same seed.
/// There is no abort among them, so that programs come to their end.
pub(crate) fn random_events(seed: u64) -> Vec<Event> {
    const DURATION: f64 = 600.0;
    let mut random = crate::generated::random::Random::new(seed);
    let mut events = Vec::new();
    let mut time = 0.0;
    while time < DURATION {
        time += random.between(0.02, 1.5);
        let action = match random.below(10) {
            0..=5 => Action::FeedOverride(random.between(0.05, 2.0)),
            6 => Action::FeedOverride(1.0),
            7 => Action::Pause(random.between(0.01, 0.8)),
            _ => Action::MaxVelocity(random.between(5.0, 200.0)),
        };
        events.push(Event { time, action });
    }
    events
}
