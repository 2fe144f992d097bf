//! The servo cycle: runs the reference trajectory with a time of its own, within all limits.
//!
//! The planner gives a reference trajectory q*(tau) that keeps all limits and ends at rest. The
//! [`Executor`] runs it: in each servo period it decides how far the reference time tau advances.
//! With the rate l = dtau/dt, the rate acceleration m = dl/dt and the rate jerk n = dm/dt, and Qk the k-th
//! derivative of the reference by tau, the machine moves with
//!
//! ```text
//! q'   = l Q1
//! q''  = l^2 Q2 + m Q1
//! q''' = l^3 Q3 + 3 l m Q2 + n Q1
//! ```
//!
//! Two facts carry everything. At a constant rate the motion is feasible for ever, at every one from
//! 0 to 1. So a state is safe if the rate acceleration can be brought to 0 from it within the limits: the executor
//! always holds one such backup trajectory, verified against the cells of the table, and follows it until it
//! has found a better move that comes with a backup trajectory of its own. Hence feed hold, override and
//! abort may come at any instant, in any order. Where no axis has a limit of jerk, the rate acceleration
//! may jump to 0 at once, and nothing has to be released.
//!
//! Inside, time is counted in servo periods: a velocity is what an axis moves in one period. The
//! formulas then need no period, and a [cell](Cell) of the table is one unit of reference time.

mod backup_refusal;
mod backup_trajectory;
mod braking;
mod cap;
mod caps_ahead;
pub mod cell;
mod decision;
mod demand;
mod executor;
mod feed_block;
mod follow;
mod goal;
mod jerk;
mod rate_derivative_interval;
mod rows;
mod search;
mod simulated_period;
mod simulation;
mod state;
mod stored_cell;
mod table;
mod without_jerk_limit;

pub use cell::{Cell, FeedPerTurn};
pub use demand::{Demand, ExecutorStep};
pub use executor::{ConfigureError, Executor};
pub use follow::Follow;
pub use jerk::JERK_KEPT;
pub use table::{CAPACITY, CloseError, PushError};
