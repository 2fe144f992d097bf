//! Merging of short lines ("naive cam"): lines at feed are held back and joined as long as all their
//! ends stay within the tolerance of the joined line.

use super::Layer;
use crate::canon::call::Tag;
use crate::layer::program::MotionType;
use crate::path::Position;
use crate::path::segment::{Segment, distance_to_chord};

/// More points are not joined.
const MOST_POINTS: usize = 100;

/// A line that is held back.
#[derive(Clone, Copy, Debug)]
struct Held {
    end: Position,
    line: i32,
    tag: Tag,
}

/// The lines that are held back.
#[derive(Clone, Debug, Default)]
pub(super) struct Chain {
    held: Vec<Held>,
    /// G64 Q, mm; 0 keeps all lines apart.
    pub tolerance: f64,
}

impl Layer<'_> {
    /// A straight move at feed.
    pub(super) fn feed(&mut self, line: i32, end: Position) {
        self.break_before(&end);
        if end != self.programmed_end {
            self.programmed_line(line, end);
        }
        self.hold(line, end);
        self.programmed_end = end;
    }

    /// A flat arc that is passed on as two lines over `middle`, without so many whole turns of it.
    pub(super) fn feed_flat_arc(
        &mut self,
        line: i32,
        (arc, turns): (Segment, u32),
        middle: Position,
    ) {
        self.break_before(&middle);
        self.builder.piece(line, arc);
        self.builder.leave_turns_away(turns);
        self.hold(line, middle);
        if !self.chain.held.is_empty() && !self.linkable(&arc.end) {
            self.flush();
        }
        if self.chain.held.is_empty() {
            // Its second half goes into the next move, which begins with the same arc.
            self.builder.repeat_piece();
        }
        self.hold(line, arc.end);
        self.programmed_end = arc.end;
    }

    /// Where the end of what is held back is.
    pub(super) fn last_height(&self) -> f64 {
        self.chain
            .held
            .last()
            .map_or(self.end[2], |held| held.end[2])
    }

    /// Hands over what is held back, as one line.
    pub(super) fn flush(&mut self) {
        let Some(last) = self.chain.held.last().copied() else {
            return;
        };
        self.chain.held.clear();
        let straight = self.straight(&last.end);
        let velocity = self.feed_velocity(&straight);
        if (velocity > 0.0 && straight.acceleration() > 0.0) || self.synchronised {
            self.hand_line(
                last.line,
                last.end,
                MotionType::Feed,
                velocity,
                &straight,
                last.tag,
            );
        }
        self.end = last.end;
    }

    fn break_before(&mut self, end: &Position) {
        if !self.chain.held.is_empty() && !self.linkable(end) {
            self.flush();
        }
    }

    fn hold(&mut self, line: i32, end: Position) {
        let tag = self.tag;
        self.chain.held.push(Held { end, line, tag });
        // Lines with rotary axes or U V W are not joined.
        if end[3..] != self.end[3..] {
            self.flush();
        }
    }

    fn linkable(&self, end: &Position) -> bool {
        let Some(last) = self.chain.held.last() else {
            return false;
        };
        self.continuous()
            && self.chain.tolerance > 0.0
            && self.chain.held.len() <= MOST_POINTS
            && end[3..] == last.end[3..]
            && end[..3] != self.end[..3]
            && self
                .chain
                .held
                .iter()
                .all(|held| distance_to_chord(&held.end, &self.end, end) <= self.chain.tolerance)
    }
}
