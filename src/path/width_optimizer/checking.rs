//! How a trial is checked leg by leg, and narrowed where it leaves the tolerance.
//!
//! Each vertex that is narrowed leaves some sixty legs to be checked again. Once a trial has taken much of what it may, only the legs
//! that were violated are, until none of them is; then all the others follow.

use super::super::chain::Chain;
use super::super::deviation::{self, DeviationVerdict};
use super::super::metric::Metric;
use super::super::settings::BlendSettings;
use super::super::{blame, narrowed};
use super::{GREATEST_TRIAL, OptimizerPhase, WidthOptimizer};

/// What of the tolerance a trial may use; the rest is for hardened vertices.
const TRIAL_SHARE: f64 = 0.98;

/// Times that vertices are narrowed before a trial is given up.
const ROUNDS: u32 = 48;

/// A violation so near to the end of what is known, in design widths, may be due to it.
const NEAR_END: f64 = 2.0;

/// From this share of its kernel terms on a trial checks only legs that were violated.
const VIOLATED_ALONE: f64 = 0.0625;

impl WidthOptimizer {
    /// `violated_alone`: legs are passed over that were not violated when they were checked last.
    pub(super) fn begin_check(&mut self, chain: &Chain, violated_alone: bool) {
        self.violated = false;
        self.violated_alone = violated_alone;
        self.narrowed = false;
        self.known = None;
        self.phase = OptimizerPhase::Check(self.first_leg(chain));
    }

    /// Checks a leg, or ends the check behind the last one. Answers the kernel terms that it took.
    pub(super) fn check(
        &mut self,
        chain: &mut Chain,
        leg: u64,
        settings: &BlendSettings,
        metric: &Metric,
    ) -> usize {
        if self.spent > GREATEST_TRIAL {
            return self.give_up(chain);
        }
        if leg >= self.window.next {
            return self.end_check(chain, settings);
        }
        self.phase = OptimizerPhase::Check(leg + 1);
        let known = chain.leg(leg).check;
        if !known.unchecked || (self.violated_alone && !known.violated) {
            return 1;
        }
        let DeviationVerdict {
            violation,
            left,
            cost,
        } = deviation::check(
            chain,
            leg,
            TRIAL_SHARE,
            self.window.next,
            metric,
            &mut self.reaching,
            &mut self.known,
        );
        let marking = match violation {
            None => {
                chain.leg_mut(leg).check.keeps(left);
                0
            }
            Some(violation) => {
                self.violated = true;
                chain.leg_mut(leg).check.note_violation();
                if self.is_stuck(chain, leg) {
                    self.send_back(chain, violation.s);
                }
                let last = chain.leg(self.window.next.wrapping_sub(1));
                let near_end = self
                    .window
                    .is_near_end(violation.s, NEAR_END * last.design_width);
                let spent = self.share_spent();
                blame::mark(chain, leg, violation, near_end, &self.window, metric, spent)
            }
        };
        self.spent += cost + marking;
        cost + marking
    }

    /// All legs have been checked.
    fn end_check(&mut self, chain: &mut Chain, settings: &BlendSettings) -> usize {
        if !self.violated {
            if !self.violated_alone {
                return self.accept(chain, settings, self.window.next);
            }
            self.begin_check(chain, false);
            return 1;
        }
        self.round += 1;
        if self.round >= ROUNDS {
            return self.give_up(chain);
        }
        self.phase = OptimizerPhase::Narrow(self.window.open);
        1
    }

    /// What of its kernel terms a trial has taken, 0 to 1 or a little more.
    fn share_spent(&self) -> f64 {
        self.spent as f64 / GREATEST_TRIAL as f64
    }

    /// Narrows a vertex if it is marked, or begins another check behind the last one. Answers the kernel terms that it took.
    pub(super) fn narrow(&mut self, chain: &mut Chain, number: u64) -> usize {
        if number >= self.window.next {
            if !self.narrowed {
                return self.give_up(chain);
            }
            self.begin_check(chain, self.share_spent() > VIOLATED_ALONE);
            return 1;
        }
        self.phase = OptimizerPhase::Narrow(number + 1);
        if chain.vertex(number).goes_back {
            return self.go_back(chain, number);
        }
        let narrowing = chain.vertex(number).narrowing;
        if narrowing >= 1.0 {
            return 1;
        }
        self.narrowed = true;
        let clip = self.window.clip(chain, number);
        let vertex = chain.vertex_mut(number);
        let reach = vertex.trial.reach();
        let kernel = vertex.base.kernel.max(vertex.base.further_reach());
        let wanted = (kernel * vertex.factor).max(vertex.base.easement * vertex.factor.sqrt());
        // What the surroundings of this moment are to blame for is forgotten with the trial.
        if wanted > clip || vertex.marked_temporarily {
            vertex.temporary_factor *= narrowing;
        } else {
            vertex.factor *= narrowing;
        }
        vertex.narrowing = 1.0;
        vertex.marked_temporarily = false;
        let before = *chain.trial(number);
        self.set_trial(chain, number);
        narrowed::touch(chain, number, &before, reach, self.window.next)
    }
}
