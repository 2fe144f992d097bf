//! `CYCLE800(FR, TC, ST, MODE, X0, Y0, Z0, A, B, C, X1, Y1, Z1, DIR, ..)`: a plane turned in space, and the
//! tool normal to it. (Siemens, SINUMERIK 840D sl, Programming Manual, "Swivelling - CYCLE800".)
//!
//! The frame of the cycle is one of its own: TRANS and its like act in it and do not clear it.

use super::interpreter::Interpreter;
use super::syntax::Call;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::program::Action;
use crate::program::frame::{FrameCommand, FrameOperation};
use crate::source::Span;

/// The order of the axes of rotation, two bits each: 01 X, 10 Y, 11 Z.
const AXIS_BITS: [u32; 3] = [0, 2, 4];

impl Interpreter<'_> {
    /// A frame command of the program, inside of the swivelled plane.
    pub(super) fn programmable_frame(&mut self, command: FrameCommand, span: Span) -> Done {
        if self.swivelled.is_empty() {
            return self.control.change_frame(command, span);
        }
        let mut operations = self.swivelled.clone();
        match command {
            FrameCommand::Cancel => {}
            FrameCommand::Absolute(operation) => operations.push(operation),
            FrameCommand::Additive(_) | FrameCommand::DropScales => {
                return self.control.change_frame(command, span);
            }
        }
        self.control.set_frame(&operations, span)
    }

    pub(super) fn swivel(&mut self, call: &Call) -> Done {
        let span = call.span;
        if call.arguments.iter().all(Option::is_none) {
            if self.swivelled.is_empty() {
                self.control.note("CYCLE800()", span);
                return Ok(());
            }
            self.swivelled.clear();
            return self.control.change_frame(FrameCommand::Cancel, span);
        }
        let mut values = [0.0; 14];
        for (at, (value, argument)) in values.iter_mut().zip(&call.arguments).enumerate() {
            // The name of the swivel data record stands for this one machine.
            if let (Some(argument), true) = (argument, at != 1) {
                *value = argument.number(&self.variables)?;
            }
        }
        let [
            retraction,
            _,
            state,
            mode,
            x0,
            y0,
            z0,
            a,
            b,
            c,
            x1,
            y1,
            z1,
            direction,
        ] = values;
        let operations =
            self.swivel_operations(mode, [x0, y0, z0], [a, b, c], [x1, y1, z1], span)?;
        if operations.is_empty() {
            self.control.note("CYCLE800 without angles", span);
        }
        // The units digit of ST: 1 is additive.
        match state.rem_euclid(10.0) {
            0.0 => self.swivelled = operations,
            1.0 => self.swivelled.extend(operations),
            _ => {
                return Err(Box::new(
                    Diagnostic::error(span, format!("CYCLE800 with ST = {state} is not supported"))
                        .help("0 sets a new plane, 1 turns the one that is set"),
                ));
            }
        }
        self.control.set_frame(&self.swivelled, span)?;
        let turns = [a, b, c].iter().any(|angle| *angle != 0.0);
        if retraction != 0.0 {
            self.control.diagnostics.push(
                Diagnostic::warning(
                    span,
                    format!("CYCLE800: the retraction FR = {retraction} is left to the program"),
                )
                .help("move the tool clear of the part before: G0 SUPA Z0 D0"),
            );
        }
        if turns && direction != 0.0 {
            self.control.modal.forget_position();
            self.control.actions.push(Action::ToolNormal);
        }
        Ok(())
    }

    fn swivel_operations(
        &self,
        mode: f64,
        before: [f64; 3],
        angles: [f64; 3],
        after: [f64; 3],
        span: Span,
    ) -> Result<Vec<FrameOperation>, Box<Diagnostic>> {
        let factor = self.control.modal.length_factor;
        let translate = |shift: [f64; 3]| {
            let moves = shift.iter().any(|along| *along != 0.0);
            moves.then(|| FrameOperation::Translate(shift.map(|along| along * factor)))
        };
        let mut list: Vec<FrameOperation> = translate(before).into_iter().collect();
        if angles.iter().any(|angle| *angle != 0.0) {
            let axes = rotation_axes(mode, span)?;
            for (axis, angle) in axes.into_iter().zip(angles) {
                if angle != 0.0 {
                    let mut about = [0.0; 3];
                    about[axis] = angle;
                    list.push(FrameOperation::Rotate(about));
                }
            }
        }
        list.extend(translate(after));
        Ok(list)
    }
}

/// The first, second and third axis of rotation of a MODE whose bits 7 and 6 say "axis by axis".
fn rotation_axes(mode: f64, span: Span) -> Result<[usize; 3], Box<Diagnostic>> {
    let unsupported = || {
        Box::new(
            Diagnostic::error(
                span,
                format!("CYCLE800 with MODE = {mode} is not supported"),
            )
            .help("rotations axis by axis are: 57 about X Y Z, 27 about Z Y X, 39 about Z X Y .."),
        )
    };
    if mode.fract() != 0.0 || !(0.0..64.0).contains(&mode) {
        return Err(unsupported());
    }
    let mode = mode as u32;
    let mut axes = [0; 3];
    for (axis, shift) in axes.iter_mut().zip(AXIS_BITS) {
        *axis = match (mode >> shift) & 3 {
            0 => return Err(unsupported()),
            number => number as usize - 1,
        };
    }
    Ok(axes)
}
