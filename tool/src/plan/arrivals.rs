//! When moves reached the planner in a LinuxCNC that ran: with the same arrivals a plan has the same
//! positions in every servo cycle.

use super::error::PlanError;
use std::path::{Path, PathBuf};

/// The cycles in which something changed, from a file of lines `CYCLE MOVES SCALE`: from this cycle
/// of the servo thread on so many moves have reached the planner, and all feeds are multiplied by
/// the scale (0 to 1; 0 holds the machine).
#[derive(Debug)]
pub struct Arrivals {
    file: PathBuf,
    changes: Vec<Change>,
    /// How many of them are past.
    passed: usize,
    now: Change,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Change {
    cycle: u64,
    moves: usize,
    scale: f64,
}

/// Before anything has come.
const NOTHING: Change = Change {
    cycle: 0,
    moves: 0,
    scale: 1.0,
};

impl Arrivals {
    /// # Errors
    /// A file that cannot be read, or a line that is no change, or comes too soon.
    pub fn read(file: &Path) -> Result<Self, PlanError> {
        let unusable =
            |problem: String| PlanError::Option(format!("{}: {problem}", file.display()));
        let text = std::fs::read_to_string(file)
            .map_err(|error| unusable(format!("cannot be read: {error}")))?;
        let mut changes: Vec<Change> = Vec::new();
        for (line, words) in (1..).zip(text.lines()) {
            let change = change(words).ok_or_else(|| {
                unusable(format!(
                    "line {line}: `{words}` is not a cycle, a number of moves and a scale from 0 to 1"
                ))
            })?;
            let before = changes.last().unwrap_or(&NOTHING);
            let ordered =
                before.moves <= change.moves && (changes.is_empty() || before.cycle < change.cycle);
            if !ordered {
                return Err(unusable(format!(
                    "line {line}: cycles have to rise, and moves must not fall"
                )));
            }
            changes.push(change);
        }
        Ok(Arrivals {
            file: file.to_owned(),
            changes,
            passed: 0,
            now: NOTHING,
        })
    }

    /// Goes on to a cycle.
    pub fn pass_to(&mut self, cycle: u64) {
        while let Some(change) = self.changes.get(self.passed) {
            if change.cycle > cycle {
                break;
            }
            self.now = *change;
            self.passed += 1;
        }
    }

    /// Moves that have reached the planner.
    pub fn moves(&self) -> usize {
        self.now.moves
    }

    /// What all feeds are multiplied by.
    pub fn scale(&self) -> f64 {
        self.now.scale
    }

    /// Whether they hold the machine, which has moves to go.
    ///
    /// # Errors
    /// If nothing lets it go any more.
    pub fn hold(&self) -> Result<bool, PlanError> {
        if self.scale() > 0.0 || self.passed < self.changes.len() {
            return Ok(self.scale() == 0.0);
        }
        Err(PlanError::Option(format!(
            "{}: holds the machine for good from cycle {} on, with moves to go: add a line whose scale is above 0",
            self.file.display(),
            self.now.cycle
        )))
    }

    /// What to say when the program has more moves than were recorded.
    ///
    /// # Errors
    /// If nothing more was recorded.
    pub fn expect_more(&self) -> Result<(), PlanError> {
        if self.passed < self.changes.len() {
            return Ok(());
        }
        Err(PlanError::Option(format!(
            "{}: ends with {} moves, the program has more: it belongs to another program",
            self.file.display(),
            self.now.moves
        )))
    }
}

fn change(line: &str) -> Option<Change> {
    let mut words = line.split_whitespace();
    let change = Change {
        cycle: words.next()?.parse().ok()?,
        moves: words.next()?.parse().ok()?,
        scale: words.next()?.parse().ok()?,
    };
    let sound = words.next().is_none() && (0.0..=1.0).contains(&change.scale);
    sound.then_some(change)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    fn read(text: &str) -> Result<Arrivals, String> {
        let mut file = tempfile::NamedTempFile::new().expect("a file");
        file.write_all(text.as_bytes()).expect("written");
        Arrivals::read(file.path()).map_err(|error| error.to_string())
    }

    #[test]
    fn changes_hold_from_their_cycle_on() {
        let mut arrivals = read("3 1 0\n4 2 0\n9 3 1\n").expect("sound");
        let mut seen = Vec::new();
        for cycle in 2..11 {
            arrivals.pass_to(cycle);
            seen.push((arrivals.moves(), arrivals.scale() as i32));
        }
        let held = [(2, 0); 5];
        assert_eq!(seen[..2], [(0, 1), (1, 0)]);
        assert_eq!(seen[2..7], held);
        assert_eq!(seen[7..], [(3, 1), (3, 1)]);
        assert!(arrivals.expect_more().is_err());
    }

    #[test]
    fn what_makes_no_sense_is_refused_with_its_line() {
        for (text, words) in [
            ("1 2 1\nx 2 1\n", "line 2: `x 2 1` is not"),
            ("1 2 1.5\n", "line 1"),
            ("1 2\n", "line 1"),
            ("1 2 1 4\n", "line 1"),
            ("1 2 1\n1 3 1\n", "line 2: cycles have to rise"),
            ("1 2 1\n2 1 1\n", "line 2: cycles have to rise"),
        ] {
            let error = read(text).expect_err("refused");
            assert!(error.contains(words), "{error}");
        }
    }
}
