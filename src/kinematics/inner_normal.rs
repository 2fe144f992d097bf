//! Where the rotary axes of another module's kinematics have to go for the tool to stand normal to the frame.

use nalgebra::Vector3;

use super::rotary_chain::RotaryChain;
use super::tool_angles::{RotaryAngles, nearest_solution};
use super::tool_normal::{NORMAL_TOLERANCE, RotaryLimits, ToolNormalError};
use crate::axes::Axes;
use crate::frame::ActiveFrame;

/// The place of A among the axes.
pub(super) const A: usize = 3;

/// As [`super::tool_normal()`] for axes of which is known how they turn the tool, `None` if none does; `position` are the axes
/// of the machine now.
///
/// # Errors
///
/// [`ToolNormalError`].
pub fn inner_normal(
    chain: Option<&RotaryChain>,
    frame: Option<&ActiveFrame>,
    position: &Axes,
    limits: &RotaryLimits,
) -> Result<Option<RotaryAngles>, ToolNormalError> {
    let direction = frame.map_or_else(Vector3::z, ActiveFrame::tool_axis);
    let Some(chain) = chain else {
        let upright = direction.z > 0.0 && direction.x.hypot(direction.y) <= NORMAL_TOLERANCE;
        return upright
            .then_some(None)
            .ok_or(ToolNormalError::NothingTurnsTool);
    };
    let now = angles(chain, position);
    let solutions = |current| chain.solutions(&direction, current);
    let found = nearest_solution(solutions, now, limits.tilt, limits.rotary)?;
    let mut reached = *position;
    set(&mut reached, chain.tilt.letter, found.tilt);
    if let Some(rotary) = chain.rotary {
        set(&mut reached, rotary.letter, found.rotary);
    }
    // Mirrored rotary axes run the other way round in the program.
    let programmed = frame.map_or(reached, |frame| frame.to_world(&reached));
    Ok(Some(angles(chain, &programmed)))
}

/// Where the axes are that turn the tool.
pub fn angles(chain: &RotaryChain, axes: &Axes) -> RotaryAngles {
    let angle = |letter: usize| axes.get(A + letter).copied().unwrap_or(0.0);
    RotaryAngles {
        tilt: angle(chain.tilt.letter),
        rotary: chain.rotary.map_or(0.0, |rotary| angle(rotary.letter)),
    }
}

fn set(axes: &mut Axes, letter: usize, angle: f64) {
    if let Some(value) = axes.get_mut(A + letter) {
        *value = angle;
    }
}
