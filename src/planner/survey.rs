//! What an operator sees of the planner: what limits the machine now, and how far it looks ahead.

use super::reference::PlaceInMoves;
use super::speed_limit::SpeedLimit;

/// What is known in a servo period. Times are those of an override of 100 %, and of the greater ones that were planned for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Survey {
    /// What keeps the machine from being faster.
    pub limit: SpeedLimit,
    /// Moves that are planned, the running one included.
    pub moves_ahead: usize,
    /// Seconds until the rest at the end of what is planned.
    pub seconds_ahead: f64,
    /// Seconds until the end of what is queued: planned, and behind that as much slower than the feeds ask for.
    pub seconds_queued: f64,
}

/// What is kept for it from period to period.
#[derive(Clone, Copy, Debug)]
pub(super) struct SurveyState {
    pub(super) last: Survey,
    /// Where the plan ends, and where in the moves that is.
    pub(super) end: f64,
    pub(super) place: Option<PlaceInMoves>,
    pub(super) age: u32,
    /// How many times as long as at its feed the program takes where it is planned.
    pub(super) slowness: f64,
}

impl SurveyState {
    pub const NONE: Self = Self {
        last: Survey {
            limit: SpeedLimit::Nothing,
            moves_ahead: 0,
            seconds_ahead: 0.0,
            seconds_queued: 0.0,
        },
        end: 0.0,
        place: None,
        age: 0,
        slowness: 1.0,
    };
}
