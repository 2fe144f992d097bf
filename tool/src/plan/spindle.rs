//! The spindle of the plan: it has its commanded speed at once.

use framepath::planner::{SpindleInputs, Status};

/// A spindle that turns as it is told.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spindle {
    /// Turns a second, negative in reverse.
    speed: f64,
    /// Commanded by the program to turn in reverse; what a tap does is no change of it.
    reverse: bool,
    /// Turns since the start.
    turns: f64,
    /// Where the encoder's count is 0.
    zero: f64,
    awaits_index: bool,
}

impl Spindle {
    /// Revolutions per minute, negative in reverse.
    pub fn command(&mut self, revolutions: f64) {
        self.speed = revolutions / 60.0;
        if revolutions != 0.0 {
            self.reverse = revolutions < 0.0;
        }
    }

    /// One servo period, seconds. The index is at whole turns.
    pub fn turn(&mut self, period: f64) -> SpindleInputs {
        let before = self.turns;
        self.turns += self.speed * period;
        if self.awaits_index && before.floor() != self.turns.floor() {
            self.zero = before.floor().max(self.turns.floor());
            self.awaits_index = false;
        }
        SpindleInputs {
            turns: self.turns - self.zero,
            speed: self.speed,
            commanded: self.speed.abs(),
            reverse: self.reverse,
            awaits_index: self.awaits_index,
        }
    }

    /// What the planner asks of it after a period.
    pub fn obey(&mut self, status: &Status) {
        if status.index_request == Some(0) {
            self.awaits_index = true;
        }
        if let Some((0, factor)) = status.spindle_factor {
            self.speed *= factor;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_index_sets_the_count_to_zero() {
        let mut spindle = Spindle::default();
        spindle.command(-600.0);
        for _ in 0..250 {
            spindle.turn(0.001);
        }
        spindle.awaits_index = true;
        let mut inputs = spindle.turn(0.001);
        while inputs.awaits_index {
            inputs = spindle.turn(0.001);
        }
        assert!(inputs.reverse && inputs.turns <= 0.0 && inputs.turns > -0.02);
    }
}
