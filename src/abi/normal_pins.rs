//! Where the rotary axes have to go for the tool to stand normal to the frame, as the pins show it.

use libc::{c_double, c_int};

use crate::axes::Axes;
use crate::kinematics::control::FrameControl;
use crate::kinematics::{
    RotaryAngles, RotaryChain, RotaryLimits, ToolNormalError, inner_normal, tool_normal,
};
use crate::machine::{Machine, TiltAxis};

/// What the pins show.
#[derive(Clone, Copy)]
pub(super) struct NormalPins {
    pub(super) refusal: c_int,
    pub(super) tilt: c_double,
    pub(super) rotary: c_double,
    /// 1, 2, 3: A, B, C; 0: no such axis.
    pub(super) axes: [c_int; 2],
}

impl NormalPins {
    /// Why there are none.
    pub(super) const fn refused(error: ToolNormalError) -> Self {
        Self {
            refusal: error as c_int,
            tilt: 0.0,
            rotary: 0.0,
            axes: [0; 2],
        }
    }

    fn new(found: Result<Option<RotaryAngles>, ToolNormalError>, axes: [c_int; 2]) -> Self {
        let (angles, refusal) = match found {
            Ok(angles) => (angles, 0),
            Err(error) => (None, error as c_int),
        };
        Self {
            refusal,
            tilt: angles.map_or(0.0, |angles| angles.tilt),
            rotary: angles.map_or(0.0, |angles| angles.rotary),
            axes,
        }
    }

    /// Of a machine of ours.
    pub(super) fn of_machine(
        machine: &Machine,
        control: &FrameControl,
        limits: &RotaryLimits,
        position: &Axes,
    ) -> Self {
        let axes = match machine {
            Machine::TableTilting(table) => match table.tilt_axis() {
                TiltAxis::A => [1, 3],
                TiltAxis::B => [2, 3],
            },
            Machine::Identity(_) => [0; 2],
        };
        let (behind, frame) = (control.behind(), control.active());
        Self::new(tool_normal(behind, frame, position, limits), axes)
    }

    /// Of axes that turn the tool in a way that is known.
    pub(super) fn of_chain(
        chain: Option<&RotaryChain>,
        control: &FrameControl,
        limits: &RotaryLimits,
        position: &Axes,
    ) -> Self {
        let number = |letter: usize| 1 + letter as c_int;
        let tilt = chain.map_or(0, |chain| number(chain.tilt.letter));
        let rotary = chain.and_then(|chain| chain.rotary);
        let axes = [tilt, rotary.map_or(0, |rotary| number(rotary.letter))];
        Self::new(
            inner_normal(chain, control.active(), position, limits),
            axes,
        )
    }
}
