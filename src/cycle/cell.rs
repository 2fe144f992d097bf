//! What the executor knows of the reference: its derivatives ahead, one cell for each servo period.

use crate::axes::Axes;

/// What feed per turn counts with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedPerTurn {
    /// Number of the spindle, below [`SPINDLE_COUNT`](crate::moves::SPINDLE_COUNT).
    pub spindle: usize,
    /// For how many turns a second the reference is planned at most, above 0.
    pub planned_turns: f64,
}

/// One servo period of the reference trajectory q*(tau).
///
/// The reference is feasible by itself and ends at rest. The executor never needs the path: it
/// runs the reference with a time of its own and needs to know only how fast the reference
/// changes. Values "at the start" are at the first instant of the cell; bounds hold on the whole
/// closed cell, on both sides of every jump of acceleration or jerk inside it.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// First derivative by reference time at the start, units per second.
    pub velocity: Axes,
    /// Second derivative by reference time at the start, units per second squared.
    pub acceleration: Axes,
    /// Least second derivative anywhere in the cell.
    pub acceleration_min: Axes,
    /// Greatest second derivative anywhere in the cell.
    pub acceleration_max: Axes,
    /// Least third derivative anywhere in the cell, units per second cubed.
    pub jerk_min: Axes,
    /// Greatest third derivative anywhere in the cell.
    pub jerk_max: Axes,
    /// Path speed ds/dtau at the start, in the measure that LinuxCNC applies the F word to.
    pub path_velocity: f64,
    /// Its derivative at the start.
    pub path_acceleration: f64,
    /// Greatest feed in this cell over the path speed at its start, or, where the path speed rises,
    /// over the path speed there: 1 where the path parameter is the distance that F counts, less than 1
    /// inside blends.
    pub feed_ratio: f64,
    /// What the program asks for at an override of 100 %: the F word, or the rapid rate.
    pub programmed_feed: f64,
    /// Where [`Self::programmed_feed`] is what a turn of a spindle a second would give: it counts times the turns a second.
    pub feed_per_turn: Option<FeedPerTurn>,
    /// Whether the rapid override applies instead of the feed override.
    pub rapid: bool,
    /// Whether overrides apply at all (M48, or M49 while the move was queued).
    pub override_enabled: bool,
}
