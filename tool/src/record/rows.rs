//! What halsampler prints becomes the rows of a recording.

use super::error::RecordError;
use super::wiring::{Columns, SCALE};
use std::io::{self, Write};

/// A sample: a servo cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// From 0, one more in each servo cycle.
    pub number: u64,
    /// Joints, then axes, machine units.
    pub positions: Vec<f64>,
    /// motion.program-line.
    pub line: i64,
    /// motion.motion-type: 0 while no move of a program runs.
    pub motion: i64,
    /// halui.program.is-idle, where there is one.
    pub idle: Option<bool>,
}

impl Sample {
    /// Reads a line of halsampler; `None` for one that only says that samples are lost, which the next number
    /// shows.
    ///
    /// # Errors
    /// [`RecordError::Sampler`] with a line that is not understood.
    pub fn parse(line: &str, columns: &Columns) -> Result<Option<Sample>, RecordError> {
        let mut words = line.split_ascii_whitespace();
        let Some(number) = words.next().filter(|word| *word != "overrun") else {
            return Ok(None);
        };
        let mut next = || words.next().ok_or(());
        let mut read = || -> Result<Sample, ()> {
            let mut positions = Vec::with_capacity(columns.positions());
            for _ in 0..columns.positions() {
                positions.push(next()?.parse::<f64>().map_err(drop)? / SCALE);
            }
            Ok(Sample {
                number: number.parse().map_err(drop)?,
                positions,
                line: next()?.parse().map_err(drop)?,
                motion: next()?.parse().map_err(drop)?,
                idle: match columns.idle {
                    true => Some(next()? == "1"),
                    false => None,
                },
            })
        };
        let problem = format!("halsampler prints `{}`", line.trim_end());
        read().map(Some).map_err(|()| RecordError::Sampler(problem))
    }
}

/// Writes the recording.
#[derive(Debug)]
pub struct Table<W> {
    output: W,
    joints: usize,
    /// Seconds.
    period: f64,
    /// Number of the first sample.
    first: Option<u64>,
    /// The last one.
    last: Option<Sample>,
    /// Number of the motion.
    id: u64,
    /// How many rows there are.
    pub rows: u64,
    /// Servo cycles that are missing.
    pub lost: u64,
    /// When the first of them is missing, seconds.
    pub first_lost: Option<f64>,
}

impl<W: Write> Table<W> {
    /// With the header. `period` in seconds.
    ///
    /// # Errors
    /// Those of `output`.
    pub fn new(mut output: W, columns: &Columns, period: f64) -> io::Result<Table<W>> {
        write!(output, "time,id,line")?;
        for joint in &columns.joints {
            write!(output, ",joint.{joint}")?;
        }
        for axis in &columns.axes {
            write!(output, ",axis.{axis}")?;
        }
        writeln!(output)?;
        Ok(Table {
            output,
            joints: columns.joints.len(),
            period,
            first: None,
            last: None,
            id: 0,
            rows: 0,
            lost: 0,
            first_lost: None,
        })
    }

    /// Seconds from the first row to a sample.
    pub fn time(&self, sample: &Sample) -> f64 {
        let first = self.first.unwrap_or(sample.number);
        (sample.number - first.min(sample.number)) as f64 * self.period
    }

    /// Whether a joint has moved since the last sample.
    pub fn moves(&self, sample: &Sample) -> bool {
        self.last
            .as_ref()
            .is_some_and(|last| last.positions[..self.joints] != sample.positions[..self.joints])
    }

    /// A row.
    ///
    /// # Errors
    /// Those of the output.
    pub fn write(&mut self, sample: Sample) -> io::Result<()> {
        self.first.get_or_insert(sample.number);
        let time = self.time(&sample);
        // LinuxCNC has no number of the motion in HAL: a new one begins with another line or kind.
        let same = |last: &Sample| (last.line, last.motion) == (sample.line, sample.motion);
        if !self.last.as_ref().is_some_and(same) {
            self.id += 1;
        }
        let follows = self
            .last
            .as_ref()
            .map_or(sample.number, |last| last.number + 1);
        if sample.number > follows {
            self.lost += sample.number - follows;
            self.first_lost.get_or_insert(time);
        }
        write!(self.output, "{time:.9},{},{}", self.id, sample.line)?;
        for position in &sample.positions {
            write!(self.output, ",{position:.12}")?;
        }
        writeln!(self.output)?;
        self.rows += 1;
        self.last = Some(sample);
        Ok(())
    }

    /// The output, complete.
    pub fn into_output(self) -> W {
        self.output
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns() -> Columns {
        Columns {
            joints: vec![0, 1],
            axes: vec!['x'],
            idle: true,
        }
    }

    fn sample(line: &str) -> Sample {
        let sample = Sample::parse(line, &columns()).expect("understood");
        sample.expect("a sample")
    }

    #[test]
    fn a_line_of_halsampler_is_read() {
        let expected = Sample {
            number: 7,
            positions: vec![1.5, -0.000_000_25, 12.0],
            line: 3,
            motion: 2,
            idle: Some(false),
        };
        let line = "7 1500000.000000 -0.250000 12000000.000000 3 2 0 \n";
        assert_eq!(sample(line), expected);
        assert_eq!(
            Sample::parse("overrun\n", &columns()).expect("understood"),
            None
        );
        for line in ["7 1.0", "7 1 2 x 3 2 0", "seven 1 2 3 4 5 0"] {
            let error = Sample::parse(line, &columns()).expect_err("refused");
            assert!(error.to_string().contains(line), "{error}");
        }
    }

    #[test]
    fn rows_have_time_and_the_number_of_the_motion() {
        let mut table = Table::new(Vec::new(), &columns(), 0.001).expect("memory");
        let first = sample("5 1000000.0 0 0 1 1 0");
        assert!(!table.moves(&first));
        table.write(first).expect("memory");
        let moved = sample("6 1000000.25 0 0 1 1 0");
        assert!(table.moves(&moved));
        table.write(moved).expect("memory");
        // Another line; the axis alone is no motion of a joint.
        let line = sample("7 1000000.25 0 9 2 1 0");
        assert!(!table.moves(&line));
        table.write(line).expect("memory");
        assert_eq!((table.rows, table.lost), (3, 0));
        // Two servo cycles are missing.
        table.write(sample("10 0 0 0 2 1 0")).expect("memory");
        assert_eq!((table.lost, table.first_lost), (2, Some(0.005)));
        let text = String::from_utf8(table.into_output()).expect("text");
        let expected = "\
time,id,line,joint.0,joint.1,axis.x
0.000000000,1,1,1.000000000000,0.000000000000,0.000000000000
0.001000000,1,1,1.000000250000,0.000000000000,0.000000000000
0.002000000,2,2,1.000000250000,0.000000000000,0.000009000000
0.005000000,2,2,0.000000000000,0.000000000000,0.000000000000
";
        assert_eq!(text, expected);
    }
}
