//! What stands behind the frame: a machine of ours, or the kinematics of another module.

use super::inner::{InnerType, TYPES};
use super::pins::FrameInputs;
use super::refusal::FrameRefusal;
use crate::machine::Machine;

/// What turns the positions that a frame gives into joints. Like the dimensions of a machine, the type of inner kinematics
/// changes at a switch only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Behind {
    /// One of ours.
    Own(Machine),
    /// Those of another module, which only their owner can ask.
    Inner(InnerType),
}

impl From<Machine> for Behind {
    fn from(machine: Machine) -> Self {
        Self::Own(machine)
    }
}

impl Behind {
    /// Ours.
    pub fn machine(&self) -> Option<&Machine> {
        match self {
            Self::Own(machine) => Some(machine),
            Self::Inner(_) => None,
        }
    }

    /// Whether what is behind the frame turns the tool's length itself.
    pub fn turns_tool(&self) -> bool {
        match self {
            Self::Own(machine) => machine.tool_centre_point(),
            Self::Inner(kind) => kind.turns_tool(),
        }
    }

    /// The type of the inner kinematics, 0 for ours.
    pub fn inner_type(&self) -> i32 {
        match self {
            Self::Own(_) => 0,
            Self::Inner(kind) => kind.number(),
        }
    }

    /// The same with the dimensions and the type that the pins say.
    ///
    /// # Errors
    ///
    /// [`FrameRefusal::MachineParameters`], [`FrameRefusal::UnknownInnerType`].
    pub fn as_on_pins(&self, inputs: &FrameInputs) -> Result<Self, FrameRefusal> {
        match *self {
            Self::Own(mut machine) => match machine.set_parameters(&inputs.table) {
                Ok(()) => Ok(Self::Own(machine)),
                Err(_) => Err(FrameRefusal::MachineParameters),
            },
            Self::Inner(kind) => match InnerType::on_pin(inputs.inner_type) {
                Some(number) => Ok(Self::Inner(kind.with(number))),
                None => Err(FrameRefusal::UnknownInnerType),
            },
        }
    }

    /// The number that motion is asked for: without a frame (slot 0) that of the inner kinematics, as if they were alone.
    pub fn number(&self, slot: i32) -> i32 {
        match self {
            Self::Own(_) => slot,
            Self::Inner(kind) => TYPES * slot + kind.number(),
        }
    }

    /// The slot that a number of motion means, and what is behind the frame then.
    pub fn switched_to(&self, number: i32) -> (i32, Self) {
        match *self {
            Self::Own(_) => (number, *self),
            Self::Inner(kind) => (
                number.div_euclid(TYPES),
                Self::Inner(kind.with(number.rem_euclid(TYPES))),
            ),
        }
    }

    /// Whether the machine cannot move an axis X Y Z (0 to 2).
    pub fn lacks(&self, axis: usize, inputs: &FrameInputs) -> bool {
        match self {
            Self::Own(machine) => machine.coordinates().joint_of_axis(axis).is_none(),
            Self::Inner(_) => inputs.fixed_axes.get(axis).copied().unwrap_or(false),
        }
    }
}
