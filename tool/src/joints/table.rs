//! The tilting tables of framekins, as the planner asks them here.

use crate::wiring::joints::JointSettings;
use framepath::frame::FrameError;
use framepath::machine::{
    ConfigurationError, Machine, RotaryDirection, TableTiltingParameters, TiltAxis,
};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

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
