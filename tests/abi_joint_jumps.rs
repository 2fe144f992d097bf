//! What the C interface finds on the way of moves that joints with limits of their own cannot follow.
#![allow(unsafe_code)]

mod abi_calls;

use std::ffi::{c_int, c_ulong};
use std::sync::{Mutex, MutexGuard, PoisonError};

use abi_calls::motion::Shared;
use framepath::abi::linuxcnc::{EmcPose, KINEMATICS_TYPE};
use framepath::abi::planner::joint_limits::{
    FRAMEPATH_JOINTS_TAKEN, FramepathJointLimits, framepath_planner_joint_jet,
    framepath_planner_set_joint_limits,
};
use framepath::abi::planner::run::framepath_planner_run_cycle;
use framepath::abi::planner::soft_limits::{
    FRAMEPATH_JOINT_JUMPS, FRAMEPATH_OUT_OF_REACH, FRAMEPATH_STAYS_IN_RANGE,
    framepath_planner_finding_place, framepath_planner_kinematics, framepath_planner_range_finding,
};

/// There is one planner in a process.
static ONE: Mutex<()> = Mutex::new(());

type Inverse =
    unsafe extern "C" fn(*const EmcPose, *mut f64, *const c_ulong, *mut c_ulong) -> c_int;

type Forward =
    unsafe extern "C" fn(*const f64, *mut EmcPose, *const c_ulong, *mut c_ulong) -> c_int;

/// Sets three joints; `f` has X Y Z.
unsafe fn answer(
    pose: *const EmcPose,
    joints: *mut f64,
    f: impl Fn([f64; 3]) -> [f64; 3],
) -> c_int {
    // SAFETY: the planner hands over a pose and room for 16 joints.
    unsafe {
        let tran = (*pose).tran;
        let joints = &mut *joints.cast::<[f64; 3]>();
        *joints = f([tran.x, tran.y, tran.z]);
    }
    0
}

/// The first joint goes a turn back behind X 20, and there are no joints behind X 40; none beyond Y 50, and those for there lead
/// to Y 50.
unsafe extern "C" fn turning(
    pose: *const EmcPose,
    joints: *mut f64,
    _: *const c_ulong,
    _: *mut c_ulong,
) -> c_int {
    // SAFETY: as above.
    unsafe {
        let joint = |x: f64| if x > 20.0 { x - 360.0 } else { x };
        answer(pose, joints, |[x, y, z]| [joint(x), y.min(50.0), z]);
        if (*pose).tran.x > 40.0 { -1 } else { 0 }
    }
}

/// Where these lead.
unsafe extern "C" fn turned(
    joints: *const f64,
    pose: *mut EmcPose,
    _: *const c_ulong,
    _: *mut c_ulong,
) -> c_int {
    // SAFETY: the planner hands over 16 joints, and a pose.
    unsafe {
        let [x, y, z] = *joints.cast::<[f64; 3]>();
        let tran = &mut (*pose).tran;
        (tran.x, tran.y, tran.z) = (if x < -180.0 { x + 360.0 } else { x }, y, z);
    }
    0
}

/// The same as kinematics that iterate find it: they go half of the way from where they begin.
unsafe extern "C" fn approached(
    joints: *const f64,
    pose: *mut EmcPose,
    forward_flags: *const c_ulong,
    inverse_flags: *mut c_ulong,
) -> c_int {
    // SAFETY: as above.
    unsafe {
        let before = (*pose).tran.y;
        turned(joints, pose, forward_flags, inverse_flags);
        (*pose).tran.y = 0.5 * ((*pose).tran.y + before);
    }
    0
}

/// There are joints up to X 30 only, and beyond they are not a number.
unsafe extern "C" fn rooted_away(
    pose: *const EmcPose,
    joints: *mut f64,
    _: *const c_ulong,
    _: *mut c_ulong,
) -> c_int {
    // SAFETY: as above.
    unsafe { answer(pose, joints, |[x, y, z]| [(30.0 - x).sqrt(), y, z]) }
}

/// Three joints at the origin.
struct Machine {
    shared: Shared,
    _one: MutexGuard<'static, ()>,
}

