//! What follows the end of cutter compensation: LinuxCNC leaves the compensated path on a straight line only.

use crate::diagnostics::Diagnostic;
use crate::program::moves::{Move, MoveKind};
use crate::program::{Action, Compensation, Plane};
use crate::source::Span;

/// Why LinuxCNC cannot leave the compensated path with a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoWayOff {
    /// It is an arc.
    Arc,
    /// It is an increment from a place that LinuxCNC would have to read, while the compensation is still on.
    UnknownPlace,
}

impl NoWayOff {
    /// Says so at the block of the motion.
    pub fn error(self, span: Span) -> Diagnostic {
        match self {
            NoWayOff::Arc => Diagnostic::error(
                span,
                "an arc is the first motion behind the end of cutter compensation",
            )
            .help("LinuxCNC leaves the compensated path on a straight line: write G40 with a G1 before the arc"),
            NoWayOff::UnknownPlace => Diagnostic::unknown_place(
                span,
                "where cutter compensation ends, from a place that is not known ahead of time",
            )
            .help(
                "write this motion in G90, or program its axes absolute before G41 or G42",
            ),
        }
    }
}

/// How far the end of cutter compensation has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EndOfCompensation {
    plane: Plane,
    /// Whether it is on.
    on: bool,
    /// Whether something has moved in the plane since: without that LinuxCNC sees nothing of it.
    begun: bool,
    /// Whether it has been switched off, having begun, and nothing has moved in the plane since.
    open: bool,
}

impl Default for EndOfCompensation {
    fn default() -> Self {
        EndOfCompensation {
            plane: Plane::Xy,
            on: false,
            begun: false,
            open: false,
        }
    }
}

impl EndOfCompensation {
    /// Follows the actions of a block, and gives the first motion behind the compensation that LinuxCNC cannot leave
    /// the path with.
    pub fn meets(&mut self, actions: &[Action]) -> Option<NoWayOff> {
        let mut met = None;
        for action in actions {
            match action {
                Action::Compensation(Compensation::Off) => {
                    self.open = self.open || self.begun;
                    (self.on, self.begun) = (false, false);
                }
                Action::Compensation(_) => self.on = true,
                Action::Plane(plane) => self.plane = *plane,
                Action::Move(path) => {
                    met = met.or_else(|| self.no_way_off(path));
                    let leads = path.leads_in_plane(self.plane);
                    self.open = self.open && !leads;
                    self.begun = self.begun || self.on && leads;
                }
                _ => {}
            }
        }
        met
    }

    fn no_way_off(&self, path: &Move) -> Option<NoWayOff> {
        match path.kind {
            _ if !self.open => None,
            MoveKind::Arc(_) => Some(NoWayOff::Arc),
            _ => path.depends_on_position().then_some(NoWayOff::UnknownPlace),
        }
    }
}
