//! Rigid tapping: down with the spindle, back up with it, and to rest where it began.
//!
//! The spindle needs some turns to turn back, at the end of the tap and at its start; the machine
//! follows it there too. So the move is run as three: down and up to ten turns beyond, back up the
//! same, and a short move to where it began.

use super::super::planner::Planner;
use super::thread::{SpindleError, Stage};
use crate::axes::Axes;
use crate::cycle::Step;
use crate::moves::SynchronisationMode;
use crate::path::{Line9, Shape, ShapeError};

/// How many turns the spindle may take to turn back, as in LinuxCNC's own planner.
const MOST_TURNS: f64 = 10.0;

/// The spindle has turned back when its angle has by so many turns, and its speed too.
const TURNED_BACK: f64 = 1e-4;

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
    start: Axes,
    /// Unit vector from the start to the end, shape (9).
    direction: Axes,
    /// How far the spindle is to be told to turn round, from where this way began.
    way: f64,
    /// Turns of the sequence where the way up began.
    turned_at: f64,
}

impl Tap {
    /// From `start`, shape (9), by `depth` along `direction`.
    pub fn new(start: &Axes, direction: &Axes, depth: f64) -> Self {
        Self {
            stage: TapStage::Down,
            start: *start,
            direction: *direction,
            way: depth,
            turned_at: 0.0,
        }
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

impl Planner {
    /// The next stage of a tap, where it is due. `distance` from where the way began, `turns` of
    /// the sequence.
    pub(in crate::planner) fn advance_tap(&mut self, step: &Step) {
        let Some((distance, turns, speed, per_turn, scale)) = self.tap_progress() else {
            return;
        };
        let Some(thread) = &mut self.thread else {
            return;
        };
        let Some(tap) = &mut thread.tap else {
            return;
        };
        match tap.stage {
            TapStage::Down if distance >= tap.way => {
                tap.stage = TapStage::TurningBack;
                thread.furthest = turns;
                self.status.spindle_factor = Some((thread.spindle, -scale));
            }
            TapStage::Up if distance >= tap.way => {
                tap.stage = TapStage::TurningForth;
                thread.furthest = turns;
                self.status.spindle_factor = Some((thread.spindle, -1.0 / scale));
            }
            TapStage::TurningBack => {
                thread.furthest = thread.furthest.max(turns);
                if step.at_rest && speed < 0.0 && turns < thread.furthest - TURNED_BACK {
                    let turned_at = tap.turns_at(distance, per_turn);
                    let position = self.status.position;
                    tap.stage = TapStage::Up;
                    tap.turned_at = turned_at;
                    tap.way = (position - tap.start).dot(&tap.direction);
                    thread.furthest = turns;
                    let beyond = tap.start - tap.direction * (MOST_TURNS * per_turn);
                    self.take_way(&beyond, true);
                }
            }
            TapStage::TurningForth => {
                thread.furthest = thread.furthest.min(turns);
                if step.at_rest && speed > 0.0 && turns > thread.furthest + TURNED_BACK {
                    let start = tap.start;
                    self.thread = None;
                    self.take_way(&start, false);
                }
            }
            TapStage::Down | TapStage::Up => {}
        }
    }

    /// Distance on this way, turns of the sequence and how fast they go on, pitch, and the factor of the way up.
    fn tap_progress(&self) -> Option<(f64, f64, f64, f64, f64)> {
        let front = self.queue.front()?;
        let with = front.synchronisation?;
        let SynchronisationMode::Tap { reversal_scale } = with.mode else {
            return None;
        };
        let thread = self.thread.as_ref()?;
        if thread.stage != Stage::Running {
            return None;
        }
        let distance = front.shape.length() - self.status.distance_to_go;
        let tracker = self.trackers.get(thread.spindle)?;
        Some((
            distance,
            self.turns_of(thread),
            thread.sign * tracker.speed(),
            with.per_turn,
            reversal_scale,
        ))
    }

    /// The tap that the next move begins.
    pub(super) fn tap_of_front(&self) -> Option<Tap> {
        let front = self.queue.front()?;
        let per_turn = front.synchronisation?.per_turn;
        let Shape::Line(line) = &front.shape else {
            return None;
        };
        let depth = line.length() - MOST_TURNS * per_turn;
        Some(Tap::new(&self.status.position, line.direction(), depth))
    }

    /// At rest in a tap: goes on to `end`, shape (9), with the spindle or by itself.
    fn take_way(&mut self, end: &Axes, with_spindle: bool) {
        let position = self.status.position;
        let Some(front) = self.queue.front_mut() else {
            return;
        };
        match Line9::new(&position, end) {
            Ok(line) => front.shape = Shape::Line(line),
            // Where it began already.
            Err(_) => {
                self.queue.pop();
                if self.queue.is_empty() {
                    self.drop_moves();
                }
            }
        }
        if !with_spindle && let Some(front) = self.queue.front_mut() {
            front.synchronisation = None;
        }
        self.reference.clear();
        self.executor.reset();
        self.running = false;
        self.report_rest();
    }

    /// Whether a tap came to the end of the turns that the spindle may take to turn back.
    pub(in crate::planner) fn tap_overran(&self) -> bool {
        self.thread.is_some_and(|thread| thread.tap.is_some())
    }

    /// Stops a tap whose spindle did not turn back.
    pub(in crate::planner) fn stop_overrun_tap(&mut self) {
        self.trip(SpindleError::NotReversed);
    }
}
