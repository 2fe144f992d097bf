//! Velocity, acceleration and jerk from recorded positions: finite differences at the servo period.

use crate::machine::configuration::MemberLimits;
use serde::Serialize;

/// Velocity, acceleration or jerk: the first, second or third difference of the position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// Units per second.
    Velocity,
    /// Units per second squared.
    Acceleration,
    /// Units per second cubed.
    Jerk,
}

impl Quantity {
    /// All three, in the order of their differences.
    pub const ALL: [Quantity; 3] = [Quantity::Velocity, Quantity::Acceleration, Quantity::Jerk];

    /// How many rows before a row its difference reaches back: 1, 2 or 3.
    pub fn order(self) -> usize {
        match self {
            Quantity::Velocity => 1,
            Quantity::Acceleration => 2,
            Quantity::Jerk => 3,
        }
    }

    /// The name in plain English.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Velocity => "velocity",
            Quantity::Acceleration => "acceleration",
            Quantity::Jerk => "jerk",
        }
    }

    /// The key of its limit in an INI file.
    pub fn key(self) -> &'static str {
        match self {
            Quantity::Velocity => "MAX_VELOCITY",
            Quantity::Acceleration => "MAX_ACCELERATION",
            Quantity::Jerk => "MAX_JERK",
        }
    }

    /// The limit for this quantity, if there is one.
    pub fn limit(self, limits: &MemberLimits) -> Option<f64> {
        match self {
            Quantity::Velocity => Some(limits.velocity),
            Quantity::Acceleration => Some(limits.acceleration),
            Quantity::Jerk => limits.jerk,
        }
    }

    /// The difference that ends at `row`, divided by the period (seconds) to its order.
    ///
    /// `None` where there are not enough rows before.
    pub fn at(self, positions: &[f64], row: usize, period: f64) -> Option<f64> {
        let window = positions.get(row.checked_sub(self.order())?..=row)?;
        Some(match *window {
            [a, b] => (b - a) / period,
            [a, b, c] => ((c - b) - (b - a)) / (period * period),
            [a, b, c, d] => (((d - c) - (c - b)) - ((c - b) - (b - a))) / period.powi(3),
            _ => return None,
        })
    }

    /// How far a difference can be off because positions are known to `half_digit` only:
    /// the binomial coefficients of the difference add up to 2 to the power of its order.
    pub fn uncertainty(self, half_digit: f64, period: f64) -> f64 {
        let order = self.order() as i32;
        half_digit * (2.0 / period).powi(order)
    }
}

/// Whether the difference that ends at `row` reaches back across a break.
pub fn crosses(breaks: &[usize], row: usize, order: usize) -> bool {
    let next = breaks.partition_point(|at| *at + order <= row);
    breaks.get(next).is_some_and(|at| *at <= row)
}
