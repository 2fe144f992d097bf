//! The tilting tables of framekins, as the planner asks them here.

use crate::wiring::joints::JointSettings;
use framepath::axes::Axes;
use framepath::frame::FrameError;
use framepath::machine::{
    ConfigurationError, Machine, RotaryDirection, TableTiltingParameters, TiltAxis,
};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::sync::{Arc, PoisonError, RwLock};

/// A table as the parameters and pins of framekins describe it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Table {
    /// `machine=`.
    pub name: String,
    pub coordinates: String,
    /// The point of rotation, the way from there to the axis that tilts, the length of the tool; units of length.
    pub rotation_point: [f64; 3],
    pub offset: [f64; 3],
    pub tool_offset: f64,
    pub conventional: bool,
    pub tool_centre_point: bool,
    /// Whether HAL hands it the length of the tool in force.
    pub takes_tool_length: bool,
}

/// The machine that it makes with the tool in force: of all copies the same.
#[derive(Clone, Debug)]
pub(super) struct TableMachine(Arc<RwLock<Machine>>);

impl PartialEq for TableMachine {
    fn eq(&self, other: &TableMachine) -> bool {
        self.now() == other.now()
    }
}

impl TableMachine {
    pub(super) fn new(machine: Machine) -> TableMachine {
        TableMachine(Arc::new(RwLock::new(machine)))
    }

    pub(super) fn now(&self) -> Machine {
        *self.0.read().unwrap_or_else(PoisonError::into_inner)
    }

    /// See [`super::LimitedJoints::derivatives`].
    pub(super) fn derivatives(&self, position: &Axes, derivatives: &[Axes; 3]) -> [Axes; 3] {
        let machine = self.0.read().unwrap_or_else(PoisonError::into_inner);
        machine.joint_derivatives(position, derivatives)
    }

    /// Whether it is a machine with a tool of this length.
    pub(super) fn set_tool_length(&self, table: &Table, length: f64) -> bool {
        let with_tool = Table {
            tool_offset: length,
            ..table.clone()
        };
        let machine = with_tool.machine();
        if let Ok(machine) = machine {
            *self.0.write().unwrap_or_else(PoisonError::into_inner) = machine;
        }
        machine.is_ok()
    }
}

/// Why a table is none of ours.
#[derive(Clone, Copy, Debug, thiserror::Error)]
pub(super) enum TableError {
    #[error("framekins refuses it: {0:?}")]
    Configuration(ConfigurationError),
    #[error("framekins refuses the table: {0:?}")]
    Dimensions(FrameError),
}

impl Table {
    /// For the reader.
    pub(super) fn told(&self) -> String {
        let with = if self.tool_centre_point {
            "with"
        } else {
            "without"
        };
        format!("machine={} {with} the tool centre point", self.name)
    }

    /// As the pins say before a program asks for anything else.
    pub(super) fn new(settings: &JointSettings, lengths: f64) -> Table {
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
            takes_tool_length: settings
                .tool_length_pins()
                .contains(&"framekins.tool-offset".to_owned()),
        }
    }

    pub(super) fn machine(&self) -> Result<Machine, TableError> {
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
pub(super) fn own_table(settings: &JointSettings) -> Option<TiltAxis> {
    match (settings.kinematics.as_str(), settings.machine.as_str()) {
        ("framekins", "xyzac") => Some(TiltAxis::A),
        ("framekins", "xyzbc") => Some(TiltAxis::B),
        _ => None,
    }
}
