//! A limit of jerk as an option gives it.

use crate::arguments;
use serde::Serialize;
use std::str::FromStr;

/// A jerk limit to run a planner with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Jerk {
    /// None.
    Unlimited,
    /// Units per second cubed, the same for all axes.
    Value(f64),
    /// Times the acceleration of each axis, per second.
    Accelerations(f64),
}

/// Reads `unlimited` (or 0), a number, or a number of accelerations: `20A`.
impl FromStr for Jerk {
    type Err = String;

    fn from_str(text: &str) -> Result<Jerk, String> {
        let text = text.trim();
        if matches!(text, "unlimited" | "0") {
            return Ok(Jerk::Unlimited);
        }
        match text.strip_suffix(['A', 'a']) {
            Some(number) => Ok(Jerk::Accelerations(rate(number)?)),
            None => Ok(Jerk::Value(rate(text)?)),
        }
    }
}

impl Jerk {
    /// The limit of an axis with this acceleration, 0 where it is not limited.
    pub(crate) fn of_axis(self, acceleration: f64) -> f64 {
        match self {
            Jerk::Unlimited => 0.0,
            Jerk::Value(jerk) => jerk,
            Jerk::Accelerations(times) => acceleration * times,
        }
    }
}

impl std::fmt::Display for Jerk {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Jerk::Unlimited => write!(f, "unlimited"),
            Jerk::Value(jerk) => write!(f, "{jerk}"),
            Jerk::Accelerations(times) => write!(f, "{times}A"),
        }
    }
}

/// A rate, with the text in the words of the refusal.
pub(super) fn rate(text: &str) -> Result<f64, String> {
    arguments::rate(text.trim()).map_err(|problem| format!("`{text}`: {problem}"))
}
