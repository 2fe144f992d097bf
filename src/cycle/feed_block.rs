//! What a quick look at the cells ahead needs of sixteen of them.

use super::stored_cell::{OverrideKind, StoredCell};

/// Cells of a block. A power of two.
pub const BLOCK_LENGTH: usize = 16;

/// The greatest feeds in a block of cells, for a quick look at what lies ahead.
#[derive(Clone, Copy, Debug)]
pub struct FeedBlock {
    /// Greatest feed at a rate of 1.
    pub feed: f32,
    /// Greatest programmed feed.
    pub programmed: f32,
    /// Greatest feed over programmed feed where the feed override applies.
    pub feed_over_programmed: f32,
    /// The same where the rapid override applies.
    pub rapid_over_programmed: f32,
    /// The same where no override applies.
    pub fixed_over_programmed: f32,
    /// The same for feed per turn, with and without the feed override.
    pub turns_over_programmed: f32,
    pub fixed_turns_over_programmed: f32,
    /// Greatest turns a second that feed per turn is planned for.
    pub planned_turns: f32,
}

impl FeedBlock {
    pub const EMPTY: Self = Self {
        feed: 0.0,
        programmed: 0.0,
        feed_over_programmed: 0.0,
        rapid_over_programmed: 0.0,
        fixed_over_programmed: 0.0,
        turns_over_programmed: 0.0,
        fixed_turns_over_programmed: 0.0,
        planned_turns: 0.0,
    };

    pub fn include(&mut self, cell: &StoredCell) {
        let ratio = (cell.feed() / f64::from(cell.programmed_feed)) as f32;
        let greatest = match cell.override_kind {
            OverrideKind::Feed => &mut self.feed_over_programmed,
            OverrideKind::Rapid => &mut self.rapid_over_programmed,
            OverrideKind::None => &mut self.fixed_over_programmed,
            OverrideKind::Turns => &mut self.turns_over_programmed,
            OverrideKind::TurnsOnly => &mut self.fixed_turns_over_programmed,
        };
        *greatest = greatest.max(ratio);
        self.feed = self.feed.max(cell.feed() as f32);
        self.programmed = self.programmed.max(cell.programmed_feed);
        self.planned_turns = self.planned_turns.max(cell.planned_turns);
    }

    /// The same block if the reference were as fast as programmed in all of it.
    pub fn as_programmed(&self) -> Self {
        let full = |ratio: f32| if ratio > 0.0 { 1.0 } else { 0.0 };
        // Feed per turn is planned with a reserve, for more turns than there are.
        let planned = |ratio: f32| full(ratio) * self.planned_turns;
        Self {
            feed: self.programmed,
            programmed: self.programmed,
            feed_over_programmed: full(self.feed_over_programmed),
            rapid_over_programmed: full(self.rapid_over_programmed),
            fixed_over_programmed: full(self.fixed_over_programmed),
            turns_over_programmed: planned(self.turns_over_programmed),
            fixed_turns_over_programmed: planned(self.fixed_turns_over_programmed),
            planned_turns: self.planned_turns,
        }
    }
}
