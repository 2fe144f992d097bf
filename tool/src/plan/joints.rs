//! Joints behind kinematics that have limits of their own.

use super::error::PlanError;
use crate::machine::ini::Ini;
use crate::path::Position;
use crate::wiring::joints::JointSettings;
use framepath::axes::{AXIS_COUNT, Axes, AxisLimits};
use framepath::machine::{
    Coordinates, JOINT_COUNT, Machine, RotaryDirection, TableTilting, TableTiltingParameters,
    TiltAxis,
};
use framepath::machine_map::JointMap;
use framepath::planner::JerkLimit;
use nalgebra::Vector3;
use std::cell::Cell;

/// What a jet of our tables takes, nanoseconds: blendtp measures it, and plans about as far in a servo period.
const JET: f64 = 100.0;

thread_local! {
    /// The machine of the planner of this thread, for its jets.
    static MACHINE: Cell<Option<Machine>> = const { Cell::new(None) };
}

/// What is known of joints with limits.
#[derive(Clone, Debug)]
pub enum Joints {
    /// There are none.
    Axes,
    /// There are, behind this module, which is not known here.
    Unknown(String),
    /// They are planned.
    Planned(Box<PlannedJoints>),
}

/// Joints of a machine of ours.
#[derive(Clone, Debug)]
pub struct PlannedJoints {
    machine: Machine,
    limits: AxisLimits,
    name: String,
}

impl Joints {
    /// # Errors
    /// Limits with which blendtp refuses every move, kinematics that framekins does not take.
    pub fn from_settings(
        settings: &JointSettings,
        ini: &Ini,
        period: f64,
    ) -> Result<Joints, PlanError> {
        if !settings.is_limited() {
            return Ok(Joints::Axes);
        }
        let Some(tilt) = own_table(settings) else {
            return Ok(Joints::Unknown(settings.kinematics.clone()));
        };
        let refused =
            |why: String| PlanError::from(ini.bad_value("KINS", "KINEMATICS", why.as_str()));
        let coordinates = Coordinates::parse(settings.coordinates.as_bytes());
        let table = coordinates.and_then(|coordinates| TableTilting::new(tilt, coordinates));
        let mut table =
            table.map_err(|error| refused(format!("framekins refuses it: {error:?}")))?;
        table
            .set_parameters(dimensions(settings))
            .map_err(|error| refused(format!("framekins refuses the table: {error:?}")))?;
        let machine = Machine::TableTilting(table);
        Ok(Joints::Planned(Box::new(PlannedJoints {
            limits: limits(settings, &machine, period)?,
            machine,
            name: settings.machine.clone(),
        })))
    }

    /// The joints that are planned.
    pub fn planned(&self) -> Option<&PlannedJoints> {
        match self {
            Joints::Planned(joints) => Some(joints),
            _ => None,
        }
    }

    /// For the reader.
    pub fn told(&self) -> Option<String> {
        match self {
            Joints::Axes => None,
            Joints::Unknown(kinematics) => Some(format!(
                "NOT planned: HAL files set limits of joints (blendtp.joint.*) behind {kinematics}, which is not known here; \
                 all times and limits are those of the axes"
            )),
            Joints::Planned(joints) => Some(format!(
                "blendtp.joint.* as HAL files set them, behind machine={} {} the tool centre point",
                joints.name,
                if joints.machine.tool_centre_point() {
                    "with"
                } else {
                    "without"
                }
            )),
        }
    }
}

impl PlannedJoints {
    /// For the planner of this thread.
    pub fn map(&self) -> JointMap {
        MACHINE.set(Some(self.machine));
        JointMap::new(jet, &self.limits, JET)
    }

    /// Velocity, acceleration, jerk, shape (3, 9), machine units; infinite where there is none.
    pub fn limits(&self) -> [Position; 3] {
        let AxisLimits {
            velocity,
            acceleration,
            jerk,
        } = self.limits;
        [velocity, acceleration, jerk].map(Position::from)
    }

