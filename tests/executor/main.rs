//! What the servo cycle does with a plan.

mod demand;
mod edges;
mod holds;
mod limits;
mod support;
mod without_jerk_limit;
