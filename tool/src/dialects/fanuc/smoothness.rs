//! G187 of Haas mills: by how much corners may be rounded.
//!
//! `G187 P3 E0.05`: E is the greatest rounding until G187 stands alone or the program ends; P chooses between roughing
//! and finishing, whose values are set at the machine. (Haas Automation, Mill Operator's Manual, "G187 Accuracy
//! Control", Setting 85.)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::At;
use crate::program::PathControl;
use crate::source::Span;

/// What G187 has set.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Smoothness {
    /// E, machine units.
    tolerance: Option<f64>,
    /// The mode that E has taken the place of, until it ends.
    before: Option<PathControl>,
}

impl Interpreter<'_> {
    /// G187.
    pub(super) fn smoothness(&mut self, words: &mut BlockWords, span: Span) -> Done {
        let level = words.p.take();
        if let Some(At { value, span }) = level
            && ![1.0, 2.0, 3.0].contains(&value.0)
        {
            return Err(Diagnostic::error(span, "P beside G187 is 1, 2 or 3")
                .help("P1 is for roughing, P2 between, P3 for finishing"));
        }
        let Some(rounding) = words.rounding.take() else {
            if level.is_some() {
                self.control.note("G187 P", span);
            }
            return self.end_of_rounding(span);
        };
        if rounding.value <= 0.0 {
            return Err(
                Diagnostic::error(rounding.span, "E beside G187 is above 0").help(
                    "write G187 E0.05 for corners that are rounded by .05, or G61 for sharp ones",
                ),
            );
        }
        let tolerance = self.control.tolerance(rounding.value, rounding.span)?;
        let before = self.control.modal.path_control;
        // G61 goes on; the rounding is that of the G64 behind it.
        if before != PathControl::ExactStop {
            self.control.continuous_path(Some(tolerance), span)?;
            self.smoothness.before.get_or_insert(before);
        }
        self.smoothness.tolerance = Some(tolerance);
        Ok(())
    }

    /// G61 and G64, which count behind G187 too.
    pub(super) fn path_mode(&mut self, control: PathControl, span: Span) -> Done {
        match control {
            PathControl::Continuous { .. } => {
                self.control
                    .continuous_path(self.smoothness.tolerance, span)?;
            }
            _ => self.control.path_control(control, span)?,
        }
        self.smoothness.before = None;
        Ok(())
    }

    /// G187 without E: with P alone, whose rounding is set at the machine, as without words.
    fn end_of_rounding(&mut self, span: Span) -> Done {
        if self.smoothness.tolerance.take().is_none() {
            return Ok(());
        }
        match (
            self.smoothness.before.take(),
            self.control.modal.path_control,
        ) {
            (Some(before), _) => self.control.path_control(before, span),
            (None, PathControl::Continuous { .. }) => self.control.continuous_path(None, span),
            _ => Ok(()),
        }
    }
}
