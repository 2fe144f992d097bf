//! The segments of a reference that were handed out and are not yet behind the machine.

use super::coast::Coast;
use crate::axes::Axes;
use crate::moves::shape::PathPoint;
use crate::path::BlendedPath;
use crate::ring::Ring;
use crate::speed::{JerkLimitedProfile, ProfileState, look_ahead};

/// How s depends on time in a segment.
#[derive(Clone, Copy, Debug)]
#[allow(
    clippy::large_enum_variant,
    reason = "segments lie in slots of equal size, without a heap"
)]
pub(super) enum SegmentMotion {
    /// A move from rest to rest, or what is left of it.
    Move(ProfiledMotion),
    /// A segment of what the look-ahead planned.
    Run(look_ahead::PlannedSegment),
    /// The same, back along the path: its distance is the path distance with the other sign.
    Return(look_ahead::PlannedSegment),
    /// A stretch of the path from rest to rest for which the look-ahead found no plan.
    Creep(ProfiledMotion),
    /// The same, back along the path.
    CreepBack(ProfiledMotion),
    /// On along the path, where nothing else is left.
    Coast(Coast),
}

/// A move, or its rest, run by one profile.
#[derive(Clone, Copy, Debug)]
pub(super) struct ProfiledMotion {
    /// Serial number of the move.
    pub serial: u64,
    /// Where the profile starts, path distance.
    pub start: f64,
    /// Where the move ends, path distance.
    pub end: f64,
    /// Path distance for a unit of the profile's distance, which is what F counts.
    pub rate: f64,
    pub profile: JerkLimitedProfile,
    /// The cap on the velocity that it was planned with.
    pub cap: f64,
}

/// A stretch of the reference.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReferenceSegment {
    pub motion: SegmentMotion,
    /// How long the segment lasts: as long as its motion, less if another segment took over.
    pub duration: f64,
}

impl ReferenceSegment {
    const VACANT: Self = Self {
        motion: SegmentMotion::Move(ProfiledMotion {
            serial: 0,
            start: 0.0,
            end: 0.0,
            rate: 1.0,
            profile: JerkLimitedProfile::NONE,
            cap: 0.0,
        }),
        duration: 0.0,
    };

    /// Distance and its derivatives at time `t`, in the phase of the motion at `within`.
    pub fn state(&self, t: f64, within: f64) -> ProfileState {
        match &self.motion {
            SegmentMotion::Run(segment) | SegmentMotion::Return(segment) => segment.at(t),
            SegmentMotion::Coast(coast) => coast.state(t, within),
            SegmentMotion::Move(motion)
            | SegmentMotion::Creep(motion)
            | SegmentMotion::CreepBack(motion) => {
                let state = motion.profile.state(t, within);
                ProfileState {
                    distance: (motion.start + motion.rate * state.distance).min(motion.end),
                    velocity: motion.rate * state.velocity,
                    acceleration: motion.rate * state.acceleration,
                    jerk: motion.rate * state.jerk,
                }
            }
        }
    }

    /// The next time after `t` at which acceleration or jerk jump; infinite if there is none.
    pub fn next_jump(&self, t: f64) -> f64 {
        match &self.motion {
            SegmentMotion::Run(_) | SegmentMotion::Return(_) => f64::INFINITY,
            SegmentMotion::Coast(coast) => coast.next_jump(t),
            SegmentMotion::Move(motion)
            | SegmentMotion::Creep(motion)
            | SegmentMotion::CreepBack(motion) => motion.profile.next_jump(t),
        }
    }

    /// Whether it is of a plan of the look-ahead, on along the path.
    pub fn is_run(&self) -> bool {
        matches!(self.motion, SegmentMotion::Run(_))
    }

    /// The path distance where the distance of this segment is `distance`.
    pub fn path_distance(&self, distance: f64) -> f64 {
        match &self.motion {
            SegmentMotion::Return(_) | SegmentMotion::CreepBack(_) => -distance,
            SegmentMotion::Coast(coast) if coast.backwards => -distance,
            _ => distance,
        }
    }

    /// The position and the first derivative of [the path there](Self::point) alone.
    pub fn position_and_direction(&self, path: &BlendedPath, distance: f64) -> [Axes; 2] {
        if self.is_run() {
            path.position_and_direction(distance)
        } else {
            let PathPoint {
                position, first, ..
            } = self.point(path, distance);
            [position, first]
        }
    }

    /// The path at a distance, as it is on this segment: where the machine rests its direction may
    /// jump.
    pub fn point(&self, path: &BlendedPath, distance: f64) -> PathPoint {
        let s = self.path_distance(distance);
        match &self.motion {
            SegmentMotion::Move(motion) | SegmentMotion::Creep(motion) if s >= motion.end => {
                path.point_before(s)
            }
            SegmentMotion::Coast(coast) => coast.point(path, distance),
            SegmentMotion::Return(_) | SegmentMotion::CreepBack(_) => {
                path.point_before(s).backwards()
            }
            _ => path.point(s),
        }
    }
}

/// Enough for 100 ms of a servo period of 1 ms with two short moves in each.
const SLOTS: usize = 256;

