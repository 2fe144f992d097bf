//! Which spindle the moves to come follow, and rigid taps as they are queued.

use super::super::planner::Planner;
use super::super::request::{AddError, Added, MoveRequest};
use super::spindle_command::SpindleCommand;
use super::tap::way_down;
use crate::axes::Axes;
use crate::moves::{SPINDLE_COUNT, Synchronisation, SynchronisationMode};

/// What feed per turn is planned for, over what the spindle is expected to do.
const RESERVE: f64 = 2.2;

impl Planner {
    /// Which spindle the moves to come follow: by `per_turn` units a turn of it, its speed only
    /// (feed per turn) or its angle (threads). None if `per_turn` is 0. What makes no sense refuses
    /// the moves.
    pub fn set_spindle_synchronisation(&mut self, spindle: i32, per_turn: f64, speed_only: bool) {
        self.synchronisation = (per_turn != 0.0).then_some(SpindleCommand {
            spindle,
            per_turn,
            speed_only,
        });
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
        let Some(with) = self.synchronisation else {
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

    /// How a move that is queued now follows its spindle, if it follows one.
    pub(in crate::planner) fn motion_mode(&self) -> SynchronisationMode {
        match self.synchronisation {
            Some(with) if !with.speed_only => SynchronisationMode::Thread {
                turns_before: self
                    .sequence
                    .filter(|(spindle, _)| {
                        usize::try_from(with.spindle) == Ok(*spindle) && !self.queue.is_empty()
                    })
                    .map_or(0.0, |(_, turns)| turns),
            },
            _ => SynchronisationMode::Speed,
        }
    }

    /// What a move that is queued now does with a spindle.
    pub(in crate::planner) fn synchronisation_in(
        &self,
        mode: SynchronisationMode,
    ) -> Result<Option<Synchronisation>, AddError> {
        let Some(with) = self.synchronisation else {
            return Ok(None);
        };
        let (spindle, per_turn) = (with.spindle, with.per_turn);
        if !(per_turn > 0.0 && per_turn.is_finite()) {
            return Err(AddError::PerTurn(per_turn));
        }
        match usize::try_from(spindle) {
            Ok(number) if number < SPINDLE_COUNT => Ok(Some(Synchronisation {
                spindle: number,
                per_turn,
                mode,
            })),
            _ => Err(AddError::Spindle { spindle }),
        }
    }

    /// What a move that follows a spindle is planned for: a thread as fast as the axes allow, feed
    /// per turn with a reserve for changes of the speed and of the override.
    pub(in crate::planner) fn planned_feed(
        &self,
        with: &Synchronisation,
        max_velocity: f64,
    ) -> f64 {
        let expected = match self.spindles.get(with.spindle) {
            Some(spindle) if !with.follows_angle() => {
                RESERVE * with.per_turn * spindle.speed.abs().max(spindle.commanded)
            }
            _ => 0.0,
        };
        if expected > 0.0 {
            expected.min(max_velocity)
        } else {
            max_velocity
        }
    }

    /// Stops following any spindle with the moves to come.
    pub(in crate::planner) fn end_synchronisation(&mut self) {
        self.synchronisation = None;
    }
}
