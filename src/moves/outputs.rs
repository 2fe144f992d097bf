//! Outputs that are written at the moment a move starts: M62, M63, M67.

/// How many digital and how many analog outputs LinuxCNC's motion controller has at most.
pub const OUTPUT_COUNT: usize = 64;

/// A set of outputs and the value of each, at most [`OUTPUT_COUNT`] of either kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SynchronisedOutputs {
    digital_mask: u64,
    digital_values: u64,
    analog_mask: u64,
    analog_values: [f64; OUTPUT_COUNT],
}

impl SynchronisedOutputs {
    /// No output at all.
    pub const NONE: Self = Self {
        digital_mask: 0,
        digital_values: 0,
        analog_mask: 0,
        analog_values: [0.0; OUTPUT_COUNT],
    };

    /// Whether nothing is to be written.
    pub fn is_empty(&self) -> bool {
        self.digital_mask == 0 && self.analog_mask == 0
    }

    /// Adds a digital output, the later value if it is there already. `false`, and nothing is
    /// added, if there is no output of this number.
    pub fn set_digital(&mut self, index: usize, value: bool) -> bool {
        if index >= OUTPUT_COUNT {
            return false;
        }
        let bit = 1 << index;
        self.digital_mask |= bit;
        if value {
            self.digital_values |= bit;
        } else {
            self.digital_values &= !bit;
        }
        true
    }

    /// Adds an analog output, the later value if it is there already. `false`, and nothing is
    /// added, if there is no output of this number or the value is not finite.
    pub fn set_analog(&mut self, index: usize, value: f64) -> bool {
        let Some(slot) = self.analog_values.get_mut(index) else {
            return false;
        };
        if !value.is_finite() {
            return false;
        }
        *slot = value;
        self.analog_mask |= 1 << index;
        true
    }

    /// Adds all of `later`; where both have an output, its value counts.
    pub fn merge(&mut self, later: &Self) {
        self.digital_values = (self.digital_values & !later.digital_mask)
            | (later.digital_values & later.digital_mask);
        self.digital_mask |= later.digital_mask;
        for (index, value) in later.analog() {
            self.set_analog(index, value);
        }
    }

    /// The digital outputs to be written, (number, value), in ascending order.
    pub fn digital(&self) -> impl Iterator<Item = (usize, bool)> + '_ {
        (0..OUTPUT_COUNT)
            .filter(|index| self.digital_mask >> index & 1 != 0)
            .map(|index| (index, self.digital_values >> index & 1 != 0))
    }

    /// The analog outputs to be written, (number, value), in ascending order.
    pub fn analog(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.analog_values
            .iter()
            .copied()
            .enumerate()
            .filter(|(index, _)| self.analog_mask >> index & 1 != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_later_value_counts() {
        let mut first = SynchronisedOutputs::NONE;
        assert!(first.is_empty());
        assert!(first.set_digital(0, true) && first.set_digital(63, true));
        assert!(first.set_analog(2, 1.5));
        let mut second = SynchronisedOutputs::NONE;
        assert!(second.set_digital(63, false) && second.set_analog(2, -1.0));
        assert!(second.set_analog(63, 7.0));
        first.merge(&second);
        assert!(first.digital().eq([(0, true), (63, false)]));
        assert!(first.analog().eq([(2, -1.0), (63, 7.0)]));
    }

    #[test]
    fn outputs_that_do_not_exist_are_refused() {
        let mut outputs = SynchronisedOutputs::NONE;
        assert!(!outputs.set_digital(64, true));
        assert!(!outputs.set_analog(64, 0.0));
        assert!(!outputs.set_analog(0, f64::NAN));
        assert!(outputs.is_empty());
    }
}
