//! A servo cycle of the plan.

use crate::path::Position;

/// Why the machine stands, or that it moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Activity {
    /// The planner has moves.
    Moves,
    /// G4.
    Dwells,
    /// The program waits for the end of motion, or has ended.
    Waits,
}

/// One servo cycle.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Since the program was started, s.
    pub time: f64,
    /// mm and degrees.
    pub position: Position,
    /// Number of the move that runs, from 0.
    pub running: Option<usize>,
    /// Speed along the path over what the move asks for; 0 where nothing runs.
    pub share_of_feed: f64,
    /// The greatest velocity along the path of the running move, mm/s; infinite where there is none, as where only rotary axes move.
    pub path_velocity: f64,
    /// Whether the next move waits for the spindle: its index or its speed.
    pub awaits_spindle: bool,
    /// What goes on.
    pub activity: Activity,
    /// How many moves are behind the machine.
    pub moves_done: u64,
    /// What F counts until the end of the running or next move, machine units or degrees.
    pub distance_to_go: f64,
}
