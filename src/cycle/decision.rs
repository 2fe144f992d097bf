//! What the executor wants in a servo period, and which n = dm/dt would serve it best.

use super::Executor;
use super::backup_trajectory::BackupRefusal;
use super::cap::{Caps, hard_braking};
use super::demand::Demand;
use super::goal::Goal;
use super::rate_derivative_interval::RateDerivativeInterval;
use super::rows::Span;
use super::simulation::Simulation;
use super::table::Node;

/// The reference counts as too fast for a cap from this ratio on.
const CAP_BINDS: f64 = 1.0001;

/// Differences of n below this are no difference.
const SAME_N: f64 = 1e-12;

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

    /// The n of this period. Whatever it is, the stored backup trajectory continues from its end.
    pub(super) fn decide(&mut self, goal: Goal) -> f64 {
        let state = self.state;
        let is_adjusted = matches!(goal, Goal::Cap(_) | Goal::Follow);
        let target = match goal {
            Goal::Hold => 0.0,
            Goal::Run | Goal::Cap(_) | Goal::Follow => 1.0,
        };
        if state.rate_change == 0.0 && state.rate == target && !is_adjusted {
            self.goal = goal;
            self.backup_mut().clear();
            return 0.0;
        }
        if std::mem::discriminant(&goal) != std::mem::discriminant(&self.goal) {
            self.fraction = 1.0;
        }
        self.goal = goal;

        let start = self.table.node(state.time);
        let safe = self.safe_n(&start);
        let predicted = state.step(safe);
        let end = self.table.node(predicted.time);
        let span = Span::new(&self.table, &self.limits, &start, &end);
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
        let wanted = match goal {
            Goal::Hold => allowed.low,
            Goal::Run => allowed.high,
            Goal::Cap(ratio) => self.toward_cap(ratio, &jerk, &allowed),
            Goal::Follow => self
                .pursuit
                .and_then(|pursuit| pursuit.approach(&self.table, state, &jerk))
                .map_or(allowed.high, |n| allowed.nearest(n)),
        };

        // A cap or a thread may ask for less than a landing on the target takes.
        let most = if is_adjusted {
            wanted + SAME_N
        } else {
            f64::INFINITY
        };
        if let Some(n) = self.landing(target, most, &allowed, &start) {
            return n;
        }
        if (wanted - safe).abs() < SAME_N {
            self.backup_mut().advance();
            return safe;
        }
        self.search(safe, wanted, &start)
    }

    /// The n of the stored backup trajectory: always possible.
    fn safe_n(&mut self, start: &Node) -> f64 {
        if let Some(n) = self.backup().next() {
            return n;
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
            .nearest(-state.rate_change)
    }

    /// The n that the feed cap asks for.
    fn toward_cap(
        &mut self,
        ratio: f64,
        jerk: &RateDerivativeInterval,
        allowed: &RateDerivativeInterval,
    ) -> f64 {
        let state = self.state;
        let wanted = match self.caps.approach(&self.table, &self.limits, state, jerk) {
            Some(n) => allowed.nearest(n),
            None => allowed.high,
        };
        if wanted <= allowed.low || !Caps::needs_guard(state, ratio, self.servo_period) {
            return wanted;
        }
        // What the guard brakes with is enough where it has been obeyed so far.
        let braking = allowed.nearest(hard_braking(jerk, allowed.low)).min(wanted);
        for n in [wanted, braking] {
            match self.keeps_caps(n) {
                Ok(true) => return n,
                Ok(false) => {}
                Err(_) => {
                    self.wall = true;
                    break;
                }
            }
        }
        allowed.low
    }

    /// Whether braking keeps the caps behind a period with this n.
    fn keeps_caps(&mut self, n: f64) -> Result<bool, BackupRefusal> {
        let state = self.state.step(n);
        let mut simulation = Simulation {
            table: &self.table,
            limits: &self.limits,
            servo_period: self.servo_period,
            budget: &mut self.budget,
        };
        self.caps.guard(&mut simulation, state, n)
    }
}
