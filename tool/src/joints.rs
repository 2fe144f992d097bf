//! Joints behind kinematics of ours that have limits of their own: what the planner asks of them.

use crate::machine::IniError;
use crate::machine::ini::Ini;
use crate::machine::limits::{Jerk, infinite_for_none, is_rotary};
use crate::path::Position;
use crate::wiring::blendtp::LIMITED_JOINTS;
use crate::wiring::joints::JointSettings;
use framepath::axes::Axes;
use framepath::frame::FrameError;
use framepath::machine::{
    ConfigurationError, JOINT_COUNT, Machine, RotaryDirection, TableTiltingParameters, TiltAxis,
};
use framepath::planner::JerkLimit;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What is known of joints with limits.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Joints {
    /// There are none.
    Axes,
    /// There are, behind this module, which is not known here.
    Unknown(String),
    /// There are, behind kinematics of ours.
    Limited(Box<LimitedJoints>),
}

/// Joints of a machine of ours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Told", into = "Told")]
pub(crate) struct LimitedJoints {
    table: Table,
    machine: Machine,
    limits: [Position; 3],
}

/// The same as it is told another process.
#[derive(Serialize, Deserialize)]
struct Told {
    table: Table,
    limits: [Position; 3],
}

/// A table as the parameters and pins of framekins describe it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Table {
    /// `machine=`.
    name: String,
    coordinates: String,
    /// The point of rotation, the way from there to the axis that tilts, the length of the tool; units of length.
    rotation_point: [f64; 3],
    offset: [f64; 3],
    tool_offset: f64,
    conventional: bool,
    tool_centre_point: bool,
}

/// Why limits of joints cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum JointsError {
    /// The INI file names kinematics that framekins refuses.
    #[error(transparent)]
    Ini(#[from] IniError),
    /// --tool-centre-point for a machine of which that is not known.
    #[error(
        "--tool-centre-point: the HAL files of {} set no limits of joints (blendtp.joint.*) behind a table of framekins \
         (machine=xyzac or machine=xyzbc)",
        .0.display()
    )]
    NoTable(PathBuf),
    /// Without this limit blendtp refuses every move.
    #[error(
        "blendtp.joint.{joint}.max-{quantity} is {limit}: since a limit of joints is set, blendtp refuses every move \
         unless it is positive for each joint, and an acceleration not infinite: set it with setp from [JOINT_{joint}]MAX_{}",
        quantity.to_uppercase()
    )]
    NotPositive {
        /// Its number.
        joint: usize,
        /// velocity or acceleration.
        quantity: &'static str,
        /// What the pin says, machine units.
        limit: f64,
    },
    /// A jerk so small that blendtp refuses every move.
    #[error(
        "blendtp.joint.{joint}.max-jerk is {limit}: blendtp refuses every move unless it is 0 (not limited) or at \
         least {smallest}: set it with setp from [JOINT_{joint}]MAX_JERK"
    )]
    Jerk {
        /// Its number.
        joint: usize,
        /// What the pin says, machine units.
        limit: f64,
        /// The least that is taken, machine units.
        smallest: f64,
    },
}

/// Why a table is none of ours.
#[derive(Clone, Copy, Debug, thiserror::Error)]
enum TableError {
    #[error("framekins refuses it: {0:?}")]
    Configuration(ConfigurationError),
    #[error("framekins refuses the table: {0:?}")]
    Dimensions(FrameError),
}

impl Joints {
    /// In lengths of which a machine unit has so many: 1 for machine units. `period`: of the servo thread, s.
    ///
    /// # Errors
    /// Limits with which blendtp refuses every move, kinematics that framekins does not take.
    pub(crate) fn from_settings(
        settings: &JointSettings,
        ini: &Ini,
        period: f64,
        lengths: f64,
    ) -> Result<Joints, JointsError> {
        let is_planned = settings.is_limited() && own_table(settings).is_some();
        if settings.turned_on && !is_planned {
            return Err(JointsError::NoTable(ini.file().to_owned()));
        }
        if !settings.is_limited() {
            return Ok(Joints::Axes);
        }
        if own_table(settings).is_none() {
            return Ok(Joints::Unknown(settings.kinematics.clone()));
        }
        let refused =
            |why: TableError| ini.bad_value("KINS", "KINEMATICS", why.to_string().as_str());
        let table = Table::new(settings, lengths);
        let machine = table.machine().map_err(refused)?;
        Ok(Joints::Limited(Box::new(LimitedJoints {
            limits: limits(settings, &machine, period, lengths)?,
            table,
            machine,
        })))
    }

