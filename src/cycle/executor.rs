//! The servo cycle: one decision for each servo period.

use super::backup_trajectory::BackupTrajectory;
use super::cap::{Caps, FORESIGHT};
use super::caps_ahead::BRAKING_PERIODS;
use super::cell::Cell;
use super::demand::{Demand, ExecutorStep};
use super::follow::Pursuit;
use super::goal::Goal;
use super::rows::PeriodLimits;
use super::state::State;
use super::table::{CloseError, PushError, Table, USABLE};
use crate::axes::{Axes, AxisLimits};
use crate::lanes::axes_of;

/// Servo periods that may be simulated in one cycle: bounds its cost.
pub(super) const BUDGET: usize = 384;

/// Where caps may bind, cells that are wanted in the period in which a machine starts from rest ..
const CELLS_AT_START: usize = 24;

/// .. and how many more with each period since: it is no faster than it could become by then, and brakes as fast as it
/// gathers speed. With jerk alone three times the time lead 26 times as far, and coming to rest takes 11 times as far as it
/// has come by then. With 1 a period it is twice the time and 7 times as far: too late.
const MORE_CELLS_A_PERIOD: usize = 2;

/// Why limits or a servo period were refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConfigureError {
    /// The servo period is not a positive, finite number of seconds.
    ServoPeriod(f64),
    /// A limit is zero, negative or not a number.
    Limit {
        /// Index of the axis.
        axis: usize,
    },
}

/// Runs the reference trajectory with a time of its own, within all limits. See [`super`].
///
/// In each servo period the planner pushes cells until [`Executor::cells_ahead`] reaches
/// [`Executor::cells_wanted`], or closes the reference where it comes to rest for good; then it
/// calls [`Executor::cycle`] and advances its own position in the reference by what the step says.
#[derive(Clone, Debug)]
pub struct Executor {
    pub(super) table: Table,
    pub(super) state: State,
    /// Seconds; 0 before the first [`Executor::configure`].
    pub(super) servo_period: f64,
    pub(super) limits: PeriodLimits,
    /// The stored backup trajectory is `backups[stored]`; the other one is for the candidate.
    pub(super) backups: [BackupTrajectory; 2],
    pub(super) stored: usize,
    /// Part of the way to the wanted rate jerk that the search tries first.
    pub(super) fraction: f64,
    /// Whether that was towards a lower rate jerk than the stored backup trajectory's.
    pub(super) brakes: bool,
    pub(super) goal: Goal,
    pub(super) caps: Caps,
    /// In a thread: where to be.
    pub(super) pursuit: Option<Pursuit>,
    pub(super) greatest_programmed_feed: f64,
    /// Periods left to simulate in this cycle.
    pub(super) budget: usize,
    pub(super) wall: bool,
    pub(super) started: bool,
    pub(super) starved: bool,
    /// Servo periods of the reference, those before its first motion in which it was held among them.
    pub(super) periods_since_start: usize,
    pub(super) end_reached: bool,
    pub(super) backups_lost: u64,
}

impl Executor {
    /// At rest, with an empty table. It takes no cells before [`Executor::configure`].
    pub const fn new() -> Self {
        Self {
            table: Table::new(),
            state: State::START,
            servo_period: 0.0,
            limits: PeriodLimits::UNLIMITED,
            backups: [BackupTrajectory::EMPTY, BackupTrajectory::EMPTY],
            stored: 0,
            fraction: 1.0,
            brakes: false,
            goal: Goal::Run,
            caps: Caps::NONE,
            pursuit: None,
            greatest_programmed_feed: 0.0,
            budget: 0,
            wall: false,
            started: false,
            starved: false,
            periods_since_start: 0,
            end_reached: false,
            backups_lost: 0,
        }
    }

    /// Sets limits and servo period (seconds) and [resets](Executor::reset).
    pub fn configure(
        &mut self,
        limits: &AxisLimits,
        servo_period: f64,
    ) -> Result<(), ConfigureError> {
        if !(servo_period > 0.0 && servo_period.is_finite()) {
            return Err(ConfigureError::ServoPeriod(servo_period));
        }
        check(limits)?;
        self.servo_period = servo_period;
        self.limits = PeriodLimits::new(limits, servo_period);
        self.reset();
        Ok(())
    }

    /// Sets the limits, at any time after [`Executor::configure`]. A reference planned for higher
    /// limits is still run as it is: the executor only adds nothing to what it needs.
    pub fn set_limits(&mut self, limits: &AxisLimits) -> Result<(), ConfigureError> {
        if self.servo_period == 0.0 {
            return Err(ConfigureError::ServoPeriod(self.servo_period));
        }
        check(limits)?;
        self.limits = PeriodLimits::new(limits, self.servo_period);
        Ok(())
    }

