//! What the executor wants in a servo period, and which rate jerk would serve it best.

use super::Executor;
use super::braking::hard_braking;
use super::cap::Caps;
use super::caps_ahead::{CapOutlook, CapsAhead};
use super::demand::Demand;
use super::goal::Goal;
use super::rate_derivative_interval::RateDerivativeInterval;
use super::rows::Span;
use super::search::Keeping;
use super::table::Node;

/// The reference counts as too fast for a cap from this ratio on.
const CAP_BINDS: f64 = 1.0001;

/// Periods that may be simulated in one cycle where caps lie ahead: one of braking costs twice one of a backup trajectory
/// that needs not brake. With 384 no program is faster.
const BUDGET_BELOW_CAPS: usize = 200;

/// Those of them that are left to brake by any means, where no backup trajectory keeps the caps ahead.
const BUDGET_TO_BRAKE: usize = 48;

/// Differences of the rate jerk below this are no difference.
const SAME_RATE_JERK: f64 = 1e-12;

impl Executor {
    /// What the demand asks for here and in the cells ahead.
    pub(super) fn goal(&self, demand: &Demand) -> Goal {
        let here = self.table.cell(self.state.time as usize);
        if let Some(pursuit) = &self.pursuit {
            return if demand.hold || pursuit.is_standstill() {
                Goal::Hold
            } else {
                Goal::Follow
            };
        }
        if demand.hold || self.caps.is_hold(here) {
            return Goal::Hold;
        }
        let ratio = self
            .caps
            .greatest_ratio(&self.table, self.state.time, self.servo_period);
        if ratio > CAP_BINDS {
            Goal::Cap(ratio)
        } else {
            Goal::Run
        }
    }

    /// The rate jerk of this period. Whatever it is, the stored backup trajectory continues from its end.
    pub(super) fn decide(&mut self, goal: Goal) -> f64 {
        let state = self.state;
        let is_adjusted = matches!(goal, Goal::Cap(_) | Goal::Follow);
        let target = match goal {
            Goal::Hold => 0.0,
            Goal::Run | Goal::Cap(_) | Goal::Follow => 1.0,
        };
        if state.rate_acceleration == 0.0 && state.rate == target && !is_adjusted {
            self.goal = goal;
            self.backup_mut().clear();
            return 0.0;
        }
        if std::mem::discriminant(&goal) != std::mem::discriminant(&self.goal) {
            self.fraction = 1.0;
        }
        self.goal = goal;

        let start = self.table.node(state.time);
        let safe = self.safe_rate_jerk(&start);
        let (jerk, allowed) = self.intervals(&start, safe);
        let wanted = self.wanted(goal, &jerk, &allowed);

        // A cap or a thread may ask for less than a landing on the target takes.
        let most = if is_adjusted {
            wanted + SAME_RATE_JERK
        } else {
            f64::INFINITY
        };
        let aim = Aim {
            target,
            most,
            wanted,
            safe,
            allowed,
        };
        match goal {
            Goal::Cap(ratio) if Caps::lie_ahead(state, ratio, self.servo_period) => {
                self.below_caps(&aim, &jerk, &start)
            }
            _ => self.toward(&aim, &start, Keeping::Limits),
        }
    }

    /// The rate jerks of this period by the jerk of the axes, and by all limits: `safe` is always among these.
    #[inline]
    fn intervals(
        &self,
        start: &Node,
        safe: f64,
    ) -> (RateDerivativeInterval, RateDerivativeInterval) {
        let state = self.state;
        let predicted = state.step(safe);
        let end = self.table.node(predicted.time);
        let span = Span::new(&self.table, &self.limits, start, &end);
        let jerk = span.jerk_interval(state, predicted);
        let mut allowed = jerk
            .intersection(&span.acceleration_interval(state, predicted))
            .intersection(&RateDerivativeInterval::of_rate(state));
        if allowed.is_empty() {
            allowed = RateDerivativeInterval {
                low: allowed.low.min(safe),
                high: allowed.high.max(safe),
            };
        }
        (jerk, allowed)
    }

