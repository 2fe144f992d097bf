//! Under which conditions the modules are compared: options, else the INI file of a machine, else stated defaults.

use super::CompareArguments;
use super::error::CompareError;
use crate::joints::{Joints, are_axes};
use crate::machine::above_joints::AboveJoint;
use crate::machine::configuration::Machine;
use crate::machine::ini::Ini;
use crate::machine::limits::Limits;
use crate::machine::warn_of;
use crate::path::Position;
use crate::wiring::joints::JointSettings;
use std::path::Path;

/// More than any machine has, mm/s.
pub(super) const NO_VELOCITY_LIMIT: f64 = 1e9;

/// Lengths are mm, whatever the machine's unit is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Conditions {
    /// Velocity and acceleration of each axis.
    pub limits: Limits,
    /// Where they come from, for the reader.
    pub limits_from: String,
    /// What is known of the joints, for positions as seen from the start.
    pub joints: Joints,
    /// Where the machine begins: where joints have limits behind a kinematics module, with these at home.
    pub start: Position,
    /// Servo period, s.
    pub period: f64,
    /// Along the path, mm/s.
    pub velocity_limit: f64,
    /// 1 is 100 %.
    pub max_feed_override: f64,
}

impl Conditions {
    /// # Errors
    /// An INI file, or limits of joints, that cannot be used.
    pub(super) fn new(arguments: &CompareArguments) -> Result<Conditions, CompareError> {
        let mut conditions = match &arguments.ini {
            Some(file) => Conditions::of_machine(file, arguments)?,
            None => Conditions::without_machine(),
        };
        if let Some(changes) = &arguments.limits {
            conditions.limits.apply(changes);
            conditions.limits_from = match arguments.ini {
                Some(_) => format!("{}, changed by {changes}", conditions.limits_from),
                None => changes.to_string(),
            };
        }
        let Conditions {
            period,
            velocity_limit,
            max_feed_override,
            ..
        } = conditions;
        Ok(Conditions {
            period: arguments.period.unwrap_or(period),
            velocity_limit: arguments.velocity_limit.unwrap_or(velocity_limit),
            max_feed_override: arguments.max_feed_override.unwrap_or(max_feed_override),
            ..conditions
        })
    }

    fn without_machine() -> Conditions {
        Conditions {
            limits: Limits::default(),
            limits_from: "V=100,A=1000".to_owned(),
            joints: Joints::Axes,
            start: [0.0; 9],
            period: 0.001,
            velocity_limit: NO_VELOCITY_LIMIT,
            max_feed_override: 1.0,
        }
    }

    fn of_machine(file: &Path, arguments: &CompareArguments) -> Result<Conditions, CompareError> {
        let ini = Ini::read(file)?;
        let machine = Machine::from_ini(&ini)?;
        warn_of(ini.passed_over());
        warn_of(machine.axes.iter().flat_map(|axis| &axis.assumed));
        let period = machine.servo_period;
        let mut joints = JointSettings::read(&ini);
        joints.turned_on = arguments.tool_centre_point;
        joints.kinematics_type = arguments.kinematics_type;
        let are_axes = are_axes(&joints);
        let joints = Joints::from_settings(&joints, &ini, period, machine.millimetres())?;
        if are_axes && joints.limited().is_none() && arguments.limits.is_none() {
            let above = AboveJoint::of_machine(&ini, &machine);
            warn_of(&Vec::from_iter(
                above.iter().map(|above| above.warning(&ini)),
            ));
        }
        let (start, joints) = at_home(joints);
        let mut conditions = Conditions {
            limits_from: format!("limits of {}", file.display()),
            joints,
            start,
            period,
            ..Conditions::without_machine()
        };
        conditions.limits.take_from(&machine);
        if let Some(velocity) = ini.path_velocity()? {
            conditions.velocity_limit = velocity * machine.millimetres();
        }
        // Below 1 it only slows the operator down.
        if let Some(scale) = ini.number("DISPLAY", "MAX_FEED_OVERRIDE")? {
            conditions.max_feed_override = scale.max(1.0);
        }
        Ok(conditions)
    }
}

/// Where the machine begins, with its joints at home, and the joints as programs see them that begin at zero there.
fn at_home(joints: Joints) -> (Position, Joints) {
    match joints {
        Joints::Limited(joints) => {
            let start = joints.home().unwrap_or_default();
            let joints = joints.beginning_at(&start);
            (start.into(), Joints::Limited(Box::new(joints)))
        }
        others => ([0.0; 9], others),
    }
}