impl Machine {
    /// Behind these kinematics, with limits of joints or without.
    fn new(inverse: Inverse, forward: Option<Forward>, limited: bool) -> Self {
        let one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
        let mut shared = Shared::new();
        shared.make_ready();
        shared.config().numJoints = 3;
        for joint in &mut shared.status().joint_status {
            (joint.min_pos_limit, joint.max_pos_limit) = (-1e3, 1e3);
        }
        framepath_planner_kinematics(Some(inverse), forward, KINEMATICS_TYPE::KINEMATICS_BOTH);
        framepath_planner_joint_jet(None);
        let mut limits = FramepathJointLimits::default();
        if limited {
            limits.velocity[..3].fill(60.0);
            limits.acceleration[..3].fill(800.0);
        }
        // SAFETY: a handle, and limits.
        let taken = unsafe { framepath_planner_set_joint_limits(shared.handle, &mut limits) };
        assert_eq!(taken, FRAMEPATH_JOINTS_TAKEN);
        Self { shared, _one: one }
    }

    /// What the look along a line to X and Y finds: the code, the joint, by how much it jumps, and where.
    fn finding(&mut self, x: f64, y: f64) -> (c_int, c_int, f64, [f64; 9]) {
        self.shared.add_line(x, y);
        let (handle, tp) = (self.shared.handle, self.shared.tp);
        let (mut line, mut joint, mut way, mut limit) = (0, -1, 0.0, 0.0);
        let mut place = [0.0; 9];
        for _ in 0..20_000 {
            // SAFETY: a handle, motmod's structure, numbers, and room for nine of them.
            let (code, found) = unsafe {
                framepath_planner_run_cycle(handle, tp);
                (
                    framepath_planner_range_finding(
                        handle, &mut line, &mut joint, &mut way, &mut limit,
                    ),
                    framepath_planner_finding_place(handle, place.as_mut_ptr()),
                )
            };
            assert_eq!(found == 0, code != FRAMEPATH_STAYS_IN_RANGE);
            if code != FRAMEPATH_STAYS_IN_RANGE || self.shared.tp().done != 0 {
                return (code, joint, way, place);
            }
        }
        panic!("never done");
    }
}

#[test]
fn a_move_that_joints_with_limits_cannot_follow_is_not_begun() {
    let mut machine = Machine::new(turning, None, true);
    let (code, joint, way, place) = machine.finding(30.0, 0.0);
    assert_eq!((code, joint), (FRAMEPATH_JOINT_JUMPS, 0));
    assert_eq!(machine.shared.tp().currentPos.tran.x, 0.0);
    assert!((way + 360.0).abs() < 0.01, "{way}");
    assert!((place[0] - 20.0).abs() < 1e-3, "{place:?}");
    drop(machine);
    let within = Machine::new(turning, None, true).finding(19.0, 10.0);
    assert_eq!(within.0, FRAMEPATH_STAYS_IN_RANGE);
    let without = Machine::new(turning, None, false).finding(30.0, 0.0);
    assert_eq!(without.0, FRAMEPATH_STAYS_IN_RANGE);
}

#[test]
fn joints_that_do_not_lead_to_their_place_are_none() {
    // Nothing tells that without forward kinematics that answer by the joints alone.
    for forward in [None, Some(approached as Forward)] {
        let (code, ..) = Machine::new(turning, forward, true).finding(0.0, 60.0);
        assert_eq!(code, FRAMEPATH_STAYS_IN_RANGE);
    }
    let (code, _, _, place) = Machine::new(turning, Some(turned), true).finding(0.0, 60.0);
    assert_eq!(code, FRAMEPATH_OUT_OF_REACH);
    assert!(place[1] > 50.0 && place[1] <= 60.0, "{place:?}");
    let without = Machine::new(turning, Some(turned), false).finding(0.0, 60.0);
    assert_eq!(without.0, FRAMEPATH_STAYS_IN_RANGE);
}

#[test]
fn a_place_without_joints_is_not_entered() {
    let mut machine = Machine::new(rooted_away, None, true);
    let (code, _, _, place) = machine.finding(60.0, 0.0);
    assert_eq!(code, FRAMEPATH_OUT_OF_REACH);
    assert!(place[0] > 30.0 && place[0] < 40.0, "{place:?}");
}
