//! A rigid tap as it runs: from one way to the next, as the spindle turns back.

use super::super::status::Status;
use super::follower::SpindleFollower;
use super::move_at_hand::MoveAtHand;
use super::tap::{MOST_TURNS, TapStage};
use super::thread::Stage;
use crate::axes::Axes;
use crate::cycle::ExecutorStep;
use crate::moves::SynchronisationMode;

/// The spindle has turned back when its angle has by so many turns, and its speed too.
const TURNED_BACK: f64 = 1e-4;

/// How a tap goes on from rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Where it leads, shape (9).
    pub end: Axes,
    /// Whether with the spindle, or by itself.
    pub with_spindle: bool,
}

/// Where a tap is.
struct TapProgress {
    /// From where this way began, units of the move's measure.
    distance: f64,
    /// Of the sequence, and how fast they go on, turns and turns a second.
    turns: f64,
    speed: f64,
    /// Pitch, units a turn.
    per_turn: f64,
    /// How much faster the spindle turns on the way up.
    reversal_scale: f64,
}

impl SpindleFollower {
    /// The next stage of a tap, where it is due: the way that it goes on with if it is at rest, and in `status`
    /// what the spindle is told.
    pub fn advance_tap(
        &mut self,
        running: &MoveAtHand,
        step: &ExecutorStep,
        status: &mut Status,
    ) -> Option<Way> {
        let progress = self.tap_progress(running, status)?;
        let TapProgress {
            distance,
            turns,
            speed,
            per_turn,
            reversal_scale,
        } = progress;
        let thread = self.thread.as_mut()?;
        let tap = thread.tap.as_mut()?;
        match tap.stage {
            TapStage::Down if distance >= tap.way => {
                tap.stage = TapStage::TurningBack;
                thread.furthest = turns;
                status.spindle_factor = Some((thread.spindle, -reversal_scale));
            }
            TapStage::Up if distance >= tap.way => {
                tap.stage = TapStage::TurningForth;
                thread.furthest = turns;
                status.spindle_factor = Some((thread.spindle, -1.0 / reversal_scale));
            }
            TapStage::TurningBack => {
                thread.furthest = thread.furthest.max(turns);
                if step.at_rest && speed < 0.0 && turns < thread.furthest - TURNED_BACK {
                    let turned_at = tap.turns_at(distance, per_turn);
                    tap.stage = TapStage::Up;
                    tap.turned_at = turned_at;
                    tap.way = (status.position - tap.start).dot(&tap.direction);
                    thread.furthest = turns;
                    return Some(Way {
                        end: tap.start - tap.direction * (MOST_TURNS * per_turn),
                        with_spindle: true,
                    });
                }
            }
            TapStage::TurningForth => {
                thread.furthest = thread.furthest.min(turns);
                if step.at_rest && speed > 0.0 && turns > thread.furthest + TURNED_BACK {
                    let end = tap.start;
                    self.thread = None;
                    return Some(Way {
                        end,
                        with_spindle: false,
                    });
                }
            }
            TapStage::Down | TapStage::Up => {}
        }
        None
    }

    /// Where the tap is, if the machine is within one.
    fn tap_progress(&self, running: &MoveAtHand, status: &Status) -> Option<TapProgress> {
        let with = running.queued.synchronisation?;
        let SynchronisationMode::Tap { reversal_scale } = with.mode else {
            return None;
        };
        let thread = self.thread.as_ref()?;
        if thread.stage != Stage::Running {
            return None;
        }
        let tracker = self.trackers.get(thread.spindle)?;
        Some(TapProgress {
            distance: running.queued.shape.length() - status.distance_to_go,
            turns: self.turns_of(thread),
            speed: thread.sign * tracker.speed(),
            per_turn: with.per_turn,
            reversal_scale,
        })
    }
}
