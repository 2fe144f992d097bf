//! What the machine is able to do: velocity and acceleration of each axis, and the jerk to compare with.

#[cfg(feature = "linuxcnc")]
use super::configuration::Machine;
pub use super::jerk::Jerk;
use super::jerk::rate;
use framepath::axes::{AXIS_COUNT, AXIS_LETTERS};
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// The axes that turn: A B C.
pub(crate) fn is_rotary(axis: usize) -> bool {
    (3..6).contains(&axis)
}

/// A limit of 0 is none.
#[cfg(feature = "linuxcnc")]
pub(crate) fn infinite_for_none(limit: f64) -> f64 {
    if limit > 0.0 { limit } else { f64::INFINITY }
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
    /// Those of the axes of a machine.
    #[cfg(feature = "linuxcnc")]
    pub(crate) fn take_from(&mut self, machine: &Machine) {
        for member in &machine.axes {
            let Some(axis) = AXIS_LETTERS
                .iter()
                .position(|letter| *letter == member.letter)
            else {
                continue;
            };
            let unit = if is_rotary(axis) {
                1.0
            } else {
                machine.millimetres()
            };
            self.velocity[axis] = member.limits.velocity * unit;
            self.acceleration[axis] = member.limits.acceleration * unit;
        }
    }

    /// With the changes that an option asks for.
    pub(crate) fn apply(&mut self, changes: &LimitChanges) {
        for change in &changes.changes {
            let limits = match change.quantity {
                Quantity::Velocity => &mut self.velocity,
                Quantity::Acceleration => &mut self.acceleration,
            };
            limits[change.axis] = change.limit;
        }
    }
}

/// Limits of some axes, as an option gives them: `V=100,A=1000` (all axes) or `XY:V=50`; several are separated
/// by `;`.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitChanges {
    text: String,
    changes: Vec<LimitChange>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct LimitChange {
    axis: usize,
    quantity: Quantity,
    limit: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Quantity {
    Velocity,
    Acceleration,
}

impl FromStr for LimitChanges {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut changes = Vec::new();
        for part in text.split(';') {
            let (letters, values) = part.split_once(':').unwrap_or(("XYZABCUVW", part));
            for value in values.split(',') {
                let (kind, number) = value
                    .split_once('=')
                    .ok_or_else(|| format!("`{value}`: V= or A= and a number is needed"))?;
                let limit = rate(number)?;
                let quantity = match kind.trim() {
                    "V" | "v" => Quantity::Velocity,
                    "A" | "a" => Quantity::Acceleration,
                    _ => return Err(format!("`{kind}` is neither V nor A; jerk is --jerk")),
                };
                if letters.trim().is_empty() {
                    return Err(format!(
                        "`{part}` names no axis before the colon: write X:{value}, or {value} for all"
                    ));
                }
                for letter in letters.trim().chars() {
                    let axis = AXIS_LETTERS
                        .iter()
                        .position(|known| known.eq_ignore_ascii_case(&letter))
                        .ok_or_else(|| format!("`{letter}` is none of the axes XYZABCUVW"))?;
                    changes.push(LimitChange {
                        axis,
                        quantity,
                        limit,
                    });
                }
            }
        }
        Ok(LimitChanges {
            text: text.to_owned(),
            changes,
        })
    }
}

impl std::fmt::Display for LimitChanges {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

impl Jerk {
    /// The limit of each axis, 0 where it is not limited.
    pub(crate) fn of_axes(self, limits: &Limits) -> [f64; AXIS_COUNT] {
        limits
            .acceleration
            .map(|acceleration| self.of_axis(acceleration))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_axes_differ() {
        let mut limits = Limits::default();
        limits.apply(&"A=500;zc:V=20,A=300".parse().expect("valid"));
        assert_eq!(limits.velocity[..3], [100.0, 100.0, 20.0]);
        assert_eq!(
            limits.acceleration[..6],
            [500.0, 500.0, 300.0, 500.0, 500.0, 300.0]
        );
    }

    #[test]
    fn says_what_is_wrong() {
        let refused = |text: &str| text.parse::<LimitChanges>().expect_err("refused");
        assert!(refused("J=5").contains("--jerk"));
        assert!(refused("Q:V=1").contains('Q'));
        assert!(refused("V=-1").contains("-1"));
        assert!(refused("V").contains('V'));
        assert!(refused(":V=5").contains("names no axis"));
        assert!(refused("X:V=1e308").contains("1e9"));
    }

    #[test]
    fn jerk_in_accelerations() {
        let jerk = "20A".parse::<Jerk>().expect("valid");
        assert_eq!(jerk.of_axes(&Limits::default())[0], 20_000.0);
        assert_eq!("0".parse(), Ok(Jerk::Unlimited));
        assert!("fast".parse::<Jerk>().is_err());
    }
}
