//! What the axes of the machine may do, and how those of the program lie to them.

use nalgebra::{ArrayStorage, Matrix3};

use super::request::LEAST_LIMITS;
use crate::axes::{AXIS_COUNT, Axes, AxisLimits, MachineMap};
use crate::moves::Move;
use crate::moves::shape::Shape;
use crate::speed::PathLimits;

const UNLIMITED: Axes = Axes::from_array_storage(ArrayStorage([[f64::INFINITY; AXIS_COUNT]]));

const UNLIMITED_AXES: AxisLimits = AxisLimits {
    velocity: UNLIMITED,
    acceleration: UNLIMITED,
    jerk: UNLIMITED,
};

/// The axes of the machine.
#[derive(Clone, Copy, Debug)]
pub(super) struct MachineAxes {
    /// What they may do in the motion that runs: what they were able to do when it began.
    limits: AxisLimits,
    /// What they are able to do now: in force from the next rest on.
    next_limits: AxisLimits,
    /// Which axes have had usable limits the last time.
    limited: [bool; AXIS_COUNT],
    /// How the axes of the program lie to them.
    map: MachineMap,
}

impl MachineAxes {
    /// Without limits, and without a frame.
    pub const UNLIMITED: Self = Self {
        limits: UNLIMITED_AXES,
        next_limits: UNLIMITED_AXES,
        limited: [false; AXIS_COUNT],
        map: MachineMap::IDENTITY,
    };

    /// What the axes may do in the motion that runs.
    pub fn limits(&self) -> &AxisLimits {
        &self.limits
    }

    /// How the axes of the program lie to those of the machine.
    pub fn map(&self) -> &MachineMap {
        &self.map
    }

    /// Sets what the axes are able to do now. An axis one of whose limits is next to zero, negative or not a
    /// number keeps those it had, and is not usable.
    pub fn set_next_limits(&mut self, limits: &AxisLimits) {
        let next = &mut self.next_limits;
        for axis in 0..AXIS_COUNT {
            let new = [
                limits.velocity[axis],
                limits.acceleration[axis],
                limits.jerk[axis],
            ];
            let usable = new
                .iter()
                .zip(LEAST_LIMITS)
                .all(|(limit, least)| *limit >= least);
            self.limited[axis] = usable;
            if usable {
                [
                    next.velocity[axis],
                    next.acceleration[axis],
                    next.jerk[axis],
                ] = new;
            }
        }
    }

    /// Whether the axes are able to do something else than when the motion began.
    pub fn limits_changed(&self) -> bool {
        self.next_limits != self.limits
    }

    /// At rest: what the axes are able to do now is what they may do.
    pub fn take_limits(&mut self) {
        self.limits = self.next_limits;
    }

    /// Sets how X Y Z of the program lie to those of the machine, shape (3, 3). `false`, and nothing
    /// changes, if it is not one of [`MachineMap`].
    pub fn set_map(&mut self, linear: &Matrix3<f64>) -> bool {
        let map = MachineMap::new(linear);
        if let Some(map) = map {
            self.map = map;
        }
        map.is_some()
    }

    /// The first axis of the machine that a shape moves and that has no usable limits.
    pub fn unusable_axis(&self, shape: &Shape) -> Option<usize> {
        let mut axes = (0..AXIS_COUNT).zip(self.limited);
        let moves = |axis| self.map.axes_of(axis).any(|from| shape.moves(from));
        let found = axes.find(|(axis, limited)| !limited && moves(*axis));
        found.map(|(axis, _)| axis)
    }

    /// What the axes allow along the path of a move.
    pub fn path_limits(&self, queued: &Move) -> PathLimits {
        PathLimits::of(&queued.shape, &self.map, &self.limits, queued.max_velocity)
    }
}
