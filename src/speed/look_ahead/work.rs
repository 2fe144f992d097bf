//! What is being worked on.

use super::cost;

/// The work that is under way: one thing at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Work {
    Nothing,
    /// A candidate is being made.
    Candidate,
    /// A step of the refinement.
    Refinement,
}

impl Work {
    /// What it costs to choose it.
    pub fn beginning(self) -> u32 {
        match self {
            Self::Nothing => 0,
            Self::Candidate => cost::BEGIN_CANDIDATE,
            Self::Refinement => cost::BEGIN_REFINEMENT,
        }
    }
}
