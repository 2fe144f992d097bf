//! The verified backup trajectory: how the rate change m is brought to 0 from where the machine is.
//!
//! A backup trajectory is a list of n, one for each servo period to come. It was simulated against the
//! cells of the table, so following it keeps all limits; behind its last entry the rate stays as
//! it is, which is feasible for ever. As long as one is stored, nothing can go wrong.

use super::rows::{PeriodLimits, Span};
use super::simulation::Simulation;
use super::state::State;
use super::table::Node;

/// Longest backup trajectory, servo periods. A power of two.
const LONGEST: usize = 256;

/// How often a period is predicted before it is given up.
const PREDICTIONS: usize = 2;

/// Part of the jerk limit that is held back while the rate rises, at a rate of 1.
const RESERVE_AT_FULL_RATE: f32 = 0.01;

/// How much more is held back towards a rate of 0.
const FURTHER_RESERVE: f32 = 0.3;

/// Whether a backup trajectory may need all of the jerk.
///
/// Where the reference turns at its jerk limit, turning takes nearly all of the jerk. A rate that rises as
/// fast as it can just be released runs along the edge of what is possible, and a hold cannot leave that
/// edge: the rate rises on nearly to 1, whatever is done. With a little held back a hold while the rate
/// rises ends up to 100 ms earlier, at the price of a rise that takes 3 to 12 % longer on such curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reserve {
    /// All of it.
    Used,
    /// A part is held back for a hold that may come.
    Kept,
}

/// Part of the jerk limit that may be used at this rate with [`Reserve::Kept`].
fn kept_part(rate: f64) -> f32 {
    1.0 - RESERVE_AT_FULL_RATE - FURTHER_RESERVE * (1.0 - rate as f32)
}

/// Why no backup trajectory was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BackupRefusal {
    /// It would leave the known cells.
    Wall,
    /// It breaks a limit, or the rate would leave 0 to 1.
    Limits,
    /// It takes longer than the periods that may be simulated in one cycle.
    Budget,
}

/// A list of n that brings the rate change to 0.
#[derive(Clone, Debug)]
pub struct BackupTrajectory {
    n: [f64; LONGEST],
    length: usize,
    next: usize,
    /// When the rate change is 0, in the time of the table.
    end_time: f64,
}

impl BackupTrajectory {
    pub const EMPTY: Self = Self {
        n: [0.0; LONGEST],
        length: 0,
        next: 0,
        end_time: 0.0,
    };

    /// Nothing to release.
    pub fn clear(&mut self) {
        self.length = 0;
        self.next = 0;
        self.end_time = 0.0;
    }

    /// A single n, after which the state is `end`.
    pub fn set_single(&mut self, n: f64, end: State) {
        self.start();
        self.append(n);
        self.end_time = end.time;
    }

    /// The n of the next period, `None` behind the last one.
    pub fn next(&self) -> Option<f64> {
        if self.next < self.length {
            self.n.get(self.next).copied()
        } else {
            None
        }
    }

    /// Whether one n is left.
    pub fn is_last(&self) -> bool {
        self.next + 1 == self.length
    }

    /// Takes the next n as done.
    pub fn advance(&mut self) {
        self.next = self.next.saturating_add(1).min(LONGEST);
    }

    /// When the rate change is 0, in the time of the table.
    pub fn end_time(&self) -> f64 {
        self.end_time
    }

    /// The origin of time moves on by `time`.
    pub fn shift(&mut self, time: f64) {
        self.end_time -= time;
    }

    fn start(&mut self) {
        self.length = 0;
        self.next = 0;
    }

    fn append(&mut self, n: f64) -> bool {
        match self.n.get_mut(self.length) {
            Some(slot) => {
                *slot = n;
                self.length += 1;
                true
            }
            None => false,
        }
    }

    /// Simulates the fastest backup trajectory from `state`, reached with `previous_n`, and stores it.
    #[inline(never)]
    pub fn find(
        &mut self,
        simulation: &mut Simulation,
        reserve: Reserve,
        state: State,
        previous_n: f64,
    ) -> Result<(), BackupRefusal> {
        self.start();
        let table = simulation.table;
        if !table.knows(state.time) {
            return Err(BackupRefusal::Wall);
        }
        let mut here = Place {
            n: previous_n,
            state,
            node: table.node(state.time),
        };
        for _ in 0..=LONGEST {
            let state = here.state;
            if state.is_steady() || table.is_behind_end(state.time) {
                self.end_time = state.time;
                return Ok(());
            }
            let reduced;
            let limits = match reserve {
                Reserve::Used => simulation.limits,
                Reserve::Kept => {
                    reduced = simulation.limits.with_jerk_part(kept_part(state.rate));
                    &reduced
                }
            };
            here = fastest_step(simulation, limits, &here)?;
            if !self.append(here.n) {
                return Err(BackupRefusal::Budget);
            }
        }
        Err(BackupRefusal::Budget)
    }
}

/// Where a backup trajectory is between two periods.
struct Place {
    /// The n that led here.
    n: f64,
    state: State,
    /// The reference here.
    node: Node,
}

