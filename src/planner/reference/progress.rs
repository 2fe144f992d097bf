//! Where the machine is on the reference.

use super::reference::{Reference, ReferencePoint, Rest};
use super::running_move::running;
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
        let (serial, distance_to_go) = running(&self.path, queue, s)?;
        Some(ReferencePoint {
            serial,
            distance_to_go,
            velocity,
            position,
        })
    }

    /// Where the machine is, path distance.
    pub(super) fn place(&self) -> f64 {
        match self.segments.front() {
            Some(segment) => {
                let state = segment.state(self.elapsed, self.elapsed);
                segment.path_distance(state.distance)
            }
            None => self.rest,
        }
    }

    /// On the way on, at rest: what F will count until the end of the first move of the queue, if the machine is in it.
    pub fn distance_to_go_at_rest(&self, queue: &MoveQueue) -> Option<f64> {
        if !self.active || self.backwards {
            return None;
        }
        let (serial, distance_to_go) = running(&self.path, queue, self.rest)?;
        (serial == queue.first_serial()).then_some(distance_to_go)
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
                next: running(&self.path, queue, s)
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
