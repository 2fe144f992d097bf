//! What the C interface answers to limits of joints, and how joints then move.
#![allow(unsafe_code)]

mod abi_calls;

use std::ffi::{c_int, c_ulong};
use std::ptr::null_mut;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use abi_calls::motion::Shared;
use abi_calls::moves::pose_of;
use framepath::abi::kinematics::{
    framepath_frame_inputs, framepath_kinematics_configure, framepath_kinematics_inverse,
    framepath_kinematics_switch,
};
use framepath::abi::kinematics_jet::{
    framepath_kinematics_axis_of_joint, framepath_kinematics_jet,
};
use framepath::abi::linuxcnc::{EmcPose, KINEMATICS_TYPE};
use framepath::abi::planner::joint_limits::{
    FRAMEPATH_JOINT_ACCELERATION, FRAMEPATH_JOINT_JERK, FRAMEPATH_JOINT_VELOCITY,
    FRAMEPATH_JOINTS_ROUGH, FRAMEPATH_JOINTS_SINGULAR, FRAMEPATH_JOINTS_SLOW,
    FRAMEPATH_JOINTS_TAKEN, FRAMEPATH_JOINTS_TOO_MANY, FRAMEPATH_JOINTS_TRIVIAL,
    FRAMEPATH_JOINTS_UNKNOWN, FramepathJointLimits, framepath_planner_joint_jet,
    framepath_planner_set_joint_limits,
};
use framepath::abi::planner::run::framepath_planner_run_cycle;
use framepath::abi::planner::soft_limits::framepath_planner_kinematics;

/// There is one planner in a process.
static ONE: Mutex<()> = Mutex::new(());

type Inverse =
    unsafe extern "C" fn(*const EmcPose, *mut f64, *const c_ulong, *mut c_ulong) -> c_int;

/// Sets three joints; `f` has X Y Z and the joints of before.
unsafe fn answer(
    pose: *const EmcPose,
    joints: *mut f64,
    f: impl Fn([f64; 3], [f64; 3]) -> [f64; 3],
) -> c_int {
    // SAFETY: the planner hands over a pose and room for 16 joints.
    unsafe {
        let tran = (*pose).tran;
        let joints = &mut *joints.cast::<[f64; 3]>();
        *joints = f([tran.x, tran.y, tran.z], *joints);
    }
    0
}

/// The first joint bends where Y moves.
fn bent_joint(x: f64, y: f64) -> f64 {
    x + 20.0 * (y / 10.0).sin()
}

unsafe extern "C" fn bent(
    pose: *const EmcPose,
    joints: *mut f64,
    _: *const c_ulong,
    _: *mut c_ulong,
) -> c_int {
    // SAFETY: as above.
    unsafe { answer(pose, joints, |[x, y, z], _| [bent_joint(x, y), y, z]) }
}

unsafe extern "C" fn iterating(
    pose: *const EmcPose,
    joints: *mut f64,
    _: *const c_ulong,
    _: *mut c_ulong,
) -> c_int {
    // SAFETY: as above.
    unsafe {
        answer(pose, joints, |[x, y, z], near| {
            [x, y + 1e-3 * (near[1] - y), z]
        })
    }
}

/// Singular where X is 0.
unsafe extern "C" fn rooted(
    pose: *const EmcPose,
    joints: *mut f64,
    _: *const c_ulong,
    _: *mut c_ulong,
) -> c_int {
    // SAFETY: as above.
    unsafe { answer(pose, joints, |[x, y, z], _| [x.abs().sqrt(), y, z]) }
}

unsafe extern "C" fn slow(
    pose: *const EmcPose,
    joints: *mut f64,
    _: *const c_ulong,
    _: *mut c_ulong,
) -> c_int {
    let begin = Instant::now();
    while begin.elapsed() < Duration::from_micros(7) {}
    // SAFETY: as above.
    unsafe { answer(pose, joints, |place, _| place) }
}

unsafe extern "C" fn refusing(
    _: *const EmcPose,
    _: *mut f64,
    _: *const c_ulong,
    _: *mut c_ulong,
) -> c_int {
    -1
}

/// Says that joints move twice as far as axes.
unsafe extern "C" fn twice(_: *const f64, derivatives: *const f64, joints: *mut f64) -> c_int {
    // SAFETY: the planner hands over 27 numbers, and room for as many.
    unsafe {
        let (from, to) = (
            &*derivatives.cast::<[f64; 27]>(),
            &mut *joints.cast::<[f64; 27]>(),
        );
        *to = from.map(|derivative| 2.0 * derivative);
    }
    0
}

struct Machine {
    shared: Shared,
    _one: MutexGuard<'static, ()>,
}

/// Three joints behind these kinematics, at the origin.
fn machine(inverse: Option<Inverse>, kind: u32) -> Machine {
    let one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    let mut shared = Shared::new();
    shared.make_ready();
    shared.config().numJoints = 3;
    for joint in &mut shared.status().joint_status {
        (joint.min_pos_limit, joint.max_pos_limit) = (-1e3, 1e3);
    }
    framepath_planner_kinematics(inverse, None, kind);
    framepath_planner_joint_jet(None);
    Machine { shared, _one: one }
}

