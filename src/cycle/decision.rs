//! What the executor wants in a servo period, and which n = dm/dt would serve it best.

use super::Executor;
use super::cap::Caps;
use super::demand::Demand;
use super::interval::Interval;
use super::rows::Span;
use super::table::Node;

/// What the executor wants in a servo period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// Come to rest: rate 0.
    Hold,
    /// As fast as the reference: rate 1.
    Run,
    /// As fast as the feed cap allows. The reference exceeds it ahead, at most by this ratio.
    Cap(f64),
    /// To be where a thread wants the machine to be.
    Follow,
}

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

    /// The n of this period. Whatever it is, the stored release continues from its end.
    pub(super) fn decide(&mut self, goal: Goal) -> f64 {
        let state = self.state;
        let is_adjusted = matches!(goal, Goal::Cap(_) | Goal::Follow);
        let target = match goal {
            Goal::Hold => 0.0,
            Goal::Run | Goal::Cap(_) | Goal::Follow => 1.0,
        };
        if state.rate_change == 0.0 && state.rate == target && !is_adjusted {
            self.goal = goal;
            self.release_mut().clear();
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
            .intersection(&Interval::of_rate(state));
        if allowed.is_empty() {
            allowed = Interval {
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
            self.release_mut().advance();
            return safe;
        }
        self.search(safe, wanted, &start)
    }

    /// The n of the stored release: always possible.
    fn safe_n(&mut self, start: &Node) -> f64 {
        if let Some(n) = self.release().next() {
            return n;
        }
        let state = self.state;
        if state.is_steady() {
            return 0.0;
        }
        // Cannot happen as long as arithmetic is exact. The best that is left: release as fast as
        // the jerk allows at this instant.
        self.releases_lost = self.releases_lost.saturating_add(1);
        let predicted = state.step(0.0);
        let end = self.table.node(predicted.time);
        Span::new(&self.table, &self.limits, start, &end)
            .jerk_interval(state, predicted)
            .nearest(-state.rate_change)
    }

    /// The n that the feed cap asks for.
    fn toward_cap(&mut self, ratio: f64, jerk: &Interval, allowed: &Interval) -> f64 {
        let state = self.state;
        let wanted = match self.caps.approach(&self.table, &self.limits, state, jerk) {
            Some(n) => allowed.nearest(n),
            None => allowed.high,
        };
        if wanted <= allowed.low || !Caps::needs_guard(state, ratio, self.servo_period) {
            return wanted;
        }
        let next = state.step(wanted);
        let answer = self.caps.guard(
            &self.table,
            &self.limits,
            next,
            wanted,
            self.servo_period,
            &mut self.budget,
        );
        match answer {
            Ok(true) => wanted,
            Ok(false) => allowed.low,
            Err(_) => {
                self.wall = true;
                allowed.low
            }
        }
    }
}
