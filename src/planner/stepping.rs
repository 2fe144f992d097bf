//! Single steps that begin in the middle of the path: each ends at rest where its move ends.
//!
//! LinuxCNC pauses the machine when the number of the move changes. On a plan that goes on beyond the end of the move it
//! would only begin to brake there.

use super::inputs::CycleInputs;
use super::planner::Planner;

impl Planner {
    /// Where the machine stands still in the middle of its path, and single steps begin or are over: what was planned
    /// beyond this place is dropped. The path stays as it is, since the machine may rest within a blend.
    pub(super) fn turn_to_steps(&mut self, inputs: &CycleInputs) {
        if self.motion.is_moving() || !self.plans_otherwise(inputs) {
            return;
        }
        self.reference.step_by_step(inputs.stepping);
        if self.motion.is_running() {
            self.finish();
        }
    }

    /// Whether a single step has to wait until the machine stands, since the plan that it runs goes on beyond the move.
    pub(super) fn awaits_step(&self, inputs: &CycleInputs) -> bool {
        inputs.stepping && self.plans_otherwise(inputs)
    }

    /// Whether the plan is one for single steps where none are taken, or none where they are.
    fn plans_otherwise(&self, inputs: &CycleInputs) -> bool {
        let otherwise = self.reference.is_step_by_step() != inputs.stepping;
        let planned_alone = self.reference.is_single() || self.reference.is_backwards();
        let open = self.reference.is_active() && !planned_alone && !self.status.aborting;
        otherwise && open && !self.ends_at_rest_by_itself()
    }

    /// Whether the machine is in a move that no other is planned with, and that is not to be planned anew in its middle:
    /// one that follows the angle of a spindle, or turns a locking indexer.
    fn ends_at_rest_by_itself(&self) -> bool {
        let front = self.queue.front();
        let alone =
            front.is_some_and(|front| front.indexer_joint.is_some() || front.follows_angle());
        alone || self.spindle.has_thread() || self.indexer.locking().is_some()
    }
}
