//! Which intervals are refined next, and when a step of the refinement is worth its time.

use super::newton::MOST_INTERVALS;

/// Steps of the refinement for what is new ..
const FRESH_STEPS: u32 = 16;
/// .. and then one more each time that the machine has come on by so many intervals: more gain nothing.
const PACE: usize = 4;

/// Intervals before the first one that a step found unconverged, which the next one begins with: what it changes changes these.
const BEFORE_UNCONVERGED: usize = 16;

/// The same before where the plan becomes another one.
const BEFORE_REPLANNED: usize = 32;

/// How far the refinement of a plan has come.
#[derive(Clone, Copy, Debug)]
pub(super) struct RefinementPace {
    refined: usize,
    /// The first interval that might be changed when the last step was done.
    paced: usize,
    /// Those before this one have converged.
    unconverged: usize,
    /// Steps since the plan or its caps changed.
    fresh_steps: u32,
    settled: usize,
    /// Steps since the last extension.
    steps: u32,
}

impl RefinementPace {
    pub const AT_REST: Self = Self {
        refined: 1,
        paced: 0,
        unconverged: 0,
        fresh_steps: 0,
        settled: 1,
        steps: 0,
    };

    /// Intervals before this one have been refined.
    pub fn refined(&self) -> usize {
        self.refined
    }

    /// What the end of the plan hardly influences any more.
    pub fn settled(&self) -> usize {
        self.settled
    }

    /// Whether a step behind the interval `committed` is worth its time.
    pub fn is_due(&self, committed: usize) -> bool {
        self.fresh_steps < FRESH_STEPS || committed >= self.paced + PACE
    }

    /// Whether an extension comes before the next step: after few steps while the machine is near to what is
    /// not settled, since a longer plan gains more than a smoother one.
    pub fn lets_extend(&self, committed: usize) -> bool {
        let ahead = self.settled.saturating_sub(committed);
        let steps = if ahead > 2 * MOST_INTERVALS {
            12
        } else if ahead > MOST_INTERVALS * 5 / 4 {
            4
        } else if ahead > MOST_INTERVALS / 2 {
            2
        } else {
            1
        };
        self.steps >= steps
    }

    /// An extension has begun.
    pub fn note_extension(&mut self) {
        self.steps = 0;
    }

    /// A step is begun with more of the plan behind its window, which reaches up to interval `end`.
    pub fn note_window(&mut self, end: usize) {
        self.refined = self.refined.max(end);
    }

    /// The first interval that a step is worth its time for, behind the interval `committed`.
    pub fn first(&self, committed: usize) -> usize {
        committed.max(self.unconverged)
    }

    /// A step is done behind the interval `committed`, which found that those before `unconverged` have converged.
    pub fn note_step(&mut self, committed: usize, unconverged: usize) {
        self.unconverged = unconverged.saturating_sub(BEFORE_UNCONVERGED);
        self.steps = self.steps.saturating_add(1);
        self.fresh_steps = self.fresh_steps.saturating_add(1);
        self.paced = committed;
    }

    /// Caps were raised.
    pub fn begin_anew(&mut self) {
        self.fresh_steps = 0;
        self.unconverged = 0;
    }

    /// Behind interval `base` the plan is another one, which ends with interval `last` and says itself what is
    /// `settled` of it.
    pub fn replan(&mut self, base: usize, settled: usize, last: usize) {
        self.fresh_steps = 0;
        self.unconverged = self.unconverged.min(base.saturating_sub(BEFORE_REPLANNED));
        self.refined = base;
        self.settled = settled.max(self.settled.min(base)).min(last - 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_new_takes_its_steps_and_then_one_for_each_bit_of_way() {
        let mut pace = RefinementPace::AT_REST;
        for _ in 0..FRESH_STEPS {
            assert!(pace.is_due(7));
            pace.note_step(7, 7);
        }
        assert!(!pace.is_due(7 + PACE - 1) && pace.is_due(7 + PACE));
        pace.begin_anew();
        assert!(pace.is_due(7));
    }

    #[test]
    fn extensions_come_often_while_little_is_settled() {
        for (ahead, steps) in [(70, 1), (71, 2), (176, 4), (281, 12)] {
            let mut pace = RefinementPace::AT_REST;
            pace.replan(10, 10 + ahead, 400);
            for _ in 0..steps {
                assert!(!pace.lets_extend(10), "{ahead}");
                pace.note_step(10, 10);
            }
            assert!(pace.lets_extend(10), "{ahead}");
            pace.note_extension();
            assert!(!pace.lets_extend(10));
        }
    }

    #[test]
    fn a_step_leaves_out_what_has_converged() {
        let mut pace = RefinementPace::AT_REST;
        assert_eq!(pace.first(7), 7);
        pace.note_step(7, 100);
        assert_eq!(pace.first(7), 100 - BEFORE_UNCONVERGED);
        // What has not converged at the begin of a step makes the next one begin earlier.
        pace.note_step(8, pace.first(8) + 1);
        assert_eq!(pace.first(8), 101 - 2 * BEFORE_UNCONVERGED);
        pace.note_step(8, 100);
        pace.replan(90, 0, 150);
        assert_eq!(pace.first(8), 90 - BEFORE_REPLANNED);
        assert_eq!(pace.first(70), 70, "never before what is committed");
        pace.begin_anew();
        assert_eq!(pace.first(8), 8);
    }

    #[test]
    fn another_plan_is_settled_as_far_as_it_says_or_as_it_was() {
        let mut pace = RefinementPace::AT_REST;
        pace.replan(30, 40, 100);
        pace.note_window(60);
        assert_eq!((pace.settled(), pace.refined()), (40, 60));
        pace.replan(50, 0, 100);
        assert_eq!((pace.settled(), pace.refined()), (40, 50));
        pace.replan(35, 0, 100);
        assert_eq!((pace.settled(), pace.refined()), (35, 35));
        pace.replan(35, 90, 80);
        assert_eq!(pace.settled(), 79);
    }
}
