//! Rigid tapping: down with the spindle, back up with it, and to rest where it began.
//!
//! The spindle needs some turns to turn back, at the end of the tap and at its start; the machine
//! follows it there too. So the move is run as three: down and up to ten turns beyond, back up the
//! same, and a short move to where it began.

use crate::axes::Axes;
use crate::moves::Move;
use crate::moves::shape::{Line9, Shape, ShapeError};

/// How many turns the spindle may take to turn back, as in LinuxCNC's own planner.
pub const MOST_TURNS: f64 = 10.0;

/// What of a tap is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TapStage {
    /// To the end.
    Down,
    /// Beyond the end, until the spindle turns back.
    TurningBack,
    /// Back to the start.
    Up,
    /// Beyond the start, until the spindle turns as it did.
    TurningForth,
}

/// A tap under way.
#[derive(Clone, Copy, Debug)]
pub struct Tap {
    pub stage: TapStage,
    /// Where it began, shape (9).
    pub start: Axes,
    /// Unit vector from the start to the end, shape (9).
    pub direction: Axes,
    /// How far the spindle is to be told to turn round, from where this way began.
    pub way: f64,
    /// Turns of the sequence where the way up began.
    pub turned_at: f64,
}

impl Tap {
    /// From `start`, shape (9), by `depth` along `direction`.
    fn new(start: &Axes, direction: &Axes, depth: f64) -> Self {
        Self {
            stage: TapStage::Down,
            start: *start,
            direction: *direction,
            way: depth,
            turned_at: 0.0,
        }
    }

    /// The tap that a move begins which starts from rest at `start`, shape (9).
    pub fn of(queued: &Move, start: &Axes) -> Option<Self> {
        let per_turn = queued.synchronisation?.per_turn;
        let Shape::Line(line) = &queued.shape else {
            return None;
        };
        let depth = line.length() - MOST_TURNS * per_turn;
        Some(Self::new(start, line.direction(), depth))
    }

    /// Whether the machine is on its way up, so that the spindle's angle counts down.
    pub fn is_up(&self) -> bool {
        matches!(self.stage, TapStage::Up | TapStage::TurningForth)
    }

    /// Whether the spindle is to come to a stop and turn back.
    pub fn is_turning(&self) -> bool {
        matches!(self.stage, TapStage::TurningBack | TapStage::TurningForth)
    }

    /// Turns of the sequence at a distance from where this way began.
    pub fn turns_at(&self, distance: f64, per_turn: f64) -> f64 {
        if self.is_up() {
            self.turned_at - distance / per_turn
        } else {
            distance / per_turn
        }
    }
}

/// The way down of a tap to `end`, and as far beyond as the spindle may take to turn back.
///
/// # Errors
/// See [`ShapeError`].
pub fn way_down(start: &Axes, end: &Axes, per_turn: f64) -> Result<Shape, ShapeError> {
    let line = Line9::new(start, end)?;
    let beyond = end + line.direction() * (MOST_TURNS * per_turn);
    Line9::new(start, &beyond).map(Shape::Line)
}
