//! What the steps of a slice cost, in units of 20 to 40 ns on a machine of 2020.
//!
//! They need not be exact: a slice ends when its units are spent, give or take one step.

/// A try of an arc at rest: five evaluations of the path.
pub(super) const REST_ARC: u32 = 30;
/// A node of the grid: two evaluations, seldom six.
pub(super) const NODE: u32 = 20;
/// The bounds of an interval.
pub(super) const BOUNDS: u32 = 2;
/// A coefficient in one direction, or in the hull.
pub(super) const SWEEP: u32 = 1;
/// The rows of all axes at three points.
pub(super) const CHECK: u32 = 2;
/// Gradient and second derivatives of an interval, and the elimination of a coefficient.
pub(super) const ASSEMBLE: u32 = 8;
/// A coefficient of a step.
pub(super) const SUBSTITUTE: u32 = 1;
/// Plan and draft changing places, per plan.
pub(super) const ADOPT: u32 = 60;
