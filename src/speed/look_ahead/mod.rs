//! Look-ahead: the speed along a path that becomes known move by move.
//!
//! The reference is b = v^2 over s as a quadratic [`spline`]: s, v and a are continuous by
//! construction, and the limits of the axes ([`rows`]) are linear in three coefficients. It is made
//! in two stages.
//!
//! 1. A candidate ([`candidate_plan`]) places nodes ([`grid`]), sweeps forward and backward ([`sweep`]) with scalar
//!    [`bounds`] and takes the [`hull`]. What comes out is not the fastest (1.1 to 1.4 times the
//!    optimum), but it is checked against all rows and ends at rest inside what is known. It then
//!    replaces the plan; where it fails, the plan stands.
//! 2. Steps of Newton's method ([`newton`]) on duration and [`barrier`] refine the part that the
//!    end of what is known hardly influences, to 1 or 2 % above the optimum.
//!
//! Both are done in slices of bounded work. What the executor takes is frozen as [`PlannedSegment`]s;
//! everything else works behind them.

mod barrier;
mod bounds;
mod candidate_plan;
mod context;
mod cost;
mod counted_route;
mod departure;
mod extensions;
mod feature;
mod features;
mod final_braking;
mod first_plan;
mod frozen;
mod grid;
mod hull;
mod interval;
mod interval_check;
mod interval_samples;
#[allow(clippy::module_inception, reason = "the type that the folder is about")]
mod look_ahead;
mod newton;
mod place;
mod plan_time;
mod planned_segment;
mod refinement_pace;
mod refusal;
mod rest_arc;
mod rest_arc_search;
mod route;
mod rows;
mod sample;
mod spline;
mod sweep;
mod sweeps;
#[cfg(test)]
mod test_route;
mod work;

pub use look_ahead::{LookAhead, PlanProgress};
pub use plan_time::PlanEnd;
pub use planned_segment::PlannedSegment;
pub use refusal::PlanRefusal;
pub use route::{MOST_BREAKPOINTS, Route, RouteVertex, SpeedCap};
