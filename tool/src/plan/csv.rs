//! The plan as a table: a row for each servo cycle.

use super::cause::Cause;
use super::collector::Shown;
use super::error::PlanError;
use super::setup::Setup;
use crate::output::OutputFile;
use framepath::axes::{AXIS_COUNT, AXIS_LETTERS};
use std::io::{self, Write};

/// Writes rows while the program is planned.
pub struct Table {
    output: OutputFile,
    axes: Vec<usize>,
}

impl Table {
    /// A table of all axes of the machine; without an INI file those are all nine. Its first row is
    /// the start, at time 0.
    ///
    /// # Errors
    /// A disk that is full, and the like.
    pub fn new(output: OutputFile, setup: &Setup) -> Result<Table, PlanError> {
        let axes: Vec<usize> = (0..AXIS_COUNT).filter(|axis| setup.axes[*axis]).collect();
        let mut table = Table { output, axes };
        table.header().map_err(|source| table.unwritable(source))?;
        let start = &setup.surroundings.start;
        table.note(&Shown {
            time: 0.0,
            position: std::array::from_fn(|axis| start[axis] * setup.scale(axis)),
            id: 0,
            line: 0,
            speed: 0.0,
            cause: Cause::Program,
        })?;
        Ok(table)
    }

    /// The next cycle.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn note(&mut self, shown: &Shown) -> Result<(), PlanError> {
        self.row(shown).map_err(|source| self.unwritable(source))
    }

    fn header(&mut self) -> io::Result<()> {
        let output = &mut self.output;
        write!(output, "time,id,line")?;
        for axis in &self.axes {
            write!(output, ",axis.{}", AXIS_LETTERS[*axis].to_ascii_lowercase())?;
        }
        writeln!(output, ",speed,limited_by")
    }

    fn row(&mut self, shown: &Shown) -> io::Result<()> {
        let output = &mut self.output;
        write!(output, "{:.6},{},{}", shown.time, shown.id, shown.line)?;
        for axis in &self.axes {
            write!(output, ",{}", shown.position[*axis])?;
        }
        writeln!(output, ",{:.6},{}", shown.speed, shown.cause.name())
    }

    fn unwritable(&self, source: io::Error) -> PlanError {
        PlanError::unwritable(self.output.name(), source)
    }

    /// The file, with all rows.
    pub fn into_file(self) -> OutputFile {
        self.output
    }
}
