//! The plan as a table: a row for each servo cycle.

use super::cause::Cause;
use super::collector::Shown;
use super::error::PlanError;
use super::setup::Setup;
use framepath::axes::{AXIS_COUNT, AXIS_LETTERS};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Writes rows while the program is planned.
pub struct Table {
    file: PathBuf,
    output: BufWriter<File>,
    axes: Vec<usize>,
}

impl Table {
    /// A table of all axes of the machine; without an INI file those are all nine. Its first row is
    /// the start, at time 0.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn create(file: &Path, setup: &Setup) -> Result<Table, PlanError> {
        let axes: Vec<usize> = (0..AXIS_COUNT).filter(|axis| setup.axes[*axis]).collect();
        let created = File::create(file).and_then(|created| {
            let mut output = BufWriter::with_capacity(1 << 18, created);
            write!(output, "time,id,line")?;
            for axis in &axes {
                write!(output, ",axis.{}", AXIS_LETTERS[*axis].to_ascii_lowercase())?;
            }
            writeln!(output, ",speed,limited_by")?;
            Ok(output)
        });
        let output = created.map_err(|source| PlanError::Write {
            file: file.to_owned(),
            source,
        })?;
        let mut table = Table {
            file: file.to_owned(),
            output,
            axes,
        };
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
    /// A disk that is full, and the like.
    pub fn note(&mut self, shown: &Shown) -> Result<(), PlanError> {
        self.row(shown).map_err(|source| PlanError::Write {
            file: self.file.clone(),
            source,
        })
    }

    fn row(&mut self, shown: &Shown) -> io::Result<()> {
        let output = &mut self.output;
        write!(output, "{:.6},{},{}", shown.time, shown.id, shown.line)?;
        for axis in &self.axes {
            write!(output, ",{}", shown.position[*axis])?;
        }
        writeln!(output, ",{:.6},{}", shown.speed, shown.cause.name())
    }

    /// The end of the program.
    ///
    /// # Errors
    /// As for [`Self::note`].
    pub fn finish(mut self) -> Result<(), PlanError> {
        self.output.flush().map_err(|source| PlanError::Write {
            file: self.file.clone(),
            source,
        })
    }
}
