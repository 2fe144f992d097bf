//! Motions in coordinates of the machine, and G92.

use super::block_words::{BlockWords, Dimension};
use super::evaluate_words::Done;
use super::interpreter::Interpreter;
use super::modal::Motion;
use super::motion::targets;
use crate::diagnostics::Diagnostic;
use crate::program::Action;
use crate::program::moves::{Coordinate, Move, MoveKind};
use crate::source::Span;

impl Interpreter<'_> {
    /// G53, G153, SUPA: to coordinates of the machine, without frame and work offset.
    pub(super) fn machine_move(&mut self, words: &BlockWords, span: Span) -> Done {
        if !words.names_an_axis() {
            // SUPA D0 alone only suppresses what a motion in this block would use.
            return Ok(());
        }
        self.refuse_compensation(span, "a motion in machine coordinates")?;
        if self.modal.incremental
            && words
                .axes
                .iter()
                .flatten()
                .any(|axis| axis.value.1 != Dimension::Absolute)
        {
            return Err(Box::new(
                Diagnostic::error(span, "an increment in machine coordinates")
                    .help("write G90, or X=AC(..), in this block"),
            ));
        }
        let rapid = match self.modal.motion {
            Some(Motion::Rapid) => true,
            Some(Motion::Line) => {
                self.check_feed(words, span)?;
                false
            }
            _ => {
                return Err(Box::new(
                    Diagnostic::error(span, "only G0 and G1 can move in machine coordinates")
                        .help("write G0 or G1 in this block"),
                ));
            }
        };
        let target = targets(words, &self.modal, self.settings, self.diagnostics)?;
        let start = self.modal.position.coordinates();
        for (axis, target) in target.iter().enumerate() {
            let framed = axis < 3 && !self.modal.frame.is_empty();
            if *target != Coordinate::Keep || framed {
                self.modal.position.set(axis, None);
            }
        }
        self.modal.carried = [None; 3];
        let kind = MoveKind::Machine {
            rapid,
            tool_length: true,
        };
        self.actions.push(Action::Move(Move {
            kind,
            target,
            start,
            exact_stop: false,
        }));
        Ok(())
    }

    pub(super) fn preset(&mut self, words: &BlockWords, span: Span) -> Done {
        self.refuse_compensation(span, "G92")?;
        if !self.modal.frame.is_empty() {
            return Err(Box::new(
                Diagnostic::error(span, "G92 while a frame is active")
                    .help("clear the frame with TRANS before, and set it again after"),
            ));
        }
        if !words.names_an_axis() {
            return Err(Box::new(
                Diagnostic::error(span, "G92 needs axes").help("G92 X0 makes this place X0"),
            ));
        }
        let mut values = [None; 9];
        for (axis, target) in targets(words, &self.modal, self.settings, self.diagnostics)?
            .into_iter()
            .enumerate()
        {
            match target {
                Coordinate::Keep => continue,
                Coordinate::At(value) if !self.modal.incremental => values[axis] = Some(value),
                _ => {
                    return Err(Box::new(
                        Diagnostic::error(span, "G92 with increments").help("write G90 before"),
                    ));
                }
            }
            self.modal.position.set(axis, values[axis]);
        }
        self.actions.push(Action::Preset(values));
        Ok(())
    }
}
