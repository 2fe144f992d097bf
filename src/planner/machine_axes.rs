//! What the axes of the machine, and its joints, may do, and how the axes of the program lie to them.

use nalgebra::{ArrayStorage, Matrix3};

use super::jerk_limit::JerkLimit;
use super::move_jerk;
use super::request::LEAST_LIMITS;
use crate::axes::{AXIS_COUNT, Axes, AxisLimits, ROTARY_AXES};
use crate::machine_map::{JointMap, MachineMap};
use crate::moves::Move;
use crate::moves::shape::Shape;
use crate::speed::{DerivativeBounds, PathLimits};

const UNLIMITED: Axes = Axes::from_array_storage(ArrayStorage([[f64::INFINITY; AXIS_COUNT]]));

const UNLIMITED_AXES: AxisLimits = AxisLimits {
    velocity: UNLIMITED,
    acceleration: UNLIMITED,
    jerk: UNLIMITED,
};

/// Parts of a move between whose ends its joints are looked at, where it follows a spindle.
const PLACES: u32 = 4;

/// A frame whose lengths differ by no more than this share scales nothing: rounding.
const UNSTRETCHED: f64 = 1e-9;

/// The axes of the machine.
#[derive(Clone, Copy, Debug)]
pub(super) struct MachineAxes {
    /// What they may do in the motion that runs: what they were able to do when it began.
    limits: AxisLimits,
    /// What they are able to do now: in force from the next rest on.
    next_limits: AxisLimits,
    /// What the jerk of no axis may exceed besides, since the move asks for it.
    move_jerk: f64,
    /// Which axes have had usable limits the last time.
    limited: [bool; AXIS_COUNT],
    /// How the axes of the program lie to them, and to the joints with what these may do in the motion that runs.
    map: MachineMap,
    /// What the joints are able to do now, if they have limits: in force from the next rest on.
    next_joints: Option<JointMap>,
}

impl MachineAxes {
    /// Without limits, and without a frame.
    pub const UNLIMITED: Self = Self {
        limits: UNLIMITED_AXES,
        next_limits: UNLIMITED_AXES,
        move_jerk: f64::INFINITY,
        limited: [false; AXIS_COUNT],
        map: MachineMap::IDENTITY,
        next_joints: None,
    };

    /// What the axes may do in the motion that runs.
    pub fn limits(&self) -> &AxisLimits {
        &self.limits
    }

    /// The greatest velocity of the axes together in the motion that runs, machine units per second: of the linear ones, or
    /// where none has a limit of the rotary ones.
    pub fn reach(&self) -> f64 {
        let of = |rotary: bool| {
            (0..AXIS_COUNT)
                .filter(|axis| ROTARY_AXES.contains(axis) == rotary)
                .map(|axis| self.limits.velocity[axis])
                .filter(|velocity| velocity.is_finite())
                .fold(0.0, |sum, velocity| sum + velocity * velocity)
                .sqrt()
        };
        let linear = of(false);
        if linear > 0.0 { linear } else { of(true) }
    }

