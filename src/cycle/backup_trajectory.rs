//! The verified backup trajectory: how the rate acceleration is brought to 0 from where the machine is.
//!
//! A backup trajectory is a list of rate jerks, one for each servo period to come. It was simulated against the
//! cells of the table, so following it keeps all limits; behind its last entry the rate stays as
//! it is, which is feasible for ever. As long as one is stored, nothing can go wrong.

use super::backup_refusal::BackupRefusal;
use super::braking::braking_step;
use super::cap::Caps;
use super::caps_ahead::{BRAKING_PERIODS, CapOutlook, CapsAhead};
use super::rows::PeriodLimits;
use super::simulated_period::{Place, step};
use super::simulation::Simulation;
use super::state::State;

/// Longest backup trajectory, servo periods. A power of two.
const LONGEST: usize = 256;

/// Part of the jerk limit that is held back while the rate rises, at a rate of 1.
const RESERVE_AT_FULL_RATE: f32 = 0.01;

/// How much more is held back towards a rate of 0.
const FURTHER_RESERVE: f32 = 0.3;

/// How often braking for a cap is tried, ..
const BRAKING_ATTEMPTS: usize = 4;

/// .. each time with this part of the greatest rate acceleration of the try before, where that could not be brought to
/// an end within the limits: a path that turns takes nearly all of the jerk.
const GENTLER: f64 = 0.5;

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

/// A list of rate jerks that brings the rate acceleration to 0.
#[derive(Clone, Debug)]
pub struct BackupTrajectory {
    rate_jerks: [f64; LONGEST],
    length: usize,
    next: usize,
    /// When the rate acceleration is 0, in the time of the table.
    end_time: f64,
    /// The feed caps that it keeps, all that is known ahead.
    kept: Option<Caps>,
}

impl BackupTrajectory {
    pub const EMPTY: Self = Self {
        rate_jerks: [0.0; LONGEST],
        length: 0,
        next: 0,
        end_time: 0.0,
        kept: None,
    };

    /// Nothing to release.
    pub fn clear(&mut self) {
        self.length = 0;
        self.next = 0;
        self.end_time = 0.0;
        self.kept = None;
    }

    /// A single rate jerk, after which the state is `end`, and the caps that are kept from there on.
    pub fn set_single(&mut self, rate_jerk: f64, end: State, kept: Option<Caps>) {
        self.start();
        self.append(rate_jerk);
        self.end_time = end.time;
        self.kept = kept;
    }

    /// Whether it leads on, and keeps these caps.
    pub fn keeps(&self, caps: &Caps) -> bool {
        self.next().is_some() && self.kept.as_ref() == Some(caps)
    }

    /// The rate jerk of the next period, `None` behind the last one.
    pub fn next(&self) -> Option<f64> {
        if self.next < self.length {
            self.rate_jerks.get(self.next).copied()
        } else {
            None
        }
    }

    /// Whether one rate jerk is left.
    pub fn is_last(&self) -> bool {
        self.next + 1 == self.length
    }

    /// Takes the next rate jerk as done.
    pub fn advance(&mut self) {
        self.next = self.next.saturating_add(1).min(LONGEST);
    }

    /// When the rate acceleration is 0, in the time of the table.
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
        self.kept = None;
    }

    fn append(&mut self, rate_jerk: f64) -> bool {
        match self.rate_jerks.get_mut(self.length) {
            Some(slot) => {
                *slot = rate_jerk;
                self.length += 1;
                true
            }
            None => false,
        }
    }

    /// Simulates the fastest backup trajectory from `state`, reached with `previous_rate_jerk`, and stores it.
    #[inline(never)]
    pub fn find(
        &mut self,
        simulation: &mut Simulation,
        reserve: Reserve,
        state: State,
        previous_rate_jerk: f64,
    ) -> Result<(), BackupRefusal> {
        self.start();
        let here = Place::new(simulation, state, previous_rate_jerk)?;
        self.release(simulation, reserve, here)
    }

    /// The same below feed caps: one that brakes, hard, until all that is known ahead may be run through at a rate
    /// that does not rise any more.
    #[inline(never)]
    pub fn find_below(
        &mut self,
        simulation: &mut Simulation,
        caps: &Caps,
        state: State,
        previous_rate_jerk: f64,
    ) -> Result<(), BackupRefusal> {
        let start = Place::new(simulation, state, previous_rate_jerk)?;
        let mut least_rate_acceleration = f64::NEG_INFINITY;
        for _ in 0..BRAKING_ATTEMPTS {
            let mut here = start.clone();
            let found = self.brake(simulation, caps, &mut here, least_rate_acceleration);
            if found != Err(BackupRefusal::Limits) {
                found?;
                self.kept = Some(*caps);
                return Ok(());
            }
            least_rate_acceleration = GENTLER * here.state.rate_acceleration.min(0.0);
        }
        Err(BackupRefusal::Limits)
    }

    /// Brakes from `here`, to the end or as far as it goes, with a rate acceleration down to `least_rate_acceleration`.
    fn brake(
        &mut self,
        simulation: &mut Simulation,
        caps: &Caps,
        here: &mut Place,
        least_rate_acceleration: f64,
    ) -> Result<(), BackupRefusal> {
        self.start();
        let (table, period) = (simulation.table, simulation.servo_period);
        let mut ahead = CapsAhead::new(caps, table, here.state.time, period);
        for _ in 0..BRAKING_PERIODS {
            match ahead.look(here.state) {
                CapOutlook::Exceeded => return Err(BackupRefusal::Cap),
                CapOutlook::Kept => return self.release(simulation, Reserve::Used, here.clone()),
                CapOutlook::Open => {}
            }
            *here = braking_step(
                simulation,
                here,
                (least_rate_acceleration, ahead.steady_rate()),
            )?;
            if !self.append(here.rate_jerk) {
                return Err(BackupRefusal::Budget);
            }
        }
        Err(BackupRefusal::Cap)
    }

    /// Brings the rate acceleration to 0 from here.
    fn release(
        &mut self,
        simulation: &mut Simulation,
        reserve: Reserve,
        mut here: Place,
    ) -> Result<(), BackupRefusal> {
        for _ in 0..=LONGEST {
            let state = here.state;
            if state.is_steady() || simulation.table.is_behind_end(state.time) {
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
            if !self.append(here.rate_jerk) {
                return Err(BackupRefusal::Budget);
            }
        }
        Err(BackupRefusal::Budget)
    }
}

/// One period of the fastest backup trajectory.
#[inline(always)]
fn fastest_step(
    simulation: &mut Simulation,
    limits: &PeriodLimits,
    start: &Place,
) -> Result<Place, BackupRefusal> {
    let wanted = -start.state.rate_acceleration;
    step(simulation, limits, start, |_, jerk, _| jerk.nearest(wanted))
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
            feed_per_turn: None,
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
        rate_acceleration: -0.008,
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
        while let Some(rate_jerk) = backup.next() {
            assert!((rate_jerk * 0.1).abs() <= 2.001e-5);
            state = state.step(rate_jerk);
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
