//! How far the plan is frozen: what the executor has of it never changes any more.

use super::planned_segment::PlannedSegment;
use super::spline::Spline;

/// Seconds behind the frozen part that are left alone, so that work begun is seldom overtaken.
const COMMITTED_TIME: f64 = 8e-3;
/// The most intervals that these may be.
const MOST_COMMITTED: usize = 128;

/// The frozen part of a plan, from its start on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frozen {
    next: usize,
    time: f64,
}

impl Frozen {
    pub const NOTHING: Self = Self { next: 0, time: 0.0 };

    /// The next interval to be frozen.
    pub fn next(&self) -> usize {
        self.next
    }

    /// The time at which it starts, seconds from the start of the plan.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The first interval that is still needed.
    pub fn oldest(&self) -> usize {
        self.next.saturating_sub(1)
    }

    /// Whether all of the plan is frozen, with the arc to its rest.
    pub fn is_whole(&self, plan: &Spline) -> bool {
        self.next > plan.last + 1
    }

    /// The next segment, which is frozen from now on.
    pub fn freeze(&mut self, plan: &Spline) -> PlannedSegment {
        let segment = PlannedSegment::of(plan, self.next, self.time);
        self.next += 1;
        self.time += segment.duration;
        segment
    }

    /// The first interval that may be changed.
    pub fn committed(&self, plan: &Spline) -> usize {
        if self.next == 0 {
            return 1;
        }
        self.interval_behind(plan, COMMITTED_TIME)
    }

    /// The interval that begins `seconds` behind the frozen part, or a little later.
    pub fn interval_behind(&self, plan: &Spline, seconds: f64) -> usize {
        let mut time = 0.0;
        let mut k = self.next;
        for _ in 0..MOST_COMMITTED {
            if k > plan.last || time >= seconds {
                break;
            }
            time += plan.duration(k);
            k += 1;
        }
        k
    }
}
