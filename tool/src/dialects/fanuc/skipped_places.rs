//! Where the tool is behind K0.
//!
//! K0 keeps the data of a cycle and makes no hole. Whether the tool goes to the place beside it is not the same on
//! all controls: what follows may not depend on it.

use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::{AXES, At, Dimension, MotionWords};
use crate::source::Span;

/// The axes that K0 has named since they moved last.
pub type SkippedAxes = [bool; 9];

impl Interpreter<'_> {
    /// The place of K0, to which the tool does not go.
    pub(super) fn skip_place(&mut self, motion: &MotionWords, block: Span) -> Done {
        if motion.names_an_axis() && self.control.modal.incremental {
            return Err(Diagnostic::error(block, "K0 beside a place in G91")
                .help("write the data of the cycle without the place, or the place in G90"));
        }
        for (skipped, word) in self.skipped.iter_mut().zip(&motion.axes) {
            *skipped |= word.is_some();
        }
        Ok(())
    }

    /// Refuses a motion that ends elsewhere if the tool has gone to the place of K0.
    pub(super) fn check_skipped(&mut self, motion: &MotionWords, block: Span) -> Done {
        // Said once.
        let skipped = std::mem::take(&mut self.skipped);
        let modal = &self.control.modal;
        let absolute = |word: At<(f64, Dimension)>| !modal.is_incremental(word.value.1);
        let goes =
            |axis: usize| motion.axes[axis].is_some_and(absolute) && !motion.names_a_centre();
        match (0..9).find(|axis| skipped[*axis] && !goes(*axis)) {
            None => Ok(()),
            Some(axis) => Err(not_the_same(axis, block)),
        }
    }

    /// To coordinates of the machine: axes that are not named stay where they are, wherever that is.
    pub(super) fn leave_skipped(&mut self, motion: &MotionWords) {
        for (skipped, word) in self.skipped.iter_mut().zip(&motion.axes) {
            *skipped &= word.is_none();
        }
    }

    /// Refuses to count from the place of an axis that is named.
    pub(super) fn refuse_skipped(&self, motion: &MotionWords, block: Span) -> Done {
        let named = |axis: &usize| self.skipped[*axis] && motion.axes[*axis].is_some();
        match (0..9).find(named) {
            None => Ok(()),
            Some(axis) => Err(not_the_same(axis, block)),
        }
    }
}

fn not_the_same(axis: usize, block: Span) -> Diagnostic {
    let letter = AXES[axis];
    Diagnostic::error(
        block,
        format!(
            "where {letter} is behind K0 beside a place is not the same on all controls"
        ),
    )
    .help(format!(
        "name {letter} in G90 in the first motion behind K0, which is no arc, or leave the place beside K0 out"
    ))
}
