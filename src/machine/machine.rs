//! One type for all machines, chosen once.

use super::coordinates::Coordinates;
use super::identity::Identity;
use super::joints::JOINT_COUNT;
use super::table_tilting::{TableTilting, TableTiltingParameters};
use crate::axes::Axes;
use crate::frame::FrameError;

/// One of the kinematics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Machine {
    /// Every joint is an axis.
    Identity(Identity),
    /// Five axes, the workpiece on a tilting rotary table.
    TableTilting(TableTilting),
}

impl Machine {
    /// Joint positions for axis positions. Joints that belong to no axis are left as they are.
    #[inline]
    pub fn inverse(&self, axes: &Axes, joints: &mut [f64; JOINT_COUNT]) {
        match self {
            Self::Identity(machine) => machine.inverse(axes, joints),
            Self::TableTilting(machine) => machine.inverse(axes, joints),
        }
    }

    /// Axis positions for joint positions. Axes without a joint are 0.
    #[inline]
    pub fn forward(&self, joints: &[f64; JOINT_COUNT]) -> Axes {
        match self {
            Self::Identity(machine) => machine.forward(joints),
            Self::TableTilting(machine) => machine.forward(joints),
        }
    }

    /// Three derivatives of the joints' axes, shape (9), for a position of the axes and its derivatives by the same
    /// parameter: what [`Self::inverse`] does to them, exactly.
    #[inline]
    pub fn derivatives(&self, position: &Axes, derivatives: &[Axes; 3]) -> [Axes; 3] {
        match self {
            Self::Identity(_) => *derivatives,
            Self::TableTilting(machine) => machine.derivatives(position, derivatives),
        }
    }

    /// The same of the joints 0 to 8 themselves; 0 for what is no joint.
    #[inline]
    pub fn joint_derivatives(&self, position: &Axes, derivatives: &[Axes; 3]) -> [Axes; 3] {
        self.coordinates()
            .first_joints(&self.derivatives(position, derivatives))
    }

    /// Which joint is which axis.
    pub fn coordinates(&self) -> &Coordinates {
        match self {
            Self::Identity(machine) => machine.coordinates(),
            Self::TableTilting(machine) => machine.coordinates(),
        }
    }

    /// Whether X Y Z are the tool centre point on a workpiece that turns.
    #[inline]
    pub fn tool_centre_point(&self) -> bool {
        match self {
            Self::Identity(_) => false,
            Self::TableTilting(machine) => machine.parameters().tool_centre_point,
        }
    }

    /// The axis that tilts the tool against the workpiece while C turns it, 3 for A, 4 for B, where X Y Z are those of its
    /// tip.
    pub fn tool_tilt_axis(&self) -> Option<usize> {
        match self {
            Self::TableTilting(machine) if machine.parameters().tool_centre_point => {
                Some(machine.tilt_axis().axis())
            }
            Self::TableTilting(_) | Self::Identity(_) => None,
        }
    }

    /// Takes over the dimensions of a tilting table, all at once or, if one is refused, none of
    /// them; a machine without a table has none and takes nothing. Joints follow at once where the
    /// table is turned, so this is for a machine at rest.
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`], [`FrameError::TranslationTooLarge`].
    pub fn set_parameters(&mut self, table: &TableTiltingParameters) -> Result<(), FrameError> {
        match self {
            Self::Identity(_) => Ok(()),
            Self::TableTilting(machine) => machine.set_parameters(*table),
        }
    }
}
