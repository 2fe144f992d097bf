//! Single steps: the same path, run to the end of the move under way.

use super::reference::Reference;

/// What is nearer to the end of a move than this is at its end, machine units.
const AT_END: f64 = 1e-9;

impl Reference {
    /// Whether the machine comes to rest at the end of each move.
    pub fn is_step_by_step(&self) -> bool {
        self.step_by_step
    }

    /// From now on the machine comes to rest at the end of each move, or only where the path asks for it again. What was
    /// handed out behind the place where it is is dropped: only at rest, with a path.
    pub fn step_by_step(&mut self, steps: bool) {
        let place = self.place();
        let end = self.path.vertex_after(place).map(|vertex| vertex.s);
        let s = end
            .filter(|end| end - place < AT_END && self.path.leg_ending_at(*end).is_some())
            .unwrap_or(place);
        self.drop_plans();
        self.step_by_step = steps;
        self.rested(s);
    }
}