fn bent_machine() -> Machine {
    machine(Some(bent), KINEMATICS_TYPE::KINEMATICS_BOTH)
}

/// 60, 800 and 15000 for three joints.
fn limits() -> FramepathJointLimits {
    let of = |limit: f64| {
        let mut limits = [0.0; 9];
        limits[..3].fill(limit);
        limits
    };
    FramepathJointLimits {
        velocity: of(60.0),
        acceleration: of(800.0),
        jerk: of(15_000.0),
        ..FramepathJointLimits::default()
    }
}

impl Machine {
    fn set(&self, limits: &mut FramepathJointLimits) -> c_int {
        // SAFETY: a handle, and limits.
        unsafe { framepath_planner_set_joint_limits(self.shared.handle, limits) }
    }

    /// The answer to limits that are changed like that, and the joint that it is about.
    fn answer(&self, change: impl FnOnce(&mut FramepathJointLimits)) -> (c_int, c_int, f64) {
        let mut limits = limits();
        change(&mut limits);
        let code = self.set(&mut limits);
        (code, limits.joint, limits.value)
    }

    /// Runs a line to X and Y: places of X and Y, period by period.
    fn line(&mut self, x: f64, y: f64) -> Vec<[f64; 2]> {
        self.shared.add_line(x, y);
        let (handle, tp) = (self.shared.handle, self.shared.tp);
        let mut places = vec![[0.0; 2]; 4];
        for _ in 0..20_000 {
            // SAFETY: a handle and motmod's structure.
            unsafe { framepath_planner_run_cycle(handle, tp) };
            let at = self.shared.tp().currentPos.tran;
            places.push([at.x, at.y]);
            if self.shared.tp().done != 0 {
                places.extend([[at.x, at.y]; 4]);
                return places;
            }
        }
        panic!("never done");
    }
}

/// Greatest velocity, acceleration and jerk.
fn peaks(joint: &[f64]) -> [f64; 3] {
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |a: f64, b| a.max(b.abs()));
    [
        most(&mut joint.windows(2).map(|w| w[1] - w[0])) * 1e3,
        most(&mut joint.windows(3).map(|w| w[2] - 2.0 * w[1] + w[0])) * 1e6,
        most(
            &mut joint
                .windows(4)
                .map(|w| w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]),
        ) * 1e9,
    ]
}

#[test]
fn joints_keep_their_limits() {
    let mut machine = bent_machine();
    let joint = |places: &[[f64; 2]]| -> Vec<f64> {
        places.iter().map(|[x, y]| bent_joint(*x, *y)).collect()
    };
    let [velocity, ..] = peaks(&joint(&machine.line(0.0, 60.0)));
    assert!(velocity > 120.0, "{velocity}");
    assert_eq!(machine.set(&mut limits()), FRAMEPATH_JOINTS_TAKEN);
    let [velocity, acceleration, jerk] = peaks(&joint(&machine.line(0.0, 0.0)[4..]));
    assert!(velocity > 59.0 && velocity <= 60.06, "{velocity}");
    assert!(
        acceleration > 780.0 && acceleration <= 801.0,
        "{acceleration}"
    );
    assert!(jerk <= 15_750.0, "{jerk}");
    // Without them it is as before.
    assert_eq!(
        machine.set(&mut FramepathJointLimits::default()),
        FRAMEPATH_JOINTS_TAKEN
    );
    let [velocity, ..] = peaks(&joint(&machine.line(0.0, 60.0)[4..]));
    assert!(velocity > 120.0, "{velocity}");
}

#[test]
fn who_knows_how_joints_move_is_asked_instead() {
    let mut machine = bent_machine();
    framepath_planner_joint_jet(Some(twice));
    assert_eq!(machine.set(&mut limits()), FRAMEPATH_JOINTS_TAKEN);
    let places: Vec<f64> = machine.line(80.0, 0.0).iter().map(|[x, _]| *x).collect();
    let [velocity, acceleration, _] = peaks(&places);
    assert!((velocity - 30.0).abs() < 0.05, "{velocity}");
    assert!((acceleration - 400.0).abs() < 5.0, "{acceleration}");
}

#[test]
fn limits_without_sense_are_refused_by_the_joint() {
    let machine = bent_machine();
    for wrong in [0.0, -1.0, f64::NAN] {
        let (code, joint, value) = machine.answer(|limits| limits.velocity[2] = wrong);
        assert_eq!((code, joint), (FRAMEPATH_JOINT_VELOCITY, 2));
        assert!(value == wrong || wrong.is_nan());
        let (code, joint, _) = machine.answer(|limits| limits.acceleration[1] = wrong);
        assert_eq!((code, joint), (FRAMEPATH_JOINT_ACCELERATION, 1));
    }
    let infinite = machine.answer(|limits| limits.acceleration[0] = f64::INFINITY);
    assert_eq!(infinite, (FRAMEPATH_JOINT_ACCELERATION, 0, f64::INFINITY));
    for wrong in [-1.0, 1.0, f64::NAN] {
        let answer = machine.answer(|limits| limits.jerk[2] = wrong);
        assert_eq!(answer, (FRAMEPATH_JOINT_JERK, 2, 160.0));
    }
    // A joint that the machine has not may have any; more jerk than can be used is none.
    let mut large = limits();
    large.jerk[1] = 1e9;
    large.velocity[0] = f64::INFINITY;
    large.velocity[5] = -3.0;
    assert_eq!(machine.set(&mut large), FRAMEPATH_JOINTS_TAKEN);
    assert_eq!(large.unlimited, 2);
}

