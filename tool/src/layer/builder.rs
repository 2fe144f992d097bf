//! The list of operations, and the pieces of path that belong to each move.

use crate::canon::call::PathMode;
use crate::layer::program::{Move, Operation, Piece, Program, Shape};
use crate::path::segment::Segment;

/// Collects a program.
pub(super) struct Builder {
    pub(super) program: Program,
    mode: PathMode,
    /// G64 P, mm.
    tolerance: f64,
    /// First of the pieces that belong to no move yet.
    pub(super) first_free: usize,
}

impl Builder {
    pub(super) fn new() -> Self {
        let mut builder = Builder {
            program: Program::default(),
            mode: PathMode::Continuous,
            tolerance: 0.0,
            first_free: 0,
        };
        builder.mode(PathMode::Continuous, 0.0);
        builder
    }

    pub(super) fn operation(&mut self, operation: Operation) {
        self.program.operations.push(operation);
    }

    pub(super) fn path_mode(&self) -> PathMode {
        self.mode
    }

    pub(super) fn mode(&mut self, mode: PathMode, tolerance: f64) {
        self.mode = mode;
        self.tolerance = if mode == PathMode::Continuous {
            tolerance
        } else {
            0.0
        };
        self.operation(Operation::Termination(mode, self.tolerance));
    }

    /// What comes next waits for the end of motion.
    pub(super) fn wait(&mut self) {
        if !matches!(
            self.program.operations.last(),
            Some(Operation::WaitForMotion)
        ) {
            self.operation(Operation::WaitForMotion);
        }
        self.stop();
    }

    /// Motion comes to its end behind the last move.
    fn stop(&mut self) {
        if let Some(piece) = self.program.handed.last_mut() {
            piece.stops = true;
        }
    }

    /// A piece of the program, of the next move that is handed over.
    pub(super) fn piece(&mut self, line: i32, segment: Segment) {
        let move_index = self.program.handed.len();
        let piece = Piece {
            segment,
            line,
            move_index,
            mode: self.mode,
            tolerance: self.tolerance,
            merged_within: 0.0,
            turns_left_away: 0,
            stops: false,
        };
        self.program.programmed.push(piece);
    }

    /// So many whole turns of the last piece are left away.
    pub(super) fn leave_turns_away(&mut self, turns: u32) {
        if let Some(piece) = self.program.programmed.last_mut() {
            piece.turns_left_away = turns;
        }
    }

    /// The last piece belongs to the next move, too.
    pub(super) fn repeat_piece(&mut self) {
        self.first_free = self
            .first_free
            .min(self.program.programmed.len().saturating_sub(1));
    }

    /// A move for the planner, made of all pieces that belong to no move yet.
    pub(super) fn hand(&mut self, mut handed: Move, segment: Segment) {
        if handed.at_speed {
            // A planner waits for the spindle at rest.
            self.stop();
        }
        let program = &mut self.program;
        handed.index = program.handed.len();
        if segment.start[3..] != segment.end[3..] {
            program.other_axes = true;
        }
        program.handed.push(Piece {
            segment,
            line: handed.line,
            move_index: handed.index,
            mode: self.mode,
            tolerance: self.tolerance,
            merged_within: 0.0,
            turns_left_away: 0,
            stops: matches!(handed.shape, Shape::Tap),
        });
        let last = program.programmed.len().saturating_sub(1);
        let first = self.first_free.min(last);
        program.ranges.push((first, last));
        self.first_free = program.programmed.len();
        program.operations.push(Operation::Move(Box::new(handed)));
    }

    /// The program, with what merging may have done noted in the pieces that it touched.
    pub(super) fn finish(mut self) -> Program {
        let program = &mut self.program;
        if program.handed.is_empty() {
            program.programmed.clear();
        }
        let most = program.handed.len().saturating_sub(1);
        for piece in &mut program.programmed {
            piece.move_index = piece.move_index.min(most);
        }
        for (index, &(first, last)) in program.ranges.iter().enumerate() {
            let Some(pieces) = program.programmed.get_mut(first..=last) else {
                continue;
            };
            let handed = &program.handed[index].segment;
            let far = pieces
                .iter()
                .map(|piece| merged(piece, handed))
                .fold(0.0, f64::max);
            for piece in pieces {
                piece.merged_within = piece.merged_within.max(far);
            }
        }
        self.program
    }
}

/// How far merging has taken the move that stands for a programmed piece from it. What is lost with whole turns is a fault, and
/// widens no tolerance.
pub(super) fn merged(piece: &Piece, handed: &Segment) -> f64 {
    if piece.segment == *handed {
        return 0.0;
    }
    let piece = piece.segment.without_turns(piece.turns_left_away);
    [0.0, 0.25, 0.5, 0.75, 1.0]
        .iter()
        .map(|&u| handed.nearest(&piece.point(u)).0)
        .fold(0.0, f64::max)
}
