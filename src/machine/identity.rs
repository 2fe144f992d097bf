//! Identity kinematics: every joint is an axis.

use super::coordinates::Coordinates;
use super::joints::JOINT_COUNT;
use crate::axes::Axes;

/// Every joint is an axis, several joints may be the same one (gantries).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identity {
    coordinates: Coordinates,
}

impl Identity {
    /// Joints as the coordinates name them.
    pub fn new(coordinates: Coordinates) -> Self {
        Self { coordinates }
    }

    /// Which joint is which axis.
    pub fn coordinates(&self) -> &Coordinates {
        &self.coordinates
    }

    /// Joint positions for axis positions. Joints that belong to no axis are left as they are.
    #[inline]
    pub fn inverse(&self, axes: &Axes, joints: &mut [f64; JOINT_COUNT]) {
        self.coordinates.distribute(axes, joints);
    }

    /// Axis positions for joint positions, from the first joint of each axis; 0 without a joint.
    #[inline]
    pub fn forward(&self, joints: &[f64; JOINT_COUNT]) -> Axes {
        self.coordinates.collect(joints)
    }
}
