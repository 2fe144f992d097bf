//! The joints, what limits them, and who knows where they are.

use crate::axes::Axes;
use crate::machine::JOINT_COUNT;

/// Positions of all joints, machine units or degrees.
pub type Joints = [f64; JOINT_COUNT];

/// Soft limits of the joints, machine units or degrees. Joints beyond the last one are not looked at.
#[derive(Clone, Copy, Debug)]
pub struct JointRange {
    /// Least position of each joint.
    pub least: Joints,
    /// Greatest position of each joint.
    pub greatest: Joints,
    /// How many joints there are.
    pub count: usize,
    /// Whether they have limits of velocity, acceleration and jerk of their own: none may jump then, and each place needs joints
    /// that lead to it.
    pub may_not_jump: bool,
}

impl JointRange {
    /// No joints, so nothing to look at.
    pub const NONE: Self = Self {
        least: [f64::NEG_INFINITY; JOINT_COUNT],
        greatest: [f64::INFINITY; JOINT_COUNT],
        count: 0,
        may_not_jump: false,
    };

    /// Whether both are the same, digit by digit.
    pub(super) fn is(&self, other: &Self) -> bool {
        let same =
            |a: &Joints, b: &Joints| a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
        self.count == other.count
            && self.may_not_jump == other.may_not_jump
            && same(&self.least, &other.least)
            && same(&self.greatest, &other.greatest)
    }
}

/// A joint that would leave its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfRange {
    /// Number of the joint.
    pub joint: usize,
    /// How far it would go.
    pub position: f64,
    /// Its limit.
    pub limit: f64,
}

/// A joint that would jump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// Number of the joint that jumps furthest, the least if there are several.
    pub joint: usize,
    /// By how much, machine units or degrees.
    pub way: f64,
    /// Where, shape (9).
    pub place: Axes,
}

/// What the check has to tell the operator.
#[derive(Clone, Copy, Debug)]
pub enum Finding {
    /// A move would take a joint out of its range.
    Leaves {
        /// The joint, and how far it would go.
        found: OutOfRange,
        /// LinuxCNC's number of the move.
        id: i32,
    },
    /// A joint with limits would jump within a move.
    Jumps {
        /// The joint, how far, and where.
        jump: Jump,
        /// LinuxCNC's number of the move.
        id: i32,
    },
    /// There are no joints that lead to a place within a move, and joints have limits.
    Unreached {
        /// The place, shape (9).
        place: Axes,
        /// LinuxCNC's number of the move.
        id: i32,
    },
    /// The kinematics give no joint positions for a place within a move, so it cannot be looked at.
    /// It is released all the same: motion itself has the last word.
    Unknown {
        /// LinuxCNC's number of the move.
        id: i32,
    },
}

impl Finding {
    /// Whether the motion has to stop before the move.
    pub fn stops(&self) -> bool {
        !matches!(self, Self::Unknown { .. })
    }
}

/// Inverse kinematics, as the motion controller uses them: from the joints of before.
pub trait JointSolver {
    /// The machine stands at `position`, shape (9), with these joints; what follows begins here.
    fn begin(&mut self, position: &Axes, joints: &Joints);

    /// Before a move is looked at: takes on what the joints of a position depend on besides it, as an external offset. Whether that
    /// has changed.
    fn renew(&mut self) -> bool {
        false
    }

    /// The joints for a position, shape (9), that the machine reaches from `near`, the joints at a
    /// place not far away. `None` where there are none.
    fn solve(&mut self, position: &Axes, near: &Joints) -> Option<Joints>;

    /// Whether the joints that were found for a position, shape (9), lead to it: some kinematics have joints for places out of
    /// reach, too.
    fn reaches(&mut self, _position: &Axes, _joints: &Joints) -> bool {
        true
    }

    /// What an answer may be wrong by, machine units or degrees: [`Self::ROUNDING`], or more where
    /// the kinematics iterate.
    fn precision(&self) -> f64 {
        Self::ROUNDING
    }

    /// What an answer in closed form may be wrong by.
    const ROUNDING: f64 = 1e-9;

    /// How often [`Self::solve`] may be called in a servo period, 1 and above.
    fn calls_a_cycle(&self) -> usize;

    /// Whether the joints follow straight lines in proportion, so that these need no look inside.
    fn keeps_lines(&self) -> bool;
}
