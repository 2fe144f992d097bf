//! How the tool is drawn back, as the pins show it.

use libc::{c_double, c_int};

use nalgebra::Vector3;

use crate::axes::Axes;
use crate::kinematics::control::FrameControl;
use crate::kinematics::inner_normal::angles;
use crate::kinematics::inner_tool::{ToolTurning, Unknown};
use crate::kinematics::retraction::{along_tool, chain_of_table};
use crate::kinematics::{Retraction, RetractionError};
use crate::machine::{JOINT_COUNT, Machine};

/// What the pins show.
#[derive(Clone, Copy)]
pub(super) struct RetractPins {
    /// 0: by Z without the frame; 1: along the way; below 0 a [`RetractionError`].
    pub(super) kind: c_int,
    /// Where the tip goes while the machine's own Z rises by one.
    pub(super) way: [c_double; 3],
    /// Where that Z is.
    pub(super) z: c_double,
}

impl RetractPins {
    /// What is known.
    pub(super) fn new(found: Result<Retraction, RetractionError>) -> Self {
        let (kind, way, z) = match found {
            Ok(Retraction::ByZ) => (0, Vector3::zeros(), 0.0),
            Ok(Retraction::AlongTool { way, z }) => (1, way, z),
            Err(error) => (error as c_int, Vector3::zeros(), 0.0),
        };
        let shown = |value: f64| if value.is_finite() { value } else { 0.0 };
        Self {
            kind,
            way: way.map(shown).into(),
            z: shown(z),
        }
    }

    /// Of a machine of ours.
    pub(super) fn of_machine(machine: &Machine, control: &FrameControl, position: &Axes) -> Self {
        let Machine::TableTilting(table) = machine else {
            return Self::new(Ok(Retraction::ByZ));
        };
        let z_joint = table.coordinates().joint_of_axis(2);
        if !table.parameters().tool_centre_point {
            return Self::new(Ok(Retraction::ByZ));
        }
        let mut joints = [0.0; JOINT_COUNT];
        table.inverse(position, &mut joints);
        let z = z_joint.and_then(|joint| joints.get(joint)).copied();
        let chain = chain_of_table(table);
        let angles = angles(&chain, position);
        Self::new(along_tool(
            &chain,
            angles,
            control.active(),
            z.unwrap_or(0.0),
        ))
    }

    /// Of the kinematics of another module, with what they have answered.
    pub(super) fn of_inner(
        turning: &Result<ToolTurning, Unknown>,
        control: &FrameControl,
        position: &Axes,
        joints: &[f64; JOINT_COUNT],
    ) -> Self {
        let found = match turning {
            Ok(ToolTurning {
                chain: Some(chain),
                z_joint: Some(z_joint),
            }) => {
                let z = joints.get(*z_joint).copied().unwrap_or(0.0);
                along_tool(chain, angles(chain, position), control.active(), z)
            }
            // An arm has no Z that could rise.
            Ok(ToolTurning { chain: Some(_), .. }) | Err(Unknown::NotAsSaid) => {
                Err(RetractionError::UnknownKinematics)
            }
            Err(Unknown::NotFound) if control.behind().turns_tool() => {
                Err(RetractionError::UnknownKinematics)
            }
            Ok(ToolTurning { chain: None, .. }) | Err(Unknown::NotFound) => Ok(Retraction::ByZ),
        };
        Self::new(found)
    }
}
