//! How the kinematics of another module turn the tool, asked when the machine has come to rest.

use libc::c_int;

use super::frame_pins::{framepath_frame_inputs, limits_of};
use super::inner::{Calls, InnerModule};
use super::normal_pins::NormalPins;
use super::retract_pins::RetractPins;
use super::tool_pins::ToolPins;
use crate::axes::{AXIS_COUNT, Axes};
use crate::kinematics::command::Command;
use crate::kinematics::control::FrameControl;
use crate::kinematics::inner_tool::{ToolTurning, Unknown, tool_turning};
use crate::kinematics::{Behind, RetractionError, ToolAxes, ToolNormalError};
use crate::machine::JOINT_COUNT;

/// The types of the kinematics behind the frame that a program may change to; none of a machine of ours.
fn types_of(behind: &Behind, inner: &InnerModule) -> [c_int; 2] {
    let Behind::Inner(kind) = behind else {
        return [-1; 2];
    };
    let is_had = |number: &i32| *number == kind.number() || inner.switch.is_some();
    [kind.for_tool_centre(), kind.for_axes()]
        .map(|number| number.filter(is_had).map_or(-1, c_int::from))
}

/// How the tool is turned with a frame and a type of the kinematics: another module is asked dozens of times, which is done
/// once, when the machine stands in a new frame or with another type, and again at each rest while it is not known. Without
/// a frame nobody touches it unless a program asks, or blendtp, which then asks for joints itself: some remember where they
/// were asked last.
pub(super) struct AskedNormal {
    /// motion's number for the frame and the type.
    question: Option<c_int>,
    turning: Result<ToolTurning, Unknown>,
    /// What `tool_axes=` says.
    said: ToolAxes,
    /// The type of the kinematics that this belongs to.
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
    pub(super) const NONE: Self = Self::with(ToolAxes::Unsaid);

    /// Nothing is asked yet, and this is what `tool_axes=` says.
    pub(super) const fn with(said: ToolAxes) -> Self {
        Self {
            question: None,
            turning: Err(Unknown::NotFound),
            said,
            inner_type: 0,
            planner_asks: false,
            stands: false,
            rested: false,
            slot: 0,
        }
    }

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
        let chain = self.turning.as_ref().ok()?.chain?;
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
        let question = self.question_of(control);
        let is_open = question != self.question || (self.rested && self.turning.is_err());
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
        self.turning = tool_turning(&mut calls, axes, joints, &self.said);
    }

    /// What is to be asked for now.
    fn question_of(&self, control: &FrameControl) -> Option<c_int> {
        Some(control.behind().number(self.slot))
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
    ) -> ToolPins {
        let axes = Axes::from(*position);
        let limits = limits_of(pins);
        if let Some(machine) = control.behind().machine() {
            return ToolPins {
                normal: NormalPins::of_machine(machine, control, &limits, &axes),
                retract: RetractPins::of_machine(machine, control, &axes),
                types: types_of(control.behind(), inner),
            };
        }
        let stands = pins.in_position != 0 && pins.enabled != 0;
        self.rested |= stands && !self.stands;
        (self.stands, self.slot) = (stands, slot);
        let has_frame = control.active().is_some();
        let program_asks = Command::on_pin(pins.command).is_some_and(|command| command.asks());
        if has_frame || self.planner_asks || program_asks {
            self.ask(control, &axes, joints, inner);
        }
        let normal = match &self.turning {
            _ if !has_frame => NormalPins::refused(ToolNormalError::NoFrame),
            Ok(turning) if turning.is_turned_by_another(&axes) => {
                NormalPins::refused(ToolNormalError::ThirdAxis)
            }
            Ok(turning) => NormalPins::of_chain(turning.chain.as_ref(), control, &limits, &axes),
            Err(Unknown::NotFound) => NormalPins::refused(ToolNormalError::UnknownKinematics),
            Err(Unknown::NotAsSaid) => NormalPins::refused(ToolNormalError::NotAsSaid),
        };
        let retract = if self.question_of(control) == self.question {
            RetractPins::of_inner(&self.turning, control, &axes, joints)
        } else {
            RetractPins::new(Err(RetractionError::NotAsked))
        };
        ToolPins {
            normal,
            retract,
            types: types_of(control.behind(), inner),
        }
    }
}
