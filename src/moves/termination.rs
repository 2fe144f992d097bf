//! How a move meets the next one.

/// A wider tolerance than this, machine units, is used as this: the path leaves the program by less than it may.
const GREATEST_TOLERANCE: f64 = 1e3;

/// LinuxCNC's path control modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TerminationCondition {
    /// G61.1: comes to rest at the end point.
    Stop,
    /// G61: passes through the end point, at rest only where the path asks for it.
    Exact,
    /// G64: may leave the programmed path near the end point.
    Continuous {
        /// How far, in machine units; 0 where the program gave no P.
        tolerance: f64,
    },
}

impl TerminationCondition {
    /// The condition with the number that LinuxCNC's `tc_types.h` gives it: 0 stop, 1 exact,
    /// 2 and 3 continuous. `None` for any other number, and for a tolerance that is negative or
    /// not finite.
    pub fn from_number(number: i32, tolerance: f64) -> Option<Self> {
        if !(tolerance >= 0.0 && tolerance.is_finite()) {
            return None;
        }
        match number {
            0 => Some(Self::Stop),
            1 => Some(Self::Exact),
            2 | 3 => Some(Self::Continuous {
                tolerance: tolerance.min(GREATEST_TOLERANCE),
            }),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_linuxcnc() {
        assert_eq!(
            TerminationCondition::from_number(0, 0.0),
            Some(TerminationCondition::Stop)
        );
        assert_eq!(
            TerminationCondition::from_number(1, 0.5),
            Some(TerminationCondition::Exact)
        );
        let continuous = Some(TerminationCondition::Continuous { tolerance: 0.5 });
        assert_eq!(TerminationCondition::from_number(2, 0.5), continuous);
        assert_eq!(TerminationCondition::from_number(3, 0.5), continuous);
        let widest = Some(TerminationCondition::Continuous { tolerance: 1e3 });
        assert_eq!(TerminationCondition::from_number(2, 1e300), widest);
        assert_eq!(TerminationCondition::from_number(4, 0.5), None);
        assert_eq!(TerminationCondition::from_number(2, -0.5), None);
        assert_eq!(TerminationCondition::from_number(2, f64::NAN), None);
    }
}
