//! What a program writes into the work offsets: `G10 L2 P1 X-300. Y-200. Z-150.` for G54, `G10 L20 P1 X..` for
//! G54.1 P1. It acts at once, and is kept. (Fanuc, Series 30i, User's Manual, "Workpiece coordinate system setting".)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::At;
use crate::program::{Action, SystemValues};
use crate::source::Span;

impl Interpreter<'_> {
    /// G10.
    pub(super) fn set_offset(&mut self, words: &mut BlockWords, span: Span) -> Done {
        let system = offset_number(words, span)?;
        if self.control.modal.incremental {
            return Err(
                Diagnostic::error(span, "G10 in G91 adds to what is set at the machine")
                    .help("write G90 and the whole offset"),
            );
        }
        if !self.transforms.is_empty() {
            return Err(
                Diagnostic::error(span, "G10 while G51, G51.1, G68 or G68.2 is in force")
                    .help("end them with G69, G50 and G50.1 before"),
            );
        }
        if words.first_axis().is_none() {
            return Err(
                Diagnostic::error(span, "G10 without axes").help("write G10 L2 P1 X-300. Y-200.")
            );
        }
        self.control
            .refuse_compensation(span, "a work offset is set")?;
        self.control.note_once(
            "G10",
            "G10 replaces the work offset that LinuxCNC has stored, which stays behind the program",
            span,
        );
        let mut axes = [None; 9];
        for (axis, value) in axes.iter_mut().enumerate() {
            let factor = match axis {
                3..6 => 1.0,
                _ => self.control.modal.length_factor,
            };
            *value = words.axes[axis].take().map(|word| word.value * factor);
        }
        if self
            .control
            .modal
            .work_offset
            .is_none_or(|active| active == system)
        {
            self.control
                .modal
                .change_offset(axes.map(|value| value.is_some()));
        }
        self.control
            .actions
            .push(Action::SystemValues(Box::new(SystemValues {
                system,
                axes,
                rotation: None,
            })));
        Ok(())
    }
}

/// The work offset of LinuxCNC that L and P name.
fn offset_number(words: &mut BlockWords, span: Span) -> Result<u8, Diagnostic> {
    let (kind, number) = (words.l.take(), words.p.take());
    let further = match kind.map(|kind| kind.value) {
        Some(2.0) => false,
        Some(20.0) => true,
        _ => {
            return Err(Diagnostic::error(
                kind.map_or(span, |kind| kind.span),
                "G10 is not supported without L2 or L20",
            )
            .help(
                "tools and settings are entered at the machine: take it out, and enter the values there; G10 L2 P1 \
                 sets G54, G10 L20 P1 sets G54.1 P1",
            ));
        }
    };
    let most = if further { 3.0 } else { 6.0 };
    match number {
        Some(At {
            value: (number, _), ..
        }) if number.fract() == 0.0 && (1.0..=most).contains(&number) => {
            Ok(number as u8 + if further { 6 } else { 0 })
        }
        _ => Err(Diagnostic::error(
            number.map_or(span, |number| number.span),
            "LinuxCNC has no such work offset",
        )
        .help("P1 to P6 of L2 are G54 to G59, P1 to P3 of L20 are G54.1 P1 to P3")),
    }
}