    /// The one of the allowed rate jerks that leads to the goal soonest.
    #[inline]
    fn wanted(
        &self,
        goal: Goal,
        jerk: &RateDerivativeInterval,
        allowed: &RateDerivativeInterval,
    ) -> f64 {
        let approached = match goal {
            Goal::Hold => return allowed.low,
            Goal::Run => None,
            Goal::Cap(_) => self
                .caps
                .approach(&self.table, &self.limits, self.state, jerk),
            Goal::Follow => self
                .pursuit
                .and_then(|pursuit| pursuit.approach(&self.table, self.state, jerk)),
        };
        approached.map_or(allowed.high, |rate_jerk| allowed.nearest(rate_jerk))
    }

    /// The rate jerk nearest to what is wanted whose backup trajectory keeps that.
    fn toward(&mut self, aim: &Aim, start: &Node, keeping: Keeping) -> f64 {
        let landing = (aim.target, aim.most);
        if let Some(rate_jerk) = self.landing(landing, &aim.allowed, start, keeping) {
            return rate_jerk;
        }
        if (aim.wanted - aim.safe).abs() < SAME_RATE_JERK {
            self.backup_mut().advance();
            return aim.safe;
        }
        self.search(aim.safe, aim.wanted, start, keeping)
    }

    /// The same where caps lie ahead: with a backup trajectory that keeps them, once one has been found. Until then
    /// the machine brakes, unless a cap has just been lowered below its feed: then it approaches that.
    fn below_caps(&mut self, aim: &Aim, jerk: &RateDerivativeInterval, start: &Node) -> f64 {
        self.budget = BUDGET_BELOW_CAPS;
        if self.backup().keeps(&self.caps) {
            return self.toward(aim, start, Keeping::Caps);
        }
        let outlook = CapsAhead::new(&self.caps, &self.table, self.state.time, self.servo_period)
            .look(self.state);
        if outlook == CapOutlook::Exceeded {
            return self.toward(aim, start, Keeping::Limits);
        }
        self.budget = self.budget.saturating_sub(BUDGET_TO_BRAKE);
        let braking = hard_braking(jerk, aim.allowed.low);
        let braking = aim.allowed.nearest(braking).min(aim.wanted);
        for rate_jerk in [aim.wanted, braking, aim.allowed.low] {
            if self.verify(rate_jerk, start, Keeping::Caps) {
                return rate_jerk;
            }
        }
        self.budget += BUDGET_TO_BRAKE;
        let braking = Aim {
            wanted: aim.allowed.low,
            most: aim.allowed.low + SAME_RATE_JERK,
            ..*aim
        };
        self.toward(&braking, start, Keeping::Limits)
    }

    /// The rate jerk of the stored backup trajectory: always possible.
    fn safe_rate_jerk(&mut self, start: &Node) -> f64 {
        if let Some(rate_jerk) = self.backup().next() {
            return rate_jerk;
        }
        let state = self.state;
        if state.is_steady() {
            return 0.0;
        }
        // Cannot happen as long as arithmetic is exact. The best that is left: release as fast as
        // the jerk allows at this instant.
        self.backups_lost = self.backups_lost.saturating_add(1);
        let predicted = state.step(0.0);
        let end = self.table.node(predicted.time);
        Span::new(&self.table, &self.limits, start, &end)
            .jerk_interval(state, predicted)
            .nearest(-state.rate_acceleration)
    }
}

/// What is to be done in a period.
struct Aim {
    /// The rate at the end of the change.
    target: f64,
    /// The greatest rate jerk with which to land there.
    most: f64,
    wanted: f64,
    /// Of the stored backup trajectory.
    safe: f64,
    /// What the limits allow over the period.
    allowed: RateDerivativeInterval,
}
