//! Times by line: when the machine is where in the program, for the operator's panel (hal-component/panel/program_time.py).
//!
//! Within a move rows lie where the time is not a straight line over what is left of the move.

use super::error::PlanError;
use super::sample::Sample;
use crate::canon::CanonError;
use crate::output::OutputFile;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;

/// What time may be off between two rows, servo periods.
const WITHIN: f64 = 0.5;

/// A row.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    /// s.
    time: f64,
    /// Line of the program.
    line: i32,
    /// How many moves are behind the machine: the number of the one that runs, from 0.
    moves_done: u64,
    /// What F counts until the end of the move, machine units (degrees); `None` while the machine stands between moves.
    to_go: Option<f64>,
}

impl Row {
    /// Seconds for a unit of the way since another row of the same move.
    fn slope(&self, since: &Row) -> Option<f64> {
        let way = since.to_go? - self.to_go?;
        let same = since.moves_done == self.moves_done;
        (same && way > 0.0).then(|| (self.time - since.time) / way)
    }
}

/// Writes rows while the program is planned.
pub struct Times {
    output: OutputFile,
    /// s.
    tolerance: f64,
    /// The last row that was written.
    written: Option<Row>,
    /// The last cycle, where it was not written.
    pending: Option<Row>,
    /// Least and greatest slope from the last row that leave the cycles since then within the tolerance.
    slopes: (f64, f64),
}

impl Times {
    /// Times of a program, which is read to know it again.
    ///
    /// # Errors
    /// A program that cannot be read, a disk that is full, and the like.
    pub fn new(output: OutputFile, program: &Path, period: f64) -> Result<Times, PlanError> {
        let sum = checksum(program).map_err(|source| CanonError::Read {
            file: program.to_owned(),
            source,
        })?;
        let mut times = Times {
            output,
            tolerance: WITHIN * period,
            written: None,
            pending: None,
            slopes: (0.0, f64::INFINITY),
        };
        let written = writeln!(times.output, "framepath times,1,{},{:08x}", sum.0, sum.1)
            .and_then(|()| writeln!(times.output, "time,line,move,to_go"));
        written.map_err(|source| times.unwritable(source))?;
        Ok(times)
    }

    /// The next cycle.
    ///
    /// # Errors
    /// A disk that is full, and the like.
    pub fn note(&mut self, sample: &Sample, line: i32) -> Result<(), PlanError> {
        let row = Row {
            time: sample.time,
            line,
            moves_done: sample.moves_done,
            to_go: sample.running.map(|_| sample.distance_to_go),
        };
        self.take(row).map_err(|source| self.unwritable(source))
    }

    fn take(&mut self, row: Row) -> io::Result<()> {
        let Some(written) = self.written else {
            return self.write(row);
        };
        if row.to_go.is_none() && written.to_go.is_none() && row.moves_done == written.moves_done {
            return Ok(());
        }
        let (low, high) = self.slopes;
        match row.slope(&written) {
            Some(slope) if low <= slope && slope <= high => {
                let way = (row.time - written.time) / slope;
                let slack = self.tolerance / way;
                self.slopes = (low.max(slope - slack), high.min(slope + slack));
                self.pending = Some(row);
                Ok(())
            }
            _ => match self.pending.take() {
                Some(pending) => {
                    self.write(pending)?;
                    self.take(row)
                }
                None => self.write(row),
            },
        }
    }

    fn write(&mut self, row: Row) -> io::Result<()> {
        (self.written, self.slopes) = (Some(row), (0.0, f64::INFINITY));
        let output = &mut self.output;
        write!(output, "{:.6},{},{},", row.time, row.line, row.moves_done)?;
        match row.to_go {
            Some(to_go) => writeln!(output, "{to_go:.6}"),
            None => writeln!(output),
        }
    }

    /// The file, with all rows; the program ends at `end` seconds.
    ///
    /// # Errors
    /// As for [`Self::note`].
    pub fn finish(mut self, end: f64) -> Result<OutputFile, PlanError> {
        let pending = self.pending.take();
        let written = pending
            .map_or(Ok(()), |row| self.write(row))
            .and_then(|()| writeln!(self.output, "{end:.6},,,"));
        written.map_err(|source| self.unwritable(source))?;
        Ok(self.output)
    }

    fn unwritable(&self, source: io::Error) -> PlanError {
        PlanError::unwritable(self.output.name(), source)
    }
}

/// Bytes of a file, and their Adler-32 sum.
fn checksum(file: &Path) -> io::Result<(u64, u32)> {
    const PRIME: u32 = 65_521;
    /// So many bytes do not overflow the sums.
    const PIECE: usize = 5552;
    let mut file = File::open(file)?;
    let (mut bytes, mut low, mut high) = (0u64, 1u32, 0u32);
    let mut piece = [0; PIECE];
    loop {
        let count = file.read(&mut piece)?;
        if count == 0 {
            return Ok((bytes, high << 16 | low));
        }
        bytes += count as u64;
        for byte in piece.iter().take(count) {
            low += u32::from(*byte);
            high += low;
        }
        (low, high) = (low % PRIME, high % PRIME);
    }
}
