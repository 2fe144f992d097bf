//! Five-axis mills with a tilting rotary table: X Y Z with A C, or with B C.
//!
//! # Derivation
//!
//! The machine is what LinuxCNC calls `xyzac-trt-kins` and `xyzbc-trt-kins`. With all rotary axes
//! at 0, let r be the point of the rotary axis C (parallel to Z) at table height
//! (`rotation_point`), and r + o a point of the tilting axis (parallel to X for A, to Y for B; o is
//! `offset`). The tool stands along Z, and LinuxCNC's positions hold its length h:
//! tip = position - h z.
//!
//! A tip q, fixed to the workpiece, is first turned by the rotary axis about r, then with the whole
//! rotary table by the tilting axis about r + o:
//!
//! ```text
//! tip of the joints = r + o + R_tilt ( r + Rz(C) (q - r) - (r + o) )
//!                   = r + o + R_tilt ( Rz(C) (q - r) - o )
//! ```
//!
//! Put q = p - h z and add h z on the left: Rz leaves h z alone, so it only lengthens o. With
//! d = o + h z
//!
//! ```text
//! joints = r + d + R_tilt ( Rz(C) (p - r) - d )
//! p      = r + Rz(-C) ( d + R_tilt^-1 (joints - r - d) )
//! ```
//!
//! The part of o along the tilting axis cancels, as it should.

use nalgebra::Vector3;

use super::coordinates::{Coordinates, CoordinatesError};
use super::joints::JOINT_COUNT;
use crate::axes::Axes;
use crate::frame::FrameError;
use crate::frame::angle::sin_cos_degrees;
use crate::frame::operation::check_translation;

/// Which axis tilts the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TiltAxis {
    /// About X (`xyzac-trt-kins`).
    A,
    /// About Y (`xyzbc-trt-kins`).
    B,
}

impl TiltAxis {
    /// Its number: 3 for A, 4 for B.
    pub fn axis(self) -> usize {
        match self {
            Self::A => 3,
            Self::B => 4,
        }
    }
}

/// Which way a positive angle turns the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RotaryDirection {
    /// The table turns right-handed about +X, +Y, +Z: LinuxCNC 2.9, and later unless told
    /// otherwise.
    #[default]
    Table,
    /// The tool turns right-handed relative to the workpiece, so the table the other way round:
    /// the pin `conventional-directions` of later versions.
    Conventional,
}

/// Dimensions of the machine, named as the pins of LinuxCNC's kinematics.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TableTiltingParameters {
    /// `x-rot-point`, `y-rot-point`, `z-rot-point`: where the rotary axis is, machine units.
    pub rotation_point: Vector3<f64>,
    /// `x-offset`, `y-offset`, `z-offset`: from there to the tilting axis, machine units. The part
    /// along the tilting axis has no effect.
    pub offset: Vector3<f64>,
    /// `tool-offset`: length of the tool along Z that LinuxCNC has in its positions, machine units
    /// (`motion.tooloffset.z`).
    pub tool_offset: f64,
    /// `conventional-directions`.
    pub direction: RotaryDirection,
    /// Whether X Y Z are the tool centre point on the turning workpiece; otherwise every joint is
    /// an axis.
    pub tool_centre_point: bool,
}

/// A mill with a tilting rotary table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableTilting {
    coordinates: Coordinates,
    tilt_axis: TiltAxis,
    parameters: TableTiltingParameters,
}

impl TableTilting {
    /// All dimensions 0 and the tool centre point off until [`Self::set_parameters`].
    ///
    /// # Errors
    ///
    /// [`CoordinatesError::MissingAxis`] unless X, Y, Z, C and the tilting axis are named.
    pub fn new(tilt_axis: TiltAxis, coordinates: Coordinates) -> Result<Self, CoordinatesError> {
        coordinates.require(&[0, 1, 2, tilt_axis.axis(), 5])?;
        Ok(Self {
            coordinates,
            tilt_axis,
            parameters: TableTiltingParameters::default(),
        })
    }

