//! The lines of the moves that the planner has.

use framepath::moves::CAPACITY;
use std::collections::VecDeque;

/// The moves that were handed over last: LinuxCNC's number, and the line.
#[derive(Debug, Default)]
pub struct Lines(VecDeque<(i32, i32)>);

impl Lines {
    /// A move is handed over, with LinuxCNC's number of it.
    pub fn note(&mut self, id: i32, line: i32) {
        self.0.truncate(CAPACITY);
        self.0.push_front((id, line));
    }

    /// The line of the last one, 0 for none.
    pub fn last(&self) -> i32 {
        self.0.front().map_or(0, |(_, line)| *line)
    }

    /// The line of the move with this number; that of the last one where the planner has none with it.
    pub fn of(&self, id: i32) -> i32 {
        let mut handed = self.0.iter();
        let found = handed.find(|(handed, _)| *handed == id);
        found.map_or(self.last(), |(_, line)| *line)
    }
}
