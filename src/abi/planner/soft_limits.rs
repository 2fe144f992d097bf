//! The kinematics module as the planner asks it, for the soft limits of the joints on the way of a move.

use libc::{c_double, c_int, c_uint, c_ulong};

use super::{Handle, module};
use crate::abi::linuxcnc::{EmcPose, KINEMATICS_TYPE, emcmot_config_t, emcmot_status_t};
use crate::abi::pose::pose_of;
use crate::axes::Axes;
use crate::machine::JOINT_COUNT;
use crate::planner::range::{Finding, JointRange, JointSolver, Joints};

/// LinuxCNC's `kinematicsInverse`.
type Inverse = Option<
    unsafe extern "C" fn(*const EmcPose, *mut c_double, *const c_ulong, *mut c_ulong) -> c_int,
>;
/// LinuxCNC's `kinematicsForward`.
type Forward = Option<
    unsafe extern "C" fn(*const c_double, *mut EmcPose, *const c_ulong, *mut c_ulong) -> c_int,
>;

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

/// The kinematics module.
pub(super) struct Kinematics {
    inverse: Inverse,
    forward: Forward,
    kind: c_uint,
    /// Joints that are looked at.
    count: usize,
    /// Whether the forward kinematics choose the arm that the inverse kinematics take.
    chooses_arm: bool,
    /// Whether the inverse kinematics go on from the joints they are given.
    iterates: bool,
}

impl Kinematics {
    pub(super) const NONE: Self = Self {
        inverse: None,
        forward: None,
        kind: KINEMATICS_TYPE::KINEMATICS_IDENTITY,
        count: 0,
        chooses_arm: false,
        iterates: false,
    };

    /// The flags of the arm that the machine has with these joints, `before` where the forward kinematics leave them.
    fn flags(&self, position: &Axes, joints: &Joints, before: c_ulong) -> c_ulong {
        let (mut pose, forward_flags, mut flags) = (pose_of(position), 0, before);
        if let Some(forward) = self.forward {
            // SAFETY: the kinematics module's own function, with as many joints as it may read.
            unsafe { forward(joints.as_ptr(), &mut pose, &forward_flags, &mut flags) };
        }
        flags
    }

    /// The joints for a position with this arm, from those of before.
    fn joints(&self, position: &Axes, near: &Joints, flags: c_ulong) -> Option<Joints> {
        let inverse = self.inverse?;
        let (pose, mut joints, mut forward_flags) = (pose_of(position), *near, 0);
        // SAFETY: the kinematics module's own function, with as many joints as it may write.
        let result = unsafe { inverse(&pose, joints.as_mut_ptr(), &flags, &mut forward_flags) };
        (result == 0).then_some(joints)
    }
}

impl JointSolver for Kinematics {
    fn begin(&mut self, position: &Axes, joints: &Joints) {
        // Motion calls the forward kinematics of such a module only.
        self.chooses_arm = self.kind == KINEMATICS_TYPE::KINEMATICS_BOTH
            && (self.flags(position, joints, 0) != 0
                || self.flags(position, joints, c_ulong::MAX) != c_ulong::MAX);
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
    }

    fn solve(&mut self, position: &Axes, near: &Joints) -> Option<Joints> {
        let flags = if self.chooses_arm {
            self.flags(position, near, 0)
        } else {
            0
        };
        self.joints(position, near, flags)
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
        self.kind == KINEMATICS_TYPE::KINEMATICS_IDENTITY
    }
}

/// The soft limits as motmod has them now.
fn range_of(status: &emcmot_status_t, config: &emcmot_config_t) -> JointRange {
    let mut range = JointRange {
        count: usize::try_from(config.numJoints - config.numExtraJoints).unwrap_or(0),
        ..JointRange::NONE
    };
    let limits = range.least.iter_mut().zip(&mut range.greatest);
    for ((least, greatest), joint) in limits.zip(&status.joint_status) {
        *least = joint.min_pos_limit;
        *greatest = joint.max_pos_limit;
    }
    range
}

impl Handle {
    /// Looks at more of what is queued, and stops for a move that leaves the soft limits.
    pub(super) fn check_range(&mut self) {
        self.finding = None;
        if self.kinematics.inverse.is_none() {
            return;
        }
        // SAFETY: null, or motmod's own structures for as long as the module is loaded.
        let (Some(status), Some(config)) =
            (unsafe { (self.status.as_ref(), self.config.as_ref()) })
        else {
            return;
        };
        let range = range_of(status, config);
        let mut machine = [0.0; JOINT_COUNT];
        for (joint, status) in machine.iter_mut().zip(&status.joint_status) {
            *joint = status.pos_cmd;
        }
        self.kinematics.count = range.count;
        self.finding = self
            .planner
            .check_range(&range, &machine, &mut self.kinematics);
    }
}

/// The kinematics, for the soft limits of the joints on the way of a move: moves wait until they have been looked at. With
/// null for `inverse` they do not. `kinematics_type` is what `kinematicsType` says.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_planner_kinematics(
    inverse: Option<
        unsafe extern "C" fn(*const EmcPose, *mut c_double, *const c_ulong, *mut c_ulong) -> c_int,
    >,
    forward: Option<
        unsafe extern "C" fn(*const c_double, *mut EmcPose, *const c_ulong, *mut c_ulong) -> c_int,
    >,
    kinematics_type: c_uint,
) {
    let handle = module();
    handle.kinematics = Kinematics {
        inverse,
        forward,
        kind: kinematics_type,
        ..Kinematics::NONE
    };
    handle.planner.wait_for_range_check(inverse.is_some());
}

/// What a move was found to do to the joints, in the last servo period.
pub const FRAMEPATH_STAYS_IN_RANGE: c_int = 0;
/// It would take one beyond a soft limit: the motion is stopped before it.
pub const FRAMEPATH_LEAVES_RANGE: c_int = 1;
/// The kinematics gave no joints for a place on its way, so that it could not be looked at.
pub const FRAMEPATH_RANGE_UNKNOWN: c_int = 2;

/// What the look along the queued moves came to in the last servo period: one of the codes above, with the program line,
/// and for a move that leaves the soft limits the joint, how far it would go, and the limit.
///
/// # Safety
/// `handle` from `framepath_planner_create`; the others point to numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_range_finding(
    handle: *const Handle,
    line: *mut c_int,
    joint: *mut c_int,
    position: *mut c_double,
    limit: *mut c_double,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(line), Some(joint), Some(position), Some(limit)) = (unsafe {
        (
            handle.as_ref(),
            line.as_mut(),
            joint.as_mut(),
            position.as_mut(),
            limit.as_mut(),
        )
    }) else {
        return FRAMEPATH_STAYS_IN_RANGE;
    };
    match handle.finding {
        None => FRAMEPATH_STAYS_IN_RANGE,
        Some(Finding::Leaves { found, id }) => {
            *line = id;
            *joint = found.joint as c_int;
            *position = found.position;
            *limit = found.limit;
            FRAMEPATH_LEAVES_RANGE
        }
        Some(Finding::Unknown { id }) => {
            *line = id;
            FRAMEPATH_RANGE_UNKNOWN
        }
    }
}
