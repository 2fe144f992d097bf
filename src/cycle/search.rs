//! The search for a rate jerk that comes with a backup trajectory: the shield around whatever is wanted.
//!
//! The rate jerk of the stored backup trajectory is always possible. A candidate takes its place only if the period
//! with it keeps the limits and a backup trajectory from the state behind it was found.

use super::Executor;
use super::backup_refusal::BackupRefusal;
use super::backup_trajectory::Reserve;
use super::executor::BUDGET;
use super::goal::Goal;
use super::rate_derivative_interval::{
    RATE_ACCELERATION_LIMIT, RATE_JERK_LIMIT, RateDerivativeInterval,
};
use super::rows::Span;
use super::simulation::Simulation;
use super::state::State;
use super::table::Node;

/// Candidates that are tried in one cycle.
const TRIES: usize = 6;

/// The search for the best rate jerk ends when it is known to this part of the way.
const SEARCH_TOLERANCE: f64 = 0.06;

/// With less than this left of the budget, what was found is good enough: where backup trajectories are long
/// it changes little from cycle to cycle.
const ENOUGH_LEFT: usize = BUDGET * 7 / 8;

/// Least part of the way that is tried first.
pub(super) const LEAST_FRACTION: f64 = 1.0 / 64.0;

/// What a backup trajectory has to keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keeping {
    /// The limits of the axes.
    Limits,
    /// These and the feed caps ahead.
    Caps,
}

impl Executor {
    /// Two periods that end exactly on the target rate with no rate acceleration, if such a pair keeps
    /// all limits. The second one is stored as the backup trajectory, the first one is the answer. In the
    /// second period of such a pair the answer is the stored one. Never more than `most`.
    pub(super) fn landing(
        &mut self,
        (target, most): (f64, f64),
        allowed: &RateDerivativeInterval,
        start: &Node,
        keeping: Keeping,
    ) -> Option<f64> {
        let state = self.state;
        let missing = state.rate - target;
        let first = -(missing + 1.5 * state.rate_acceleration);
        let second = missing + 0.5 * state.rate_acceleration;
        if !allowed.contains(first) || first > most || second.abs() > RATE_JERK_LIMIT {
            // Already in the second period of a pair?
            let rate_jerk = self.backup().next().filter(|_| self.backup().is_last())?;
            if rate_jerk > most || (state.step(rate_jerk).rate - target).abs() > 1e-9 {
                return None;
            }
            self.backup_mut().advance();
            return Some(rate_jerk);
        }
        let middle = state.step(first);
        let mut last = middle.step(second);
        let known = self.table.knows(middle.time.max(last.time));
        if !middle.follows(state) || !last.follows(middle) || !known {
            return None;
        }
        last.rate = target;
        last.rate_acceleration = 0.0;
        let (node, end) = (self.table.node(middle.time), self.table.node(last.time));
        let first_span = Span::new(&self.table, &self.limits, start, &node);
        let second_span = Span::new(&self.table, &self.limits, &node, &end);
        let keeps = second_span.jerk_interval(middle, last).contains(second)
            && first_span.keeps_limits(state, middle, first)
            && second_span.keeps_limits(middle, last, second);
        if !keeps {
            return None;
        }
        let kept = match keeping {
            Keeping::Limits => None,
            Keeping::Caps => {
                self.find_backup(last, second, keeping).ok()?;
                Some(self.caps)
            }
        };
        self.backup_mut().set_single(second, last, kept);
        Some(first)
    }

    /// The rate jerk nearest to the wanted one that comes with a backup trajectory: from that of the stored one as
    /// far towards the wanted one as it can be verified within the budget.
    pub(super) fn search(&mut self, safe: f64, wanted: f64, start: &Node, keeping: Keeping) -> f64 {
        let (mut verified, mut refused) = (0.0, 2.0);
        // What was refused while the rate rose says nothing about braking.
        let brakes = wanted < safe;
        if brakes != self.brakes {
            self.brakes = brakes;
            self.fraction = 1.0;
        }
        let mut fraction = self.fraction;
        let mut best = None;
        for _ in 0..TRIES {
            let rate_jerk = safe + fraction * (wanted - safe);
            if self.verify(rate_jerk, start, keeping) {
                best = Some(rate_jerk);
                verified = fraction;
            } else {
                refused = fraction;
            }
            let costly = verified > 0.0 && self.budget < ENOUGH_LEFT;
            let close = verified >= 1.0 || refused - verified < SEARCH_TOLERANCE;
            if close || costly || self.budget == 0 {
                break;
            }
            fraction = if refused > 1.0 {
                (4.0 * fraction).min(1.0)
            } else if verified == 0.0 {
                0.25 * fraction
            } else {
                0.5 * (verified + refused)
            };
        }
        match best {
            Some(rate_jerk) => {
                self.fraction = (2.0 * verified).min(1.0);
                rate_jerk
            }
            None => {
                self.fraction = fraction.max(LEAST_FRACTION);
                self.backup_mut().advance();
                safe
            }
        }
    }

    /// Whether this rate jerk keeps the limits and has a backup trajectory of its own, which is then stored.
    pub(super) fn verify(&mut self, rate_jerk: f64, start: &Node, keeping: Keeping) -> bool {
        let state = self.state;
        let next = state.step(rate_jerk).settled();
        if !next.follows(state) || next.rate_acceleration.abs() > RATE_ACCELERATION_LIMIT {
            return false;
        }
        if !self.table.knows(next.time) {
            self.wall = true;
            return false;
        }
        let end = self.table.node(next.time);
        let span = Span::new(&self.table, &self.limits, start, &end);
        if !span.keeps_limits(state, next, rate_jerk) {
            return false;
        }
        let found = self.find_backup(next, rate_jerk, keeping);
        match found {
            Ok(()) => self.stored = 1 - (self.stored & 1),
            Err(refusal) => self.wall |= refusal == BackupRefusal::Wall,
        }
        found.is_ok()
    }

    /// Looks for a backup trajectory from `state`, reached with `previous_rate_jerk`, beside the stored one.
    fn find_backup(
        &mut self,
        state: State,
        previous_rate_jerk: f64,
        keeping: Keeping,
    ) -> Result<(), BackupRefusal> {
        let mut simulation = Simulation {
            table: &self.table,
            limits: &self.limits,
            servo_period: self.servo_period,
            budget: &mut self.budget,
        };
        let spare = &mut self.backups[1 - (self.stored & 1)];
        if keeping == Keeping::Caps {
            return spare.find_below(&mut simulation, &self.caps, state, previous_rate_jerk);
        }
        // A thread goes where the spindle is, at whatever price.
        let rises = state.rate_acceleration > 0.0 && matches!(self.goal, Goal::Run | Goal::Cap(_));
        let reserve = if rises { Reserve::Kept } else { Reserve::Used };
        spare.find(&mut simulation, reserve, state, previous_rate_jerk)
    }
}
