//! Arcs of several turns that LinuxCNC runs without them, in words.

use crate::layer::program::Piece;
use serde::Serialize;

/// Arcs whose whole turns LinuxCNC leaves away.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct TurnsLeftAway {
    /// How many arcs.
    pub arcs: usize,
    /// Line of the first one.
    pub line: i32,
    /// Its turns.
    pub turns: u32,
}

impl TurnsLeftAway {
    /// A piece of the program.
    pub(crate) fn note(&mut self, piece: &Piece) {
        if piece.turns_left_away == 0 {
            return;
        }
        if self.arcs == 0 {
            (self.line, self.turns) = (piece.line, piece.turns_left_away);
        }
        self.arcs += 1;
    }

    /// No arc loses any.
    pub(crate) fn is_none(&self) -> bool {
        self.arcs == 0
    }

    /// What is wrong, if anything is.
    pub(crate) fn told(&self) -> Option<String> {
        let turns = match self.turns {
            1 => "a whole turn".to_owned(),
            turns => format!("{turns} whole turns"),
        };
        let others = match self.arcs {
            0 => return None,
            1 => String::new(),
            arcs => format!(", the first of {arcs} such arcs"),
        };
        Some(format!(
            "LinuxCNC leaves {turns} of the arc at line {} away{others}: what is left of it without them is lower than Q of G64, and is \
             run as lines; write the whole turns as an arc of their own, which ends where it begins, or G64 with Q0",
            self.line
        ))
    }
}
