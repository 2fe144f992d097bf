//! The kinematics module as the planner asks it.

use libc::{c_uint, c_ulong};
use nalgebra::ArrayStorage;

use crate::abi::inner::{Forward, Inverse};
use crate::abi::linuxcnc::KINEMATICS_TYPE;
use crate::abi::pose::pose_of;
use crate::axes::{AXIS_COUNT, Axes};
use crate::planner::range::{JointSolver, Joints};

/// Positions that are asked for in a servo period.
const CALLS_A_CYCLE: usize = 16;
/// The same where each takes the forward kinematics too ..
const ARMS_A_CYCLE: usize = 8;
/// .. and where the kinematics iterate, which takes some microseconds for each. A short move needs as many.
const ITERATIONS_A_CYCLE: usize = 4;

/// What kinematics that iterate may be wrong by, machine units or degrees: genserkins ends a circle 2e-6 off.
const CONVERGENCE: f64 = 1e-5;

/// What the joints are moved by to see whether the answer depends on them.
const NUDGE: f64 = 1e-3;

/// How close to a place its joints lead, machine units: far less than what is out of reach, and far more than rounding.
const REACHED: f64 = 1e-4;

const NO_OFFSET: Axes = Axes::from_array_storage(ArrayStorage([[0.0; AXIS_COUNT]]));

/// The kinematics module.
#[derive(Clone, Copy, Debug)]
pub struct KinematicsModule {
    inverse: Inverse,
    forward: Forward,
    /// What `kinematicsType` says.
    kind: c_uint,
    /// Joints that are looked at.
    pub count: usize,
    /// What motion adds to a position before it asks for the joints, shape (9): external offsets, in the last servo period, ..
    last_offset: Axes,
    /// .. as they last stood still ..
    standing_offset: Axes,
    /// .. and as they are for the move that is looked at.
    offset: Axes,
    /// Whether the forward kinematics choose the arm that the inverse kinematics take.
    chooses_arm: bool,
    /// Whether the inverse kinematics go on from the joints they are given.
    iterates: bool,
    /// Whether the forward kinematics tell by the joints alone where these lead.
    tells_place: bool,
}

impl KinematicsModule {
    /// No module.
    pub const NONE: Self = Self {
        inverse: None,
        forward: None,
        kind: KINEMATICS_TYPE::KINEMATICS_IDENTITY,
        count: 0,
        last_offset: NO_OFFSET,
        standing_offset: NO_OFFSET,
        offset: NO_OFFSET,
        chooses_arm: false,
        iterates: false,
        tells_place: false,
    };

    /// The module's functions, and what `kinematicsType` says.
    pub fn new(inverse: Inverse, forward: Forward, kind: c_uint) -> Self {
        Self {
            inverse,
            forward,
            kind,
            ..Self::NONE
        }
    }

    /// What external offsets add to a position in this servo period, shape (9). Where one that moves will be, as that of a height
    /// control, nobody knows: it counts as it last stood.
    pub fn note_offset(&mut self, offset: &Axes) {
        if *offset == self.last_offset {
            self.standing_offset = *offset;
        }
        self.last_offset = *offset;
    }

    /// Whether the joints are the axes.
    pub fn is_trivial(&self) -> bool {
        self.kind == KINEMATICS_TYPE::KINEMATICS_IDENTITY
    }

    /// Whether there is a module to ask.
    pub fn is_known(&self) -> bool {
        self.inverse.is_some()
    }

    /// The flags of the arm that the machine has with these joints, 0 where the kinematics have one only.
    pub fn arm(&self, position: &Axes, joints: &Joints) -> c_ulong {
        if self.chooses_arm {
            self.flags(position, joints, 0)
        } else {
            0
        }
    }

    /// The flags of the arm that the machine has with these joints, `before` where the forward kinematics leave them.
    fn flags(&self, position: &Axes, joints: &Joints, before: c_ulong) -> c_ulong {
        let (mut pose, forward_flags, mut flags) = (pose_of(position), 0, before);
        if let Some(forward) = self.forward {
            // SAFETY: the kinematics module's own function, with as many joints as it may read.
            unsafe { forward(joints.as_ptr(), &mut pose, &forward_flags, &mut flags) };
        }
        flags
    }

