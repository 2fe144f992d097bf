//! How fast the machine goes in X Y Z, over the F of the moves that run.

use framepath::axes::Axes;
use framepath::moves::MotionType;
use framepath::planner::{Added, Status};

use super::Programmed;
use crate::common::PERIOD;

/// The greatest speed over F.
pub struct FeedWatch {
    /// Of each move, by its number from 1 on; infinite for a rapid one.
    feeds: Vec<f64>,
    /// The move that ran last.
    reached: usize,
    before: Axes,
    fastest: f64,
}

impl FeedWatch {
    pub fn new() -> Self {
        Self {
            feeds: vec![f64::INFINITY],
            reached: 1,
            before: Axes::zeros(),
            fastest: 0.0,
        }
    }

    pub fn supply(&mut self, programmed: &Programmed, added: Added) {
        self.feeds.push(match (added, programmed.motion_type) {
            // It never runs.
            (Added::ZeroLength, _) => 0.0,
            (_, MotionType::Traverse) => f64::INFINITY,
            _ => programmed.feed,
        });
    }

    pub fn look(&mut self, status: &Status) {
        let way = (status.position - self.before).fixed_rows::<3>(0).norm();
        // Where none runs any more the last ones may have begun and ended within this period.
        let last = match status.exec_id {
            1.. => status.exec_id as usize,
            _ => self.feeds.len() - 1,
        };
        let feed = self.feeds[self.reached.min(last)..=last]
            .iter()
            .copied()
            .fold(0.0, f64::max);
        if way > 0.0 {
            self.fastest = self.fastest.max(way / PERIOD / feed);
        }
        self.reached = self.reached.max(status.exec_id.max(0) as usize);
        self.before = status.position;
    }

    pub fn fastest(&self) -> f64 {
        self.fastest
    }
}
