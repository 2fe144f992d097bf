//! Moves that follow a spindle, as they are queued and as they run: what the spindle's follower finds is done.

use super::error_stop::ErrorStop;
use super::inputs::CycleInputs;
use super::planner::Planner;
use super::request::{AddError, Added, MoveRequest};
use super::spindle::{MoveAtHand, SpindleCommand, SpindleError, Way, way_down};
use crate::axes::Axes;
use crate::cycle::ExecutorStep;
use crate::moves::SynchronisationMode;
use crate::moves::shape::{Line9, Shape};

impl Planner {
    /// Which spindle the moves to come follow: by `per_turn` units a turn of it, its speed only
    /// (feed per turn) or its angle (threads). None if `per_turn` is 0. What makes no sense refuses
    /// the moves.
    pub fn set_spindle_synchronisation(&mut self, spindle: i32, per_turn: f64, speed_only: bool) {
        let command = SpindleCommand {
            spindle,
            per_turn,
            speed_only,
        };
        self.spindle
            .set_command((per_turn != 0.0).then_some(command));
    }

    /// Queues a rigid tap to `end`, shape (9), and back to where it begins; the spindle comes back
    /// `reversal_scale` times as fast as it goes.
    ///
    /// # Errors
    /// See [`AddError`]; nothing changes then.
    pub fn add_rigid_tap(
        &mut self,
        end: &Axes,
        reversal_scale: f64,
        request: &MoveRequest,
    ) -> Result<Added, AddError> {
        let Some(with) = self.spindle.command() else {
            return Err(AddError::RigidTap);
        };
        if with.speed_only || !(reversal_scale > 0.0 && reversal_scale.is_finite()) {
            return Err(AddError::RigidTap);
        }
        let shape = if with.per_turn > 0.0 && with.per_turn.is_finite() {
            way_down(&self.goal, end, with.per_turn)
        } else {
            return Err(AddError::PerTurn(with.per_turn));
        };
        let goal = self.goal;
        let mode = SynchronisationMode::Tap { reversal_scale };
        let result = self.add(shape, mode, request);
        // It comes back to where it began.
        self.goal = goal;
        result
    }

    /// Measures the spindles. Once in each servo period.
    pub(super) fn track_spindles(&mut self, inputs: &CycleInputs) {
        self.status.index_request = None;
        self.status.spindle_factor = None;
        self.status.spindle_error = None;
        self.spindle.track(&inputs.spindles, self.period);
    }

    /// The move that runs or comes next.
    pub(super) fn move_at_hand(&self) -> Option<MoveAtHand<'_>> {
        MoveAtHand::first(&self.queue, &self.axes, self.period)
    }

    /// The spindle that the first feed per turn ahead counts with. It is braked for as soon as any is queued.
    pub(super) fn feed_spindle(&self) -> Option<usize> {
        let queued = self.spindle.feed_ahead(self.queue.first_serial());
        self.executor.spindle_ahead().or(queued)
    }

    /// At rest: whether the spindle is where the next move may start.
    pub(super) fn spindle_permits_start(&mut self) -> bool {
        let Some(next) = MoveAtHand::first(&self.queue, &self.axes, self.period) else {
            return false;
        };
        match self.spindle.permits_start(&next, &mut self.status) {
            Ok(permitted) => permitted,
            Err(error) => {
                self.stop_for_spindle(error);
                false
            }
        }
    }

    /// In a thread: looks what is wrong with the spindle.
    pub(super) fn watch_spindle(&mut self) {
        if self.status.aborting {
            return;
        }
        let Some(running) = MoveAtHand::first(&self.queue, &self.axes, self.period) else {
            return;
        };
        if let Err(error) = self.spindle.watch(&running) {
            self.stop_for_spindle(error);
        }
    }

    /// Stops for the sake of the spindle: what follows a broken thread must not run.
    pub(super) fn stop_for_spindle(&mut self, error: SpindleError) {
        self.stop_for_error(ErrorStop::Spindle(error));
        self.status.spindle_error = Some(error);
    }

    /// The next stage of a tap, where it is due.
    pub(super) fn advance_tap(&mut self, step: &ExecutorStep) {
        let Some(running) = MoveAtHand::first(&self.queue, &self.axes, self.period) else {
            return;
        };
        if let Some(way) = self.spindle.advance_tap(&running, step, &mut self.status) {
            self.take_way(&way);
        }
    }

    /// At rest in a tap: goes on with its next way.
    fn take_way(&mut self, way: &Way) {
        let position = self.status.position;
        let Some(front) = self.queue.front_mut() else {
            return;
        };
        match Line9::new(&position, &way.end) {
            Ok(line) => front.shape = Shape::Line(line),
            // Where it began already.
            Err(_) => {
                self.queue.pop();
                if self.queue.is_empty() {
                    self.drop_moves();
                }
            }
        }
        if !way.with_spindle
            && let Some(front) = self.queue.front_mut()
        {
            front.synchronisation = None;
        }
        self.reference.clear();
        self.executor.reset();
        self.motion.stand();
        self.report_rest();
    }
}
