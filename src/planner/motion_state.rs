//! What the machine does, as the planner knows it from one servo period to the next.

/// What the machine does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MotionState {
    /// It is at rest, and the executor has nothing to run.
    Standing,
    /// The executor runs the reference.
    Running {
        /// How much of the reference the executor has.
        handed_out: HandedOut,
        /// Whether the machine moves along it.
        pace: Pace,
    },
}

/// How much of a reference the executor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HandedOut {
    /// The beginning: more follows as it is asked for.
    Partly,
    /// All of it, or all that it takes.
    ToTheEnd,
}

/// How a machine runs its reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pace {
    Moving,
    /// Held: it stands still, in the middle of the reference.
    StandingStill,
}

impl MotionState {
    /// The reference begins, from rest.
    pub fn start(&mut self) {
        *self = Self::Running {
            handed_out: HandedOut::Partly,
            pace: Pace::StandingStill,
        };
    }

    /// The reference is over, or dropped.
    pub fn stand(&mut self) {
        *self = Self::Standing;
    }

    /// Whether the executor runs the reference.
    pub fn is_running(&self) -> bool {
        matches!(self, Self::Running { .. })
    }

    /// Whether the machine moves.
    pub fn is_moving(&self) -> bool {
        matches!(
            self,
            Self::Running {
                pace: Pace::Moving,
                ..
            }
        )
    }

    /// Whether the executor takes more of the reference.
    pub fn takes_more(&self) -> bool {
        matches!(
            self,
            Self::Running {
                handed_out: HandedOut::Partly,
                ..
            }
        )
    }

    /// Notes how much of the reference that runs has been handed out.
    pub fn hand_out(&mut self, now: HandedOut) {
        if let Self::Running { handed_out, .. } = self {
            *handed_out = now;
        }
    }

    /// Notes whether the machine that runs stands still.
    pub fn set_pace(&mut self, now: Pace) {
        if let Self::Running { pace, .. } = self {
            *pace = now;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_told_of_a_reference_is_forgotten_at_rest() {
        let mut motion = MotionState::Standing;
        motion.hand_out(HandedOut::ToTheEnd);
        motion.set_pace(Pace::Moving);
        assert_eq!(motion, MotionState::Standing);
        assert!(!motion.is_running() && !motion.is_moving() && !motion.takes_more());
        motion.start();
        assert!(motion.is_running() && !motion.is_moving() && motion.takes_more());
        motion.set_pace(Pace::Moving);
        motion.hand_out(HandedOut::ToTheEnd);
        assert!(motion.is_running() && motion.is_moving() && !motion.takes_more());
        motion.stand();
        motion.start();
        assert!(!motion.is_moving() && motion.takes_more());
    }
}
