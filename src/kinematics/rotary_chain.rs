//! How two rotary axes of any machine turn the tool: those of a table, of a head, or one of each.
//!
//! Seen from the workpiece one of them turns about a line that stands still, and carries the other, which carries the tool:
//!
//! ```text
//! t = R(rotary) R(tilt) z
//! ```
//!
//! is the direction from the tip towards the spindle. A tilting table has C as the rotary axis and A or B as the tilt, the axes
//! reversed; a head on C and B has the same order. Where the lines lie matters no more than how long the tool is.

use nalgebra::{Rotation3, Unit, Vector3};

use super::tool_angles::{OrientationError, RotaryAngles, checked_length};

/// Directions closer to the line of the rotary axis than this (sine of the angle) leave it where it is.
const AXIAL_TOLERANCE: f64 = 1e-12;
/// How far (sine of the angle) a direction may be from what is reached: rounding.
const REACHED: f64 = 1e-9;

/// How far (of a unit vector) lines may be from upright and square.
const SQUARE: f64 = 1e-6;

/// A rotary axis as the workpiece sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotaryAxis {
    /// 0, 1, 2: A, B, C.
    pub letter: usize,
    /// The line that a positive angle turns the tool about, right-handed, while the other axis is at 0.
    pub line: Unit<Vector3<f64>>,
    /// Whether it turns the tool, and not the workpiece.
    pub is_of_head: bool,
}

impl RotaryAxis {
    /// A vector turned by this axis, degrees.
    pub fn turned(&self, angle: f64, vector: &Vector3<f64>) -> Vector3<f64> {
        Rotation3::from_axis_angle(&self.line, angle.to_radians()) * vector
    }
}

/// The axes that turn the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotaryChain {
    /// The one that carries the other; `None` if there is one only.
    pub rotary: Option<RotaryAxis>,
    /// The one that carries the tool.
    pub tilt: RotaryAxis,
}

impl RotaryChain {
    /// The axis, 3 for A or 4 for B, that tilts the tool square to Z while C turns what is tilted about Z; `None` where the axes
    /// are others.
    pub fn tilt_axis_below_c(&self) -> Option<usize> {
        let rotary = self.rotary?;
        let is_upright = rotary.letter == 2 && rotary.line.z.abs() > 1.0 - SQUARE;
        let is_square = self.tilt.letter < 2 && self.tilt.line.z.abs() < SQUARE;
        (is_upright && is_square).then_some(3 + self.tilt.letter)
    }

    /// Where the tool points.
    pub fn direction(&self, angles: RotaryAngles) -> Vector3<f64> {
        let tilted = self.tilt.turned(angles.tilt, &Vector3::z());
        self.rotary
            .map_or(tilted, |rotary| rotary.turned(angles.rotary, &tilted))
    }

    /// Where the tool points in the machine, while [`Self::direction`] is what the workpiece sees.
    pub fn direction_in_machine(&self, angles: RotaryAngles) -> Vector3<f64> {
        let turned = |axis: &RotaryAxis, angle, tool: Vector3<f64>| match axis.is_of_head {
            true => axis.turned(angle, &tool),
            false => tool,
        };
        let tilted = turned(&self.tilt, angles.tilt, Vector3::z());
        self.rotary
            .map_or(tilted, |rotary| turned(&rotary, angles.rotary, tilted))
    }

    /// Both solutions, without whole turns, for a tool along `direction` in coordinates of the workpiece (any length above
    /// zero); the rotary axis as it is now where it is free. With one axis, or at the end of what can be reached, they are
    /// the same.
    ///
    /// # Errors
    ///
    /// [`OrientationError::NotFinite`]; [`OrientationError::Unreachable`] with the nearest angles.
    pub fn solutions(
        &self,
        direction: &Vector3<f64>,
        current: RotaryAngles,
    ) -> Result<[RotaryAngles; 2], OrientationError> {
        let wanted = direction / checked_length(direction, current)?;
        let tilts = match self.rotary {
            Some(rotary) => self.tilts(&rotary, &wanted),
            None => {
                let tilt = angle_about(&self.tilt.line, &Vector3::z(), &wanted).unwrap_or(0.0);
                [tilt, tilt]
            }
        };
        let [first, second] =
            tilts.map(|tilt| self.refined(&wanted, self.with(tilt, &wanted, current)));
        if [first, second]
            .iter()
            .any(|found| !self.reaches(&wanted, *found))
        {
            return Err(OrientationError::Unreachable { first, second });
        }
        Ok([first, second])
    }

    fn reaches(&self, wanted: &Vector3<f64>, angles: RotaryAngles) -> bool {
        (self.direction(angles) - wanted).norm() <= REACHED
    }

    /// The angles of the tilt at which the tool is as far along the line of the rotary axis as it is to be.
    fn tilts(&self, rotary: &RotaryAxis, wanted: &Vector3<f64>) -> [f64; 2] {
        let (line, tilt, z) = (*rotary.line, *self.tilt.line, Vector3::z());
        let constant = tilt.z * line.dot(&tilt);
        let (cosine, sine) = (line.z - constant, line.dot(&tilt.cross(&z)));
        let share = (line.dot(wanted) - constant) / cosine.hypot(sine);
        let middle = sine.atan2(cosine);
        let spread = share.clamp(-1.0, 1.0).acos();
        [middle + spread, middle - spread].map(|tilt| {
            let degrees = tilt.to_degrees();
            degrees - 360.0 * (degrees / 360.0).round()
        })
    }

    /// With the angle of the rotary axis that belongs to a tilt, degrees.
    fn with(&self, tilt: f64, wanted: &Vector3<f64>, current: RotaryAngles) -> RotaryAngles {
        let tilted = self.tilt.turned(tilt, &Vector3::z());
        let turn = self
            .rotary
            .and_then(|rotary| angle_about(&rotary.line, &tilted, wanted));
        RotaryAngles {
            tilt,
            rotary: turn.unwrap_or(current.rotary),
        }
    }

    /// One step towards the direction: the cosine of a small angle says little of it.
    fn refined(&self, wanted: &Vector3<f64>, angles: RotaryAngles) -> RotaryAngles {
        let reached = self.direction(angles);
        let tilt_line = self.rotary.map_or(*self.tilt.line, |rotary| {
            rotary.turned(angles.rotary, &self.tilt.line)
        });
        // Square to what is reached: it says as much of what is wanted as of what is missed.
        let by_tilt = tilt_line.cross(&reached);
        let step = wanted.dot(&by_tilt) / by_tilt.norm_squared();
        if step.is_finite() && step.abs() < REACHED.sqrt() {
            RotaryAngles {
                tilt: angles.tilt + step.to_degrees(),
                ..angles
            }
        } else {
            angles
        }
    }
}

/// The angle about a line, degrees, that turns one direction over another, seen along the line; `None` where one of them is
/// along it.
pub fn angle_about(
    line: &Unit<Vector3<f64>>,
    from: &Vector3<f64>,
    to: &Vector3<f64>,
) -> Option<f64> {
    let across = |vector: &Vector3<f64>| vector - line.as_ref() * line.dot(vector);
    let (from, to) = (across(from), across(to));
    let known = from.norm() > AXIAL_TOLERANCE && to.norm() > AXIAL_TOLERANCE;
    known.then(|| line.dot(&from.cross(&to)).atan2(from.dot(&to)).to_degrees())
}
