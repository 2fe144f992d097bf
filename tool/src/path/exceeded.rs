//! From where on a limit or a tolerance counts as exceeded, where a planner is looked at in its servo cycles only.

/// Beyond this ratio a limit or a tolerance counts as exceeded.
pub(crate) const EXCEEDED: f64 = 1.01;

/// What the measuring itself may be off, mm: the path is known at the end of each cycle only.
const RESOLUTION: f64 = 1e-3;

/// Whether a distance, mm, is beyond a tolerance; 0 in exact modes.
pub(crate) fn is_beyond(distance: f64, tolerance: f64) -> bool {
    distance > EXCEEDED * tolerance + RESOLUTION
}
