//! What is set for the next move before it comes.

use crate::moves::{SynchronisedOutputs, TerminationCondition};

/// What the next move gets besides what comes with it.
#[derive(Clone, Copy, Debug)]
pub(super) struct NextMove {
    /// LinuxCNC's number.
    pub id: i32,
    /// How it meets the one behind it.
    pub termination: TerminationCondition,
    /// What is written at its start.
    pub outputs: SynchronisedOutputs,
}

impl NextMove {
    pub const FIRST: Self = Self {
        id: 0,
        termination: TerminationCondition::Continuous { tolerance: 0.0 },
        outputs: SynchronisedOutputs::NONE,
    };

    /// The move is queued: the one behind it has the next number, and no outputs yet.
    pub fn pass_on(&mut self) {
        self.id = self.id.wrapping_add(1);
        self.clear_outputs();
    }

    /// Drops the outputs.
    pub fn clear_outputs(&mut self) {
        self.outputs = SynchronisedOutputs::NONE;
    }
}
