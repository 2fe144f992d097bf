//! Kinematics that bend, as the planner is handed them: a tilting table, exact and by its inverse alone, and a robot
//! with two arms.

use std::sync::LazyLock;

use framepath::axes::{AXIS_COUNT, Axes, AxisLimits};
use framepath::machine::{JOINT_COUNT, Machine, TableTiltingParameters};
use framepath::machine_map::{JointJet, JointMap};
use framepath::numerical_jet::numerical_jet;
use nalgebra::Vector3;

/// Five axes, the workpiece on a table, the tool centre point on.
static TABLE: LazyLock<Machine> = LazyLock::new(|| {
    let mut machine = Machine::configured(b"xyzac", b"XYZAC").expect("a machine");
    let parameters = TableTiltingParameters {
        rotation_point: Vector3::new(3.0, -2.0, 0.0),
        offset: Vector3::new(0.0, 20.0, 10.0),
        tool_offset: 5.0,
        tool_centre_point: true,
        ..TableTiltingParameters::default()
    };
    machine.set_parameters(&parameters).expect("dimensions");
    machine
});

/// Positions of the joints XYZAC.
pub fn table(axes: &Axes) -> Axes {
    let mut joints = [0.0; JOINT_COUNT];
    TABLE.inverse(axes, &mut joints);
    Axes::from_fn(|joint, _| joints[joint])
}

pub const EXACT_TABLE: JointJet =
    |position, derivatives, _| TABLE.joint_derivatives(position, derivatives);

pub const NUMERICAL_TABLE: JointJet =
    |position, derivatives, shares| numerical_jet(table, position, derivatives, shares);

const UPPER_ARM: f64 = 490.0;
const LOWER_ARM: f64 = 340.0;

/// A robot with two arms: its joints are singular where both are in line, `REACH` away from the first one.
pub fn robot(axes: &Axes) -> Axes {
    let (x, y) = (axes[0], axes[1]);
    let squares = UPPER_ARM * UPPER_ARM + LOWER_ARM * LOWER_ARM;
    let cosine = (x * x + y * y - squares) / (2.0 * UPPER_ARM * LOWER_ARM);
    let elbow = cosine.clamp(-1.0, 1.0).acos();
    let along = UPPER_ARM + LOWER_ARM * elbow.cos();
    let shoulder = y.atan2(x) - (LOWER_ARM * elbow.sin()).atan2(along);
    let mut joints = *axes;
    joints[0] = shoulder.to_degrees();
    joints[1] = elbow.to_degrees();
    joints[3] = axes[5] - joints[0] - joints[1];
    joints[5] = 0.0;
    joints
}

pub const REACH: f64 = UPPER_ARM + LOWER_ARM;

pub const NUMERICAL_ROBOT: JointJet =
    |position, derivatives, shares| numerical_jet(robot, position, derivatives, shares);

/// Limits of joints, and none for what is no joint.
pub fn joint_limits(count: usize, [velocity, acceleration, jerk]: [f64; 3]) -> AxisLimits {
    let of = |limit: f64| {
        let joint = |joint: usize| if joint < count { limit } else { f64::INFINITY };
        Axes::from_iterator((0..AXIS_COUNT).map(joint))
    };
    AxisLimits {
        velocity: of(velocity),
        acceleration: of(acceleration),
        jerk: of(jerk),
    }
}

/// Joints with 100, 1000 and 20000.
pub fn joints_of(jet: JointJet, count: usize) -> JointMap {
    JointMap::new(jet, &joint_limits(count, [100.0, 1000.0, 20_000.0]), 600.0)
}
