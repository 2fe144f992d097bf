//! Why a motion was stopped, and no move is taken before an abort.

use super::spindle::SpindleError;
use super::status::Fault;

/// Why a motion was stopped: what follows in the program must not run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ErrorStop {
    /// The planner broke its own rules.
    Fault(Fault),
    /// The spindle did not do what a thread or a tap needs.
    Spindle(SpindleError),
    /// A joint would leave its soft limits on the way of a move, or jump.
    JointsOnTheWay,
}

impl ErrorStop {
    /// What is reported where the motion was stopped for `before` already: of several faults the first,
    /// since the others may follow from it, and a fault rather than anything else.
    pub fn after(self, before: Option<Self>) -> Self {
        match before {
            Some(Self::Fault(first)) => Self::Fault(first),
            _ => self,
        }
    }

    /// The fault of the planner, if it is one.
    pub fn fault(self) -> Option<Fault> {
        match self {
            Self::Fault(fault) => Some(fault),
            Self::Spindle(_) | Self::JointsOnTheWay => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_fault_is_the_one_that_is_reported() {
        let first = ErrorStop::Fault(Fault::NoPlan);
        let second = ErrorStop::Fault(Fault::Starved);
        let spindle = ErrorStop::Spindle(SpindleError::Stalled);
        assert_eq!(first.after(None).fault(), Some(Fault::NoPlan));
        assert_eq!(second.after(Some(first)), first);
        assert_eq!(spindle.after(Some(first)), first);
        assert_eq!(first.after(Some(spindle)), first);
        assert_eq!(ErrorStop::JointsOnTheWay.after(Some(spindle)).fault(), None);
    }
}
