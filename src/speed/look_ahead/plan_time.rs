//! How long a plan takes: summed up by a few intervals in each servo period.

use super::frozen::Frozen;
use super::spline::{CAPACITY, Spline};
use crate::ring::Ring;

/// Intervals that are added in a servo period; each takes two or three roots. More than the machine runs through in it, so
/// that every round comes to its end.
const INTERVALS_A_PERIOD: usize = 4;

/// Where a plan comes to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanEnd {
    /// Seconds from the start of the plan.
    pub time: f64,
    /// As s.
    pub place: f64,
}

/// A sum that goes on from the frozen part to the end of the plan, round after round.
#[derive(Debug)]
pub(super) struct PlanTime {
    /// When each interval begins that this round has passed, seconds from the start of the plan.
    begins: Ring<f64, CAPACITY>,
    /// The next interval to be added.
    next: usize,
    /// When it begins.
    time: f64,
    /// What the last round has found.
    end: Option<PlanEnd>,
}

impl PlanTime {
    pub const NONE: Self = Self {
        begins: Ring::filled_with(0.0),
        next: 0,
        time: 0.0,
        end: None,
    };

    /// Another plan begins.
    pub fn begin(&mut self) {
        (self.next, self.time, self.end) = (0, 0.0, None);
    }

    /// Where the plan comes to rest, as the last round has found it.
    pub fn end(&self) -> Option<PlanEnd> {
        self.end
    }

    /// A servo period passes.
    pub fn pass(&mut self, plan: &Spline, frozen: &Frozen) {
        self.begin_behind(frozen);
        for _ in 0..INTERVALS_A_PERIOD {
            if self.next > plan.last + 1 {
                self.end = Some(PlanEnd {
                    time: self.time,
                    place: plan.end,
                });
                (self.next, self.time) = (frozen.next(), frozen.time());
                return;
            }
            *self.begins.at_mut(self.next as u64) = self.time;
            self.time += plan.duration(self.next);
            self.next += 1;
        }
    }

    /// From interval `base` on, behind the frozen part, the plan is another one.
    pub fn replan(&mut self, frozen: &Frozen, base: usize) {
        if base < self.next {
            (self.next, self.time) = (base, *self.begins.at(base as u64));
        }
        self.begin_behind(frozen);
    }

    /// What is frozen need not be added any more.
    fn begin_behind(&mut self, frozen: &Frozen) {
        if self.next < frozen.next() {
            (self.next, self.time) = (frozen.next(), frozen.time());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of `last` intervals, 0.1 s each.
    fn plan(last: usize) -> Box<Spline> {
        let mut plan = Box::new(Spline::NONE);
        for k in 0..last + 2 {
            plan.at_mut(k).coefficient = 100.0;
        }
        (plan.last, plan.end) = (last, last as f64);
        plan
    }

    fn sum(plan: &Spline, from: usize) -> f64 {
        (from..=plan.last + 1).map(|k| plan.duration(k)).sum()
    }

    fn rounds(time: &mut PlanTime, plan: &Spline, frozen: &Frozen, periods: usize) -> PlanEnd {
        for _ in 0..periods {
            time.pass(plan, frozen);
        }
        time.end().expect("a whole round")
    }

    #[test]
    fn the_end_is_the_sum_of_all_intervals_however_much_is_frozen() {
        let plan = plan(30);
        let mut frozen = Frozen::NOTHING;
        let mut time = PlanTime::NONE;
        time.begin();
        time.pass(&plan, &frozen);
        assert_eq!(time.end(), None);
        let whole = sum(&plan, 0);
        for _ in 0..31 {
            let end = rounds(&mut time, &plan, &frozen, 20);
            assert!((end.time - whole).abs() < 1e-12 && end.place == 30.0);
            frozen.freeze(&plan);
        }
    }

    #[test]
    fn a_plan_that_is_continued_in_the_middle_of_a_round_is_summed_as_it_is() {
        let mut plan = plan(30);
        let frozen = Frozen::NOTHING;
        let mut time = PlanTime::NONE;
        for passed in 0..8 {
            time.begin();
            for _ in 0..passed {
                time.pass(&plan, &frozen);
            }
            for k in 20..42 {
                plan.at_mut(k).coefficient = if passed % 2 == 0 { 25.0 } else { 100.0 };
            }
            (plan.last, plan.end) = (40, 40.0);
            time.replan(&frozen, 19);
            let end = rounds(&mut time, &plan, &frozen, 11);
            assert!((end.time - sum(&plan, 0)).abs() < 1e-12, "{passed}");
        }
    }
}
