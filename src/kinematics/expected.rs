//! What may come in a servo period, so that the inner kinematics are asked beforehand what they make of it: they are their
//! owner's to ask.

use super::command::Command;
use super::control::{FrameControl, FrameInputs};
use super::switching::standing;
use crate::frame::ActiveFrame;

impl FrameControl {
    /// Whether a frame may be made in this period, for which the axes that inner kinematics cannot move have to be known.
    pub fn expects_frame(&self, inputs: &FrameInputs) -> bool {
        let restaged = self.active.frame.is_some()
            && self
                .behind_on_pins(inputs)
                .is_ok_and(|wanted| wanted != self.active.behind);
        self.request.is_none()
            && standing(inputs).is_ok()
            && (self.is_commanded(inputs) || restaged)
    }

    /// Whether there is a command that has not been answered.
    fn is_commanded(&self, inputs: &FrameInputs) -> bool {
        Command::on_pin(inputs.command).is_some_and(|command| self.is_unanswered(&command))
    }

    fn is_unanswered(&self, command: &Command) -> bool {
        command.number != self.outputs.acknowledged
    }

    /// Whether a frame may come or go in this period, for which it has to be known that no joint jumps.
    pub fn expects_switch(&self, inputs: &FrameInputs) -> bool {
        let going = self.active.frame.is_some()
            && (self.release.is_due() || inputs.release || inputs.command == 0.0);
        self.request.is_none() && standing(inputs).is_ok() && (self.is_commanded(inputs) || going)
    }

    /// The frame that the command of this period brings, `None` if it brings none or is refused.
    pub fn frame_of_command(&self, inputs: &FrameInputs) -> Option<ActiveFrame> {
        let command =
            Command::on_pin(inputs.command).filter(|command| self.is_unanswered(command))?;
        self.commanded(&command, inputs).ok()?.frame
    }

    /// The frame that a switch to kinematics `number` brings, `None` if it brings none or is refused.
    pub fn frame_of_switch(&self, number: i32, inputs: &FrameInputs) -> Option<ActiveFrame> {
        self.checked(number, self.request, inputs).ok()?.frame
    }
}