    /// Forgets the reference. To be called at rest only: before the first cell, when the end is
    /// reached, or after a hold. The next cell pushed starts a new reference, from rest.
    pub fn reset(&mut self) {
        self.table.clear();
        self.state = State::START;
        for backup in &mut self.backups {
            backup.clear();
        }
        self.fraction = 1.0;
        self.greatest_programmed_feed = 0.0;
        self.wall = false;
        self.started = false;
        self.starved = false;
        self.periods_since_start = 0;
        self.end_reached = false;
    }

    /// Adds the next cell of the reference.
    pub fn push(&mut self, cell: &Cell) -> Result<(), PushError> {
        if self.servo_period == 0.0 {
            return Err(PushError::NotConfigured);
        }
        self.table.push(cell, self.servo_period)?;
        let feed = if cell.feed_per_turn.is_some() {
            cell.path_velocity * cell.feed_ratio * self.servo_period
        } else {
            cell.programmed_feed * self.servo_period
        };
        self.greatest_programmed_feed = self.greatest_programmed_feed.max(feed);
        Ok(())
    }

    /// The reference ends at rest `seconds` after the start of the last cell pushed (0 to one
    /// servo period). The table then needs no more cells.
    pub fn close(&mut self, seconds: f64) -> Result<(), CloseError> {
        let time = if self.servo_period > 0.0 {
            seconds / self.servo_period
        } else {
            0.0
        };
        self.table.close(time, self.state.time)
    }

    /// Cells known from the one that the reference time lies in, that one included.
    pub fn cells_ahead(&self) -> usize {
        self.table.length()
    }

    /// The spindle whose turns [`Demand::turns`] is to say: that of the first cells ahead which follow one.
    pub fn spindle_ahead(&self) -> Option<usize> {
        self.table.spindle()
    }

    /// How many cells, from the one that the reference time lies in, the executor wants to know
    /// before the next cycle. Pushing more than 8 in one cycle is never needed. When the reference
    /// is closed there is nothing more to push.
    ///
    /// The less is frozen in the table, the sooner the planner's improvements count. So it is
    /// little while the reference runs as it is, as far as the stored backup trajectory reaches while the
    /// rate changes, and as far as it takes to brake where a feed cap may bind.
    pub fn cells_wanted(&self) -> usize {
        // From the time of the state to the end of the cell behind, which is known only when the
        // next one is.
        const BOTH_ENDS: usize = 2;
        // 6 ms, but no less than it takes to answer a demand, and no more than is of use.
        let mut wanted = ((6e-3 / self.servo_period.max(1e-9)) as usize).clamp(4, 6);
        if self.goal == Goal::Hold || !self.is_idle() {
            wanted = wanted.max(self.cells_for_backup());
        }
        if self.may_be_capped() {
            wanted = wanted.max(self.cells_to_brake());
        }
        wanted = wanted.saturating_add(BOTH_ENDS);
        if self.wall {
            wanted = wanted.max(self.table.length() + 8);
        }
        wanted.min(USABLE)
    }

    /// How many cells the executor cannot do without while its rate changes, from the one that the
    /// reference time lies in; 0 while it does not. A backup trajectory must not leave the known cells: with less
    /// of them a hold takes longer.
    pub fn cells_needed(&self) -> usize {
        if self.state.rate_acceleration != 0.0 || self.goal == Goal::Hold && self.state.rate > 0.0 {
            self.cells_for_backup()
        } else {
            0
        }
    }

    /// Whether the machine moves and would run out of cells in the next cycle.
    pub fn is_dry(&self) -> bool {
        let moves = self.state.rate > 0.0 || self.state.rate_acceleration != 0.0;
        self.started && moves && self.table.end().is_none() && self.table.length() < 2
    }

    /// Velocity and acceleration of what the limits hold for, units and seconds, behind the last servo period.
    pub fn motion(&self) -> [Axes; 2] {
        if self.end_reached || !self.started {
            return [Axes::zeros(); 2];
        }
        let node = self.table.node(self.state.time);
        let (velocity, acceleration) = (axes_of(&node.velocity), axes_of(&node.acceleration));
        let (rate, period) = (self.state.rate, self.servo_period);
        let by_rate = velocity * self.state.rate_acceleration;
        [
            velocity * (rate / period),
            (acceleration * (rate * rate) + by_rate) / (period * period),
        ]
    }

    /// How often the stored backup trajectory ended before the rate acceleration was 0: a count of numerical
    /// accidents, to be 0.
    pub fn backups_lost(&self) -> u64 {
        self.backups_lost
    }

