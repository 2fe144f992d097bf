//! How far the machine sees: the time and the place of the rest at the end of what is planned.

use super::reference::Reference;
use crate::moves::MoveQueue;

/// What is planned from where the machine is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeAhead {
    /// Seconds of the reference: of time, while nothing slows the machine down.
    pub seconds: f64,
    /// Where it comes to rest, path distance.
    pub end: f64,
}

/// How much of the moves lies behind a place of the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceInMoves {
    /// Serial number of the move that the place lies in, or at whose end.
    pub serial: u64,
    /// The share of the move, or of the merged ones that end with it, that is behind the place.
    pub left: f64,
    /// Serial number of the first of them.
    pub first: u64,
}

impl Reference {
    /// Goes on with the sums of how long the plans take. Once in each servo period; nothing that is run depends on it.
    pub fn sum_time(&mut self) {
        for run in &mut self.runs {
            run.sum_time();
        }
    }

    /// What is planned from where the machine is; the plan as it was summed last.
    pub fn time_ahead(&self) -> TimeAhead {
        let mut ahead = TimeAhead {
            seconds: (self.segments.duration() - self.elapsed).max(0.0),
            end: self.rest,
        };
        if !self.active || !ahead.seconds.is_finite() {
            return TimeAhead {
                seconds: 0.0,
                ..ahead
            };
        }
        // What goes on with the run that has been handed out in part, and the one that begins where that ends.
        let (current, other) = (self.current(), self.other());
        let mut next = Some(current);
        if self.resting && !current.starts_at(self.rest) {
            next = Some(other).filter(|other| other.starts_at(self.rest));
        }
        for _ in &self.runs {
            let Some(end) = next.and_then(|run| run.planned_end()) else {
                break;
            };
            ahead.seconds += end.time;
            ahead.end = end.place;
            next = Some(other).filter(|other| other.starts_at(end.place));
        }
        ahead
    }

    /// Where a place of the path lies in the moves; `None` if there is no path.
    pub fn place_in_moves(&self, queue: &MoveQueue, s: f64) -> Option<PlaceInMoves> {
        let leg = self.path.leg_before(s)?;
        let length = leg.end - leg.start;
        let left = if length > 0.0 {
            ((leg.end - s) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        Some(PlaceInMoves {
            serial: leg.serial,
            left,
            first: leg.first.max(queue.oldest()),
        })
    }
}
