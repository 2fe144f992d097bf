//! The joints on the way of a move: their soft limits, and whether they jump where they have limits of their own.

use core::slice;

use libc::{c_double, c_int, c_uint, c_ulong};

use super::handle::{Handle, module};
use super::joint_kinematics;
use super::kinematics_module::KinematicsModule;
use crate::abi::linuxcnc::{EmcPose, emcmot_config_t, emcmot_status_t};
use crate::abi::pose::axes_of;
use crate::axes::AXIS_COUNT;
use crate::machine::JOINT_COUNT;
use crate::planner::range::{Finding, JointRange, Joints, Jump};

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

/// Where motmod commands the joints to be.
pub(super) fn commanded_joints(status: &emcmot_status_t) -> Joints {
    let mut machine = [0.0; JOINT_COUNT];
    for (joint, status) in machine.iter_mut().zip(&status.joint_status) {
        *joint = status.pos_cmd;
    }
    machine
}

impl Handle {
    /// Looks at more of what is queued, with the external offsets as they stand, and stops for a move that leaves the soft limits, or that joints with limits of their own
    /// cannot follow.
    pub(super) fn check_range(&mut self) {
        self.finding = None;
        if !self.kinematics.is_known() {
            return;
        }
        // SAFETY: null, or motmod's own structures for as long as the module is loaded.
        let (Some(status), Some(config)) =
            (unsafe { (self.status.as_ref(), self.config.as_ref()) })
        else {
            return;
        };
        let mut range = range_of(status, config);
        // Joints whose motion is known in closed form do not jump.
        range.may_not_jump = self.joints_limited && !joint_kinematics::kinematics().is_exact();
        let machine = commanded_joints(status);
        self.kinematics.count = range.count;
        self.kinematics.note_offset(&axes_of(&status.eoffset_pose));
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
    handle.kinematics = KinematicsModule::new(inverse, forward, kinematics_type);
    joint_kinematics::ask(KinematicsModule::new(inverse, forward, kinematics_type));
    handle.planner.wait_for_range_check(inverse.is_some());
}

/// What a move was found to do to the joints, in the last servo period.
pub const FRAMEPATH_STAYS_IN_RANGE: c_int = 0;
/// It would take one beyond a soft limit: the motion is stopped before it.
pub const FRAMEPATH_LEAVES_RANGE: c_int = 1;
/// The kinematics gave no joints for a place on its way, so that it could not be looked at.
pub const FRAMEPATH_RANGE_UNKNOWN: c_int = 2;
/// A joint with limits of its own would jump: the motion is stopped before the move.
pub const FRAMEPATH_JOINT_JUMPS: c_int = 3;
/// No joints lead to a place on its way, and joints have limits of their own: the motion is stopped before the move.
pub const FRAMEPATH_OUT_OF_REACH: c_int = 4;

/// What the look along the queued moves came to in the last servo period: one of the codes above, with the program line,
/// for a move that leaves the soft limits the joint, how far it would go, and the limit, and for one that makes a joint
/// jump the joint, and by how much in `position`.
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
        Some(Finding::Jumps { jump, id }) => {
            *line = id;
            *joint = jump.joint as c_int;
            *position = jump.way;
            FRAMEPATH_JOINT_JUMPS
        }
        Some(Finding::Unreached { id, .. }) => {
            *line = id;
            FRAMEPATH_OUT_OF_REACH
        }
    }
}

/// Where that is, nine numbers, for a joint that would jump and for what is out of reach. Returns 0, or -1 where there is no
/// such place.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `place` has room for nine numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_finding_place(
    handle: *const Handle,
    place: *mut c_double,
) -> c_int {
    // SAFETY: see above.
    let Some(handle) = (unsafe { handle.as_ref() }) else {
        return -1;
    };
    let (
        Some(
            Finding::Jumps {
                jump: Jump { place: found, .. },
                ..
            }
            | Finding::Unreached { place: found, .. },
        ),
        false,
    ) = (handle.finding, place.is_null())
    else {
        return -1;
    };
    // SAFETY: see above.
    let room = unsafe { slice::from_raw_parts_mut(place, AXIS_COUNT) };
    room.copy_from_slice(found.as_slice());
    0
}
