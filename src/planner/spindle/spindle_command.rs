//! Which spindle the moves to come follow.

/// What tells the moves to come to follow a spindle, as it was given.
#[derive(Clone, Copy, Debug)]
pub struct SpindleCommand {
    pub spindle: i32,
    pub per_turn: f64,
    pub speed_only: bool,
}
