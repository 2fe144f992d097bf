//! The limits of joints: what the pins say, and whether the kinematics let them be kept.

use libc::{c_double, c_int, c_uint};

use super::handle::Handle;
use super::joint_kinematics::{self, Measured};
use super::soft_limits::commanded_joints;
use crate::axes::{AXIS_COUNT, Axes, AxisLimits};
use crate::machine_map::JointMap;
use crate::numerical_jet::{BEND, STEP};
use crate::planner::{JerkLimit, LEAST_ACCELERATION, LEAST_VELOCITY};

/// The limits are taken, or there are none.
pub const FRAMEPATH_JOINTS_TAKEN: c_int = 0;
/// The velocity of `joint` makes no sense.
pub const FRAMEPATH_JOINT_VELOCITY: c_int = 1;
/// Its acceleration makes no sense.
pub const FRAMEPATH_JOINT_ACCELERATION: c_int = 2;
/// Its jerk makes no sense: `value` is the smallest that would.
pub const FRAMEPATH_JOINT_JERK: c_int = 3;
/// There are more joints, `joint`, than can have limits.
pub const FRAMEPATH_JOINTS_TOO_MANY: c_int = 4;
/// The kinematics cannot be asked, or have no joints for where the machine is.
pub const FRAMEPATH_JOINTS_UNKNOWN: c_int = 5;
/// They take too long: `value` microseconds for the joints of a place.
pub const FRAMEPATH_JOINTS_SLOW: c_int = 6;
/// Their answers for `joint` are off by `value`.
pub const FRAMEPATH_JOINTS_ROUGH: c_int = 7;
/// The joints are the axes, whose limits hold.
pub const FRAMEPATH_JOINTS_TRIVIAL: c_int = 8;

/// The machine stands at a singular place, which joints with limits cannot leave smoothly.
pub const FRAMEPATH_JOINTS_SINGULAR: c_int = 9;

/// How many joints can have limits: 0 to 8.
pub const FRAMEPATH_LIMITED_JOINTS: usize = 9;
const _: () = assert!(FRAMEPATH_LIMITED_JOINTS == AXIS_COUNT);

/// Microseconds that the kinematics may take for the joints of a place. Some 20 places are asked for in a servo period.
pub const FRAMEPATH_MOST_MICROSECONDS: c_double = 2.0;

/// The share of a limit that noise may take at full speed.
const NOISE_SHARE: f64 = 0.02;

/// What noise of the answers becomes in second and third derivatives, for a step of 1.
const IN_ACCELERATION: f64 = 4.0;
const IN_JERK: f64 = 2.8;

/// What the pins say, and what was found wrong with it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FramepathJointLimits {
    /// Of joints 0 to 8, units per second; all of these 0: no limits of joints.
    pub velocity: [c_double; 9],
    /// Units per second squared.
    pub acceleration: [c_double; 9],
    /// Units per second cubed, 0: not limited.
    pub jerk: [c_double; 9],
    /// The joint that an answer is about.
    pub joint: c_int,
    /// What was measured, or would make sense.
    pub value: c_double,
    /// A bit for each joint whose jerk is more than can be used: it counts as not limited.
    pub unlimited: c_uint,
}

/// Why limits are not taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refused {
    /// One of the codes above.
    pub code: c_int,
    /// The joint.
    pub joint: usize,
    /// What was measured, or would make sense.
    pub value: f64,
}

impl Refused {
    fn of(code: c_int, joint: usize, value: f64) -> Self {
        Self { code, joint, value }
    }
}

impl FramepathJointLimits {
    fn are_none(&self) -> bool {
        let mut all = self
            .velocity
            .iter()
            .chain(&self.acceleration)
            .chain(&self.jerk);
        all.all(|limit| *limit == 0.0)
    }

    /// The limits of so many joints, and none of what is no joint.
    fn limits(&mut self, count: usize, period: f64) -> Result<AxisLimits, Refused> {
        let none = || Axes::repeat(f64::INFINITY);
        let mut limits = AxisLimits {
            velocity: none(),
            acceleration: none(),
            jerk: none(),
        };
        self.unlimited = 0;
        for joint in 0..AXIS_COUNT.min(count) {
            let (velocity, acceleration) = (self.velocity[joint], self.acceleration[joint]);
            if velocity.is_nan() || velocity < LEAST_VELOCITY {
                return Err(Refused::of(FRAMEPATH_JOINT_VELOCITY, joint, velocity));
            }
            if !acceleration.is_finite() || acceleration < LEAST_ACCELERATION {
                return Err(Refused::of(
                    FRAMEPATH_JOINT_ACCELERATION,
                    joint,
                    acceleration,
                ));
            }
            limits.velocity[joint] = velocity;
            limits.acceleration[joint] = acceleration;
            match JerkLimit::new(self.jerk[joint], acceleration, period) {
                JerkLimit::Limited(jerk) => limits.jerk[joint] = jerk,
                JerkLimit::Unlimited { asked } => self.unlimited |= c_uint::from(asked) << joint,
                JerkLimit::Refused { smallest } => {
                    return Err(Refused::of(FRAMEPATH_JOINT_JERK, joint, smallest));
                }
            }
        }
        Ok(limits)
    }
}

