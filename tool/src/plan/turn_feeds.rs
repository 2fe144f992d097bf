//! Feed per turn of the moves that follow the spindle.

use std::collections::VecDeque;

/// Which moves follow the spindle, and how far they go in a turn of it.
#[derive(Debug, Default)]
pub struct TurnFeeds {
    /// Of the moves to come, machine units; 0: they do not follow.
    to_come: f64,
    /// From the move with this number on, the first of them the one that runs or ran last.
    from: VecDeque<(usize, f64)>,
}

impl TurnFeeds {
    /// The moves to come go so far in a turn, machine units; 0: they do not follow the spindle.
    pub fn set(&mut self, per_turn: f64) {
        self.to_come = per_turn;
    }

    /// The planner was given the move with this number.
    pub fn add(&mut self, index: usize) {
        if self.from.back().map_or(0.0, |last| last.1) != self.to_come {
            self.from.push_back((index, self.to_come));
        }
    }

    /// How far the move that runs goes in a turn; `None` if it does not follow the spindle.
    pub fn running(&mut self, index: usize) -> Option<f64> {
        while self.from.get(1).is_some_and(|next| next.0 <= index) {
            self.from.pop_front();
        }
        let (from, per_turn) = *self.from.front()?;
        (from <= index && per_turn != 0.0).then_some(per_turn)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_move_has_the_feed_that_was_set_before_it() {
        let mut feeds = TurnFeeds::default();
        for (index, per_turn) in [0.0, 0.2, 0.2, 0.0, 0.5].into_iter().enumerate() {
            feeds.set(per_turn);
            feeds.add(index);
        }
        let found = [0, 1, 2, 3, 4].map(|index| feeds.running(index));
        assert_eq!(found, [None, Some(0.2), Some(0.2), None, Some(0.5)]);
    }
}
