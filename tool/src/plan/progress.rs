//! How far the work is: a bar with an estimate, on a terminal only.

use crate::format::time_left;
use indicatif::{ProgressBar, ProgressStyle};
use std::time::{Duration, Instant};

/// The bar comes when the work takes longer than this.
const PATIENCE: Duration = Duration::from_millis(700);

/// Servo cycles between two looks at the clock.
const CYCLES: u64 = 4096;

/// The bar of a program.
pub struct Progress {
    name: String,
    lines: u64,
    started: Instant,
    cycles: u64,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// `lines` is the length of the program.
    pub fn new(name: &str, lines: u64) -> Self {
        Progress {
            name: name.to_owned(),
            lines,
            started: Instant::now(),
            cycles: 0,
            bar: None,
        }
    }

    /// A servo cycle of motion on this line, at this time of the plan.
    pub fn note(&mut self, line: i32, time: f64) {
        self.cycles += 1;
        if !self.cycles.is_multiple_of(CYCLES) || self.started.elapsed() < PATIENCE {
            return;
        }
        // Subroutines and loops go back.
        let before = self.bar.as_ref().map_or(0, ProgressBar::position);
        let line = u64::try_from(line).unwrap_or(0).min(self.lines).max(before);
        let left = time_left(self.started.elapsed(), line, self.lines);
        let message = format!("{time:.0} s of the machine's time{left}");
        match &self.bar {
            Some(bar) => {
                bar.set_message(message);
                bar.set_position(line);
            }
            None => self.bar = Some(self.begin(line, message)),
        }
    }

    /// The bar as it is drawn first, with all that it says.
    fn begin(&self, line: u64, message: String) -> ProgressBar {
        let bar = ProgressBar::new(self.lines)
            .with_prefix(self.name.clone())
            .with_message(message)
            .with_position(line);
        // Without colours it is the same bar on every terminal.
        let template = "{prefix} {wide_bar} line {human_pos} of {human_len}, {msg}";
        match ProgressStyle::with_template(template) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        }
    }

    /// Takes the bar away.
    pub fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}
