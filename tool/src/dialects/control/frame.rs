//! Changing the programmable frame.

use super::{Control, Done};
use crate::diagnostics::Diagnostic;
use crate::program::Action;
use crate::program::frame::{FrameCommand, FrameOperation};
use crate::source::Span;
use framepath::frame::FrameError;
use framepath::frame::affine::MAX_TRANSLATION;

impl Control<'_> {
    /// Carries out one frame command.
    pub fn change_frame(&mut self, command: FrameCommand, span: Span) -> Done {
        self.refuse_compensation(span, "the frame changes")?;
        let frame = self
            .modal
            .frame
            .after(command)
            .map_err(|error| frame_error(error, span))?;
        if frame.rotates_after_unequal_scale() && !self.modal.frame.rotates_after_unequal_scale() {
            self.diagnostics.push(
                Diagnostic::warning(
                    span,
                    "this rotation follows a scale that differs between axes",
                )
                .help(
                    "it acts in the scaled frame, so that right angles are not kept; \
                         controls that store scale and rotation apart would differ",
                ),
            );
        }
        self.modal.set_frame(frame);
        self.actions.push(Action::Frame(command));
        Ok(())
    }

    /// Makes the frame consist of these operations, the outermost first. Nothing happens if it does
    /// already.
    pub fn set_frame(&mut self, operations: &[FrameOperation], span: Span) -> Done {
        if self.modal.frame.operations() == operations {
            return Ok(());
        }
        self.refuse_compensation(span, "the frame changes")?;
        let mut commands: Vec<FrameCommand> = operations
            .iter()
            .map(|operation| FrameCommand::Additive(*operation))
            .collect();
        match commands.first_mut() {
            Some(FrameCommand::Additive(first)) => {
                commands[0] = FrameCommand::Absolute(*first);
            }
            _ => commands.push(FrameCommand::Cancel),
        }
        let mut frame = self.modal.frame.clone();
        for command in &commands {
            frame = frame
                .after(*command)
                .map_err(|error| frame_error(error, span))?;
        }
        self.modal.set_frame(frame);
        self.actions.extend(commands.into_iter().map(Action::Frame));
        Ok(())
    }
}

/// The words for a frame that the core refuses.
fn frame_error(error: FrameError, span: Span) -> Diagnostic {
    const CLEAR: &str = "clear the frame before, or combine several commands into one";
    const FACTORS: &str = "check the scale factors";
    match error {
        FrameError::TooManyOperations { capacity } => Diagnostic::error(
            span,
            format!(
                "too many frame commands: scales and others alternate more than {capacity} times"
            ),
        )
        .help(CLEAR),
        FrameError::TranslationTooLarge { value, .. } => {
            Diagnostic::error(span, format!("a shift of {value} is out of range"))
                .help(format!("shifts go up to {MAX_TRANSLATION}"))
        }
        FrameError::ScaleOutOfRange { smallest, greatest } => Diagnostic::error(
            span,
            format!("with this command the frame scales from {smallest} to {greatest} fold"),
        )
        .help(FACTORS),
        FrameError::IllConditioned { condition } => Diagnostic::error(
            span,
            format!(
                "with this command the scales of different directions differ {condition:.0} fold"
            ),
        )
        .help(FACTORS),
        FrameError::Singular | FrameError::ZeroScale { .. } => {
            Diagnostic::error(span, "with this command the frame has no inverse").help(FACTORS)
        }
        FrameError::ImpossibleSolidAngles { first, second } => Diagnostic::error(
            span,
            format!("no plane has the solid angles {first} and {second} degrees"),
        )
        .help("solid angles lie between -90 and 90 degrees"),
        FrameError::NotFinite
        | FrameError::NoAngles
        | FrameError::TooManyAngles
        | FrameError::MirrorMismatch => {
            Diagnostic::error(span, "the frame cannot be carried out with this command").help(CLEAR)
        }
    }
}
