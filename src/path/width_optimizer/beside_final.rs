//! What a trial does where narrowing does not help: beside the vertices that are final.
//!
//! Where dozens of kernels overlap some lead to one side of a place and some to the other. The final ones stay as they are: what an
//! open one takes back of them comes to light when that is narrowed, the more the narrower it is. In dense code nearly all trials
//! that were given up ended in this way, on one of the two legs before the first open vertex. The widths in force are known to keep
//! the tolerance there: vertices go back to them.

use super::super::chain::Chain;
use super::WidthOptimizer;

/// A leg before the first open vertex is not waited for any more when it has been violated more often than this in a trial.
const NARROWED_FOR: u32 = 12;

impl WidthOptimizer {
    /// Whether narrowing has not helped a leg.
    pub(super) fn is_stuck(&self, chain: &Chain, leg: u64) -> bool {
        leg < self.window.open && chain.leg(leg).check.violations() > NARROWED_FOR
    }

    /// Marks the open vertices that reach a place, or did: they are to go back to the widths in force.
    pub(super) fn send_back(&self, chain: &mut Chain, s: f64) {
        for number in self.window.open..self.stored_next {
            let vertex = chain.vertex_mut(number);
            let reach = vertex.trial.reach().max(vertex.stored().reach());
            vertex.goes_back |= !vertex.held && (vertex.s - s).abs() < reach;
        }
    }

    /// A vertex that is marked goes back to its widths in force and stays there for the rest of the trial. Answers the kernel terms
    /// that it took.
    pub(super) fn go_back(&mut self, chain: &mut Chain, number: u64) -> usize {
        self.narrowed = true;
        let vertex = chain.vertex_mut(number);
        let (stored, reach) = (*vertex.stored(), vertex.trial.reach());
        vertex.goes_back = false;
        vertex.held = true;
        vertex.narrowing = 1.0;
        vertex.marked_temporarily = false;
        vertex.factor = vertex.stored_factor();
        chain.set_trial(number, stored);
        chain.touch(number, reach.max(stored.reach()), self.window.next)
    }
}
