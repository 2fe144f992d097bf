//! A plane turned in space (G68.2), and the tool normal to it (G53.1).
//!
//! `I J K` are Euler angles: about Z, about the new X, about the new Z. With P1 they are roll, pitch and yaw:
//! about X, Y and Z of the work offset, in the order of Q. (Fanuc, Series 30i, User's Manual, "Tilted
//! working plane indexing".)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::At;
use crate::program::frame::FrameOperation;
use crate::program::{Action, FrameScope};
use crate::source::Span;

impl Interpreter<'_> {
    /// `G68.2 X0 Y0 Z0 I0 J30. K0`, `G68.2 P1 Q123 X0 Y0 Z0 I0 J30. K0`.
    pub(super) fn tilted_plane(&mut self, words: &mut BlockWords, span: Span) -> Done {
        if !self.transforms.is_empty() {
            return Err(
                Diagnostic::error(span, "G68.2 while G51, G51.1 or G68 is in force")
                    .help("end them with G69, G50 and G50.1 before"),
            );
        }
        if self.has_turned_aside() {
            return Err(Diagnostic::error(
                span,
                "G68.2 in a program that turns G18 or G19 with G68",
            )
            .help("the machine would tilt the tool there: put both into programs of their own"));
        }
        let angles = words.centre.map(|word| word.map_or(0.0, |word| word.value));
        words.centre = [None; 3];
        let way = words.p.take().map(|word| At {
            value: word.value.0,
            span: word.span,
        });
        let turns = match way {
            None => euler(angles),
            Some(At { value: 0.0, .. }) => euler(angles),
            Some(At { value: 1.0, .. }) => roll_pitch_yaw(angles, words.q.take(), span)?,
            Some(At { value, span }) => {
                return Err(Diagnostic::error(
                    span,
                    format!("G68.2 with P{value} is not supported"),
                )
                .help("give the plane by Euler angles, or by roll, pitch and yaw with P1"));
            }
        };
        let factor = self.control.modal.length_factor;
        let mut origin = [0.0; 3];
        for (along, word) in origin.iter_mut().zip(&mut words.axes) {
            *along = word.take().map_or(0.0, |word| word.value * factor);
        }
        let mut next = self.transforms.clone();
        // The plane is in force even where it is the one that was.
        next.tilt = vec![FrameOperation::Translate(origin)];
        next.tilt.extend(turns);
        self.control.set_frame_scope(FrameScope::Machine);
        self.set_transforms(next, span)
    }

    /// G53.1.
    pub(super) fn tool_normal(&mut self, words: &mut BlockWords, span: Span) -> Done {
        if self.transforms.tilt.is_empty() {
            return Err(Diagnostic::error(span, "G53.1 without a tilted plane")
                .help("write G68.2 X0 Y0 Z0 I0 J30. K0 in a block before"));
        }
        if let Some(At {
            value: (value, _),
            span,
        }) = words.p.take().filter(|word| word.value.0 != 0.0)
        {
            return Err(
                Diagnostic::error(span, format!("G53.1 with P{value} is not supported"))
                    .help("which way the rotary axes turn is left to the kinematics: leave P out"),
            );
        }
        self.control.refuse_compensation(span, "G53.1")?;
        self.control.modal.forget_position();
        self.control.actions.push(Action::ToolNormal);
        Ok(())
    }
}

fn about(axis: usize, angle: f64) -> Option<FrameOperation> {
    let mut angles = [0.0; 3];
    angles[axis] = angle;
    (angle != 0.0).then_some(FrameOperation::Rotate(angles))
}

fn euler([first, second, third]: [f64; 3]) -> Vec<FrameOperation> {
    let turns = [about(2, first), about(0, second), about(2, third)];
    turns.into_iter().flatten().collect()
}

/// The axes stay where they are: what turns first is innermost.
fn roll_pitch_yaw(
    angles: [f64; 3],
    order: Option<At<f64>>,
    span: Span,
) -> Result<Vec<FrameOperation>, Diagnostic> {
    const ORDERS: [(f64, [usize; 3]); 6] = [
        (123.0, [0, 1, 2]),
        (132.0, [0, 2, 1]),
        (213.0, [1, 0, 2]),
        (231.0, [1, 2, 0]),
        (312.0, [2, 0, 1]),
        (321.0, [2, 1, 0]),
    ];
    let wanted = order.map(|order| order.value);
    let found = ORDERS.iter().find(|(name, _)| Some(*name) == wanted);
    let Some((_, axes)) = found else {
        return Err(Diagnostic::error(
            order.map_or(span, |order| order.span),
            "G68.2 P1 needs Q, the order of the rotations",
        )
        .help("write Q123 for X, then Y, then Z; Q321 for Z, then Y, then X"));
    };
    let turns = axes
        .iter()
        .rev()
        .filter_map(|axis| about(*axis, angles[*axis]));
    Ok(turns.collect())
}
