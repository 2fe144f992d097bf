//! `G58 X10` and `G59 X2`: the shift of the programmable frame, axis by axis. G58 replaces the absolute part
//! of the axes that it names, which is that of TRANS; G59 replaces the additive one, to which ATRANS adds.
//! Nothing moves. (Siemens, SINUMERIK ONE, Programming Manual NC, "Axial work offset".)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::{At, Dimension};
use crate::program::frame::{FrameCommand, FrameOperation};

/// The parts of the shift with which the programmable frame begins, machine units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProgrammedOffset {
    absolute: [f64; 3],
    additive: [f64; 3],
}

impl Interpreter<'_> {
    /// Keeps the parts apart that a frame command is about to change.
    pub(super) fn follow_offset(&mut self, command: &FrameCommand) {
        let first = self.later_operations().is_empty();
        match command {
            FrameCommand::Absolute(FrameOperation::Translate(shift)) => {
                self.offset = ProgrammedOffset {
                    absolute: *shift,
                    ..ProgrammedOffset::default()
                };
            }
            FrameCommand::Absolute(_) | FrameCommand::Cancel => {
                self.offset = ProgrammedOffset::default();
            }
            FrameCommand::Additive(FrameOperation::Translate(shift)) if first => {
                for (additive, step) in self.offset.additive.iter_mut().zip(shift) {
                    *additive += step;
                }
            }
            FrameCommand::Additive(_) | FrameCommand::DropScales => {}
        }
    }

    /// The programmable frame, which acts in that of CYCLE800.
    pub(super) fn programmable_operations(&self) -> &[FrameOperation] {
        let all = self.control.modal.frame.operations();
        all.get(self.swivelled.len()..).unwrap_or(&[])
    }

    /// The programmable frame behind the shift with which it begins.
    fn later_operations(&self) -> &[FrameOperation] {
        let programmed = self.programmable_operations();
        let shift = |operation: &&FrameOperation| matches!(operation, FrameOperation::Translate(_));
        let shifts = programmed.iter().take_while(shift).count();
        programmed.get(shifts..).unwrap_or(&[])
    }

    /// A block with G58 or G59, which is in `g`.
    pub(super) fn programmed_offset(&mut self, words: &BlockWords, g: At<u32>) -> Done {
        let mut offset = self.offset;
        let part = match g.value {
            58 => &mut offset.absolute,
            _ => &mut offset.additive,
        };
        let mut rest = words.clone();
        rest.g.clear();
        for (axis, part) in part.iter_mut().enumerate() {
            let Some(word) = rest.motion.axes[axis].take() else {
                continue;
            };
            if word.value.1 == Dimension::Incremental {
                return Err(
                    Diagnostic::error(word.span, "an increment of a work offset")
                        .help("write the offset itself, or ATRANS, which adds"),
                );
            }
            *part = word.value.0 * self.control.modal.length_factor;
        }
        let number = g.value;
        if rest != BlockWords::default() || words.g.len() > 1 {
            return Err(Diagnostic::error(
                g.span,
                format!("G{number} stands alone in its block, with X, Y and Z"),
            )
            .help("put everything else in another block"));
        }
        if words.motion.axes == rest.motion.axes {
            return Err(Diagnostic::error(g.span, format!("G{number} needs axes")).help(format!(
                    "G{number} X10 shifts zero of X in the work offset; further work offsets are G505 and up"
                )));
        }
        let later = self.later_operations().to_vec();
        let shift = |operation: &FrameOperation| matches!(operation, FrameOperation::Translate(_));
        if number == 59 && later.iter().any(shift) {
            return Err(Diagnostic::error(
                g.span,
                "G59 would replace the shift of an ATRANS in a turned, scaled or mirrored frame",
            )
            .help("write TRANS and the rest of the frame anew"));
        }
        let parts = [offset.absolute, offset.additive];
        let parts = parts.into_iter().filter(|part| *part != [0.0; 3]);
        let mut operations = self.swivelled.clone();
        operations.extend(parts.map(FrameOperation::Translate));
        operations.extend(later);
        self.control.set_frame(&operations, g.span)?;
        self.offset = offset;
        Ok(())
    }
}
