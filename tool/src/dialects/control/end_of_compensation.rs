//! What follows the end of cutter compensation: LinuxCNC leaves the compensated path on a straight line only.

use crate::program::moves::MoveKind;
use crate::program::{Action, Compensation};

/// How far the end of cutter compensation has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EndOfCompensation {
    /// Whether it is on.
    on: bool,
    /// Whether it has been switched off, and nothing has moved since.
    open: bool,
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
                Action::Move(path) => {
                    met = met || self.open && matches!(path.kind, MoveKind::Arc(_));
                    self.open = false;
                }
                _ => {}
            }
        }
        met
    }
}
