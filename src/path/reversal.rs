//! Where a line leads straight back: without a tolerance, what a corner there is cut off is a depth that is not reached.

use super::leg::Leg;
use super::metric::Metric;
use crate::axes::Axes;

/// The sum of two unit vectors that turn by 178 degrees: from there on LinuxCNC's planner comes to rest, too.
const LEAST_SUM: f64 = 0.035;

/// Whether what comes behind `before` leads back over it, from one direction to the other, and to round that would lose more than
/// what the path may be off the program anyway.
pub(super) fn is_reversal(before: &Leg, after: &Leg, turn: [&Axes; 2], metric: &Metric) -> bool {
    let cuts_corners = before.allows_half_legs() && after.allows_half_legs();
    let most_lost = 0.5 * before.length.min(after.length);
    if !cuts_corners || most_lost <= before.tolerance().min(after.tolerance()) {
        return false;
    }
    let [from, to] = turn.map(|direction| direction / metric.norm(direction));
    metric.norm(&(from + to)) < LEAST_SUM
}
