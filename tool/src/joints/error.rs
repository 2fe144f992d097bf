//! Why limits of joints cannot be used.

use super::module::KinematicsRefused;
use crate::machine::IniError;
use std::path::PathBuf;

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
    /// --kinematics-type for a machine of which that is not known.
    #[error(
        "--kinematics-type: the HAL files of {} set no limits of joints (blendtp.joint.*) behind a kinematics module of \
         several types",
        .0.display()
    )]
    NoTypes(PathBuf),
    /// --kinematics-type is none of the module's.
    #[error("--kinematics-type {kind}: {why}")]
    NoType {
        /// What was asked for.
        kind: i32,
        /// What the module makes of it.
        why: String,
    },
    /// A kinematics module with which blendtp refuses every move.
    #[error(
        "limits of joints (blendtp.joint.*) behind {kinematics}, with which blendtp refuses every move: {why}"
    )]
    Module {
        /// Its name.
        kinematics: String,
        /// What blendtp says.
        why: KinematicsRefused,
    },
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
