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
/// once, when the machine stands in a new frame or with another type, and again at each rest while it is not known. Without
/// a frame nobody touches it unless blendtp asks, which then asks for joints itself: some remember where they were asked
/// last.
pub(super) struct AskedNormal {
    /// motion's number for the frame and the type.
    question: Option<c_int>,
    chain: Result<Option<RotaryChain>, Unknown>,
    /// The type of the kinematics that the chain belongs to.
    inner_type: c_int,
    /// Whether blendtp wants to know without a frame, too.
    planner_asks: bool,
    /// Whether the machine stood in the last period, and whether it had come to rest since it was asked.
    stands: bool,
    rested: bool,
    /// motion's slot in the last period.
    slot: c_int,
}

impl AskedNormal {
    pub(super) const NONE: Self = Self {
        question: None,
        chain: Err(Unknown),
        inner_type: 0,
        planner_asks: false,
        stands: false,
        rested: false,
        slot: 0,
    };

    /// The axis that tilts the tool while C turns it, 3 for A, 4 for B, for blendtp before it adds a move, as far as it is known.
    pub(super) fn tool_tilt_axis(
        &mut self,
        control: &FrameControl,
        position: &[f64; AXIS_COUNT],
        joints: &[f64; JOINT_COUNT],
        inner: &InnerModule,
    ) -> Option<usize> {
        self.planner_asks = true;
        self.ask(control, &Axes::from(*position), joints, inner);
        let is_of_this_type = self.inner_type == control.behind().inner_type();
        let chain = self.chain.as_ref().ok()?.as_ref()?;
        chain.tilt_axis_below_c().filter(|_| is_of_this_type)
    }

    /// Asks the other module, if the machine stands and something is open.
    fn ask(
        &mut self,
        control: &FrameControl,
        axes: &Axes,
        joints: &[f64; JOINT_COUNT],
        inner: &InnerModule,
    ) {
        let question = Some(control.behind().number(self.slot));
        let is_open = question != self.question || (self.rested && self.chain.is_err());
        if !(self.stands && is_open && axes.iter().all(|value| value.is_finite())) {
            return;
        }
        self.rested = false;
        self.question = question;
        self.inner_type = control.behind().inner_type();
        let mut calls = Calls {
            module: *inner,
            forward_flags: 0,
            inverse_flags: 0,
        };
        self.chain = rotary_chain(&mut calls, axes, joints);
    }

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
        let stands = pins.in_position != 0 && pins.enabled != 0;
        self.rested |= stands && !self.stands;
        (self.stands, self.slot) = (stands, slot);
        let has_frame = control.active().is_some();
        if has_frame || self.planner_asks {
            self.ask(control, &axes, joints, inner);
        }
        if !has_frame {
            return NormalPins::refused(ToolNormalError::NoFrame);
        }
        match &self.chain {
            Ok(chain) => NormalPins::of_chain(chain.as_ref(), control, &limits, &axes),
            Err(Unknown) => NormalPins::refused(ToolNormalError::UnknownKinematics),
        }
    }
}
