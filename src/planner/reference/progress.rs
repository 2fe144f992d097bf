//! Where the machine is on the reference.

use super::reference::{Reference, ReferencePoint, Rest};
use crate::moves::MoveQueue;

/// A path this near to the end of a move ends there, machine units.
const ROUNDING: f64 = 1e-9;

impl Reference {
    /// Goes on by `duration` seconds, not beyond what was handed out, and says where that is;
    /// `None` if nothing was handed out.
    pub fn advance(&mut self, queue: &MoveQueue, duration: f64) -> Option<ReferencePoint> {
        self.elapsed += duration;
        while let Some(front) = self.segments.front()
            && self.segments.len() > 1
            && self.elapsed >= front.duration
        {
            self.elapsed -= front.duration;
            self.segments.pop();
        }
        let segment = self.segments.front()?;
        let state = segment.state(self.elapsed, self.elapsed);
        let [position, direction] = segment.position_and_direction(&self.path, state.distance);
        let s = segment.path_distance(state.distance);
        self.path.discard_before(s);
        let leg = self.path.leg(s)?;
        let velocity = leg.measure_rate * self.path.distance(&direction) * state.velocity;
        let (serial, distance_to_go) = self.running(queue, s)?;
        Some(ReferencePoint {
            serial,
            distance_to_go,
            velocity,
            position,
        })
    }

    /// Serial number of the move at path distance `s`, and what F will count until its end.
    ///
    /// Where lines were merged it is told by their lengths.
    pub(super) fn running(&self, queue: &MoveQueue, s: f64) -> Option<(u64, f64)> {
        let progress = self.path.progress(s)?;
        let first = progress.first.max(queue.oldest());
        if first >= progress.serial {
            return Some((progress.serial, progress.distance_to_go));
        }
        let lengths = |from: u64| {
            (from..=progress.serial)
                .filter_map(|serial| queue.get(serial))
                .map(|queued| queued.shape.length())
        };
        // Counted from the end, since the moves at the start may be forgotten.
        let mut left: f64 = lengths(first).sum();
        for serial in first..progress.serial {
            let length = queue.get(serial)?.shape.length();
            if progress.distance_to_go > left - length {
                return Some((serial, progress.distance_to_go - (left - length)));
            }
            left -= length;
        }
        Some((progress.serial, progress.distance_to_go.min(left)))
    }

    /// The machine has come to the end of what was handed out, at rest.
    pub fn come_to_rest(&mut self, queue: &MoveQueue) -> Rest {
        let s = self.rest;
        let before = self.path.point_before(s);
        let rest = match self.path.leg_ending_at(s) {
            Some((serial, end)) => Rest {
                next: serial + 1,
                // Within a rounded corner the path does not come by the end of the move.
                position: if (end - before.position).amax() < ROUNDING {
                    end
                } else {
                    before.position
                },
            },
            None => Rest {
                // Of merged moves the one at the rest, not the last one.
                next: self
                    .running(queue, s)
                    .map_or(self.feeder.next(), |(serial, _)| serial),
                position: before.position,
            },
        };
        self.rested(s);
        if rest.next >= self.feeder.next() && !self.backwards {
            self.active = false;
        }
        rest
    }
}
