//! Where cutter compensation ends. On the other controls G40 takes effect with the next motion in the plane.
//! LinuxCNC leaves the compensated path with the next motion whatsoever: lifted after G40, the tool would go sideways
//! on its way up, into the contour. G40 is therefore written with the motion in the plane, behind motions along the
//! axis of the tool, or before the first command that LinuxCNC does not take under compensation.

use super::moves::{Coordinate, MoveKind};
use super::{Action, Block, Compensation, Plane};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::Span;

/// Moves the ends of compensation in blocks that come one after the other.
#[derive(Debug)]
pub struct ContourEnds {
    plane: Plane,
    state: State,
    /// G40, and what LinuxCNC takes behind it only.
    held: Vec<Action>,
    /// Whether the tool has been lifted since it moved in the plane.
    lifted: bool,
}

/// How far compensation has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Off,
    /// It is on, and nothing has moved in the plane since.
    Begun,
    /// The tool is beside the contour.
    Beside,
    /// LinuxCNC has got G40, and the tool is still beside the contour.
    Left(Span),
}

impl Default for ContourEnds {
    fn default() -> Self {
        ContourEnds {
            plane: Plane::Xy,
            state: State::Off,
            held: Vec::new(),
            lifted: false,
        }
    }
}

impl ContourEnds {
    /// Changes the next block. A motion on which the tool would leave the contour sideways, and cannot be helped, is
    /// reported.
    pub fn change(&mut self, block: &mut Block, diagnostics: &mut Diagnostics) {
        let begins = |action: &Action| matches!(action, Action::Compensation(_) | Action::Plane(_));
        if self.state == State::Off && !block.actions.iter().any(begins) {
            return;
        }
        let actions = std::mem::take(&mut block.actions);
        for action in actions {
            if self.state == State::Beside && waits(&action, self.plane, !self.held.is_empty()) {
                self.held.push(action);
                continue;
            }
            let in_plane = self.leads_in_plane(&action);
            if !self.held.is_empty() && (in_plane || !beside_contour(&action)) {
                block.actions.append(&mut self.held);
                self.state = State::Left(block.origin.span);
            }
            if let State::Left(span) = self.state
                && self.leaves_sideways(&action)
            {
                diagnostics.push(leaves_sideways(span));
                self.state = State::Off;
            }
            self.follow(&action);
            block.actions.push(action);
        }
    }

    fn leads_in_plane(&self, action: &Action) -> bool {
        match action {
            Action::Move(motion) => {
                !matches!(motion.kind, MoveKind::Machine { .. })
                    && motion.leads_in_plane(self.plane)
            }
            _ => false,
        }
    }

    fn follow(&mut self, action: &Action) {
        match action {
            Action::Plane(plane) => self.plane = *plane,
            Action::Compensation(Compensation::Off) => self.state = State::Off,
            Action::Compensation(_) => self.state = State::Begun,
            Action::Move(_) if self.leads_in_plane(action) => {
                self.lifted = false;
                self.state = match self.state {
                    State::Off | State::Left(_) => State::Off,
                    State::Begun | State::Beside => State::Beside,
                };
            }
            Action::Move(motion) if matches!(motion.kind, MoveKind::Machine { .. }) => {
                self.state = State::Off;
            }
            Action::Move(motion) => {
                let [_, _, normal] = self.plane.axes();
                self.lifted |= match motion.target[normal] {
                    Coordinate::By(step) => step > 0.0,
                    Coordinate::At(end) => motion.start[normal].is_some_and(|start| end > start),
                    Coordinate::Keep => false,
                };
            }
            _ => {}
        }
    }

    /// Whether the tool would leave the contour sideways on a way that is not one in the plane, at its depth.
    fn leaves_sideways(&self, action: &Action) -> bool {
        let [first, second, _] = self.plane.axes();
        match action {
            _ if self.lifted => false,
            Action::Move(motion) if matches!(motion.kind, MoveKind::Machine { .. }) => {
                let named = |axis: usize| motion.target[axis] != Coordinate::Keep;
                !named(first) || !named(second)
            }
            Action::Move(_) => !self.leads_in_plane(action),
            Action::ToolNormal | Action::RotaryZero | Action::Retract(_) => true,
            _ => false,
        }
    }
}

/// Whether an action waits for the motion in the plane: G40, and behind it what LinuxCNC does not take before.
fn waits(action: &Action, plane: Plane, ended: bool) -> bool {
    match action {
        Action::Compensation(Compensation::Off) => true,
        Action::Plane(next) => ended && *next == plane,
        Action::PathControl(_) | Action::Overrides(_) => ended,
        _ => false,
    }
}

/// Whether LinuxCNC takes an action under compensation.
fn beside_contour(action: &Action) -> bool {
    match action {
        Action::Move(motion) => matches!(motion.kind, MoveKind::Rapid | MoveKind::Line),
        Action::FeedMode(_)
        | Action::Feed(_)
        | Action::SpindleSpeed(_)
        | Action::SurfaceSpeed(_)
        | Action::Spindle(_)
        | Action::Orient(..)
        | Action::Tool(_)
        | Action::RadiusRow(_)
        | Action::CutterDiameter(_)
        | Action::Coolant(_)
        | Action::Dwell(_)
        | Action::Pause { .. }
        | Action::OtherM(_)
        | Action::Message(_)
        | Action::Enter { .. }
        | Action::Leave { .. } => true,
        _ => false,
    }
}

fn leaves_sideways(span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        "cutter compensation has ended, and nothing has moved in the plane or up since: LinuxCNC does not take this \
         under compensation, and behind it the tool would go sideways into the contour",
    )
    .help("lead the tool off the contour before, in the block of G40 or behind it, or lift it with G0 or G1")
}
