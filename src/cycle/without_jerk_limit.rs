//! The decision of a period where no axis has a limit of jerk: the rate acceleration may jump between periods.
//!
//! So every period stands for itself. Within it the rate acceleration is constant; none is always possible, and
//! there is nothing to release.

use super::Executor;
use super::cap::Caps;
use super::caps_ahead::{BRAKING_PERIODS, CapOutlook, CapsAhead};
use super::goal::Goal;
use super::rows::Span;
use super::search::LEAST_FRACTION;
use super::simulation::Simulation;
use super::state::State;
use super::table::Node;

/// How often the rows are linearised around what they gave.
const PREDICTIONS: usize = 3;

/// How often the way between a rate acceleration that the check refuses and none is halved.
const HALVINGS: usize = 8;

impl Executor {
    /// The rate acceleration over this period, per servo period.
    pub(super) fn rate_acceleration(&mut self, goal: Goal) -> f64 {
        self.goal = goal;
        self.backup_mut().clear();
        let state = self.state;
        let wanted = match goal {
            Goal::Hold => -state.rate,
            Goal::Cap(_) => self.caps.rate(&self.table, state).min(1.0) - state.rate,
            Goal::Run | Goal::Follow => 1.0 - state.rate,
        };
        let found = self.within_limits(wanted);
        match goal {
            Goal::Cap(ratio) => self.before_caps(found, ratio),
            _ => {
                self.fraction = 1.0;
                found
            }
        }
    }

    /// What the caps ahead leave of a rate acceleration: braking if nothing. Then less is tried in the next period,
    /// or a machine at rest would stay there.
    fn before_caps(&mut self, rate_acceleration: f64, ratio: f64) -> f64 {
        let part = self.fraction * rate_acceleration;
        let rate_acceleration = if rate_acceleration > 0.0 && self.keeps_limits(part) {
            part
        } else {
            rate_acceleration.min(0.0)
        };
        if self.goes_too_far(rate_acceleration, ratio) {
            self.fraction = (0.5 * self.fraction).max(LEAST_FRACTION);
            self.within_limits(-self.state.rate)
        } else {
            self.fraction = (2.0 * self.fraction).min(1.0);
            rate_acceleration
        }
    }

    /// Whether a feed cap ahead could not be kept any more.
    fn goes_too_far(&mut self, rate_acceleration: f64, ratio: f64) -> bool {
        let next = State {
            rate_acceleration: 0.0,
            ..changing(self.state, rate_acceleration).step(0.0)
        };
        if !Caps::lie_ahead(next, ratio, self.servo_period) {
            return false;
        }
        let mut simulation = Simulation {
            table: &self.table,
            limits: &self.limits,
            servo_period: self.servo_period,
            budget: &mut self.budget,
        };
        match keeps_caps(&mut simulation, &self.caps, next) {
            Some(kept) => !kept,
            None => {
                self.wall = true;
                false
            }
        }
    }

    /// The rate acceleration nearest to the wanted one that the limits of acceleration allow.
    fn within_limits(&mut self, wanted: f64) -> f64 {
        if wanted == 0.0 {
            return 0.0;
        }
        let state = self.state;
        let start = self.table.node(state.time);
        let (mut kept, mut refused, mut predicted) = (0.0_f64, wanted, 0.0);
        for _ in 0..PREDICTIONS {
            let end = self.table.node(changing(state, predicted).step(0.0).time);
            let interval = Span::new(&self.table, &self.limits, &start, &end)
                .rate_acceleration_interval(state.rate, predicted);
            // The reference itself may be on a limit, but for rounding: no change is always possible.
            let rate_acceleration = wanted
                .max(interval.low.min(0.0))
                .min(interval.high.max(0.0));
            if rate_acceleration.abs() <= kept.abs() {
                break;
            }
            if self.keeps_limits(rate_acceleration) {
                kept = rate_acceleration;
            } else {
                refused = rate_acceleration;
            }
            predicted = rate_acceleration;
        }
        if kept != 0.0 {
            return kept;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (kept + refused);
            if self.keeps_limits(middle) {
                kept = middle;
            } else {
                refused = middle;
            }
        }
        kept
    }

    fn keeps_limits(&mut self, rate_acceleration: f64) -> bool {
        let state = changing(self.state, rate_acceleration);
        let next = state.step(0.0);
        if !next.follows(state) {
            return false;
        }
        if !self.table.knows(next.time) {
            self.wall = true;
            return false;
        }
        let (start, end) = (self.table.node(state.time), self.table.node(next.time));
        Span::new(&self.table, &self.limits, &start, &end).keeps_limits(state, next, 0.0)
    }
}

/// The state with a rate acceleration that begins here.
fn changing(state: State, rate_acceleration: f64) -> State {
    State {
        rate_acceleration,
        ..state
    }
}

/// Whether hard braking from `state` keeps the caps, as [`CapsAhead`] sees them; not if that is not seen within
/// [`BRAKING_PERIODS`] or what is left of the budget. `None` if it cannot be told before more cells are known.
#[inline(never)]
fn keeps_caps(simulation: &mut Simulation, caps: &Caps, mut state: State) -> Option<bool> {
    let (table, period) = (simulation.table, simulation.servo_period);
    let mut start = table.node(state.time);
    let mut previous_rate_acceleration = 0.0;
    let mut ahead = CapsAhead::new(caps, table, state.time, period);
    for count in 0..BRAKING_PERIODS {
        match ahead.look(state) {
            // Above the cap from the first: it was lowered just now, and is approached anyway. The hardest
            // braking would end far below it.
            CapOutlook::Exceeded => return Some(count == 0),
            CapOutlook::Kept => return Some(true),
            CapOutlook::Open => {}
        }
        if simulation.spend().is_none() {
            return Some(false);
        }
        (state, start) = brake(simulation, &start, state, &mut previous_rate_acceleration)?;
    }
    Some(false)
}

/// One period of hard braking: the state behind it, and where the reference is then. `None` where that is not known.
fn brake(
    simulation: &Simulation,
    start: &Node,
    state: State,
    previous_rate_acceleration: &mut f64,
) -> Option<(State, Node)> {
    let (table, limits) = (simulation.table, simulation.limits);
    let predicted = changing(state, previous_rate_acceleration.max(-state.rate)).step(0.0);
    if !table.knows(predicted.time) {
        return None;
    }
    let end = table.node(predicted.time);
    let span = Span::new(table, limits, start, &end);
    let interval = span.rate_acceleration_interval(state.rate, *previous_rate_acceleration);
    let rate_acceleration = interval.low.min(0.0).max(-state.rate);
    *previous_rate_acceleration = rate_acceleration;
    let next = changing(state, rate_acceleration).step(0.0);
    let next = State {
        rate: next.rate.clamp(0.0, 1.0),
        rate_acceleration: 0.0,
        ..next
    };
    Some((next, end))
}
