//! KONT: where the way off a compensated contour begins behind it, the control goes round the end of the contour
//! first. LinuxCNC goes there in a straight line, as both do with NORM, and would cut into the contour.
//! (Siemens, SINUMERIK 840D sl, Programming Manual Fundamentals, "Approaching and leaving contour".)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::program::moves::{Coordinate, Move, MoveKind};
use crate::program::{Action, Compensation};
use crate::source::Span;

/// Places that are nearer to the tangent of the contour lie on it, machine units.
const ON_TANGENT: f64 = 1e-6;

/// The end of a contour under KONT that the tool has not left yet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourEnd {
    /// Towards the tool, along both axes of the plane; `None` where it is not known ahead of time.
    aside: Option<[f64; 2]>,
    span: Span,
}

impl Interpreter<'_> {
    /// KONT and NORM among the words of a block.
    pub(super) fn exit_mode(&mut self, words: &BlockWords) {
        for noted in &words.noted {
            match noted.value.as_str() {
                "KONT" => self.goes_round = true,
                "NORM" => self.goes_round = false,
                _ => {}
            }
        }
    }

    /// The side of the tool changed from `before`; at the end of a contour the way off it comes next.
    pub(super) fn end_contour(&mut self, before: Compensation, words: &BlockWords) {
        let left = match before {
            Compensation::Left => 1.0,
            Compensation::Right => -1.0,
            Compensation::Off => return,
        };
        let modal = &self.control.modal;
        if modal.compensation != Compensation::Off || !self.goes_round {
            return;
        }
        let [first, second, _] = modal.plane.axes();
        let aside = modal
            .tangent
            .map(|tangent| [-tangent[second] * left, tangent[first] * left]);
        let end = words.g.iter().find(|g| g.value == 400);
        self.contour_end = end.map(|g| ContourEnd {
            aside,
            span: g.span,
        });
    }

    /// Refuses a way off the contour that the control would not take straight; `at`: the first action of the
    /// motion.
    pub(super) fn check_exit(&mut self, at: usize) -> Done {
        let path = self.control.actions[at..]
            .iter()
            .find_map(|action| match action {
                Action::Move(path) => Some(path),
                _ => None,
            });
        let (Some(path), Some(end)) = (path, self.contour_end) else {
            return Ok(());
        };
        let distance = end.aside.and_then(|aside| self.along(path, aside));
        self.contour_end = None;
        let reason = match distance {
            Some(distance) if distance >= -ON_TANGENT => return Ok(()),
            Some(_) => {
                "KONT goes round the end of the contour here: the way off it leads behind it, where LinuxCNC \
                 would go straight and cut into it"
            }
            None => {
                "KONT, and whether the way off the contour leads behind its end is not known ahead of time"
            }
        };
        Err(Diagnostic::error(end.span, reason).help(
            "let the block of G40 lead off the contour on the side of the tool, or write NORM before it where the \
             straight way is meant",
        ))
    }

    /// How far a motion leads towards the tool. Where the last motion was along the tool's own axis, there is
    /// no contour to cut into.
    fn along(&self, path: &Move, aside: [f64; 2]) -> Option<f64> {
        let length = aside[0].hypot(aside[1]);
        if length == 0.0 {
            return Some(0.0);
        }
        let [first, second, _] = self.control.modal.plane.axes();
        let mut distance = 0.0;
        for (axis, part) in [first, second].into_iter().zip(aside) {
            let step = match path.target[axis] {
                Coordinate::Keep => 0.0,
                _ if matches!(path.kind, MoveKind::Machine { .. }) => return None,
                Coordinate::By(step) => step,
                Coordinate::At(end) => end - path.start[axis]?,
            };
            distance += step * part / length;
        }
        Some(distance)
    }
}
