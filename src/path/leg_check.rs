//! What a trial of widths has found out about a leg.

/// See the module.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegCheck {
    /// Whether the widths on trial have yet to be checked on it.
    pub unchecked: bool,
    /// Whether it was violated when it was checked last.
    pub violated: bool,
    /// How often it was.
    violations: u32,
    /// By how much the deviation may grow until it has to be checked again, machine units.
    slack: f64,
}

impl LegCheck {
    /// Nothing is known of it, and nothing is on trial.
    pub const NONE: Self = Self {
        unchecked: false,
        violated: false,
        violations: 0,
        slack: 0.0,
    };

    /// It leaves the tolerance.
    pub fn note_violation(&mut self) {
        self.violated = true;
        self.violations = self.violations.saturating_add(1);
    }

    /// How often it did in this trial.
    pub fn violations(&self) -> u32 {
        self.violations
    }

    /// The tolerance is kept, and so much is left of it.
    pub fn keeps(&mut self, left: f64) {
        *self = Self {
            slack: left,
            violations: self.violations,
            ..Self::NONE
        };
    }

    /// The deviation is greater by so much at most, machine units.
    pub fn grow(&mut self, growth: f64) {
        self.slack -= growth;
        // Also if it is not a number.
        self.unchecked |= self.slack.is_nan() || self.slack < 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn how_often_a_leg_was_violated_is_known_as_long_as_the_trial_lasts() {
        let mut check = LegCheck::NONE;
        check.note_violation();
        check.keeps(0.1);
        assert!(!check.violated);
        check.note_violation();
        assert!(check.violated);
        assert_eq!(check.violations(), 2);
        assert_eq!(LegCheck::NONE.violations(), 0);
    }

    #[test]
    fn a_leg_has_to_be_checked_when_what_was_left_is_used_up() {
        let mut check = LegCheck::NONE;
        check.keeps(0.1);
        check.grow(0.09);
        assert!(!check.unchecked);
        check.grow(0.02);
        assert!(check.unchecked);
        check.keeps(0.1);
        check.grow(f64::NAN);
        assert!(check.unchecked);
    }
}
