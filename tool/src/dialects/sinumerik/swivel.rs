//! `CYCLE800(FR, TC, ST, MODE, X0, Y0, Z0, A, B, C, X1, Y1, Z1, DIR, ..)`: a plane turned in space, and the
//! tool normal to it. (Siemens, SINUMERIK 840D sl, Programming Manual, "Swivelling - CYCLE800".)
//!
//! The frame of the cycle is one of its own: TRANS and its like act in it and do not clear it. A new plane, and
//! CYCLE800() as well, takes their frame away with the plane of before.

use super::interpreter::Interpreter;
use super::programmed_offset::ProgrammedOffset;
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
        self.follow_offset(&command);
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
            if self.control.modal.frame.is_empty() {
                self.control.note("CYCLE800()", span);
                return Ok(());
            }
            self.swivelled.clear();
            self.offset = ProgrammedOffset::default();
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
        let additive = self.is_additive(state, span)?;
        let keeps_frame = additive || self.control.modal.frame.is_empty();
        if operations.is_empty() && keeps_frame && retraction == 0.0 && direction == 0.0 {
            self.control.note("CYCLE800 without angles", span);
        }
        self.retract(retraction, span)?;
        if !additive {
            self.swivelled.clear();
        }
        self.swivelled.extend(operations);
        let tilts = self.swivelled.iter().any(is_rotation);
        // DIR 0 sets the frame and leaves the axes where they are.
        let swivels = direction != 0.0;
        if swivels && !tilts {
            self.control
                .refuse_compensation(span, "the rotary axes turn")?;
            self.control.modal.forget_position();
            self.control.actions.push(Action::RotaryZero);
        }
        self.control.set_frame(&self.swivelled, span)?;
        self.offset = ProgrammedOffset::default();
        if swivels && tilts {
            self.control.modal.forget_position();
            self.control.actions.push(Action::ToolNormal);
        }
        Ok(())
    }

    /// The units digit of ST: 1 turns the plane that is set.
    fn is_additive(&self, state: f64, span: Span) -> Result<bool, Diagnostic> {
        match state.rem_euclid(10.0) {
            0.0 => Ok(false),
            1.0 if self.programmable_operations().is_empty() => Ok(true),
            1.0 => Err(Diagnostic::error(
                span,
                format!(
                    "CYCLE800 with ST = {state} while a frame of TRANS, ROT, SCALE or MIRROR is in force"
                ),
            )
            .help(
                "end that frame before, with TRANS alone, and give what is left of it as X0, Y0, Z0 and angles \
                 of the cycle",
            )),
            _ => Err(Diagnostic::error(
                span,
                format!("CYCLE800 with ST = {state} is not supported"),
            )
            .help("0 sets a new plane, 1 turns the one that is set")),
        }
    }

    /// FR: 1 retracts Z, to a place that on the control stands in the data of its swivel axes.
    fn retract(&mut self, retraction: f64, span: Span) -> Done {
        if retraction == 0.0 {
            return Ok(());
        }
        let before = "write FR = 0 and move the tool clear before: G0 SUPA Z0 D0";
        let refuse = |why: String, help: String| Err(Diagnostic::error(span, why).help(help));
        if retraction != 1.0 {
            let why = format!("CYCLE800 with the retraction FR = {retraction} is not supported");
            return refuse(why, format!("1 retracts Z; or {before}"));
        }
        let Some(place) = self.control.settings.retract_z else {
            return refuse(
                "CYCLE800 with FR = 1 retracts Z, and where to is not set".to_string(),
                format!(
                    "give Z of the machine in mm: --retract-z 120, or RETRACT_Z in [FRAMEPATH]; or {before}"
                ),
            );
        };
        self.control
            .refuse_compensation(span, "the tool retracts")?;
        let map = self.control.modal.frame.map();
        if self.control.modal.frame.has_scale() || map.linear().determinant() < 0.0 {
            let why = "CYCLE800 with FR = 1 while a scale or a mirror is in force";
            return refuse(why.to_string(), "clear it before: TRANS".to_string());
        }
        self.control.modal.forget_position();
        self.control.actions.push(Action::Retract(place));
        Ok(())
    }

    fn swivel_operations(
        &self,
        mode: f64,
        before: [f64; 3],
        angles: [f64; 3],
        after: [f64; 3],
        span: Span,
    ) -> Result<Vec<FrameOperation>, Diagnostic> {
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

fn is_rotation(operation: &FrameOperation) -> bool {
    matches!(operation, FrameOperation::Rotate(_))
}

/// The first, second and third axis of rotation of a MODE whose bits 7 and 6 say "axis by axis".
fn rotation_axes(mode: f64, span: Span) -> Result<[usize; 3], Diagnostic> {
    let unsupported = || {
        Diagnostic::error(
            span,
            format!("CYCLE800 with MODE = {mode} is not supported"),
        )
        .help("rotations axis by axis are: 57 about X Y Z, 27 about Z Y X, 39 about Z X Y ..")
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
