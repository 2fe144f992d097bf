//! What the planner does not say of the move that runs.

use std::collections::VecDeque;

/// How a move is run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Kind {
    /// How far it goes in a turn of the spindle, machine units; 0: it does not follow it.
    pub per_turn: f64,
    /// Nothing but rotary axes moves: the greatest velocity along the path does not count.
    pub is_rotary: bool,
}

/// The kinds of the moves that the planner has, where they change.
#[derive(Debug, Default)]
pub struct Kinds {
    /// From the move with this number on, the first of them the one that runs or ran last.
    from: VecDeque<(usize, Kind)>,
}

impl Kinds {
    /// The planner was given the move with this number.
    pub fn add(&mut self, index: usize, kind: Kind) {
        if self.from.back().is_none_or(|last| last.1 != kind) {
            self.from.push_back((index, kind));
        }
    }

    /// That of the move that runs.
    pub fn running(&mut self, index: usize) -> Kind {
        while self.from.get(1).is_some_and(|next| next.0 <= index) {
            self.from.pop_front();
        }
        self.from.front().map_or(Kind::default(), |first| first.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_move_has_the_kind_that_it_was_given_with() {
        let mut kinds = Kinds::default();
        let given = [
            (0.0, false),
            (0.2, false),
            (0.2, false),
            (0.0, true),
            (0.5, false),
        ];
        let given = given.map(|(per_turn, is_rotary)| Kind {
            per_turn,
            is_rotary,
        });
        for (index, kind) in given.into_iter().enumerate() {
            kinds.add(index, kind);
        }
        assert_eq!([0, 1, 2, 3, 4].map(|index| kinds.running(index)), given);
    }
}
