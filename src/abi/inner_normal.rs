//! How the kinematics of another module turn the tool, asked when the machine has come to rest.

use libc::c_int;

use super::frame_pins::{framepath_frame_inputs, limits_of};
use super::inner::{Calls, InnerModule};
use super::normal_pins::NormalPins;
use crate::axes::{AXIS_COUNT, Axes};
use crate::kinematics::ToolNormalError;
use crate::kinematics::control::FrameControl;
use crate::kinematics::inner_tool::rotary_chain;
use crate::machine::JOINT_COUNT;

/// What was answered last, and to which question: another module is asked dozens of times, which is done once, when the machine
/// has come to rest in a frame. Without one nobody touches it: some remember where they were asked last.
pub(super) struct AskedNormal {
    question: Option<([f64; AXIS_COUNT], c_int, [[f64; 2]; 2])>,
    answer: NormalPins,
}

impl AskedNormal {
    pub(super) const NONE: Self = Self {
        question: None,
        answer: NormalPins::refused(ToolNormalError::NoFrame),
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
        if let Some(machine) = control.behind().machine() {
            return NormalPins::of_machine(machine, control, &limits_of(pins), &axes);
        }
        if control.active().is_none() {
            *self = Self::NONE;
            return self.answer;
        }
        let number = control.behind().number(slot);
        let question = Some((*position, number, [pins.tilt_range, pins.rotary_range]));
        let stands = pins.in_position != 0 && pins.enabled != 0;
        if stands && axes.iter().all(|value| value.is_finite()) && question != self.question {
            self.question = question;
            let mut calls = Calls {
                module: *inner,
                forward_flags: 0,
                inverse_flags: 0,
            };
            self.answer = match rotary_chain(&mut calls, &axes, joints) {
                Ok(chain) => NormalPins::of_chain(chain.as_ref(), control, &limits_of(pins), &axes),
                Err(_) => NormalPins::refused(ToolNormalError::UnknownKinematics),
            };
        }
        self.answer
    }
}
