//! The move that runs or comes next, as what follows a spindle has to know it.

use super::super::machine_axes::MachineAxes;
use crate::moves::{Move, MoveQueue, Synchronisation};
use crate::speed::PathLimits;

/// The move that runs or comes next.
#[derive(Clone, Copy, Debug)]
pub struct MoveAtHand<'a> {
    pub queued: &'a Move,
    /// Whether it has begun.
    pub begun: bool,
    axes: &'a MachineAxes,
    /// Duration of a servo period, seconds.
    pub period: f64,
}

impl<'a> MoveAtHand<'a> {
    /// The first one of the queue, if there is any.
    pub fn first(queue: &'a MoveQueue, axes: &'a MachineAxes, period: f64) -> Option<Self> {
        Some(Self {
            queued: queue.front()?,
            begun: queue.has_begun(),
            axes,
            period,
        })
    }

    /// How it follows the angle of a spindle, if it does.
    pub fn angle(&self) -> Option<Synchronisation> {
        let with = self.queued.synchronisation;
        with.filter(Synchronisation::follows_angle)
    }

    /// What the axes allow along its path.
    pub fn limits(&self) -> PathLimits {
        self.axes.path_limits(self.queued)
    }
}