/// Whether limits can be kept by kinematics that are like that. `fastest`: the greatest velocity of an axis, for joints whose
/// own has no limit.
///
/// # Errors
/// [`FRAMEPATH_JOINTS_SLOW`], [`FRAMEPATH_JOINTS_ROUGH`].
pub fn check(
    measured: &Measured,
    limits: &AxisLimits,
    count: usize,
    fastest: f64,
) -> Result<(), Refused> {
    let microseconds = measured.call * 1e-3;
    if microseconds > FRAMEPATH_MOST_MICROSECONDS {
        return Err(Refused::of(FRAMEPATH_JOINTS_SLOW, 0, microseconds));
    }
    for (joint, noise) in measured
        .noise
        .iter()
        .enumerate()
        .take(count.min(AXIS_COUNT))
    {
        let velocity = limits.velocity[joint];
        let velocity = if velocity.is_finite() {
            velocity
        } else {
            fastest
        };
        let bend = (limits.acceleration[joint] / (2.0 * BEND)).sqrt();
        let steps = (velocity / STEP).max(bend);
        let acceleration = IN_ACCELERATION * noise * steps * steps / limits.acceleration[joint];
        let jerk = IN_JERK * noise * steps * steps * steps / limits.jerk[joint];
        if acceleration > NOISE_SHARE || jerk > NOISE_SHARE {
            return Err(Refused::of(FRAMEPATH_JOINTS_ROUGH, joint, *noise));
        }
    }
    Ok(())
}

impl Handle {
    /// Tells the kinematics where the machine is, in each servo period in which joints have limits.
    pub(super) fn follow_joints(&mut self) {
        // SAFETY: null, or motmod's status for as long as the module is loaded.
        let (true, Some(status)) = (self.joints_limited, unsafe { self.status.as_ref() }) else {
            return;
        };
        let position = self.planner.status().position;
        joint_kinematics::kinematics().follow(&position, &commanded_joints(status));
    }

    fn take_joint_limits(&mut self, pins: &mut FramepathJointLimits) -> Result<(), Refused> {
        let unknown = || Refused::of(FRAMEPATH_JOINTS_UNKNOWN, 0, 0.0);
        let kinematics = joint_kinematics::kinematics();
        // SAFETY: null, or motmod's own structures for as long as the module is loaded.
        let (Some(status), Some(config)) =
            (unsafe { (self.status.as_ref(), self.config.as_ref()) })
        else {
            return Err(unknown());
        };
        let count = usize::try_from(config.numJoints - config.numExtraJoints).unwrap_or(0);
        if kinematics.is_trivial() {
            return Err(Refused::of(FRAMEPATH_JOINTS_TRIVIAL, 0, 0.0));
        }
        if count > AXIS_COUNT {
            return Err(Refused::of(FRAMEPATH_JOINTS_TOO_MANY, count, 0.0));
        }
        if !kinematics.is_known() {
            return Err(unknown());
        }
        let limits = pins.limits(count, self.planner.period())?;
        let now = self.planner.status();
        let measured = match kinematics.measured {
            Some(measured) if !now.done => measured,
            _ => kinematics
                .measure(&now.position, &commanded_joints(status), count)
                .ok_or_else(unknown)?,
        };
        check(&measured, &limits, count, self.limits().velocity.max())?;
        let jet = joint_kinematics::jet(measured.exact);
        let joints = JointMap::new(jet, &limits, measured.jet);
        let singular = || kinematics.is_singular(&now.position, joints.shares());
        if now.done && !measured.exact && singular() {
            return Err(Refused::of(FRAMEPATH_JOINTS_SINGULAR, 0, 0.0));
        }
        self.joints_limited |= self.planner.set_joints(Some(joints));
        Ok(())
    }
}

/// Sets the limits of joints, from the next rest on: that of velocity, acceleration and jerk of each joint holds for all
/// motion that is planned, and the limits of acceleration and jerk of the axes do not. Returns one of the codes above. With anything but
/// `FRAMEPATH_JOINTS_TAKEN` and `FRAMEPATH_JOINTS_TRIVIAL` nothing changes, and no move may be added.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `pins` points to one of these.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_joint_limits(
    handle: *mut Handle,
    pins: *mut FramepathJointLimits,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(pins)) = (unsafe { (handle.as_mut(), pins.as_mut()) }) else {
        return FRAMEPATH_JOINTS_UNKNOWN;
    };
    pins.unlimited = 0;
    let taken = if pins.are_none() {
        handle.forget_joints();
        Ok(())
    } else {
        handle.take_joint_limits(pins)
    };
    match taken {
        Ok(()) => FRAMEPATH_JOINTS_TAKEN,
        Err(Refused { code, joint, value }) => {
            if code == FRAMEPATH_JOINTS_TRIVIAL {
                handle.forget_joints();
            }
            pins.joint = joint as c_int;
            pins.value = value;
            code
        }
    }
}

impl Handle {
    fn forget_joints(&mut self) {
        self.planner.set_joints(None);
        // What runs keeps the limits that it began with.
        self.joints_limited &= !self.planner.status().done;
    }
}

/// Who says in closed form how joints move: `framekinsJet`, or null where there is none.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_planner_joint_jet(
    exact: Option<unsafe extern "C" fn(*const c_double, *const c_double, *mut c_double) -> c_int>,
) {
    joint_kinematics::kinematics().set_exact(exact);
}
