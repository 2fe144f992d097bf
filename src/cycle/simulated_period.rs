//! One servo period of a simulated machine.

use super::backup_refusal::BackupRefusal;
use super::rate_derivative_interval::RateDerivativeInterval;
use super::rows::{PeriodLimits, Span};
use super::simulation::Simulation;
use super::state::State;
use super::table::Node;

/// How often a period is predicted before it is given up.
const PREDICTIONS: usize = 2;

/// Where a simulated machine is between two periods.
#[derive(Clone)]
pub struct Place {
    /// The rate jerk that led here.
    pub rate_jerk: f64,
    pub state: State,
    /// The reference here.
    node: Node,
}

impl Place {
    pub fn new(
        simulation: &Simulation,
        state: State,
        rate_jerk: f64,
    ) -> Result<Self, BackupRefusal> {
        let table = simulation.table;
        if !table.knows(state.time) {
            return Err(BackupRefusal::Wall);
        }
        let node = table.node(state.time);
        Ok(Self {
            rate_jerk,
            state,
            node,
        })
    }
}

/// One period with the rate jerk that is chosen from what the jerk allows. The rows are linearised around that of the
/// period before; where that is far off, as at the start, they are once more, around what they gave.
#[inline(always)]
pub fn step(
    simulation: &mut Simulation,
    limits: &PeriodLimits,
    start: &Place,
    choose: impl Fn(&Span, &RateDerivativeInterval, State) -> f64,
) -> Result<Place, BackupRefusal> {
    let (table, state) = (simulation.table, start.state);
    let mut predicted_rate_jerk = start.rate_jerk;
    for _ in 0..PREDICTIONS {
        simulation.spend().ok_or(BackupRefusal::Budget)?;
        let predicted = state.step(predicted_rate_jerk);
        if !table.knows(predicted.time) {
            return Err(BackupRefusal::Wall);
        }
        let node = table.node(predicted.time);
        let span = Span::new(table, limits, &start.node, &node);
        let interval = span.jerk_interval(state, predicted);
        if interval.is_empty() {
            return Err(BackupRefusal::Limits);
        }
        let rate_jerk = choose(&span, &interval, predicted);
        let next = state.step(rate_jerk);
        if !table.knows(next.time) {
            return Err(BackupRefusal::Wall);
        }
        if !next.follows(state) {
            return Err(BackupRefusal::Limits);
        }
        if span.keeps_limits(state, next, rate_jerk) {
            return Ok(Place {
                rate_jerk,
                state: next,
                node,
            });
        }
        predicted_rate_jerk = rate_jerk;
    }
    Err(BackupRefusal::Limits)
}
