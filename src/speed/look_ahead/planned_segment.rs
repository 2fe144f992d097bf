//! Frozen segments of the plan: what the executor's table is built of.

use super::interval::Parabola;
use super::rest_arc::RestArc;
use super::spline::Spline;
use crate::speed::ProfileState;

/// A segment of the reference that never changes any more.
#[derive(Clone, Copy, Debug)]
pub struct PlannedSegment {
    /// When it starts, seconds from the start of the plan.
    pub start_time: f64,
    /// Seconds, greater than 0.
    pub duration: f64,
    law: SegmentLaw,
}

/// How s depends on time.
#[derive(Clone, Copy, Debug)]
enum SegmentLaw {
    /// Constant jerk from rest at `start`.
    FromRest { start: f64, jerk: f64 },
    /// One interval of the spline from `start` on.
    Interval { start: f64, parabola: Parabola },
    /// Constant jerk to rest at `end`.
    ToRest { end: f64, jerk: f64 },
}

impl PlannedSegment {
    /// Interval k of a plan, the arcs at rest for 0 and `last + 1`.
    pub(super) fn of(plan: &Spline, k: usize, start_time: f64) -> Self {
        let law = if k == 0 {
            let RestArc { jerk, .. } = plan.start_arc;
            let start = plan.start;
            SegmentLaw::FromRest { start, jerk }
        } else if k <= plan.last {
            let start = plan.at(k).start;
            let parabola = plan.parabola(k);
            SegmentLaw::Interval { start, parabola }
        } else {
            let RestArc { jerk, .. } = plan.end_arc;
            let end = plan.end;
            SegmentLaw::ToRest { end, jerk }
        };
        Self {
            start_time,
            duration: plan.duration(k),
            law,
        }
    }

    /// The state `t` seconds after the start of the segment, held within its duration. The distance
    /// is the s of the route; the end of the last segment is exact.
    pub fn at(&self, t: f64) -> ProfileState {
        let t = t.max(0.0).min(self.duration);
        match self.law {
            SegmentLaw::FromRest { start, jerk } => ProfileState {
                distance: start + jerk * t * t * t / 6.0,
                velocity: 0.5 * jerk * t * t,
                acceleration: jerk * t,
                jerk,
            },
            SegmentLaw::Interval { start, parabola } => {
                let (distance, velocity, acceleration) = parabola.state(t);
                ProfileState {
                    distance: start + distance,
                    velocity,
                    acceleration,
                    jerk: parabola.u * velocity,
                }
            }
            SegmentLaw::ToRest { end, jerk } => {
                let left = self.duration - t;
                ProfileState {
                    distance: end - jerk * left * left * left / 6.0,
                    velocity: 0.5 * jerk * left * left,
                    acceleration: -jerk * left,
                    jerk,
                }
            }
        }
    }
}
