//! The reverse run: back along the path, and forward again.

use super::planner::Planner;
use crate::moves::MotionType;

/// Why the direction cannot be turned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DirectionError {
    /// The machine has to come to rest first.
    Moving,
    /// There is nothing to go back over, or the machine is within a move of a kind that does not
    /// run backwards.
    NoWayBack,
}

impl Planner {
    /// Chooses whether the machine runs its moves forward or back along the path it came, through
    /// the moves it remembers: those since it last had nothing to do, up to some hundreds.
    ///
    /// It comes to rest where it remembers no more, or at a move that belongs to something else
    /// than the path: one that follows the angle of a spindle, probes, or turns a locking indexer. Outputs that
    /// were written on the way are not written again.
    ///
    /// # Errors
    /// See [`DirectionError`]; nothing changes then.
    pub fn run_backwards(&mut self, backwards: bool) -> Result<(), DirectionError> {
        if backwards == self.reference.is_backwards() {
            return Ok(());
        }
        if self.motion.is_moving() || self.status.aborting {
            return Err(DirectionError::Moving);
        }
        if !self.reference.is_active() || self.is_coupled() {
            return Err(DirectionError::NoWayBack);
        }
        self.executor.reset();
        self.motion.stand();
        self.indexer.give_up();
        self.reference.reverse(backwards);
        self.status.backwards = backwards;
        self.report_rest();
        Ok(())
    }

    /// Whether the machine is within a move that cannot be run backwards.
    fn is_coupled(&self) -> bool {
        let coupled = self.queue.front().is_some_and(|front| {
            front.follows_angle()
                || front.indexer_joint.is_some()
                || front.motion_type == MotionType::Probing
        });
        self.queue.has_begun() && coupled
            || self.spindle.has_thread()
            || self.indexer.locking().is_some()
    }
}
