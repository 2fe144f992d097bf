//! How corners are passed: the mode that the program has in force, and the exact path of cycles.

use super::{Control, Done};
use crate::diagnostics::Diagnostic;
use crate::program::{Action, Compensation, PathControl};
use crate::source::Span;

impl Control<'_> {
    /// How corners are passed from here on. A cycle that is running ends on the exact path first.
    ///
    /// # Errors
    ///
    /// Under cutter compensation, where LinuxCNC keeps the mode in which it began: only that mode, and
    /// the exact stop, which a dwell of no time makes.
    pub fn path_control(&mut self, control: PathControl, span: Span) -> Done {
        let before = std::mem::replace(&mut self.modal.path_control, control);
        let wanted = self.path_control_in_force();
        if !self.keeps_path_control() {
            let other = |state: &Action| !matches!(state, Action::PathControl(_));
            self.states.retain(other);
            self.states.push(Action::PathControl(wanted));
            self.path_of_compensation = wanted;
            return Ok(());
        }
        if wanted == self.path_of_compensation || wanted == PathControl::ExactStop {
            return Ok(());
        }
        self.modal.path_control = before;
        Err(Diagnostic::error(
            span,
            "another way to pass corners while cutter compensation is on",
        )
        .help("LinuxCNC cannot change it there: select it before G41 or G42, or end the compensation with G40 before"))
    }

    /// Corners may be rounded by so much, machine units; `None`: as the settings say. See
    /// [`Control::path_control`].
    pub fn continuous_path(&mut self, tolerance: Option<f64>, span: Span) -> Done {
        let tolerance = tolerance.unwrap_or(self.settings.tolerance);
        self.path_control(PathControl::Continuous { tolerance }, span)
    }

    /// Whether the motions under cutter compensation end at rest, in whatever mode it began.
    pub fn stops_under_compensation(&self) -> bool {
        self.modal.compensation != Compensation::Off
            && self.modal.path_control == PathControl::ExactStop
    }

    /// Cutter compensation begins in the mode that is in force.
    pub(super) fn hold_path_control(&mut self) {
        self.path_of_compensation = self.path_control_in_force();
    }

    /// Cutter compensation ends: the mode that the program has asked for meanwhile.
    pub(super) fn release_path_control(&mut self) {
        let wanted = self.path_control_in_force();
        if wanted != self.path_of_compensation {
            self.states.push(Action::PathControl(wanted));
        }
    }

    /// Whether LinuxCNC cannot change the mode: the compensation is on. The one that this block switches on
    /// begins behind the mode.
    fn keeps_path_control(&self) -> bool {
        let begins = |state: &Action| {
            matches!(
                state,
                Action::Compensation(Compensation::Left | Compensation::Right)
            )
        };
        self.modal.compensation != Compensation::Off && !self.states.iter().any(begins)
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
        if self.cycles == 1 && self.rounds_corners() && !self.keeps_path_control() {
            self.actions
                .push(Action::PathControl(PathControl::ExactPath));
        }
    }

    /// A cycle ends: corners are passed as the program has it, under cutter compensation when that has
    /// ended too.
    pub fn end_cycle(&mut self) {
        self.cycles = self.cycles.saturating_sub(1);
        if self.cycles == 0 && self.rounds_corners() && !self.keeps_path_control() {
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
