//! Where cutter compensation takes effect. On most controls that is the first motion that leads elsewhere in the plane.
//! LinuxCNC takes the first motion whatsoever, and stops where it is not longer in the plane than the radius of the
//! tool, as a plunge is not. G41 and G42 are therefore written with the motion in the plane.

use super::{Action, Block, Compensation, Plane};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::Span;

/// Moves G41 and G42 in blocks that come one after the other.
#[derive(Debug)]
pub struct ContourEntries {
    plane: Plane,
    /// G41 or G42, behind which nothing has moved in the plane.
    held: Option<Action>,
    standing: Standing,
}

/// What the control does where the first motion behind G41 or G42 does not lead elsewhere in the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Compensation waits for one that does.
    Waits,
    /// The tool goes at once to beside the place where it is, at right angles to the path that follows. (Fagor, CNC
    /// 8055, Programming Manual, "Beginning of tool radius compensation without programmed movement".)
    Steps,
}

impl Default for ContourEntries {
    fn default() -> Self {
        ContourEntries {
            plane: Plane::Xy,
            held: None,
            standing: Standing::Waits,
        }
    }
}

impl ContourEntries {
    /// How the control begins without a motion in the plane.
    pub fn set_standing(&mut self, standing: Standing) {
        self.standing = standing;
    }

    /// Changes the next block. A beginning that cannot be written is reported.
    pub fn change(&mut self, block: &mut Block, diagnostics: &mut Diagnostics) {
        let begins = |action: &Action| matches!(action, Action::Compensation(_) | Action::Plane(_));
        if self.held.is_none() && !block.actions.iter().any(begins) {
            return;
        }
        let actions = std::mem::take(&mut block.actions);
        for action in actions {
            match &action {
                Action::Plane(plane) => self.plane = *plane,
                // What has not begun ends without a trace.
                Action::Compensation(Compensation::Off) => self.held = None,
                Action::Compensation(_) => {
                    self.held = Some(action);
                    continue;
                }
                Action::Move(motion) if motion.leads_in_plane(self.plane) => {
                    block.actions.extend(self.held.take());
                }
                Action::Move(_) if self.held.is_some() && self.standing == Standing::Steps => {
                    diagnostics.push(steps_aside(block.origin.span));
                    self.held = None;
                }
                _ => {}
            }
            block.actions.push(action);
        }
    }
}

fn steps_aside(span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        "the first motion behind G41 or G42 does not lead elsewhere in the plane: the control steps aside by the \
         radius of the tool where it stands, and LinuxCNC cannot begin so",
    )
    .help("write G41 or G42 in the block of the motion that leads onto the contour: G41 G1 X10 Y0")
}
