//! What the rest of the planner sees of a blended path: its progress, legs and vertices.

use crate::moves::shape::measure::Measure;

/// Where the machine is in the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoveProgress {
    /// Number of the move; of merged moves that of the last one.
    pub serial: u64,
    /// Number of the first of merged moves.
    pub first: u64,
    /// What F has counted since the start of the leg.
    pub distance: f64,
    /// What F will count until its end.
    pub distance_to_go: f64,
}

/// A leg: a move, or several merged ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegView {
    /// Number of the move; of merged moves that of the last one.
    pub serial: u64,
    /// Number of the first of merged moves.
    pub first: u64,
    /// Where it starts, path distance.
    pub start: f64,
    /// Where it ends, path distance.
    pub end: f64,
    /// Its programmed speed, path distance per second: with this ds/dt the programmed path is run
    /// through at F. Where a corner is rounded the path is shorter than the programmed one, and
    /// ds/dt may be higher: `speed * measure_rate` over the length of dq/ds in F's measure.
    pub speed: f64,
    /// The same for the feed that no override may exceed.
    pub greatest_speed: f64,
    /// How far its direction turns for a unit of path distance, radians: 0 on a line.
    pub turning: f64,
    /// How much F counts for a unit of path distance.
    pub measure_rate: f64,
    /// What F counts.
    pub measure: Measure,
}

/// A vertex: where two legs meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexView {
    /// Where it is, path distance.
    pub s: f64,
    /// How far the path around it is changed to both sides. Where two legs meet without a turn in
    /// the middle of a smoothed run, as far as for its neighbours.
    pub reach: f64,
    /// How far a sharper change in the middle reaches: the rounded corner within an easement, or
    /// the easement within a rounded corner; 0 if both are of about the same size, or there is only
    /// one.
    pub core: f64,
    /// Whether the machine comes to rest there: the direction may jump.
    pub stop: bool,
    /// Whether the curvature of the program jumps there: then the third derivative of the path may jump as well.
    pub curvature_jumps: bool,
    /// Whether the speeds of the legs differ that meet there.
    pub speed_changes: bool,
}