    /// The same with another limit of jerk. A mm has so many `lengths`.
    pub(crate) fn with_jerk(self, jerk: Jerk, lengths: f64) -> Joints {
        match self {
            Joints::Limited(joints) => Joints::Limited(Box::new(joints.with_jerk(jerk, lengths))),
            others => others,
        }
    }

    /// The joints whose limits are known to hold.
    pub(crate) fn limited(&self) -> Option<&LimitedJoints> {
        match self {
            Joints::Limited(joints) => Some(joints),
            _ => None,
        }
    }
}

impl LimitedJoints {
    /// The machine, for the reader.
    pub(crate) fn told(&self) -> String {
        let with = if self.table.tool_centre_point {
            "with"
        } else {
            "without"
        };
        let name = &self.table.name;
        format!("machine={name} {with} the tool centre point")
    }

    /// Velocity, acceleration, jerk, shape (3, 9); infinite where there is none.
    pub(crate) fn limits(&self) -> &[Position; 3] {
        &self.limits
    }

    /// How many joints there are.
    pub(crate) fn count(&self) -> usize {
        self.machine.coordinates().joint_count()
    }

    /// The axis that a joint moves, 0 to 8.
    pub(crate) fn axis(&self, joint: usize) -> Option<usize> {
        self.machine.coordinates().axis_of_joint(joint)
    }

    /// The same joints with another limit of jerk. A mm has so many `lengths`.
    pub(crate) fn with_jerk(&self, jerk: Jerk, lengths: f64) -> LimitedJoints {
        let mut joints = self.clone();
        for joint in 0..LIMITED_JOINTS {
            let unit = match self.axis(joint) {
                Some(axis) if !is_rotary(axis) => lengths,
                _ => 1.0,
            };
            let asked = jerk.of_axis(self.limits[1][joint] / unit) * unit;
            joints.limits[2][joint] = infinite_for_none(asked);
        }
        joints
    }

    /// The joints for a position, shape (9); 0 where there is none.
    pub(crate) fn at(&self, position: &Position) -> Position {
        let mut joints = [0.0; JOINT_COUNT];
        self.move_to(&Axes::from(*position), &mut joints);
        std::array::from_fn(|joint| joints[joint])
    }

    /// The same for as many joints as LinuxCNC has. What is no joint stays as it is.
    pub(crate) fn move_to(&self, position: &Axes, joints: &mut [f64; JOINT_COUNT]) {
        self.machine.inverse(position, joints);
    }

    /// The position that the joints stand for.
    pub(crate) fn position(&self, joints: &[f64; JOINT_COUNT]) -> Axes {
        self.machine.forward(joints)
    }

    /// Three derivatives of the joints for a position and its derivatives by the same parameter, all shape (9).
    pub(crate) fn derivatives(&self, position: &Axes, derivatives: &[Axes; 3]) -> [Axes; 3] {
        self.machine.derivatives(position, derivatives).map(|axes| {
            let mut joints = [0.0; JOINT_COUNT];
            self.machine.coordinates().distribute(&axes, &mut joints);
            Axes::from_fn(|joint, _| joints[joint])
        })
    }
}

impl TryFrom<Told> for LimitedJoints {
    type Error = TableError;

    fn try_from(told: Told) -> Result<LimitedJoints, TableError> {
        Ok(LimitedJoints {
            machine: told.table.machine()?,
            table: told.table,
            limits: told.limits,
        })
    }
}

impl From<LimitedJoints> for Told {
    fn from(joints: LimitedJoints) -> Told {
        Told {
            table: joints.table,
            limits: joints.limits,
        }
    }
}

impl Table {
    /// As the pins say before a program asks for anything else.
    fn new(settings: &JointSettings, lengths: f64) -> Table {
        let pin = |name: &str| settings.framekins(name);
        let length = |name: &str| pin(name) * lengths;
        Table {
            name: settings.machine.clone(),
            coordinates: settings.coordinates.clone(),
            rotation_point: ["x-rot-point", "y-rot-point", "z-rot-point"].map(length),
            offset: ["x-offset", "y-offset", "z-offset"].map(length),
            tool_offset: length("tool-offset"),
            conventional: pin("conventional-directions") != 0.0,
            tool_centre_point: settings.tool_centre_point(),
        }
    }

