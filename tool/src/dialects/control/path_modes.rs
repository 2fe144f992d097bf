//! How corners are passed: the mode that the program has in force, and the exact path of cycles.

use super::Control;
use crate::diagnostics::Diagnostic;
use crate::program::{Action, PathControl};
use crate::source::Span;

impl Control<'_> {
    /// How corners are passed from here on. A cycle that is running ends on the exact path first.
    pub fn path_control(&mut self, control: PathControl) {
        self.modal.path_control = control;
        let other = |state: &Action| !matches!(state, Action::PathControl(_));
        self.states.retain(other);
        self.states
            .push(Action::PathControl(self.path_control_in_force()));
    }

    /// Corners may be rounded by so much, machine units; `None`: as the settings say.
    pub fn continuous_path(&mut self, tolerance: Option<f64>) {
        let tolerance = tolerance.unwrap_or(self.settings.tolerance);
        self.path_control(PathControl::Continuous { tolerance });
    }

    /// A tolerance of the program, in its units, as machine units.
    ///
    /// # Errors
    ///
    /// When it is negative.
    pub fn tolerance(&self, value: f64, span: Span) -> Result<f64, Diagnostic> {
        match value < 0.0 {
            true => Err(Diagnostic::error(span, "a tolerance cannot be negative")),
            false => Ok(value * self.modal.length_factor),
        }
    }

    /// A cycle begins: until [`Control::end_cycle`] the path is kept exactly, as by LinuxCNC's own
    /// cycles, since G64 would round the bottom of a hole away. Cycles may be inside each other.
    pub fn begin_cycle(&mut self) {
        self.cycles += 1;
        if self.cycles == 1 && self.rounds_corners() {
            self.actions
                .push(Action::PathControl(PathControl::ExactPath));
        }
    }

    /// A cycle ends: corners are passed as the program has it.
    pub fn end_cycle(&mut self) {
        self.cycles = self.cycles.saturating_sub(1);
        if self.cycles == 0 && self.rounds_corners() {
            let before = self.modal.path_control;
            self.actions.push(Action::PathControl(before));
        }
    }

    /// Whether a modal cycle is in force; the motions between its places are a part of it.
    pub fn modal_cycle(&mut self, in_force: bool) {
        if in_force == self.has_modal_cycle {
            return;
        }
        self.has_modal_cycle = in_force;
        match in_force {
            true => self.begin_cycle(),
            false => self.end_cycle(),
        }
    }

    fn rounds_corners(&self) -> bool {
        matches!(self.modal.path_control, PathControl::Continuous { .. })
    }

    /// What the output has in force.
    fn path_control_in_force(&self) -> PathControl {
        match self.cycles > 0 && self.rounds_corners() {
            true => PathControl::ExactPath,
            false => self.modal.path_control,
        }
    }
}
