//! Joints with limits of their own, as the planner is told of them.

use crate::joints::{Joints, LimitedJoints};
use framepath::axes::{Axes, AxisLimits};
use framepath::machine_map::JointMap;
use std::cell::RefCell;

thread_local! {
    /// The joints of the planner of this thread, for their jets.
    static JOINTS: RefCell<Option<LimitedJoints>> = const { RefCell::new(None) };
}

/// For the planner of this thread.
pub fn map(joints: &LimitedJoints) -> JointMap {
    JOINTS.set(Some(joints.clone()));
    let [velocity, acceleration, jerk] = joints.limits().map(Axes::from);
    let limits = AxisLimits {
        velocity,
        acceleration,
        jerk,
    };
    JointMap::new(jet, &limits, joints.nanoseconds())
}

fn jet(position: &Axes, derivatives: &[Axes; 3], shares: &[Axes; 3]) -> [Axes; 3] {
    JOINTS.with_borrow(|joints| match joints {
        Some(joints) => joints.derivatives(position, derivatives, shares),
        None => [Axes::repeat(f64::NAN); 3],
    })
}

/// What is planned of the limits of joints, for the reader.
pub fn told(joints: &Joints) -> Option<String> {
    match joints {
        Joints::Axes => None,
        Joints::Unknown(kinematics) => Some(format!(
            "NOT planned: HAL files set limits of joints (blendtp.joint.*) behind {kinematics}; \
             all times and limits are those of the axes"
        )),
        Joints::Limited(joints) => Some(format!(
            "blendtp.joint.* as HAL files set them, behind {}",
            joints.told()
        )),
    }
}