    fn machine(&self) -> Result<Machine, TableError> {
        let (name, coordinates) = (self.name.as_bytes(), self.coordinates.as_bytes());
        let mut machine =
            Machine::configured(name, coordinates).map_err(TableError::Configuration)?;
        let parameters = TableTiltingParameters {
            rotation_point: Vector3::from(self.rotation_point),
            offset: Vector3::from(self.offset),
            tool_offset: self.tool_offset,
            direction: match self.conventional {
                false => RotaryDirection::Table,
                true => RotaryDirection::Conventional,
            },
            tool_centre_point: self.tool_centre_point,
        };
        machine
            .set_parameters(&parameters)
            .map_err(TableError::Dimensions)?;
        Ok(machine)
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
pub(crate) fn tool_tilt_axis(settings: &JointSettings) -> Option<usize> {
    let tilt = own_table(settings)?;
    settings.tool_centre_point().then_some(tilt.axis())
}

fn limits(
    settings: &JointSettings,
    machine: &Machine,
    period: f64,
    lengths: f64,
) -> Result<[Position; 3], JointsError> {
    let mut limits = [[f64::INFINITY; LIMITED_JOINTS]; 3];
    for joint in 0..LIMITED_JOINTS {
        let Some(axis) = machine.coordinates().axis_of_joint(joint) else {
            continue;
        };
        let [velocity, acceleration, jerk] = settings.limits.map(|limits| limits[joint]);
        for (limit, quantity) in [(velocity, "velocity"), (acceleration, "acceleration")] {
            let is_endless = quantity == "acceleration" && limit.is_infinite();
            if limit.is_nan() || limit <= 0.0 || is_endless {
                return Err(JointsError::NotPositive {
                    joint,
                    quantity,
                    limit,
                });
            }
        }
        let jerk = match JerkLimit::new(jerk, acceleration, period) {
            JerkLimit::Limited(jerk) => jerk,
            JerkLimit::Unlimited { .. } => f64::INFINITY,
            JerkLimit::Refused { smallest } => {
                return Err(JointsError::Jerk {
                    joint,
                    limit: jerk,
                    smallest,
                });
            }
        };
        let unit = if is_rotary(axis) { 1.0 } else { lengths };
        for (limits, limit) in limits.iter_mut().zip([velocity, acceleration, jerk]) {
            limits[joint] = limit * unit;
        }
    }
    Ok(limits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::differences::Differences;

    fn joints() -> LimitedJoints {
        let table = Table {
            name: "xyzac".to_owned(),
            coordinates: "XYZAC".to_owned(),
            rotation_point: [10.0, -20.0, 5.0],
            offset: [0.0, 3.0, 40.0],
            tool_offset: 25.0,
            conventional: true,
            tool_centre_point: true,
        };
        LimitedJoints {
            machine: table.machine().expect("a table"),
            table,
            limits: [[100.0; 9], [1000.0; 9], [f64::INFINITY; 9]],
        }
    }

    #[test]
    fn another_process_has_the_same_joints() {
        let bytes = postcard::to_stdvec(&joints()).expect("bytes");
        let back: LimitedJoints = postcard::from_bytes(&bytes).expect("joints");
        assert_eq!(back, joints());
        let place = [1.0, 2.0, 3.0, 30.0, 0.0, 50.0, 0.0, 0.0, 0.0];
        let mut there = [0.0; JOINT_COUNT];
        joints().move_to(&Axes::from(place), &mut there);
        assert!((back.position(&there) - Axes::from(place)).amax() < 1e-12);
    }

    #[test]
    fn derivatives_are_those_of_the_joints() {
        let (joints, period) = (joints(), 1e-3);
        let rate = [5.0, -4.0, 3.0, 20.0, 0.0, -30.0, 0.0, 0.0, 0.0];
        let at = |time: f64| rate.map(|rate| rate * time);
        let mut differences = Differences::new(joints.at(&at(0.0)), period);
        let mut rates = differences.step(&joints.at(&at(period)));
        for cycle in 2..=4 {
            rates = differences.step(&joints.at(&at(f64::from(cycle) * period)));
        }
        let along = [Axes::from(rate), Axes::zeros(), Axes::zeros()];
        let exact = joints.derivatives(&Axes::from(at(4.0 * period)), &along);
        for (found, exact) in rates.orders.iter().zip(&exact).take(2) {
            let off = (Axes::from(*found) - exact).amax();
            assert!(off < 0.1, "{found:?} for {exact}");
        }
    }

    #[test]
    fn jerk_of_another_number() {
        let with = joints().with_jerk(Jerk::Accelerations(20.0), 1.0);
        assert_eq!(with.limits()[2], [20_000.0; 9]);
        let without = with.with_jerk(Jerk::Unlimited, 1.0);
        assert_eq!(without.limits(), joints().limits());
        let inches = with.with_jerk(Jerk::Value(2540.0), 1.0 / 25.4);
        assert_eq!(
            inches.limits()[2][..5],
            [100.0, 100.0, 100.0, 2540.0, 2540.0]
        );
    }
}
