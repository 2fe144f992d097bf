//! Tools and their offsets: T, D, M06, G43 and G44, and the radius that G41 and G42 take.

use super::block_words::BlockWords;
use super::g_functions::OneShot;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::beside_motion::Waiting;
use crate::dialects::control::words::At;
use crate::dialects::control::{Control, Done};
use crate::program::Compensation;
use crate::program::position::Position;
use crate::source::Span;

/// What the program has said about its tool.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct ToolState {
    /// T.
    selected: Option<u32>,
    /// The tool that M06 changed to.
    in_spindle: Option<u32>,
    /// The row of the tool table that D selected; `None` for that of the tool.
    row: Option<u32>,
    /// The row that is selected with the next M06, if T has been there since the last.
    next_row: Option<Option<u32>>,
    /// G43.
    length_on: bool,
    /// Whether G43 or G44 was ever there.
    length_chosen: bool,
    /// Where a tool was changed first.
    changed: Option<Span>,
    /// Whether it has been said that the tool is not changed to.
    told: bool,
}

impl ToolState {
    /// The row of the tool table that is in force, if it is not that of the tool in the spindle; 0 is no
    /// offset at all.
    pub(super) fn row(&self) -> Option<u32> {
        let is_other = |row: &u32| *row == 0 || Some(*row) != self.in_spindle;
        self.row.filter(is_other)
    }

    /// T with the offset behind its point. A tool that waits for M06 leaves alone what the one in the
    /// spindle has.
    fn select(&mut self, tool: u32, offset: Option<u32>) {
        self.selected = Some(tool);
        match self.in_spindle {
            None => self.row = offset,
            Some(_) => self.next_row = Some(offset),
        }
    }

    /// M06.
    fn change(&mut self, span: Span) {
        self.changed.get_or_insert(span);
        self.in_spindle = self.selected;
        if let Some(row) = self.next_row.take() {
            self.row = row;
        }
    }
}

impl Interpreter<'_> {
    /// Whether the control switches the length compensation on by itself is a setting of the machine.
    pub(super) fn check_tool_length(&mut self) {
        if let (Some(span), false) = (self.tool.changed, self.tool.length_chosen) {
            self.control.diagnostics.push(
                Diagnostic::warning(
                    span,
                    "the program changes the tool and says neither G43 nor G44: \
                     the tool length stays as LinuxCNC has it",
                )
                .help("write G43 after the tool change"),
            );
        }
    }

    /// D; whether another row of the tool table is meant than before.
    fn select_offset(&mut self, offset: At<f64>) -> Result<bool, Diagnostic> {
        if offset.value.fract() != 0.0 || !(0.0..=99999.0).contains(&offset.value) {
            return Err(Diagnostic::error(
                offset.span,
                format!("D{}: this is not the number of an offset", offset.value),
            ));
        }
        let before = self.tool.row();
        self.tool.row = Some(offset.value as u32);
        self.tool.next_row = None;
        let changes = self.tool.row() != before;
        if changes {
            self.control
                .refuse_compensation(offset.span, "the tool offset changes")?;
        }
        Ok(changes)
    }

    /// T and D beside G41 or G42 are selected before the compensation that uses them. Returns the block without
    /// them.
    pub(super) fn offset_of_compensation(
        &mut self,
        words: &BlockWords,
    ) -> Result<Option<BlockWords>, Diagnostic> {
        let begins = words.g.iter().any(|g| matches!(g.value, 41 | 42))
            && self.control.modal.compensation == Compensation::Off;
        if !begins || words.offset.is_none() && words.tool.is_none() {
            return Ok(None);
        }
        let mut rest = words.clone();
        if let Some(tool) = rest.tool.take() {
            self.select_tool(tool)?;
        }
        if let Some(offset) = rest.offset.take()
            && self.select_offset(offset)?
            && self.tool.length_on
        {
            let before = self.control.modal.position.clone();
            self.length_of_row(offset.span)?;
            self.keep_across_length(before);
        }
        Ok(Some(rest))
    }

    /// T, with the offset behind its point.
    fn select_tool(&mut self, tool: At<(f64, Option<u32>)>) -> Done {
        let (number, offset) = tool.value;
        self.control.tool(number, tool.span)?;
        self.tool.select(number as u32, offset);
        Ok(())
    }

    /// T, D, M functions and the length compensation; returns the M function that ends the program.
    pub(super) fn tool_and_m(
        &mut self,
        words: &BlockWords,
        once: &OneShot,
    ) -> Result<Option<u32>, Diagnostic> {
        let mut end = None;
        let mut rows_change = None;
        if let Some(tool) = words.tool {
            self.select_tool(tool)?;
        }
        if let Some(offset) = words.offset
            && self.select_offset(offset)?
        {
            rows_change = Some(offset.span);
        }
        let has_offset = words.offset.is_some() || once.length.is_some();
        self.control
            .begin_functions(&words.m, Waiting::SwitchesOff, has_offset);
        for At { value, span } in Control::in_order(&words.m) {
            match value {
                0 | 1 => {}
                2 | 30 => end = Some(value),
                6 => {
                    self.control.tool_change(span, false)?;
                    self.tool.change(span);
                    rows_change = Some(span);
                }
                41..=44 => self.control.note(&format!("M{value}"), span),
                _ if self.control.switch(value) => {}
                _ => self.control.other_m(value, span)?,
            }
        }
        self.control.hold_functions();
        if let Some(length) = once.length {
            self.tool.length_chosen = true;
            self.warn_of_tool_left(length.span);
            let changes = self.tool.length_on != length.value;
            self.tool.length_on = length.value;
            match length.value {
                true => rows_change = rows_change.or(changes.then_some(length.span)),
                false => self.control.tool_length(false, length.span)?,
            }
        }
        let changed = words.m.iter().any(|m| m.value == 6);
        let before = self.control.modal.position.clone();
        if let (Some(span), true) = (rows_change, self.tool.length_on) {
            self.length_of_row(span)?;
        }
        if !changed {
            self.keep_across_length(before);
        }
        if let Some(compensation) = once.compensation {
            self.radius_of_row(compensation);
        }
        Ok(end)
    }

    /// The length of the row that is in force.
    fn length_of_row(&mut self, span: Span) -> Done {
        match self.tool.row() {
            Some(row) => self.control.tool_offset(row, span),
            None => self.control.tool_length(true, span),
        }
    }

    /// The radius of the row that is in force, for G41 and G42, whether its length is compensated or not.
    fn radius_of_row(&mut self, compensation: At<Compensation>) {
        if compensation.value == Compensation::Off {
            return;
        }
        self.warn_of_tool_left(compensation.span);
        self.control.radius_of_row(self.tool.row());
    }

    /// Machines without a changer take T for the change.
    fn warn_of_tool_left(&mut self, span: Span) {
        let left = self.tool.selected.filter(|_| self.tool.changed.is_none());
        let Some(tool) = left.filter(|_| !self.tool.told) else {
            return;
        };
        self.tool.told = true;
        self.control.diagnostics.push(
            Diagnostic::warning(
                span,
                format!(
                    "T{tool} is selected and not changed to: LinuxCNC keeps the tool that it has"
                ),
            )
            .help("write M06 behind T if the tool is to be changed"),
        );
    }

    /// Lengths count along the axis of the tool: in a plane that is not tilted the others stay where they
    /// are.
    fn keep_across_length(&mut self, before: Position) {
        let [first, second, _] = self.control.modal.plane.axes();
        for axis in (0..9).filter(|axis| [first, second].contains(axis) || *axis > 2) {
            self.control.modal.position.set(axis, before.get(axis));
        }
    }
}
