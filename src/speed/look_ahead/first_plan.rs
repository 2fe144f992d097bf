//! The first plan of a run: where it is to end, how long it waits for more of the path, and what is tried
//! where it is refused.

use super::refusal::PlanRefusal;
use super::route::{Route, SpeedCap};

/// Seconds at the programmed speed that the first plan covers. It is short, so that the motion
/// begins soon.
const FIRST_TIME: f64 = 0.04;

/// While the path is shorter than that and grows, the first plan waits, for this many slices at
/// most ..
const LONGEST_WAIT: u32 = 40;
/// .. and for this many while nothing more becomes known.
const PATIENCE: u32 = 8;

/// A first plan over less than this share of the path distance waits for more: rounding.
const LEAST_LENGTH: f64 = 1e-9;

/// A first plan that is refused is made over half the length, this often ..
const SHORTER_FIRST_PLANS: u32 = 6;
/// .. and then, as often again, at this share of the programmed speed.
const SLOWER_FIRST_PLANS: u32 = 4;
const SLOWER: f64 = 0.4;

/// The attempts at a first plan.
#[derive(Clone, Copy, Debug)]
pub(super) struct FirstPlan {
    /// The length that was known in the slice before.
    seen: f64,
    /// Slices since more of it became known.
    quiet: u32,
    /// Slices since the start.
    waited: u32,
    /// How many were refused.
    failures: u32,
    speed_share: f64,
}

impl FirstPlan {
    pub const NONE: Self = Self {
        seen: 0.0,
        quiet: 0,
        waited: 0,
        failures: 0,
        speed_share: 1.0,
    };

    /// Share of the program's speeds: less than 1 for a first plan that was refused otherwise.
    pub fn speed_share(&self) -> f64 {
        self.speed_share
    }

    /// A slice begins.
    pub fn pass_slice(&mut self) {
        self.waited = self.waited.saturating_add(1);
    }

    /// Where the first plan from `start` on is to come to rest, as s; `None` if it waits for more of the path.
    pub fn end<R: Route>(&mut self, route: &R, start: f64) -> Option<f64> {
        let (known_end, complete) = (route.known_end(), route.is_complete());
        let known = known_end - start;
        if known <= 0.0 || !complete && known <= LEAST_LENGTH * (1.0 + start.abs()) {
            return None;
        }
        let SpeedCap { programmed, .. } = route.speed_cap(start, &route.point(start).first);
        let most = FIRST_TIME * programmed;
        if self.is_patient(known) && known < most && !complete {
            return None;
        }
        let mut length = if most < 0.7 * known { most } else { known };
        for _ in 0..self.failures.min(SHORTER_FIRST_PLANS) {
            length *= 0.5;
        }
        Some(if length < known {
            start + length
        } else {
            known_end
        })
    }

    /// Whether it may wait for more than this `known` length; counts how long it has been.
    fn is_patient(&mut self, known: f64) -> bool {
        if known > self.seen {
            self.seen = known;
            self.quiet = 0;
        }
        self.quiet += 1;
        self.quiet < PATIENCE && self.waited < LONGEST_WAIT
    }

    /// Whether there is another one to be tried after this refusal.
    pub fn note_refusal(&mut self, refusal: PlanRefusal) -> bool {
        self.failures = self.failures.saturating_add(1);
        let over = self.failures > SHORTER_FIRST_PLANS + SLOWER_FIRST_PLANS;
        if over || refusal == PlanRefusal::Unsound {
            return false;
        }
        if self.failures > SHORTER_FIRST_PLANS {
            self.speed_share *= SLOWER;
        }
        true
    }

    /// There is a plan: whether it was made slower than the program asks for, which is over now.
    pub fn note_adopted(&mut self) -> bool {
        let slower = self.speed_share < 1.0;
        self.speed_share = 1.0;
        slower
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refused_ones_are_tried_shorter_then_slower_then_not_at_all() {
        let mut first = FirstPlan::NONE;
        for _ in 0..SHORTER_FIRST_PLANS {
            assert!(first.note_refusal(PlanRefusal::NotFound));
            assert_eq!(first.speed_share(), 1.0);
        }
        let mut share = 1.0;
        for _ in 0..SLOWER_FIRST_PLANS {
            assert!(first.note_refusal(PlanRefusal::NotFound));
            share *= SLOWER;
            assert_eq!(first.speed_share(), share);
        }
        let mut adopted = first;
        assert!(adopted.note_adopted() && adopted.speed_share() == 1.0 && !adopted.note_adopted());
        assert!(!first.note_refusal(PlanRefusal::NotFound));
        let mut unsound = FirstPlan::NONE;
        assert!(!unsound.note_refusal(PlanRefusal::Unsound));
    }

    #[test]
    fn it_waits_while_more_becomes_known_but_not_for_ever() {
        let mut quiet = FirstPlan::NONE;
        let slices = (0..100).take_while(|_| quiet.is_patient(1.0)).count();
        assert_eq!(slices as u32, PATIENCE - 1);
        let mut growing = FirstPlan::NONE;
        let grows = |slice: &u32| {
            growing.pass_slice();
            growing.is_patient(f64::from(*slice))
        };
        let slices = (1..100).take_while(grows).count();
        assert_eq!(slices as u32, LONGEST_WAIT - 1);
    }
}