    /// The joints for a position, machine units.
    pub fn at(&self, position: &Position) -> Position {
        let mut joints = [0.0; JOINT_COUNT];
        self.machine.inverse(&Axes::from(*position), &mut joints);
        std::array::from_fn(|joint| joints[joint])
    }
}

/// The table of ours that a machine has.
fn own_table(settings: &JointSettings) -> Option<TiltAxis> {
    match (settings.kinematics.as_str(), settings.machine.as_str()) {
        ("framekins", "xyzac") => Some(TiltAxis::A),
        ("framekins", "xyzbc") => Some(TiltAxis::B),
        _ => None,
    }
}

/// The axis, 3 for A or 4 for B, that tilts the tool while C turns it, as framekins tells blendtp.
pub fn tool_tilt_axis(settings: &JointSettings) -> Option<usize> {
    let tilt = own_table(settings)?;
    (settings.framekins("tool-centre-point") != 0.0).then_some(tilt.axis())
}

fn jet(position: &Axes, derivatives: &[Axes; 3], _: &[Axes; 3]) -> [Axes; 3] {
    let Some(machine) = MACHINE.get() else {
        return [Axes::repeat(f64::NAN); 3];
    };
    machine.derivatives(position, derivatives).map(|axes| {
        let mut joints = [0.0; JOINT_COUNT];
        machine.coordinates().distribute(&axes, &mut joints);
        Axes::from_fn(|joint, _| joints[joint])
    })
}

/// As the pins say before a program asks for anything else.
fn dimensions(settings: &JointSettings) -> TableTiltingParameters {
    let pin = |name: &str| settings.framekins(name);
    TableTiltingParameters {
        rotation_point: Vector3::new(pin("x-rot-point"), pin("y-rot-point"), pin("z-rot-point")),
        offset: Vector3::new(pin("x-offset"), pin("y-offset"), pin("z-offset")),
        tool_offset: pin("tool-offset"),
        direction: match pin("conventional-directions") {
            0.0 => RotaryDirection::Table,
            _ => RotaryDirection::Conventional,
        },
        tool_centre_point: pin("tool-centre-point") != 0.0,
    }
}

fn limits(
    settings: &JointSettings,
    machine: &Machine,
    period: f64,
) -> Result<AxisLimits, PlanError> {
    let mut limits = [Axes::repeat(f64::INFINITY); 3];
    for joint in
        (0..AXIS_COUNT).filter(|joint| machine.coordinates().axis_of_joint(*joint).is_some())
    {
        let [velocity, acceleration, jerk] = settings.limits.map(|limits| limits[joint]);
        for (limit, name) in [(velocity, "velocity"), (acceleration, "acceleration")] {
            if limit <= 0.0 {
                return Err(PlanError::Option(format!(
                    "blendtp.joint.{joint}.max-{name} is {limit}: since a limit of joints is set, blendtp refuses every move \
                     unless it is positive for each joint: set it with setp from [JOINT_{joint}]MAX_{}",
                    name.to_uppercase()
                )));
            }
        }
        limits[0][joint] = velocity;
        limits[1][joint] = acceleration;
        match JerkLimit::new(jerk, acceleration, period) {
            JerkLimit::Limited(jerk) => limits[2][joint] = jerk,
            JerkLimit::Unlimited { .. } => {}
            JerkLimit::Refused { smallest } => {
                return Err(PlanError::Option(format!(
                    "blendtp.joint.{joint}.max-jerk is {jerk}: blendtp refuses every move unless it is 0 (not limited) or at \
                     least {smallest}: set it with setp from [JOINT_{joint}]MAX_JERK"
                )));
            }
        }
    }
    let [velocity, acceleration, jerk] = limits;
    Ok(AxisLimits {
        velocity,
        acceleration,
        jerk,
    })
}
