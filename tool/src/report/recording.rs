//! Reads a recording: a CSV file with one row for every servo cycle.
//!
//! Header: `time,id,line,joint.0,joint.1,..,axis.x,axis.y,..`. `time` is in seconds, `id` is the
//! number of the motion, `line` the program line (motion.program-line), `joint.N` the commanded
//! position of a joint and `axis.L` the planner's own output, in machine units or degrees.

use std::path::Path;

use csv::ByteRecord;

use super::error::ReportError;
use super::short_lines::{ShortLines, line_of};

/// A recording in columns; all columns have [`Recording::rows`] entries.
#[derive(Debug)]
pub struct Recording {
    /// Seconds, rising.
    pub times: Vec<f64>,
    /// Number of the motion.
    pub ids: Vec<i64>,
    /// Program line.
    pub lines: Vec<i64>,
    /// Commanded positions, shape (joints, rows), machine units or degrees.
    pub joints: Vec<Vec<f64>>,
    /// The planner's output by lower-case axis letter, shape (axes, rows), units alike.
    pub axes: Vec<(char, Vec<f64>)>,
    /// The last digit that the file writes, in units: positions are known to half of it.
    pub resolution: f64,
    /// Rows before which at least one servo cycle is missing, rising.
    pub gaps: Vec<usize>,
}

/// What a column of the file holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Column {
    Time,
    Id,
    Line,
    Joint(usize),
    Axis(usize),
}

impl Recording {
    /// Reads a file.
    ///
    /// # Errors
    /// [`ReportError::Read`] or the errors of [`Recording::parse`].
    pub fn read(file: &Path) -> Result<Recording, ReportError> {
        let opened = std::fs::File::open(file).map_err(|source| ReportError::Read {
            file: file.to_owned(),
            source,
        })?;
        if opened.metadata().is_ok_and(|metadata| metadata.is_dir()) {
            return Err(ReportError::Read {
                file: file.to_owned(),
                source: std::io::Error::other("it is a folder, and a recording is one file"),
            });
        }
        Recording::parse(file, opened)
    }

    /// Reads `source`; `file` is its name in messages.
    ///
    /// # Errors
    /// [`ReportError::Recording`] with the line, for a header that is not understood, a row with
    /// too few fields or an unusable number, and time that does not rise.
    pub fn parse(file: &Path, source: impl std::io::Read) -> Result<Recording, ReportError> {
        let fail = |line: u64, problem: String| ReportError::Recording {
            file: file.to_owned(),
            line,
            problem,
        };
        let mut reader = csv::ReaderBuilder::new()
            .buffer_capacity(1 << 20)
            .trim(csv::Trim::None)
            // A field in quotes might go on to the end of the file.
            .quoting(false)
            .from_reader(ShortLines::new(source));
        let header = reader
            .byte_headers()
            .map_err(|error| unreadable(file, &error))?;
        let (columns, axis_letters) = columns_of(header).map_err(|problem| fail(1, problem))?;
        let joint_count = columns
            .iter()
            .filter(|column| matches!(column, Column::Joint(_)))
            .count();

        let mut recording = Recording {
            times: Vec::new(),
            ids: Vec::new(),
            lines: Vec::new(),
            joints: vec![Vec::new(); joint_count],
            axes: axis_letters
                .into_iter()
                .map(|letter| (letter, Vec::new()))
                .collect(),
            resolution: 1.0,
            gaps: Vec::new(),
        };
        let mut decimals = 0;
        let mut row = ByteRecord::new();
        while reader
            .read_byte_record(&mut row)
            .map_err(|error| unreadable(file, &error))?
        {
            let line = row.position().map_or(0, csv::Position::line);
            for (column, field) in columns.iter().zip(row.iter()) {
                recording
                    .push(*column, field, &mut decimals)
                    .map_err(|problem| fail(line, problem))?;
            }
            if let [.., before, now] = recording.times[..]
                && now <= before
            {
                return Err(fail(
                    line,
                    format!("time {now} s does not come after {before} s: one run to a recording"),
                ));
            }
        }
        if recording.rows() < 4 {
            return Err(fail(
                recording.rows() as u64 + 1,
                "the recording ends here; at least 4 rows are needed".to_owned(),
            ));
        }
        recording.resolution = 10f64.powi(-decimals);
        recording.gaps = recording.find_gaps();
        Ok(recording)
    }