    /// One servo period.
    pub fn cycle(&mut self, demand: &Demand) -> ExecutorStep {
        self.wall = false;
        if self.end_reached || self.table.length() == 0 && !self.started {
            return self.standing();
        }
        self.caps = Caps::new(demand, self.servo_period);
        let period = self.servo_period;
        self.pursuit = demand.follow.map(|follow| Pursuit::new(&follow, period));
        let goal = self.goal(demand);
        if !self.started {
            // The reference starts at rest: every rate is the same motion.
            self.state.rate = if goal == Goal::Hold { 0.0 } else { 1.0 };
        }
        self.budget = BUDGET;
        if goal == Goal::Follow || self.limits.limit_jerk() {
            let rate_jerk = self.decide(goal);
            let rate_jerk = if rate_jerk.is_finite() {
                rate_jerk
            } else {
                0.0
            };
            self.commit(rate_jerk, self.state.step(rate_jerk).settled())
        } else {
            self.state.rate_acceleration = self.rate_acceleration(goal);
            let next = self.state.step(0.0);
            self.commit(
                0.0,
                State {
                    rate_acceleration: 0.0,
                    ..next
                },
            )
        }
    }

    /// Takes the step with this rate jerk, behind which the state is `next`.
    fn commit(&mut self, rate_jerk: f64, next: State) -> ExecutorStep {
        let state = self.state;
        let mut next = next.within_range();
        // At a rate of 1 this is exactly one period, wherever in its cell the time lies.
        let mut advance = state.advance(rate_jerk).clamp(0.0, 1.0);
        next.time = state.time + advance;
        let known = self.table.length() as f64;
        match self.table.end() {
            Some(end) if next.time >= end => {
                self.end_reached = true;
                advance = (end - state.time).max(0.0);
                next.time = end.max(state.time);
            }
            None if next.time > known => {
                self.starved = true;
                self.backup_mut().clear();
                advance = (known - state.time).max(0.0);
                next = State {
                    time: known,
                    rate: 0.0,
                    rate_acceleration: 0.0,
                };
            }
            _ => {}
        }
        self.started |= advance > 0.0;
        self.periods_since_start = self.periods_since_start.saturating_add(1);
        self.state = next;
        let passed = next.time as usize;
        if passed > 0 {
            self.table.discard(passed);
            self.state.time -= passed as f64;
            for backup in &mut self.backups {
                backup.shift(passed as f64);
            }
        }
        ExecutorStep {
            advance: advance * self.servo_period,
            ..self.standing()
        }
    }

    /// The answer for the present state, without an advance.
    fn standing(&mut self) -> ExecutorStep {
        let rests = self.end_reached || !self.started;
        let (rate, rate_acceleration) = if rests {
            (0.0, 0.0)
        } else {
            (
                self.state.rate,
                self.state.rate_acceleration / self.servo_period,
            )
        };
        ExecutorStep {
            advance: 0.0,
            rate,
            rate_acceleration,
            at_rest: rate == 0.0 && rate_acceleration == 0.0,
            end_reached: self.end_reached,
            wall: self.wall,
            starved: std::mem::take(&mut self.starved),
        }
    }

    /// Whether there is nothing to release and nothing to gain.
    fn is_idle(&self) -> bool {
        self.state.rate_acceleration == 0.0 && (self.state.rate == 0.0 || self.state.rate == 1.0)
    }

    /// As far as the stored backup trajectory reaches, and as far again as it may reach after the next cycle.
    fn cells_for_backup(&self) -> usize {
        self.backup().end_time() as usize + 16
    }

    fn may_be_capped(&self) -> bool {
        matches!(self.goal, Goal::Cap(_)) || self.caps.may_bind(self.greatest_programmed_feed)
    }

    /// Cells within which a change of feed is foreseen: those in which the machine may brake for a cap and
    /// those that are looked at from there, and no less than a jerk-limited change from the greatest
    /// programmed feed takes. Soon after the start less: what is frozen then has hardly been planned yet.
    fn cells_to_brake(&self) -> usize {
        let braking = (2.0 * self.greatest_programmed_feed / self.limits.least_jerk()).sqrt();
        let period = self.servo_period.max(1e-9);
        let seen = BRAKING_PERIODS as f64 + FORESIGHT / period;
        let most = seen.max(0.02 / period + 1.6 * braking) as usize;
        let since_start = self.periods_since_start.saturating_mul(MORE_CELLS_A_PERIOD);
        most.min(CELLS_AT_START.saturating_add(since_start))
    }

    pub(super) fn backup(&self) -> &BackupTrajectory {
        &self.backups[self.stored & 1]
    }

    pub(super) fn backup_mut(&mut self) -> &mut BackupTrajectory {
        &mut self.backups[self.stored & 1]
    }
}

impl Default for Executor {
    fn default() -> Self {
        Self::new()
    }
}

fn check(limits: &AxisLimits) -> Result<(), ConfigureError> {
    for kind in [&limits.velocity, &limits.acceleration, &limits.jerk] {
        for (axis, limit) in kind.iter().enumerate() {
            if limit.is_nan() || *limit <= 0.0 {
                return Err(ConfigureError::Limit { axis });
            }
        }
    }
    Ok(())
}
