//! What is left where the look-ahead has no plan, or nothing more can be handed out.

use super::coast::Coast;
use super::outlook::Outlook;
use super::reference::Reference;
use super::reference_segment::{ReferenceSegment, SegmentMotion};
use crate::axes::AXIS_COUNT;
use crate::moves::shape::PathPoint;

/// The share of the jerk that an acceleration is released with: the rest is left for braking.
const RELEASE_SHARE: f64 = 0.5;

impl Reference {
    /// Plans to creep where no plan was found for what comes next. `false` if one was, or is still sought.
    pub(super) fn creep(&mut self, outlook: &Outlook) -> bool {
        let Some(motion) = self.current().creep(&self.path, outlook) else {
            return false;
        };
        let duration = motion.profile.duration();
        let (end, motion) = if self.backwards {
            (-motion.end, SegmentMotion::CreepBack(motion))
        } else {
            (motion.end, SegmentMotion::Creep(motion))
        };
        self.segments.push(ReferenceSegment { motion, duration });
        // From there on another plan is sought.
        self.current_mut().clear();
        self.rest = end;
        true
    }

    /// Whether it goes on along the path without an end.
    pub fn is_coasting(&self) -> bool {
        let last = self.segments.back();
        last.is_some_and(|last| matches!(last.motion, SegmentMotion::Coast(_)))
    }

    /// Goes on along the path from what was handed out last, without an end: the machine has to be held.
    /// `false` if nothing was handed out, or it does so already.
    pub fn coast(&mut self, outlook: &Outlook) -> bool {
        if self.is_coasting() {
            return false;
        }
        let Some(last) = self.segments.back() else {
            return false;
        };
        let start = last.state(self.frontier, self.frontier);
        let PathPoint {
            position,
            first,
            second,
            third,
        } = last.point(&self.path, start.distance);
        let [first, ..] = outlook
            .map
            .derivatives(&position, [&first, &second, &third]);
        let jerk = outlook.limits_behind().jerk;
        // Seconds for a unit of acceleration with all of the jerk; braking ends at rest, and no later.
        let seconds = (0..AXIS_COUNT)
            .map(|axis| first[axis].abs() / jerk[axis])
            .fold(0.0, f64::max);
        let share = if start.acceleration > 0.0 {
            RELEASE_SHARE
        } else {
            1.0
        };
        let backwards = matches!(
            last.motion,
            SegmentMotion::Return(_) | SegmentMotion::CreepBack(_)
        );
        let end = if backwards {
            -self.current().end()
        } else {
            self.path.final_end()
        };
        let coast = Coast {
            start,
            release: (seconds * start.acceleration.abs() / share).max(outlook.now.period),
            end: end.max(start.distance),
            backwards,
        };
        self.segments.cut_last(self.frontier);
        self.segments.push_last(ReferenceSegment {
            motion: SegmentMotion::Coast(coast),
            duration: f64::INFINITY,
        });
        self.frontier = 0.0;
        true
    }
}