    /// X Y Z of the place that joints lead to; `None` if the forward kinematics do not answer.
    fn place(&self, joints: &Joints, guess: &Axes, forward_flags: c_ulong) -> Option<[f64; 3]> {
        let forward = self.forward?;
        let (mut pose, mut inverse_flags) = (pose_of(guess), 0);
        // SAFETY: as above.
        let result = unsafe {
            forward(
                joints.as_ptr(),
                &mut pose,
                &forward_flags,
                &mut inverse_flags,
            )
        };
        (result == 0).then_some([pose.tran.x, pose.tran.y, pose.tran.z])
    }

    /// Whether the forward kinematics lead back to a position by its joints alone: those that iterate depend on where they
    /// begin, some on the arm that their flags say, and what they find from elsewhere may be another place.
    fn leads_back(&self, position: &Axes, joints: &Joints) -> bool {
        let beside = position.add_scalar(NUDGE);
        // Behind a frame they begin where they were asked last.
        self.place(&joints.map(|joint| joint + NUDGE), &beside, 0);
        let from_beside = self.place(joints, &beside, 0);
        let from_there = self.place(joints, position, 0);
        let of_another_arm = self.place(joints, position, 1);
        from_there.is_some_and(|place| is_at(&place, position))
            && from_there == from_beside
            && from_there == of_another_arm
    }

    /// The joints for a position with this arm, from those of before.
    pub fn joints(&self, position: &Axes, near: &Joints, flags: c_ulong) -> Option<Joints> {
        let inverse = self.inverse?;
        let (pose, mut joints, mut forward_flags) = (pose_of(position), *near, 0);
        // SAFETY: the kinematics module's own function, with as many joints as it may write.
        let result = unsafe { inverse(&pose, joints.as_mut_ptr(), &flags, &mut forward_flags) };
        (result == 0).then_some(joints)
    }
}

impl JointSolver for KinematicsModule {
    fn begin(&mut self, position: &Axes, joints: &Joints) {
        self.renew();
        let behind = position + self.offset;
        // Motion calls the forward kinematics of such a module only.
        self.chooses_arm = self.kind == KINEMATICS_TYPE::KINEMATICS_BOTH
            && (self.flags(&behind, joints, 0) != 0
                || self.flags(&behind, joints, c_ulong::MAX) != c_ulong::MAX);
        let nudged = joints.map(|joint| joint + NUDGE);
        let answers = [joints, &nudged].map(|near| self.solve(position, near));
        self.iterates = match answers {
            [Some(one), Some(other)] => {
                // Joints that are left as they are do not count.
                let mut answers = one.iter().zip(&other).zip(joints).take(self.count);
                answers.any(|((one, other), joint)| one != other && one != joint)
            }
            _ => true,
        };
        let [answer, _] = answers;
        self.tells_place = self.kind == KINEMATICS_TYPE::KINEMATICS_BOTH
            && answer.is_some_and(|answer| self.leads_back(&behind, &answer));
    }

    fn renew(&mut self) -> bool {
        let changed = self.offset != self.standing_offset;
        self.offset = self.standing_offset;
        changed
    }

    fn solve(&mut self, position: &Axes, near: &Joints) -> Option<Joints> {
        let position = position + self.offset;
        self.joints(&position, near, self.arm(&position, near))
    }

    fn reaches(&mut self, position: &Axes, joints: &Joints) -> bool {
        let position = position + self.offset;
        !self.tells_place
            || self
                .place(joints, &position, 0)
                .is_none_or(|place| is_at(&place, &position))
    }

    fn precision(&self) -> f64 {
        if self.iterates {
            CONVERGENCE
        } else {
            Self::ROUNDING
        }
    }

    fn calls_a_cycle(&self) -> usize {
        if self.iterates {
            ITERATIONS_A_CYCLE
        } else if self.chooses_arm {
            ARMS_A_CYCLE
        } else {
            CALLS_A_CYCLE
        }
    }

    fn keeps_lines(&self) -> bool {
        self.is_trivial()
    }
}

/// Whether X Y Z of a place are those of a position.
fn is_at(place: &[f64; 3], position: &Axes) -> bool {
    place
        .iter()
        .zip(position)
        .all(|(one, other)| (one - other).abs() <= REACHED)
}