    /// What the joints may do in the motion that runs, or the axes where the joints have no limits.
    pub fn limits_behind(&self) -> &AxisLimits {
        self.map.limits(&self.limits)
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

    /// Sets what the joints are able to do now, `None` for no limits of joints. `false`, and nothing changes, if one of them
    /// is next to zero, negative or not a number.
    pub fn set_next_joints(&mut self, joints: Option<JointMap>) -> bool {
        let usable = |joints: &JointMap| {
            let limits = joints.limits();
            [&limits.velocity, &limits.acceleration, &limits.jerk]
                .iter()
                .zip(LEAST_LIMITS)
                .all(|(limits, least)| limits.iter().all(|limit| *limit >= least))
        };
        let accepted = joints.as_ref().is_none_or(usable);
        if accepted {
            self.next_joints = joints;
        }
        accepted
    }

    /// Whether axes or joints are able to do something else than when the motion began.
    pub fn limits_changed(&self) -> bool {
        let same = match (&self.next_joints, self.map.joints()) {
            (Some(next), Some(joints)) => next.is_with(&self.as_moves_ask(next.limits()), joints),
            (None, None) => true,
            _ => false,
        };
        !same || self.wanted() != self.limits
    }

    /// At rest: what axes and joints are able to do now is what they may do.
    pub fn take_limits(&mut self) {
        self.limits = self.wanted();
        self.map = self.map.with_joints(self.wanted_joints());
    }

    /// What the axes may do from the next rest on.
    fn wanted(&self) -> AxisLimits {
        self.as_moves_ask(&self.next_limits)
    }

    /// What the joints may do from the next rest on.
    fn wanted_joints(&self) -> Option<JointMap> {
        let joints = self.next_joints.as_ref()?;
        Some(joints.with_limits(&self.as_moves_ask(joints.limits())))
    }

    fn as_moves_ask(&self, limits: &AxisLimits) -> AxisLimits {
        AxisLimits {
            jerk: limits.jerk.map(|jerk| jerk.min(self.move_jerk)),
            ..*limits
        }
    }

    /// At rest: the next move asks for this, see [`Self::move_jerk`].
    pub fn set_move_jerk(&mut self, jerk: f64) {
        if !move_jerk::is_same(jerk, self.move_jerk) {
            self.move_jerk = jerk;
        }
    }

    /// What the jerk of no axis may exceed in a shape along which it is to be `along` at most; infinite where the axes see
    /// to that. `None` where nobody can be meant: see [`JerkLimit`].
    pub fn move_jerk(&self, shape: &Shape, along: f64, period: f64) -> Option<f64> {
        let jerk = move_jerk::of_axes(shape, along, &self.next_limits.jerk);
        let moving = (0..AXIS_COUNT).filter(|axis| shape.moves(*axis));
        let acceleration = moving.fold(0.0, |most: f64, axis| {
            most.max(self.next_limits.acceleration[axis])
        });
        match JerkLimit::new(jerk, acceleration, period) {
            JerkLimit::Limited(jerk) => Some(jerk),
            JerkLimit::Unlimited { asked: true } => Some(f64::INFINITY),
            JerkLimit::Unlimited { asked: false } | JerkLimit::Refused { .. } => None,
        }
    }

    /// Sets how X Y Z of the program lie to those of the machine, shape (3, 3). `false`, and nothing
    /// changes, if it is not one of [`MachineMap`].
    pub fn set_map(&mut self, linear: &Matrix3<f64>) -> bool {
        let map = MachineMap::new(linear);
        if let Some(map) = map {
            self.map = map.with_joints(self.map.joints().copied());
        }
        map.is_some()
    }

    /// Whether the frame makes the way of a shape longer or shorter where it begins.
    pub fn stretches(&self, shape: &Shape) -> bool {
        let stretch = self.map.stretch(&shape.point(0.0).first);
        (stretch - 1.0).abs() > UNSTRETCHED
    }

    /// The first axis of the machine that a shape moves and that has no usable limits.
    pub fn unusable_axis(&self, shape: &Shape) -> Option<usize> {
        let mut axes = (0..AXIS_COUNT).zip(self.limited);
        let moves = |axis| self.map.axes_of(axis).any(|from| shape.moves(from));
        let found = axes.find(|(axis, limited)| !limited && moves(*axis));
        found.map(|(axis, _)| axis)
    }

    /// What axes and joints allow along the path of a move.
    pub fn path_limits(&self, queued: &Move) -> PathLimits {
        let shape = &queued.shape;
        let by_axes = PathLimits::of(shape, &self.map, &self.limits, queued.max_velocity);
        let Some(joints) = self.map.joints() else {
            return by_axes;
        };
        let mut bounds = DerivativeBounds::none();
        for place in 0..=PLACES {
            let point = shape.point(shape.length() * f64::from(place) / f64::from(PLACES));
            let derivatives = [&point.first, &point.second, &point.third];
            bounds.include(&self.map.derivatives(&point.position, derivatives));
        }
        bounds.path_limits_of_line(joints.limits(), by_axes.velocity)
    }
}
