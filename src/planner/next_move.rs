//! What is set for the next move before it comes.

use super::request::MoveRequest;
use crate::moves::shape::Shape;
use crate::moves::{
    FeedWord, MotionType, ProgrammedFeed, SynchronisedOutputs, TerminationCondition,
};

/// What the next move gets besides what comes with it.
#[derive(Clone, Copy, Debug)]
pub(super) struct NextMove {
    /// LinuxCNC's number.
    pub id: i32,
    /// How it meets the one behind it.
    pub termination: TerminationCondition,
    /// The F of the program, if it is one for a minute.
    pub feed_word: Option<FeedWord>,
    /// What is known of it from the moves before.
    programmed_feed: ProgrammedFeed,
    /// What is written at its start.
    pub outputs: SynchronisedOutputs,
}

impl NextMove {
    pub const FIRST: Self = Self {
        id: 0,
        termination: TerminationCondition::Continuous { tolerance: 0.0 },
        feed_word: None,
        programmed_feed: ProgrammedFeed::UNKNOWN,
        outputs: SynchronisedOutputs::NONE,
    };

    /// The move is queued: the one behind it has the next number, no F and no outputs yet.
    pub fn pass_on(&mut self) {
        self.id = self.id.wrapping_add(1);
        self.feed_word = None;
        self.clear_outputs();
    }

    /// Feed and greatest velocity of the move, which no spindle tells the speed of. `first`: nothing is to be done before it, and
    /// what was known of F is of another program.
    pub fn feeds(&mut self, shape: &Shape, request: &MoveRequest, first: bool) -> [f64; 2] {
        if first {
            self.programmed_feed = ProgrammedFeed::UNKNOWN;
        }
        let handed = [request.feed, request.max_velocity];
        let cuts = matches!(request.motion_type, MotionType::Feed | MotionType::Arc);
        if cuts && !shape.is_rotary() {
            let is_arc = matches!(shape, Shape::Arc(_));
            self.programmed_feed.of_move(is_arc, handed, self.feed_word)
        } else {
            handed
        }
    }

    /// Drops the outputs.
    pub fn clear_outputs(&mut self) {
        self.outputs = SynchronisedOutputs::NONE;
    }
}
