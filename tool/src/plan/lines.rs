//! The lines of the moves that the planner has.

use framepath::moves::CAPACITY;
use std::collections::VecDeque;
use std::path::Path;
use std::sync::Arc;

/// Where a move stands.
#[derive(Clone, Debug)]
pub struct Line {
    /// The program, or a file of subroutines.
    pub file: Arc<Path>,
    /// From 1; 0 where nothing has moved yet.
    pub number: i32,
}

/// The moves that were handed over last: LinuxCNC's number, and the line.
#[derive(Debug)]
pub struct Lines {
    handed: VecDeque<(i32, Line)>,
    /// Before the first of them.
    beginning: Line,
}

impl Lines {
    /// Of a program that begins.
    pub fn new(program: &Path) -> Lines {
        Lines {
            handed: VecDeque::new(),
            beginning: Line {
                file: Arc::from(program),
                number: 0,
            },
        }
    }

    /// A move is handed over, with LinuxCNC's number of it.
    pub fn note(&mut self, id: i32, line: Line) {
        self.handed.truncate(CAPACITY);
        self.handed.push_front((id, line));
    }

    /// The line of the last one.
    pub fn last(&self) -> &Line {
        self.handed
            .front()
            .map_or(&self.beginning, |(_, line)| line)
    }

    /// The line of the move with this number; that of the last one where the planner has none with it.
    pub fn of(&self, id: i32) -> &Line {
        let mut handed = self.handed.iter();
        let found = handed.find(|(handed, _)| *handed == id);
        found.map_or(self.last(), |(_, line)| line)
    }
}
