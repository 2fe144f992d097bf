//! Tool length (G43 H) and tool radius (G41 D): the rows of the offset memory are those of LinuxCNC's tool
//! table.

use super::block_words::{BlockWords, g_name};
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::At;
use crate::program::{Action, Compensation};
use crate::source::Span;

/// What H and D have selected.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToolOffsets {
    /// H.
    pub length_row: Option<u32>,
    /// Whether G43 or G49 is in force; `None` before the first.
    pub length_on: Option<bool>,
    /// D.
    pub radius_row: Option<u32>,
    explained: bool,
}

impl ToolOffsets {
    /// The row whose length counts; 0 for none.
    fn length_in_force(&self) -> u32 {
        match self.length_on {
            Some(true) => self.length_row.unwrap_or(0),
            Some(false) | None => 0,
        }
    }
}

impl Interpreter<'_> {
    /// H and D, with G43, G49, G41 and G42 of the block.
    pub(super) fn tool_offsets(
        &mut self,
        words: &mut BlockWords,
        length: Option<At<bool>>,
        radius: Option<At<Compensation>>,
    ) -> Done {
        let before = self.offsets.length_in_force();
        let row = words.h.take();
        if let Some(row) = row {
            self.offsets.length_row = Some(row_number('H', row)?);
        }
        match (length, row) {
            (Some(At { value: false, span }), _) => {
                self.offsets.length_on = Some(false);
                self.control.tool_length(false, span)?;
            }
            (Some(At { value: true, span }), _) => {
                self.offsets.length_on = Some(true);
                self.length(span)?;
            }
            (None, Some(row)) if self.offsets.length_on == Some(true) => self.length(row.span)?,
            _ => {}
        }
        self.control.modal.length_undecided |= self.offsets.length_in_force() != before;
        let row = words.d.take();
        let before = self.offsets.radius_row;
        if let Some(row) = row {
            self.offsets.radius_row = Some(row_number('D', row)?);
        }
        let active = self.control.modal.compensation;
        if let (Some(row), true) = (
            row,
            active != Compensation::Off && self.offsets.radius_row != before,
        ) {
            return Err(Diagnostic::error(
                row.span,
                "another radius while cutter compensation is on",
            )
            .help("end the compensation with G40 before"));
        }
        match radius {
            Some(radius) => self.radius(radius, active),
            None => Ok(()),
        }
    }

    fn length(&mut self, span: Span) -> Done {
        match self.offsets.length_row {
            Some(row) => self.control.tool_offset(row, span),
            None => Err(Diagnostic::error(span, "G43 without an offset").help("write G43 H1 Z50.")),
        }
    }

    /// G41, G42.
    fn radius(&mut self, radius: At<Compensation>, active: Compensation) -> Done {
        let At { value, span } = radius;
        if active == value {
            return Ok(());
        }
        self.control.refuse_compensation(span, "the other side")?;
        let Some(row) = self.offsets.radius_row.filter(|row| *row > 0) else {
            return Err(
                Diagnostic::error(span, "cutter compensation without an offset")
                    .help("write G41 D1; D0 is no radius: leave G41 out then"),
            );
        };
        if !self.offsets.explained && self.offsets.length_row != Some(row) {
            self.offsets.explained = true;
            self.control.diagnostics.push(Diagnostic::warning(
                span,
                format!("D{row} takes the diameter of tool {row} of the tool table"),
            ));
        }
        self.control.states.push(Action::RadiusRow(Some(row)));
        self.control.compensation(value, span)
    }
}

fn row_number(letter: char, word: At<f64>) -> Result<u32, Diagnostic> {
    if word.value.fract() == 0.0 && (0.0..=99_999.0).contains(&word.value) {
        return Ok(word.value as u32);
    }
    Err(Diagnostic::error(
        word.span,
        format!("{letter}{} is not a row of the offset memory", word.value),
    ))
}

/// What is refused of the functions for tool lengths.
pub(super) fn other_length(code: u32, span: Span) -> Diagnostic {
    let help = match code {
        440 => "give the tool a negative length in the tool table, and write G43",
        _ => {
            "post the program without control of the tool centre point: 3+2 axes with G68.2 and G53.1"
        }
    };
    Diagnostic::error(span, format!("{} is not supported", g_name(code))).help(help)
}
