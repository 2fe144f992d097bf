//! The least time on a path that was executed, and in the tolerance of a program.

#[cfg(test)]
mod calibration;
mod derivatives;
mod executed_path;
mod grid;
mod jerk_limited;
mod limits;
mod spline;
mod stop;
mod topp_ra;
mod tube;

pub(crate) use executed_path::{ExecutedPath, PathSample, corners};
pub(crate) use grid::{Boundary, Grid, spacing};
pub(crate) use jerk_limited::least_time;
pub(crate) use limits::{PathLimits, SpeedCap};
pub(crate) use stop::shortest_stop;
pub(crate) use topp_ra::topp_ra;
pub(crate) use tube::{Leg, least_time_in_tube};
