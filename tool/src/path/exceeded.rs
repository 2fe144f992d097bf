//! From where on a limit or a tolerance counts as exceeded, where a planner is looked at in its servo cycles only.

use super::rates::Quantity;
use framepath::cycle::JERK_KEPT;

/// Beyond this ratio a limit of velocity or acceleration or a tolerance counts as exceeded.
const EXCEEDED: f64 = 1.01;

/// Whether a quantity, over its limit, exceeds it: jerk beyond what blendtp promises of it.
pub(crate) fn exceeds(quantity: Quantity, ratio: f64) -> bool {
    ratio
        > match quantity {
            Quantity::Jerk => JERK_KEPT,
            Quantity::Velocity | Quantity::Acceleration => EXCEEDED,
        }
}

/// What the measuring itself may be off, mm: the path is known at the end of each cycle only.
const RESOLUTION: f64 = 1e-3;

/// Whether a distance, mm, is beyond a tolerance; 0 in exact modes.
pub(crate) fn is_beyond(distance: f64, tolerance: f64) -> bool {
    distance > EXCEEDED * tolerance + RESOLUTION
}