/// One period of the fastest backup trajectory. The rows are linearised around the n of the period before; where
/// that is far off, as at the start of a backup trajectory, they are once more, around what they gave.
#[inline(always)]
fn fastest_step(
    simulation: &mut Simulation,
    limits: &PeriodLimits,
    start: &Place,
) -> Result<Place, BackupRefusal> {
    let (table, state) = (simulation.table, start.state);
    let wanted = -state.rate_change;
    let mut predicted_n = start.n;
    for _ in 0..PREDICTIONS {
        simulation.spend().ok_or(BackupRefusal::Budget)?;
        let predicted = state.step(predicted_n);
        if !table.knows(predicted.time) {
            return Err(BackupRefusal::Wall);
        }
        let node = table.node(predicted.time);
        let span = Span::new(table, limits, &start.node, &node);
        let interval = span.jerk_interval(state, predicted);
        if interval.is_empty() {
            return Err(BackupRefusal::Limits);
        }
        let n = interval.nearest(wanted);
        let mut next = state.step(n);
        if n == wanted {
            next.rate_change = 0.0;
        }
        if !table.knows(next.time) {
            return Err(BackupRefusal::Wall);
        }
        if !next.follows(state) {
            return Err(BackupRefusal::Limits);
        }
        if span.keeps_limits(state, next, n) {
            return Ok(Place {
                n,
                state: next,
                node,
            });
        }
        predicted_n = n;
    }
    Err(BackupRefusal::Limits)
}

#[cfg(test)]
mod tests {
    use super::super::cell::Cell;
    use super::super::table::Table;
    use super::*;
    use crate::axes::{Axes, AxisLimits};

    fn table(count: u32, cell_at: impl Fn(f64) -> Cell) -> Box<Table> {
        let mut table = Box::new(Table::new());
        table.clear();
        for i in 0..count {
            table.push(&cell_at(f64::from(i)), 1.0).unwrap();
        }
        table
    }

    fn cell(velocity: f64, acceleration: f64, jerk: f64) -> Cell {
        let acceleration_end = acceleration + jerk;
        Cell {
            velocity: Axes::x() * velocity,
            acceleration: Axes::x() * acceleration,
            acceleration_min: Axes::x() * acceleration.min(acceleration_end),
            acceleration_max: Axes::x() * acceleration.max(acceleration_end),
            jerk_min: Axes::x() * jerk,
            jerk_max: Axes::x() * jerk,
            path_velocity: velocity,
            path_acceleration: acceleration,
            feed_ratio: 1.0,
            programmed_feed: 0.1,
            per_turn: false,
            rapid: false,
            override_enabled: true,
        }
    }

    /// X moves 0.1 per period, for ever.
    fn cruise(count: u32) -> Box<Table> {
        table(count, |_| cell(0.1, 0.0, 0.0))
    }

    fn limits() -> PeriodLimits {
        let limits = AxisLimits {
            velocity: Axes::repeat(1.0),
            acceleration: Axes::repeat(1e-3),
            jerk: Axes::repeat(2e-5),
        };
        PeriodLimits::new(&limits, 1.0)
    }

    fn find(
        backup: &mut BackupTrajectory,
        table: &Table,
        (reserve, state): (Reserve, State),
        budget: &mut usize,
    ) -> Result<(), BackupRefusal> {
        let mut simulation = Simulation {
            table,
            limits: &limits(),
            servo_period: 1.0,
            budget,
        };
        backup.find(&mut simulation, reserve, state, 0.0)
    }

    const BRAKING: State = State {
        time: 0.0,
        rate: 0.7,
        rate_change: -0.008,
    };

    #[test]
    fn it_takes_the_time_that_the_jerk_asks_for() {
        let table = cruise(200);
        let mut backup = BackupTrajectory::EMPTY;
        let mut budget = 100;
        let found = find(&mut backup, &table, (Reserve::Used, BRAKING), &mut budget);
        assert_eq!(found, Ok(()));
        // 0.0008 of acceleration at 2e-5 of jerk.
        assert!((58..=60).contains(&budget), "{budget}");
        let mut state = BRAKING;
        while let Some(n) = backup.next() {
            assert!((n * 0.1).abs() <= 2.001e-5);
            state = state.step(n);
            backup.advance();
        }
        assert!(state.is_steady() && state.rate > 0.5);
        assert!((state.time - backup.end_time()).abs() < 1e-9);
        assert_eq!(backup.next(), None);
    }

    #[test]
    fn what_is_held_back_makes_it_longer() {
        let table = cruise(200);
        let periods = |reserve| {
            let (mut backup, mut budget) = (BackupTrajectory::EMPTY, 100);
            find(&mut backup, &table, (reserve, BRAKING), &mut budget).unwrap();
            f64::from(100 - budget as u32)
        };
        // The rate goes from 0.7 to 0.5.
        let ratio = periods(Reserve::Kept) / periods(Reserve::Used);
        assert!((1.1..1.2).contains(&ratio), "{ratio}");
    }

    #[test]
    fn refusals_are_told_apart() {
        let find = |table: &Table, state, mut budget: usize| {
            let mut backup = BackupTrajectory::EMPTY;
            find(&mut backup, table, (Reserve::Used, state), &mut budget)
        };
        let long = cruise(200);
        assert_eq!(find(&long, BRAKING, 20), Err(BackupRefusal::Budget));
        let slow = State {
            rate: 0.1,
            ..BRAKING
        };
        assert_eq!(find(&long, slow, 100), Err(BackupRefusal::Limits));
        assert_eq!(find(&cruise(10), BRAKING, 100), Err(BackupRefusal::Wall));
    }

    #[test]
    fn the_end_of_the_reference_releases_too() {
        // X comes to rest with constant jerk in ten periods.
        let jerk = 1e-5;
        let mut table = table(10, |time| {
            let left = 10.0 - time;
            cell(0.5 * jerk * left * left, -jerk * left, jerk)
        });
        table.close(1.0, 0.0).unwrap();
        let nearly_there = State {
            time: 9.6,
            ..BRAKING
        };
        let mut backup = BackupTrajectory::EMPTY;
        let found = find(&mut backup, &table, (Reserve::Used, nearly_there), &mut 100);
        assert_eq!(found, Ok(()));
        assert!((10.0..11.0).contains(&backup.end_time()));
    }
}
