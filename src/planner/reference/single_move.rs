//! A move that stands alone between two rests, run by one profile.

use super::outlook::Outlook;
use super::reference::Reference;
use super::reference_segment::{ProfiledMotion, ReferenceSegment, SegmentMotion};
use crate::moves::shape::Shape;
use crate::path::LegView;
use crate::speed::{JerkLimitedProfile, PathLimits};

/// A cap on the velocity has to rise by more than this factor before a move is planned anew.
const NOTICEABLE_RAISE: f64 = 1.001;

impl Reference {
    /// Whether a move that stands alone between two rests starts at `s`.
    pub(super) fn stands_alone(&self, s: f64) -> bool {
        self.lone_move(s).is_some()
    }

    /// A move that stands alone between two rests and starts at `s`, unless its joints have limits: where they bend, the
    /// look-ahead plans it as any other run. In single steps merged lines are several moves.
    fn lone_move(&self, s: f64) -> Option<(Shape, LegView)> {
        if self.backwards || self.bends {
            return None;
        }
        let (shape, leg) = self.path.move_between_rests(s)?;
        (!self.step_by_step || leg.first == leg.serial).then_some((shape, leg))
    }

    /// Plans a move that stands alone between two rests. `false` if that is not what comes next.
    pub(super) fn next_move(&mut self, outlook: &Outlook) -> bool {
        let Some((shape, leg)) = self.lone_move(self.rest) else {
            return false;
        };
        let Some(queued) = outlook.queue.get(leg.serial) else {
            return false;
        };
        let cap = outlook.velocity_cap(queued);
        let limits = PathLimits::of(&shape, outlook.map, &outlook.limits_behind(), cap);
        let profile = JerkLimitedProfile::rest_to_rest(shape.length(), &limits);
        // A profile without duration would be a jump. Positive limits never lead to one.
        if !(profile.duration() > 0.0 && profile.duration().is_finite()) {
            return false;
        }
        self.segments.push(ReferenceSegment {
            motion: SegmentMotion::Move(ProfiledMotion {
                serial: leg.serial,
                start: leg.start,
                end: leg.end,
                rate: 1.0 / leg.measure_rate,
                profile,
                cap,
            }),
            duration: profile.duration(),
        });
        // The look-ahead may have begun before it was known that the move ends at rest.
        for run in &mut self.runs {
            if run.starts_at(self.rest) {
                run.clear();
            }
        }
        self.rest = leg.end;
        true
    }

    /// Lets a faster profile take over at the frontier, if the cap has risen and the move is
    /// steady there.
    pub(super) fn raise(&mut self, outlook: &Outlook) {
        let frontier = self.frontier;
        if self.segments.is_full() {
            return;
        }
        let Some(segment) = self.segments.back_mut() else {
            return;
        };
        let SegmentMotion::Move(motion) = &mut segment.motion else {
            return;
        };
        let Some(queued) = outlook.queue.get(motion.serial) else {
            return;
        };
        // Of merged lines, what the machine runs along and no single one of them.
        let Some(shape) = self.path.shape(motion.start) else {
            return;
        };
        let cap = outlook.velocity_cap(queued);
        if cap <= motion.cap * NOTICEABLE_RAISE
            || motion.profile.steady_time_left(frontier).is_none()
        {
            return;
        }
        // Asked once for each cap, whatever the answer.
        motion.cap = cap;
        let state = motion.profile.state(frontier, frontier);
        let start = motion.start + motion.rate * state.distance;
        let limits = PathLimits::of(&shape, outlook.map, &outlook.limits_behind(), cap);
        let left = (motion.end - start) / motion.rate;
        if let Some(profile) = JerkLimitedProfile::raised(left, state.velocity, &limits) {
            let motion = ProfiledMotion {
                start,
                profile,
                ..*motion
            };
            self.segments.cut_last(frontier);
            self.segments.push(ReferenceSegment {
                motion: SegmentMotion::Move(motion),
                duration: profile.duration(),
            });
            self.frontier = 0.0;
        }
    }
}