    /// How many servo cycles the recording holds.
    pub fn rows(&self) -> usize {
        self.times.len()
    }

    /// The time between two rows that is most common (median), seconds.
    pub fn period(&self) -> f64 {
        let mut steps: Vec<f64> = self
            .times
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .collect();
        let middle = steps.len() / 2;
        *steps.select_nth_unstable_by(middle, f64::total_cmp).1
    }

    fn push(&mut self, column: Column, field: &[u8], decimals: &mut i32) -> Result<(), String> {
        let text = std::str::from_utf8(field).unwrap_or("?").trim();
        let number = || match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(format!("`{text}` is not a finite number")),
        };
        let integer = || {
            text.parse::<i64>()
                .map_err(|_| format!("`{text}` is not a whole number"))
        };
        match column {
            Column::Time => self.times.push(number()?),
            Column::Id => self.ids.push(integer()?),
            Column::Line => self.lines.push(integer()?),
            Column::Joint(index) => self.joints[index].push(number()?),
            Column::Axis(index) => self.axes[index].1.push(number()?),
        }
        if matches!(column, Column::Joint(_) | Column::Axis(_)) {
            *decimals = (*decimals).max(decimals_of(text));
        }
        Ok(())
    }

    /// A step of over 1.5 periods is a gap, unless the next step is short: then that row was only
    /// written late.
    fn find_gaps(&self) -> Vec<usize> {
        let period = self.period();
        let steps: Vec<f64> = self
            .times
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .collect();
        (0..steps.len())
            .filter(|&i| steps[i] > 1.5 * period)
            .filter(|&i| steps.get(i + 1).is_none_or(|next| *next > 0.75 * period))
            .map(|i| i + 1)
            .collect()
    }
}

fn unreadable(file: &Path, error: &csv::Error) -> ReportError {
    let line = match error.kind() {
        csv::ErrorKind::Io(error) => line_of(error).unwrap_or(1),
        _ => error.position().map_or(1, csv::Position::line),
    };
    let problem = match error.kind() {
        csv::ErrorKind::UnequalLengths {
            expected_len, len, ..
        } => format!("{len} fields, but the header has {expected_len}: the row is damaged"),
        _ => error.to_string(),
    };
    ReportError::Recording {
        file: file.to_owned(),
        line,
        problem,
    }
}

/// The meaning of each column, and the letters of the axes in the order of the columns.
fn columns_of(header: &ByteRecord) -> Result<(Vec<Column>, Vec<char>), String> {
    let mut columns = Vec::new();
    let mut letters = Vec::new();
    let mut joints = 0;
    for name in header {
        let name = std::str::from_utf8(name).unwrap_or("?").trim();
        let column = match name {
            "time" => Column::Time,
            "id" => Column::Id,
            "line" => Column::Line,
            _ if name == format!("joint.{joints}") => {
                joints += 1;
                Column::Joint(joints - 1)
            }
            _ => match name.strip_prefix("axis.").map(str::as_bytes) {
                Some(&[letter]) if b"xyzabcuvw".contains(&letter) => {
                    letters.push(char::from(letter));
                    Column::Axis(letters.len() - 1)
                }
                _ => {
                    return Err(format!(
                        "column `{name}` is not expected here: the header is \
                         time,id,line,joint.0,joint.1,..,axis.x,axis.y,.."
                    ));
                }
            },
        };
        if columns.contains(&column) {
            return Err(format!("column `{name}` comes twice"));
        }
        columns.push(column);
    }
    let repeated = (1..letters.len()).find(|&i| letters[..i].contains(&letters[i]));
    if let Some(index) = repeated {
        return Err(format!("column `axis.{}` comes twice", letters[index]));
    }
    for (needed, name) in [
        (Column::Time, "time"),
        (Column::Id, "id"),
        (Column::Line, "line"),
        (Column::Joint(0), "joint.0"),
    ] {
        if !columns.contains(&needed) {
            return Err(format!("column `{name}` is missing in the header"));
        }
    }
    Ok((columns, letters))
}

