//! Tools: offsets by the row of a table (`D3`), and the M functions of a block.

use super::words::At;
use super::{Control, Done};
use crate::diagnostics::Diagnostic;
use crate::program::Compensation;

/// The row that D selected, and whether it has been said what D becomes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OffsetRow {
    selected: Option<u32>,
    explained: bool,
}

impl OffsetRow {
    /// Whether the program has named a row; D0 names that there is none.
    pub fn is_named(self) -> bool {
        self.selected.is_some()
    }
}

impl Control<'_> {
    /// D: length and radius come from this row from here on; 0 for none. Says once that the rows are
    /// those of LinuxCNC's tool table. `true` when another row than before is selected.
    pub fn select_offset_row(
        &mut self,
        row: &mut OffsetRow,
        d: At<f64>,
    ) -> Result<bool, Diagnostic> {
        let At { value, span } = d;
        if value.fract() != 0.0 || !(0.0..=99_999.0).contains(&value) {
            return Err(Diagnostic::error(
                span,
                format!("D{value} is not a row of the offset table"),
            ));
        }
        let number = value as u32;
        if row.selected == Some(number) {
            return Ok(false);
        }
        self.tool_offset(number, span)?;
        if number > 0 && !row.explained {
            row.explained = true;
            self.diagnostics.push(Diagnostic::warning(
                span,
                format!(
                    "D{number} runs as G43 H{number}: length and radius of tool {number} of the tool table"
                ),
            ));
        }
        row.selected = Some(number);
        Ok(true)
    }

    /// G40 to G42, with the radius of the row that D selected; before the first D with that of the tool.
    pub fn compensation_by_row(&mut self, compensation: At<Compensation>, row: OffsetRow) -> Done {
        let changes = self.switch_compensation(compensation)?;
        if changes && compensation.value != Compensation::Off && row.selected.is_some() {
            self.radius_of_row(row.selected);
        }
        Ok(())
    }

    /// The M functions of a block except the stops at its end; returns the one that ends the routine.
    /// `ends`: which of them do.
    pub fn m_functions(
        &mut self,
        list: &[At<u32>],
        ends: &[u32],
    ) -> Result<Option<u32>, Diagnostic> {
        let mut end = None;
        // LinuxCNC changes the tool first, then switches spindle and coolant; so do controls.
        let mut list: Vec<&At<u32>> = list.iter().collect();
        list.sort_by_key(|m| match m.value {
            6 => 0,
            3..=5 => 1,
            7..=9 => 2,
            _ => 3,
        });
        for &At { value, span } in list {
            match value {
                0 | 1 => {}
                6 => self.tool_change(span, false)?,
                40..=45 => self.note(&format!("M{value}"), span),
                _ if ends.contains(&value) => end = Some(value),
                _ if self.switch(value) => {}
                _ => self.other_m(value, span)?,
            }
        }
        Ok(end)
    }

    /// M0 and M1 act when the motion is over.
    ///
    /// # Errors
    ///
    /// Those of [`Control::pause`].
    pub fn stops(&mut self, list: &[At<u32>]) -> Done {
        for m in list.iter().filter(|m| matches!(m.value, 0 | 1)) {
            self.pause(m.value == 1, m.span, &format!("M{}", m.value))?;
        }
        Ok(())
    }
}
