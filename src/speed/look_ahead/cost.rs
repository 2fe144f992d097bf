//! What the steps of a slice cost, in units of 20 to 40 ns on a machine of 2020.
//!
//! They need not be exact: a slice ends when its units are spent, give or take one step.

/// An evaluation of the path and the rows there, where so many kernels overlap in the mean
/// and where it takes so many nanoseconds to find what the limits hold for.
pub(super) fn evaluation(kernels: f64, nanoseconds: f64) -> u32 {
    let behind = UNITS_A_NANOSECOND * nanoseconds.clamp(0.0, MOST_NANOSECONDS);
    5 + (0.2 * kernels.clamp(0.0, MOST_KERNELS)) as u32 + behind as u32
}
/// More never overlap.
const MOST_KERNELS: f64 = 64.0;
/// Of what was measured where it runs.
const UNITS_A_NANOSECOND: f64 = 1.0 / 25.0;
/// What takes longer is refused.
const MOST_NANOSECONDS: f64 = 1e5;
/// Choosing where a candidate begins and ends.
pub(super) const BEGIN_CANDIDATE: u32 = 60;
/// Choosing a window of the refinement.
pub(super) const BEGIN_REFINEMENT: u32 = 10;
/// A try of an arc at rest, besides ..
pub(super) const REST_ARC: u32 = 20;
/// .. so many evaluations.
pub(super) const REST_ARC_EVALUATIONS: u32 = 5;
/// A node of the grid or a vertex that asks for some, besides what it looked at: so many points and bends alone, where an evaluation
/// costs that much.
pub(super) fn node([points, bends]: [u32; 2], evaluation: u32) -> u32 {
    let quarters = POINT_QUARTERS * points + BEND_QUARTERS * bends;
    NODE + evaluation.saturating_mul(quarters) / 4
}
const NODE: u32 = 11;
/// Quarters of an evaluation.
const POINT_QUARTERS: u32 = 5;
const BEND_QUARTERS: u32 = 3;
/// The bounds of an interval in which so many axes move.
pub(super) fn bounds(axes: u32) -> u32 {
    3 + axes / 2
}
/// A coefficient in the hull.
pub(super) const SWEEP: u32 = 1;
/// A coefficient in each direction.
pub(super) const SWEEPS: u32 = 2;
/// The rows of all axes at three places: of three axes, twice as much of nine.
pub(super) const CHECK: u32 = 3;
/// Gradient and second derivatives of an interval, and the elimination of a coefficient; the same.
pub(super) const ASSEMBLE: u32 = 11;
/// A coefficient of a step.
pub(super) const SUBSTITUTE: u32 = 1;
/// Plan and candidate changing places, per plan.
pub(super) const ADOPT: u32 = 60;
