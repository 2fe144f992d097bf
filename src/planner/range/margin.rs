//! How near a limit is near: how far the joints move where the path leaves the program.
//!
//! That is asked of the kinematics beside the program: a frame that scales, and the tool centre point, make of a deviation more or
//! less than it is, and rotary axes may leave the program by more degrees than linear ones by millimetres.

use super::joints::{JointSolver, Joints};
use crate::axes::{AXIS_COUNT, Axes};
use crate::machine::JOINT_COUNT;
use crate::path::GREATEST_TURN;

/// A joint is near a limit that is less than this many times away what the path may move it by: kinematics bend.
const RESERVE: f64 = 4.0;

/// How far beside the program the kinematics are asked, machine units or degrees.
const STEP: f64 = 0.1;

/// Once the program has gone so far in an axis, machine units or degrees, they are asked anew.
const STALE: f64 = 2.0;

/// How far the path may be from a move.
#[derive(Clone, Copy, Debug)]
pub struct Deviation {
    /// X Y Z U V W together, machine units.
    pub linear: f64,
    /// A and B together, degrees.
    pub rotary: f64,
    /// C, degrees.
    pub turn: f64,
}

impl Deviation {
    /// Whether the path is the program.
    pub(super) fn is_none(&self) -> bool {
        self.linear <= 0.0 && self.rotary <= 0.0 && self.turn <= 0.0
    }
}

/// What the joints do beside the program, as far as they have been asked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside {
    /// Where that was, and the joints there.
    place: Option<(Axes, Joints)>,
    /// The next axis to be asked for.
    axis: usize,
    /// How far each joint moves for one unit of X Y Z U V W together, squared; infinity where there are no joints.
    linear: Joints,
    /// The same for one degree of A and B together, squared.
    rotary: Joints,
    /// The same for one of C.
    turn: Joints,
}

impl Beside {
    /// Nothing has been asked.
    pub const UNKNOWN: Self = Self {
        place: None,
        axis: 0,
        linear: [0.0; JOINT_COUNT],
        rotary: [0.0; JOINT_COUNT],
        turn: [0.0; JOINT_COUNT],
    };

    /// Asks what is left to be asked, where the program is at `position` with the joints `near`, as often as `calls` says. Whether
    /// all of it is known then.
    pub fn find(
        &mut self,
        position: &Axes,
        near: &Joints,
        calls: &mut usize,
        solver: &mut impl JointSolver,
    ) -> bool {
        let stays = self
            .place
            .is_some_and(|(place, _)| solver.keeps_lines() || (place - position).amax() < STALE);
        if !stays {
            if *calls == 0 {
                return false;
            }
            *calls -= 1;
            let joints = solver.solve(position, near).unwrap_or(*near);
            *self = Self {
                place: Some((*position, joints)),
                ..Self::UNKNOWN
            };
        }
        let Some((place, joints)) = self.place else {
            return false;
        };
        while self.axis < AXIS_COUNT && *calls > 0 {
            *calls -= 1;
            self.ask(&place, &joints, solver);
            self.axis += 1;
        }
        self.axis == AXIS_COUNT
    }

    /// Asks for the joints beside a place in the axis that is next.
    fn ask(&mut self, place: &Axes, joints: &Joints, solver: &mut impl JointSolver) {
        let mut beside = *place;
        if let Some(axis) = beside.get_mut(self.axis) {
            *axis += STEP;
        }
        let found = solver.solve(&beside, joints);
        let rates = match self.axis {
            3 | 4 => &mut self.rotary,
            5 => &mut self.turn,
            _ => &mut self.linear,
        };
        for (number, rate) in rates.iter_mut().enumerate() {
            let moved = found.as_ref().and_then(|found| found.get(number));
            let way = match (moved, joints.get(number)) {
                (Some(moved), Some(joint)) => (moved - joint) / STEP,
                _ => f64::INFINITY,
            };
            *rate += way * way;
        }
    }

    /// How near a limit counts as near, for each joint.
    pub fn margins(&self, deviation: &Deviation) -> Joints {
        let turn = (RESERVE * deviation.turn).min(deviation.turn.max(GREATEST_TURN));
        let share = |squared: f64, by: f64| if by > 0.0 { squared.sqrt() * by } else { 0.0 };
        let mut margins = [0.0; JOINT_COUNT];
        let rates = self.linear.iter().zip(&self.rotary).zip(&self.turn);
        for (margin, ((linear, rotary), turned)) in margins.iter_mut().zip(rates) {
            *margin = share(*linear, RESERVE * deviation.linear)
                + share(*rotary, RESERVE * deviation.rotary)
                + share(*turned, turn);
        }
        margins
    }
}
