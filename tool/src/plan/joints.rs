//! Joints with limits of their own, as the planner is told of them.

use crate::joints::{Joints, LimitedJoints};
use framepath::axes::{Axes, AxisLimits};
use framepath::machine_map::JointMap;
use std::cell::RefCell;

/// A rotary axis nearer to zero is not turned, degrees.
const LEVEL: f64 = 1e-8;

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

/// From here on the tool has this length, machine units, where HAL tells the kinematics of it; the machine stands at `position`.
///
/// # Errors
/// Why the plan would be wrong.
pub fn set_tool_length(joints: &Joints, length: f64, position: &Axes) -> Result<(), &'static str> {
    let is_taken = joints
        .limited()
        .is_some_and(|joints| joints.set_tool_length(length));
    let is_turned = (3..6).any(|axis| position[axis].abs() > LEVEL);
    if is_taken && is_turned {
        return Err(
            "behind it the length of the tool changes while A, B or C are turned, which moves the joints: turn them to zero \
             before G43 and G49",
        );
    }
    Ok(())
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
