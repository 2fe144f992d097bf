//! Where the rotary axes of a running machine have to go for the tool to stand normal to the frame.

use nalgebra::Vector3;

use super::behind::Behind;
use super::tool_angles::{AngleRange, OrientationError, RotaryAngles, tool_angles};
use crate::axes::Axes;
use crate::frame::ActiveFrame;
use crate::machine::{Machine, TiltAxis};

/// Sine of the angle up to which a machine without rotary axes stands normal to a frame.
pub(super) const NORMAL_TOLERANCE: f64 = 1e-9;

/// Why the tool cannot be put normal to the frame. The numbers are those of the pin
/// `framekins.normal-refusal`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum ToolNormalError {
    /// The frame is tilted, and the machine has no table that tilts.
    NoRotaryAxes = 1,
    /// The frame would not turn along with the table.
    ToolCentrePointOff = 2,
    /// Both solutions are outside of the limits of the rotary axes.
    Unreachable = 3,
    /// A limit is not a number, or the greatest is below the smallest.
    WrongLimits = 4,
    /// How the kinematics of another module turn the tool is not known.
    UnknownKinematics = 5,
    /// The frame is tilted, and no axis turns the tool with the type that the kinematics of another module have now.
    NothingTurnsTool = 6,
    /// Without a frame the kinematics of another module are not asked how they turn the tool: nobody touches them then.
    NoFrame = 7,
    /// The kinematics of another module turn the tool otherwise than `tool_axes=` says.
    NotAsSaid = 8,
    /// An axis that `tool_axes=` does not name turns the tool of an arm elsewhere.
    ThirdAxis = 9,
}

impl From<OrientationError> for ToolNormalError {
    fn from(error: OrientationError) -> Self {
        match error {
            OrientationError::Unreachable { .. } => Self::Unreachable,
            OrientationError::NotFinite | OrientationError::LimitsReversed => Self::WrongLimits,
        }
    }
}

/// What a rotary axis can reach, for both of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotaryLimits {
    /// Of A or B.
    pub tilt: AngleRange,
    /// Of C.
    pub rotary: AngleRange,
}

/// The angles of the tilting axis and of C, in degrees of the program without work offset (as
/// LinuxCNC's interpreter would see them with all offsets 0), that put the tool normal to the XY
/// plane of the frame: the nearest to `position`, the machine's axes now, within the limits. Without
/// a frame the XY plane of the program counts. `None` if the machine has no such axes and needs
/// none.
///
/// # Errors
///
/// [`ToolNormalError`].
pub fn tool_normal(
    behind: &Behind,
    frame: Option<&ActiveFrame>,
    position: &Axes,
    limits: &RotaryLimits,
) -> Result<Option<RotaryAngles>, ToolNormalError> {
    let machine = behind.machine().ok_or(ToolNormalError::UnknownKinematics)?;
    let direction = frame.map_or_else(Vector3::z, ActiveFrame::tool_axis);
    let Machine::TableTilting(table) = machine else {
        let upright = direction.z > 0.0 && direction.x.hypot(direction.y) <= NORMAL_TOLERANCE;
        return if upright {
            Ok(None)
        } else {
            Err(ToolNormalError::NoRotaryAxes)
        };
    };
    if !table.parameters().tool_centre_point {
        return Err(ToolNormalError::ToolCentrePointOff);
    }
    let now = angles(table.tilt_axis(), position);
    let found = tool_angles(table, &direction, now, limits.tilt, limits.rotary)?;
    // Mirrored rotary axes run the other way round in the program.
    let (a, b) = match table.tilt_axis() {
        TiltAxis::A => (found.tilt, 0.0),
        TiltAxis::B => (0.0, found.tilt),
    };
    let reached = Axes::from([0.0, 0.0, 0.0, a, b, found.rotary, 0.0, 0.0, 0.0]);
    let programmed = frame.map_or(reached, |frame| frame.to_world(&reached));
    Ok(Some(angles(table.tilt_axis(), &programmed)))
}

/// The rotary axes among the nine.
fn angles(tilt_axis: TiltAxis, axes: &Axes) -> RotaryAngles {
    let [_, _, _, a, b, rotary, ..]: [f64; 9] = (*axes).into();
    let tilt = match tilt_axis {
        TiltAxis::A => a,
        TiltAxis::B => b,
    };
    RotaryAngles { tilt, rotary }
}