#[test]
fn kinematics_that_cannot_be_asked_are_refused() {
    let with = |inverse, kind| machine(inverse, kind).answer(|_| {});
    let both = KINEMATICS_TYPE::KINEMATICS_BOTH;
    assert_eq!(with(None, both).0, FRAMEPATH_JOINTS_UNKNOWN);
    assert_eq!(with(Some(refusing), both).0, FRAMEPATH_JOINTS_UNKNOWN);
    let identity = KINEMATICS_TYPE::KINEMATICS_IDENTITY;
    assert_eq!(with(Some(bent), identity).0, FRAMEPATH_JOINTS_TRIVIAL);
    let (code, _, microseconds) = with(Some(slow), both);
    assert_eq!(code, FRAMEPATH_JOINTS_SLOW);
    assert!(microseconds >= 7.0, "{microseconds}");
    let (code, joint, noise) = with(Some(iterating), both);
    assert_eq!((code, joint), (FRAMEPATH_JOINTS_ROUGH, 1));
    assert!(noise > 1e-8 && noise < 1e-6, "{noise}");
    assert_eq!(with(Some(rooted), both).0, FRAMEPATH_JOINTS_SINGULAR);
    let mut machine = bent_machine();
    machine.shared.config().numJoints = 10;
    let (code, count, _) = machine.answer(|_| {});
    assert_eq!((code, count), (FRAMEPATH_JOINTS_TOO_MANY, 10));
    // SAFETY: null pointers are permitted.
    let nothing = unsafe { framepath_planner_set_joint_limits(null_mut(), null_mut()) };
    assert_eq!(nothing, FRAMEPATH_JOINTS_UNKNOWN);
}

/// Joints XYZAC of our own table for a position.
fn own_joints(position: &[f64; 9]) -> [f64; 16] {
    let mut joints = [0.0; 16];
    let pose = pose_of(position);
    // SAFETY: a pose, and room for 16 numbers.
    assert_eq!(0, unsafe {
        framepath_kinematics_inverse(&pose, joints.as_mut_ptr())
    });
    joints
}

#[test]
fn our_table_says_how_its_joints_move() {
    let _one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    let mut letter = 0;
    // SAFETY: strings, and a number.
    let configured = unsafe {
        framepath_kinematics_configure(
            c"XYZAC".as_ptr(),
            c"xyzac".as_ptr(),
            c"frame".as_ptr(),
            &mut letter,
        )
    };
    assert_eq!(configured, 0);
    // SAFETY: plain numbers.
    let mut pins: framepath_frame_inputs = unsafe { std::mem::zeroed() };
    pins.in_position = 1;
    pins.enabled = 1;
    pins.tool_centre_point = 1;
    pins.offset = [0.0, 20.0, 10.0];
    // SAFETY: pins.
    assert_eq!(0, unsafe { framepath_kinematics_switch(0, &pins) });
    let at = [30.0, -20.0, 10.0, -40.0, 0.0, 70.0, 0.0, 0.0, 0.0];
    let speed = [5.0, -3.0, 2.0, 7.0, 0.0, -4.0, 0.0, 0.0, 0.0];
    let mut derivatives = [0.0; 27];
    derivatives[..9].copy_from_slice(&speed);
    let mut moved = [0.0; 27];
    // SAFETY: as many numbers.
    let answered =
        unsafe { framepath_kinematics_jet(at.as_ptr(), derivatives.as_ptr(), moved.as_mut_ptr()) };
    assert_eq!(answered, 0);
    let h = 1e-4;
    let beside = |t: f64| own_joints(&std::array::from_fn(|axis| at[axis] + t * speed[axis]));
    let (before, here, behind) = (beside(-h), beside(0.0), beside(h));
    for joint in 0..5 {
        let first = (behind[joint] - before[joint]) / (2.0 * h);
        let second = (behind[joint] - 2.0 * here[joint] + before[joint]) / (h * h);
        assert!(
            (moved[joint] - first).abs() < 1e-6,
            "{joint} {first} {moved:?}"
        );
        assert!(
            (moved[9 + joint] - second).abs() < 1e-4,
            "{joint} {second} {moved:?}"
        );
    }
    let axes = [-1, 0, 3, 4, 5, 99].map(|joint| framepath_kinematics_axis_of_joint(joint));
    assert_eq!(axes, [-1, 0, 3, 5, -1, -1]);
    // SAFETY: null pointers are permitted.
    let nothing =
        unsafe { framepath_kinematics_jet(std::ptr::null(), std::ptr::null(), null_mut()) };
    assert_eq!(nothing, -1);
}
