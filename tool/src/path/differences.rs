//! Velocity, acceleration and jerk of each axis, by differences of the positions at the servo period.

use super::Position;

/// Derivatives of a position at a servo cycle, each over the last periods.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rates {
    /// In the order velocity, acceleration, jerk, shape (3, 9).
    pub orders: [Position; 3],
}

/// Takes the differences one cycle after the other, from rest.
#[derive(Clone, Copy, Debug)]
pub struct Differences {
    period: f64,
    position: Position,
    rates: Rates,
}

impl Differences {
    /// At rest at `start`; `period` in seconds.
    pub fn new(start: Position, period: f64) -> Self {
        Differences {
            period,
            position: start,
            rates: Rates::default(),
        }
    }

    /// Where the last cycle was.
    pub fn position(&self) -> &Position {
        &self.position
    }

    /// The next cycle.
    pub fn step(&mut self, position: &Position) -> Rates {
        let mut next = Rates::default();
        for (axis, (new, old)) in position.iter().zip(self.position).enumerate() {
            let mut value = (new - old) / self.period;
            for order in 0..3 {
                next.orders[order][axis] = value;
                value = (value - self.rates.orders[order][axis]) / self.period;
            }
        }
        self.position = *position;
        self.rates = next;
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_has_its_derivatives() {
        let at = |t: f64| [t * t * t / 6.0; 9];
        let mut differences = Differences::new(at(0.0), 0.01);
        let mut rates = Rates::default();
        for k in 1..=100 {
            rates = differences.step(&at(f64::from(k) * 0.01));
        }
        for (order, exact) in [0.5, 1.0, 1.0].into_iter().enumerate() {
            assert!((rates.orders[order][4] - exact).abs() < 0.02, "{rates:?}");
        }
    }
}
