//! A rigid tap as it runs: from one way to the next, as the spindle turns back.

use super::super::planner::Planner;
use super::error::SpindleError;
use super::tap::{MOST_TURNS, Tap, TapStage};
use super::thread::Stage;
use crate::axes::Axes;
use crate::cycle::ExecutorStep;
use crate::moves::SynchronisationMode;
use crate::moves::shape::{Line9, Shape};

/// The spindle has turned back when its angle has by so many turns, and its speed too.
const TURNED_BACK: f64 = 1e-4;

impl Planner {
    /// The next stage of a tap, where it is due. `distance` from where the way began, `turns` of
    /// the sequence.
    pub(in crate::planner) fn advance_tap(&mut self, step: &ExecutorStep) {
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
        self.motion.stand();
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
