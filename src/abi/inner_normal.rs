//! How the kinematics of another module turn the tool, asked when the machine has come to rest.

use libc::c_int;

use super::frame_pins::{framepath_frame_inputs, limits_of};
use super::inner::{Calls, InnerModule};
use super::normal_pins::NormalPins;
use crate::axes::{AXIS_COUNT, Axes};
use crate::kinematics::control::FrameControl;
use crate::kinematics::inner_tool::{Unknown, rotary_chain};
use crate::kinematics::{RotaryChain, ToolNormalError};
use crate::machine::JOINT_COUNT;

/// How the tool is turned with a frame and a type of the kinematics: another module is asked dozens of times, which is done
/// once, when the machine stands in a new frame. Without one nobody touches it: some remember where they were asked last.
pub(super) struct AskedNormal {
    /// motion's number for the frame and the type.
    question: Option<c_int>,
    chain: Result<Option<RotaryChain>, Unknown>,
}

impl AskedNormal {
    pub(super) const NONE: Self = Self {
        question: None,
        chain: Err(Unknown),
    };

    /// In each period.
    pub(super) fn update(
        &mut self,
        control: &FrameControl,
        pins: &framepath_frame_inputs,
        position: &[f64; AXIS_COUNT],
        joints: &[f64; JOINT_COUNT],
        inner: &InnerModule,
        slot: c_int,
    ) -> NormalPins {
        let axes = Axes::from(*position);
        let limits = limits_of(pins);
        if let Some(machine) = control.behind().machine() {
            return NormalPins::of_machine(machine, control, &limits, &axes);
        }
        if control.active().is_none() {
            *self = Self::NONE;
            return NormalPins::refused(ToolNormalError::NoFrame);
        }
        let question = Some(control.behind().number(slot));
        let stands = pins.in_position != 0 && pins.enabled != 0;
        if stands && axes.iter().all(|value| value.is_finite()) && question != self.question {
            self.question = question;
            let mut calls = Calls {
                module: *inner,
                forward_flags: 0,
                inverse_flags: 0,
            };
            self.chain = rotary_chain(&mut calls, &axes, joints);
        }
        match &self.chain {
            Ok(chain) => NormalPins::of_chain(chain.as_ref(), control, &limits, &axes),
            Err(Unknown) => NormalPins::refused(ToolNormalError::UnknownKinematics),
        }
    }
}