    /// Takes over dimensions, all at once or, if one is refused, none of them.
    ///
    /// Joints follow at once where the table is turned, so this is for a machine at rest.
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`], [`FrameError::TranslationTooLarge`].
    pub fn set_parameters(&mut self, parameters: TableTiltingParameters) -> Result<(), FrameError> {
        check_translation(parameters.rotation_point.iter())?;
        check_translation(parameters.offset.iter())?;
        check_translation([0.0, 0.0, parameters.tool_offset].iter())?;
        self.parameters = parameters;
        Ok(())
    }

    /// The dimensions in force.
    pub fn parameters(&self) -> &TableTiltingParameters {
        &self.parameters
    }

    /// Which axis tilts.
    pub fn tilt_axis(&self) -> TiltAxis {
        self.tilt_axis
    }

    /// Which joint is which axis.
    pub fn coordinates(&self) -> &Coordinates {
        &self.coordinates
    }

    /// Joint positions for axis positions. Joints that belong to no axis are left as they are.
    #[inline]
    pub fn inverse(&self, axes: &Axes, joints: &mut [f64; JOINT_COUNT]) {
        let axes = if self.parameters.tool_centre_point {
            self.change_point(axes, |point, turn| {
                let (r, d) = (self.parameters.rotation_point, self.pivot());
                r + d + turn.tilt(&(turn.rotate(&(point - r)) - d))
            })
        } else {
            *axes
        };
        self.coordinates.distribute(&axes, joints);
    }

    /// Axis positions for joint positions, from the first joint of each axis; 0 without a joint.
    #[inline]
    pub fn forward(&self, joints: &[f64; JOINT_COUNT]) -> Axes {
        let axes = self.coordinates.collect(joints);
        if !self.parameters.tool_centre_point {
            return axes;
        }
        self.change_point(&axes, |point, turn| {
            let (r, d) = (self.parameters.rotation_point, self.pivot());
            let back = turn.reversed();
            r + back.rotate(&(d + back.tilt(&(point - r - d))))
        })
    }

    /// d: from the rotation point to the tilting axis, lengthened by the tool.
    #[inline]
    pub(super) fn pivot(&self) -> Vector3<f64> {
        self.parameters.offset + Vector3::new(0.0, 0.0, self.parameters.tool_offset)
    }

    /// X Y Z changed, the rest passed through.
    #[inline]
    fn change_point(
        &self,
        axes: &Axes,
        change: impl Fn(Vector3<f64>, TableTurn) -> Vector3<f64>,
    ) -> Axes {
        let [x, y, z, a, b, c, u, v, w]: [f64; 9] = (*axes).into();
        let tilt = match self.tilt_axis {
            TiltAxis::A => a,
            TiltAxis::B => b,
        };
        let turn = TableTurn::new(self.tilt_axis, tilt, c, self.parameters.direction);
        let point = change(Vector3::new(x, y, z), turn);
        Axes::from([point.x, point.y, point.z, a, b, c, u, v, w])
    }
}

/// Sines and cosines of the table's two angles.
#[derive(Clone, Copy)]
struct TableTurn {
    tilt_axis: TiltAxis,
    sin_tilt: f64,
    cos_tilt: f64,
    sin_rotary: f64,
    cos_rotary: f64,
}

impl TableTurn {
    /// Angles in degrees.
    #[inline]
    fn new(tilt_axis: TiltAxis, tilt: f64, rotary: f64, direction: RotaryDirection) -> Self {
        let (sin_tilt, cos_tilt) = sin_cos_degrees(tilt);
        let (sin_rotary, cos_rotary) = sin_cos_degrees(rotary);
        let turn = Self {
            tilt_axis,
            sin_tilt,
            cos_tilt,
            sin_rotary,
            cos_rotary,
        };
        match direction {
            RotaryDirection::Table => turn,
            RotaryDirection::Conventional => turn.reversed(),
        }
    }

    #[inline]
    fn reversed(self) -> Self {
        Self {
            sin_tilt: -self.sin_tilt,
            sin_rotary: -self.sin_rotary,
            ..self
        }
    }

    /// By the rotary axis, about Z.
    #[inline]
    fn rotate(&self, v: &Vector3<f64>) -> Vector3<f64> {
        let (s, c) = (self.sin_rotary, self.cos_rotary);
        Vector3::new(c * v.x - s * v.y, s * v.x + c * v.y, v.z)
    }

    /// By the tilting axis, about X or Y.
    #[inline]
    fn tilt(&self, v: &Vector3<f64>) -> Vector3<f64> {
        let (s, c) = (self.sin_tilt, self.cos_tilt);
        match self.tilt_axis {
            TiltAxis::A => Vector3::new(v.x, c * v.y - s * v.z, s * v.y + c * v.z),
            TiltAxis::B => Vector3::new(c * v.x + s * v.z, v.y, c * v.z - s * v.x),
        }
    }
}