/// How many decimals a written number has: 3 for `1.250` and for `1.25e-1`.
fn decimals_of(text: &str) -> i32 {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let fraction = mantissa
        .split_once('.')
        .map_or("", |(_, fraction)| fraction);
    let written = i32::try_from(fraction.len()).unwrap_or(i32::MAX);
    // More digits than a double holds add nothing.
    written
        .saturating_sub(exponent.parse().unwrap_or(0))
        .clamp(0, 15)
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// A recording with three joints from positions at 1 ms; the axes follow the joints exactly.
    pub fn recording_of(points: &[[f64; 3]], line_of: impl Fn(usize) -> i64) -> Recording {
        let column = |axis: usize| points.iter().map(|point| point[axis]).collect::<Vec<f64>>();
        Recording {
            times: (0..points.len()).map(|row| row as f64 * 0.001).collect(),
            ids: (0..points.len()).map(&line_of).collect(),
            lines: (0..points.len()).map(&line_of).collect(),
            joints: (0..3).map(column).collect(),
            axes: ['x', 'y', 'z']
                .into_iter()
                .zip((0..3).map(column))
                .collect(),
            resolution: 1e-12,
            gaps: Vec::new(),
        }
    }

    fn parse(text: &str) -> Result<Recording, ReportError> {
        Recording::parse(Path::new("run.csv"), text.as_bytes())
    }

    const HEADER: &str = "time,id,line,joint.0,axis.x\n";
    const ROWS: &str = "0.000,1,5,0.25,0\n0.001,1,5,0.5,0\n0.002,2,6,0.5,0\n0.003,2,6,0.5,-1e-2\n";

    #[test]
    fn columns_resolution_and_period_are_read() {
        let recording = parse(&format!("{HEADER}{ROWS}")).expect("a valid recording");
        assert_eq!(recording.rows(), 4);
        assert_eq!(recording.lines, [5, 5, 6, 6]);
        assert_eq!(recording.joints, [[0.25, 0.5, 0.5, 0.5]]);
        assert_eq!(recording.axes[0], ('x', vec![0.0, 0.0, 0.0, -0.01]));
        assert!((recording.resolution - 0.01).abs() < 1e-15);
        assert!((recording.period() - 0.001).abs() < 1e-12);
        assert!(recording.gaps.is_empty());
    }

    #[test]
    fn missing_cycles_are_found_and_late_rows_are_not() {
        let rows = |times: [f64; 6]| {
            let lines: String = times.iter().map(|t| format!("{t},1,1,0,0\n")).collect();
            parse(&format!("{HEADER}{lines}")).expect("a valid recording")
        };
        let gap = rows([0.0, 0.001, 0.002, 0.005, 0.006, 0.007]);
        assert_eq!(gap.gaps, [3]);
        let late = rows([0.0, 0.001, 0.0027, 0.003, 0.004, 0.005]);
        assert!(late.gaps.is_empty());
    }

    #[test]
    fn errors_name_file_and_line() {
        let message = |text: String| parse(&text).expect_err("an error").to_string();
        let damaged = |row: &str| message(format!("{HEADER}{ROWS}{row}\n"));
        assert_eq!(
            damaged("0.004,2,6,nan,0"),
            "run.csv:6: `nan` is not a finite number"
        );
        assert!(damaged("0.004,2,6").starts_with("run.csv:6: 3 fields, but the header has 5"));
        assert!(damaged("0.003,2,6,0,0").starts_with("run.csv:6: time 0.003 s does not come"));
        assert!(damaged("0.004,2.5,6,0,0").starts_with("run.csv:6: `2.5` is not a whole number"));
        for end in ["\r\n", "\r"] {
            let text = format!("{HEADER}{ROWS}0.004,2,6,nan,0\n").replace('\n', end);
            assert_eq!(message(text), "run.csv:6: `nan` is not a finite number");
        }
        assert!(message(HEADER.to_owned()).starts_with("run.csv:1: the recording ends here"));
        assert!(message("time,id,line\n".to_owned()).starts_with("run.csv:1: column `joint.0`"));
        assert!(message("time,id,line,joint.1\n".to_owned()).contains("`joint.1` is not expected"));
        assert!(message("time,id,line,joint.0,axis.x,axis.x\n".to_owned()).contains("comes twice"));
        assert!(message(String::new()).starts_with("run.csv:1: column `time` is missing"));
    }

    #[test]
    fn decimals_are_counted() {
        for (text, decimals) in [
            ("1", 0),
            ("1.250", 3),
            ("1.25e-1", 3),
            ("3e-12", 12),
            ("5e3", 0),
        ] {
            assert_eq!(decimals_of(text), decimals, "{text}");
        }
    }
}