/// A ring of segments in the order of the reference.
#[derive(Debug)]
pub(super) struct ReferenceSegments {
    slots: Ring<ReferenceSegment, SLOTS>,
    first: u64,
    count: u64,
    /// Seconds of all of them.
    duration: f64,
}

impl ReferenceSegments {
    pub const fn new() -> Self {
        Self {
            slots: Ring::filled_with(ReferenceSegment::VACANT),
            first: 0,
            count: 0,
            duration: 0.0,
        }
    }

    pub fn clear(&mut self) {
        self.count = 0;
        self.duration = 0.0;
    }

    /// How long they last, seconds; infinite where the last one has no end.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    pub fn len(&self) -> u64 {
        self.count
    }

    /// Whether the segments last for more than `seconds` in total.
    pub fn lasts(&self, seconds: f64) -> bool {
        let mut left = seconds;
        for number in 0..self.count {
            left -= self.slots.at(self.first.wrapping_add(number)).duration;
            if left < 0.0 {
                return true;
            }
        }
        false
    }

    /// Whether no segment can be pushed: the last slot is for [`Self::push_last`].
    pub fn is_full(&self) -> bool {
        self.count >= SLOTS as u64 - 1
    }

    pub fn front(&self) -> Option<&ReferenceSegment> {
        (self.count > 0).then(|| self.slots.at(self.first))
    }

    pub fn back(&self) -> Option<&ReferenceSegment> {
        (self.count > 0).then(|| self.slots.at(self.last()))
    }

    pub fn back_mut(&mut self) -> Option<&mut ReferenceSegment> {
        (self.count > 0).then(|| self.slots.at_mut(self.last()))
    }

    /// Appends a segment; does nothing if the ring is full.
    pub fn push(&mut self, segment: ReferenceSegment) {
        if !self.is_full() {
            self.push_last(segment);
        }
    }

    /// Appends a segment that no other follows, for which there is always room.
    pub fn push_last(&mut self, segment: ReferenceSegment) {
        if self.count < SLOTS as u64 {
            self.count += 1;
            self.duration += segment.duration;
            *self.slots.at_mut(self.last()) = segment;
        }
    }

    /// The last one ends after `duration` seconds: another takes over.
    pub fn cut_last(&mut self, duration: f64) {
        if self.count > 0 {
            let last = self
                .slots
                .at_mut(self.first.wrapping_add(self.count).wrapping_sub(1));
            last.duration = duration;
            self.duration = self.sum();
        }
    }

    pub fn pop(&mut self) {
        if let Some(front) = self.front() {
            let (before, popped) = (self.duration, front.duration);
            self.first = self.first.wrapping_add(1);
            self.count -= 1;
            // Of what has no end nothing finite is left by subtraction.
            self.duration = if popped.is_finite() {
                before - popped
            } else {
                self.sum()
            };
        }
    }

    /// Drops all segments behind the one with this number, which is one of them or the one before.
    pub fn truncate(&mut self, last: u64) {
        let kept = last.wrapping_sub(self.first).wrapping_add(1);
        self.count = self.count.min(kept);
        self.duration = self.sum();
    }

    fn sum(&self) -> f64 {
        let all = (0..self.count).map(|number| self.slots.at(self.first.wrapping_add(number)));
        all.map(|segment| segment.duration).sum()
    }

    /// Number of the last segment; only asked for if there is one.
    pub fn last(&self) -> u64 {
        self.first.wrapping_add(self.count).wrapping_sub(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_first_in_first_out_and_bounded() {
        let mut segments = ReferenceSegments::new();
        assert!(segments.front().is_none() && segments.back().is_none());
        for serial in 0..SLOTS + 10 {
            segments.push(ReferenceSegment {
                duration: serial as f64,
                ..ReferenceSegment::VACANT
            });
        }
        assert!(segments.is_full());
        for serial in 0..SLOTS - 1 {
            assert_eq!(
                segments.front().map(|segment| segment.duration),
                Some(serial as f64)
            );
            assert_eq!(
                segments.back().map(|segment| segment.duration),
                Some((SLOTS - 2) as f64)
            );
            segments.pop();
        }
        segments.pop();
        assert_eq!(segments.len(), 0);
    }

    #[test]
    fn the_duration_is_that_of_all_of_them() {
        let mut segments = ReferenceSegments::new();
        for duration in [0.5, 0.25, 0.125, 1.0] {
            segments.push(ReferenceSegment {
                duration,
                ..ReferenceSegment::VACANT
            });
        }
        assert_eq!(segments.duration(), 1.875);
        segments.pop();
        segments.cut_last(0.25);
        assert_eq!(segments.duration(), 0.625);
        segments.truncate(segments.last() - 1);
        assert_eq!(segments.duration(), 0.375);
        // What has no end is left as well.
        segments.cut_last(f64::INFINITY);
        assert_eq!(segments.duration(), f64::INFINITY);
        segments.cut_last(0.5);
        assert_eq!(segments.duration(), 0.75);
        segments.cut_last(f64::INFINITY);
        segments.pop();
        segments.pop();
        assert_eq!(segments.duration(), 0.0);
        segments.clear();
        segments.cut_last(1.0);
        assert_eq!(segments.duration(), 0.0);
    }
}
