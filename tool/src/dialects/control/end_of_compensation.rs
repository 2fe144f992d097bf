//! What follows the end of cutter compensation: LinuxCNC leaves the compensated path on a straight line only.

use crate::program::moves::MoveKind;
use crate::program::{Action, Compensation, Plane};

/// How far the end of cutter compensation has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EndOfCompensation {
    plane: Plane,
    /// Whether it is on.
    on: bool,
    /// Whether it has been switched off, and nothing has moved in the plane since.
    open: bool,
}

impl Default for EndOfCompensation {
    fn default() -> Self {
        EndOfCompensation {
            plane: Plane::Xy,
            on: false,
            open: false,
        }
    }
}

impl EndOfCompensation {
    /// Follows the actions of a block; `true` where the first motion behind the compensation is an arc.
    pub fn meets_arc(&mut self, actions: &[Action]) -> bool {
        let mut met = false;
        for action in actions {
            match action {
                Action::Compensation(Compensation::Off) => {
                    self.open = self.open || self.on;
                    self.on = false;
                }
                Action::Compensation(_) => self.on = true,
                Action::Plane(plane) => self.plane = *plane,
                Action::Move(path) if path.leads_in_plane(self.plane) => {
                    met = met || self.open && matches!(path.kind, MoveKind::Arc(_));
                    self.open = false;
                }
                _ => {}
            }
        }
        met
    }
}
