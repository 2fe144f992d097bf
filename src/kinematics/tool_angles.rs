//! Rotary angles that put the tool normal to a frame, for machines with a tilting rotary table.
//!
//! The table turns the workpiece by C and tilts it by A or B, so a direction t of the workpiece
//! comes to R_tilt Rz(C) t. That is to be the machine's Z, along which the tool always stands:
//!
//! ```text
//! A C:  t = Rz(-C) Rx(-A) z = ( sin A sin C,  sin A cos C, cos A)
//! B C:  t = Rz(-C) Ry(-B) z = (-sin B cos C,  sin B sin C, cos B)
//! ```
//!
//! Every direction has two solutions, (tilt, C) and (-tilt, C + 180), each with any number of whole
//! turns; a direction along Z leaves C free.

use nalgebra::Vector3;

use crate::frame::angle::turns_towards;
use crate::machine::table_tilting::{RotaryDirection, TableTilting, TiltAxis};

/// Tool directions closer to Z than this (sine of the angle) leave C where it is.
const VERTICAL_TOLERANCE: f64 = 1e-12;

/// An angle may pass its limit by this much, in degrees: rounding, no motion. The result is then
/// the limit itself.
const LIMIT_TOLERANCE: f64 = 1e-9;

/// Positions of the two rotary axes, degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotaryAngles {
    /// A or B.
    pub tilt: f64,
    /// C.
    pub rotary: f64,
}

/// What a rotary joint can reach, degrees; infinite where it has no limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngleRange {
    /// Smallest angle.
    pub min: f64,
    /// Greatest angle.
    pub max: f64,
}

impl AngleRange {
    /// No limits.
    pub const UNLIMITED: Self = Self {
        min: f64::NEG_INFINITY,
        max: f64::INFINITY,
    };

    /// `angle` plus whole turns, as close to `current` as the range allows; `None` if no turn
    /// brings it into the range.
    fn nearest(&self, angle: f64, current: f64) -> Option<f64> {
        let fewest = ((self.min - LIMIT_TOLERANCE - angle) / 360.0).ceil();
        let most = ((self.max + LIMIT_TOLERANCE - angle) / 360.0).floor();
        let turns = turns_towards(angle, current).max(fewest).min(most);
        let reached = angle + 360.0 * turns;
        (fewest <= most && reached.is_finite()).then_some(self.bounded(reached))
    }

    /// Not `clamp`, which panics when the limits are the wrong way round.
    fn bounded(&self, angle: f64) -> f64 {
        angle.max(self.min).min(self.max)
    }
}

/// Why no rotary angles can be given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OrientationError {
    /// A direction, angle or limit is not a number, or the direction has no length.
    NotFinite,
    /// Limits with the greatest angle below the smallest.
    LimitsReversed,
    /// Both solutions are outside of the joints' limits.
    Unreachable {
        /// One solution, without whole turns.
        first: RotaryAngles,
        /// The other.
        second: RotaryAngles,
    },
}

/// The length of a direction, where something can be made of it and of the angles of now.
pub(super) fn checked_length(
    direction: &Vector3<f64>,
    current: RotaryAngles,
) -> Result<f64, OrientationError> {
    let norm = direction.norm();
    let known = current.tilt.is_finite() && current.rotary.is_finite();
    if norm > 0.0 && norm.is_finite() && known {
        Ok(norm)
    } else {
        Err(OrientationError::NotFinite)
    }
}

/// Both solutions, without whole turns, for a tool along `direction` in coordinates of the
/// workpiece (tip towards spindle, any length above zero); C as it is now where it is free.
///
/// # Errors
///
/// [`OrientationError::NotFinite`].
pub fn solutions(
    machine: &TableTilting,
    direction: &Vector3<f64>,
    current: RotaryAngles,
) -> Result<[RotaryAngles; 2], OrientationError> {
    let norm = checked_length(direction, current)?;
    let sign = match machine.parameters().direction {
        RotaryDirection::Table => 1.0,
        RotaryDirection::Conventional => -1.0,
    };
    let horizontal = direction.x.hypot(direction.y);
    let tilt = horizontal.atan2(direction.z).to_degrees();
    if horizontal <= VERTICAL_TOLERANCE * norm {
        let rotary = current.rotary;
        // Straight up is one solution; straight down is reached from both sides.
        let tilt = if direction.z > 0.0 { 0.0 } else { 180.0 };
        return Ok([tilt, -tilt].map(|tilt| RotaryAngles { tilt, rotary }));
    }
    let rotary = match machine.tilt_axis() {
        TiltAxis::A => direction.x.atan2(direction.y),
        TiltAxis::B => direction.y.atan2(-direction.x),
    }
    .to_degrees();
    Ok(
        [(tilt, rotary), (-tilt, rotary + 180.0)].map(|(tilt, rotary)| RotaryAngles {
            tilt: sign * tilt,
            rotary: sign * rotary,
        }),
    )
}

/// The angles of tilt axis and C that put the tool along `direction` (as in [`solutions`]; for a
/// frame its [`tool_axis`](crate::frame::ActiveFrame::tool_axis)), within the joints' limits and as near
/// as possible to the current ones: the least sum of squares of both changes, and between equals
/// the solution with positive tilt of the table.
///
/// # Errors
///
/// Those of [`solutions`], [`OrientationError::LimitsReversed`], and
/// [`OrientationError::Unreachable`] with the angles that would have been needed.
pub fn tool_angles(
    machine: &TableTilting,
    direction: &Vector3<f64>,
    current: RotaryAngles,
    tilt_range: AngleRange,
    rotary_range: AngleRange,
) -> Result<RotaryAngles, OrientationError> {
    nearest_solution(
        |free| solutions(machine, direction, free),
        current,
        tilt_range,
        rotary_range,
    )
}

/// Of two solutions that `solutions` gives for the angles of now, with the rotary axis within its limits, the one of
/// [`tool_angles`].
pub(super) fn nearest_solution(
    solutions: impl FnOnce(RotaryAngles) -> Result<[RotaryAngles; 2], OrientationError>,
    current: RotaryAngles,
    tilt_range: AngleRange,
    rotary_range: AngleRange,
) -> Result<RotaryAngles, OrientationError> {
    for range in [tilt_range, rotary_range] {
        if range.min.is_nan() || range.max.is_nan() {
            return Err(OrientationError::NotFinite);
        }
        if range.min > range.max {
            return Err(OrientationError::LimitsReversed);
        }
    }
    // Where C is free it need not stand within its limits yet.
    let free = RotaryAngles {
        tilt: current.tilt,
        rotary: rotary_range.bounded(current.rotary),
    };
    let [first, second] = solutions(free)?;
    let reached = |solution: RotaryAngles| {
        Some(RotaryAngles {
            tilt: tilt_range.nearest(solution.tilt, current.tilt)?,
            rotary: rotary_range.nearest(solution.rotary, current.rotary)?,
        })
    };
    let distance = |to: &RotaryAngles| {
        let (tilt, rotary) = (to.tilt - current.tilt, to.rotary - current.rotary);
        tilt * tilt + rotary * rotary
    };
    match (reached(first), reached(second)) {
        (Some(a), Some(b)) if distance(&b) < distance(&a) => Ok(b),
        (Some(a), _) => Ok(a),
        (None, Some(b)) => Ok(b),
        (None, None) => Err(OrientationError::Unreachable { first, second }),
    }
}
