//! What the machine is able to do: velocity and acceleration of each axis, and the jerk to compare with.

use crate::arguments;
use framepath::axes::{AXIS_COUNT, AXIS_LETTERS};
use serde::{Deserialize, Serialize};

/// The axes that turn: A B C.
pub(crate) fn is_rotary(axis: usize) -> bool {
    (3..6).contains(&axis)
}

/// Limits of each axis, in mm (degrees) and seconds, in the order x y z a b c u v w.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Limits {
    pub velocity: [f64; AXIS_COUNT],
    pub acceleration: [f64; AXIS_COUNT],
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            velocity: [100.0; AXIS_COUNT],
            acceleration: [1000.0; AXIS_COUNT],
        }
    }
}

impl Limits {
    /// Applies `V=100,A=1000` (all axes) or `XY:V=50`; several are separated by `;`.
    pub(crate) fn apply(&mut self, text: &str) -> Result<(), String> {
        for part in text.split(';') {
            let (letters, values) = part.split_once(':').unwrap_or(("XYZABCUVW", part));
            for value in values.split(',') {
                let (kind, number) = value
                    .split_once('=')
                    .ok_or_else(|| format!("`{value}`: V= or A= and a number is needed"))?;
                let number = positive(number)?;
                for letter in letters.trim().chars() {
                    let axis = AXIS_LETTERS
                        .iter()
                        .position(|known| known.eq_ignore_ascii_case(&letter))
                        .ok_or_else(|| format!("`{letter}` is none of the axes XYZABCUVW"))?;
                    match kind.trim() {
                        "V" | "v" => self.velocity[axis] = number,
                        "A" | "a" => self.acceleration[axis] = number,
                        _ => return Err(format!("`{kind}` is neither V nor A; jerk is --jerk")),
                    }
                }
            }
        }
        Ok(())
    }
}

/// A jerk limit to run a planner with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Jerk {
    Unlimited,
    /// Units per second cubed, the same for all axes.
    Value(f64),
    /// Times the acceleration of each axis, per second.
    Accelerations(f64),
}

impl Jerk {
    /// Reads `unlimited` (or 0), a number, or a number of accelerations: `20A`.
    pub(crate) fn parse(text: &str) -> Result<Jerk, String> {
        let text = text.trim();
        if matches!(text, "unlimited" | "0") {
            return Ok(Jerk::Unlimited);
        }
        match text.strip_suffix(['A', 'a']) {
            Some(number) => Ok(Jerk::Accelerations(positive(number)?)),
            None => Ok(Jerk::Value(positive(text)?)),
        }
    }

    /// The limit of each axis, 0 where it is not limited.
    pub(crate) fn of_axes(self, limits: &Limits) -> [f64; AXIS_COUNT] {
        match self {
            Jerk::Unlimited => [0.0; AXIS_COUNT],
            Jerk::Value(jerk) => [jerk; AXIS_COUNT],
            Jerk::Accelerations(times) => limits.acceleration.map(|a| a * times),
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

fn positive(text: &str) -> Result<f64, String> {
    arguments::positive(text.trim()).map_err(|problem| format!("`{text}`: {problem}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_axes_differ() {
        let mut limits = Limits::default();
        limits.apply("A=500;zc:V=20,A=300").expect("valid");
        assert_eq!(limits.velocity[..3], [100.0, 100.0, 20.0]);
        assert_eq!(
            limits.acceleration[..6],
            [500.0, 500.0, 300.0, 500.0, 500.0, 300.0]
        );
    }

    #[test]
    fn says_what_is_wrong() {
        let refused = |text| Limits::default().apply(text).expect_err("refused");
        assert!(refused("J=5").contains("--jerk"));
        assert!(refused("Q:V=1").contains('Q'));
        assert!(refused("V=-1").contains("-1"));
        assert!(refused("V").contains('V'));
    }

    #[test]
    fn jerk_in_accelerations() {
        let jerk = Jerk::parse("20A").expect("valid");
        assert_eq!(jerk.of_axes(&Limits::default())[0], 20_000.0);
        assert_eq!(Jerk::parse("0"), Ok(Jerk::Unlimited));
        assert!(Jerk::parse("fast").is_err());
    }
}
