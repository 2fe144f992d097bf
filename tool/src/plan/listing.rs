//! The text of the program, as much of it as is shown.

use super::collector::Collected;
use super::figures::Figures;
use serde::Serialize;
use std::collections::HashSet;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

/// A program with more lines is not listed as a whole.
const MOST_LINES: u64 = 15_000;

/// Lines of a long program that are kept for the cursor, at most.
const MOST_KEPT: usize = 20_000;

/// Characters of a line that are kept.
const WIDTH: usize = 120;

/// The lines of the program that are shown.
#[derive(Debug, Default, Serialize)]
pub struct Listing {
    /// Whether it is the whole program, or only the lines of drawn points.
    pub whole: bool,
    /// Number and text, in order.
    pub lines: Vec<(i32, String)>,
}

impl Listing {
    /// Writes the lines into the figures, where they are of the program.
    pub fn put_into(&self, figures: &mut Figures) {
        for place in &mut figures.slowest {
            place.text = self.text_of(place.line, place.of_program);
        }
        for stretch in &mut figures.evenness.below {
            stretch.text = self.text_of(stretch.line, stretch.of_program);
        }
    }

    fn text_of(&self, line: i32, of_program: bool) -> String {
        match of_program {
            true => self.text(line),
            false => String::new(),
        }
    }

    /// A line, empty if it is not kept.
    fn text(&self, line: i32) -> String {
        let found = self
            .lines
            .binary_search_by_key(&line, |(number, _)| *number);
        found
            .ok()
            .and_then(|index| self.lines.get(index))
            .map_or(String::new(), |(_, text)| text.trim().to_owned())
    }
}

/// How many lines a program has; 0 if it cannot be read, which others report.
pub fn count_lines(file: &Path) -> u64 {
    let Ok(file) = File::open(file) else { return 0 };
    let mut input = BufReader::with_capacity(1 << 18, file);
    let mut count = 0;
    loop {
        match input.fill_buf() {
            Ok([]) | Err(_) => return count,
            Ok(bytes) => {
                count += bytes.iter().filter(|byte| **byte == b'\n').count() as u64;
                let length = bytes.len();
                input.consume(length);
            }
        }
    }
}

/// Reads the lines that are shown. A file that has gone by now has none.
pub fn read(file: &Path, figures: &Figures, collected: &Collected) -> Listing {
    let whole = count_lines(file) <= MOST_LINES;
    let wanted = if whole {
        HashSet::new()
    } else {
        wanted_lines(figures, collected)
    };
    let Ok(file) = File::open(file) else {
        return Listing::default();
    };
    let mut lines = Vec::new();
    let texts = BufReader::new(file).split(b'\n').map_while(Result::ok);
    for (number, text) in (1..).zip(texts) {
        if whole || wanted.contains(&number) {
            let text = String::from_utf8_lossy(&text);
            let shown = text.trim_end().chars().take(WIDTH).collect();
            lines.push((number, shown));
        }
    }
    Listing { whole, lines }
}

/// Those of the slowest places and of drawn points, evenly.
fn wanted_lines(figures: &Figures, collected: &Collected) -> HashSet<i32> {
    let stride = (collected.path.len() / MOST_KEPT).max(1);
    let drawn = collected.path.iter().step_by(stride);
    figures
        .slowest
        .iter()
        .map(|place| place.line)
        .chain(figures.evenness.below.iter().map(|stretch| stretch.line))
        .chain(drawn.map(|point| point.line))
        .collect()
}
