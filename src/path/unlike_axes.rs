//! Sharp corners between a leg that a slow axis moves along and one that a fast axis does: a drill is drawn back, and the table
//! moves on.
//!
//! Runs are [faired](super::fairing), and widths of kernels that overlap are chosen, as if all of the path were run at about one
//! speed. Beside such a corner it is not: once the slow axis stands the machine gathers speed on the fast leg many times as soon as it
//! could in the corner. What still moves the slow axis there, however little, holds it up all along the leg. So a corner like that
//! keeps its place and stands alone, unless its tolerance is so large that the legs are no more than steps on a way between them.

use super::kernel;
use super::leg::Leg;
use super::linear_axes::{self, share_of_greater_end};
use super::settings::BlendSettings;

/// So many times as slow as the faster leg a corner is at least.
const UNLIKE: f64 = 5.0;

/// Length of the difference of unit vectors by which it turns at least: 40 degrees.
const SHARP: f64 = 0.7;

/// It stands alone if the kernel that uses up its tolerance is narrower than this share of the faster leg ..
const OF_FASTER: f64 = 0.4;

/// .. and, times as slow as it is, of the shorter one.
const OF_SHORTER: f64 = 0.125;

/// Whether the corner between two legs is one that stands alone for that.
pub(super) fn stands_alone(before: &Leg, after: &Leg, settings: &BlendSettings) -> bool {
    let from = before.programmed_point(before.end()).first;
    let to = after.programmed_point(after.start).first;
    let jump = to - from;
    let turn = jump.norm();
    if turn < SHARP || !before.is_linear || !after.is_linear {
        return false;
    }
    let widest = before.tolerance().min(after.tolerance())
        / (kernel::peak(0.0) * turn * share_of_greater_end(&linear_axes::of(&jump)));
    let [slower, than_after] =
        [&from, &to].map(|direction| settings.times_as_slow(&jump, direction));
    let (slower, faster_leg) = if than_after > slower {
        (than_after, after)
    } else {
        (slower, before)
    };
    let shorter = before.whole.min(after.whole);
    slower > UNLIKE
        && widest < OF_FASTER * faster_leg.whole
        && widest < OF_SHORTER * slower * shorter
}
