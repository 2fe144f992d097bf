//! What the commands that begin with `#` do.

use super::frames::System;
use super::interpreter::Interpreter;
use super::syntax::{Command, Parameter};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::expression::Expression;
use crate::program::Action;
use crate::source::Span;

/// The contour error of `#HSC` when none is given, in millimetres.
const DEFAULT_CONTOUR_ERROR: f64 = 0.1;

/// The same of `#HSC ON [BSPLINE]`.
const DEFAULT_SPLINE_ERROR: f64 = 0.2;

/// Parameters of `#HSC` that only tune the control.
const NOTED_PARAMETERS: [&str; 9] = [
    "TRACK_DEV",
    "MERGE",
    "AUTO_OFF_PATH",
    "AUTO_OFF_TRACK",
    "AUTO_OFF_G00",
    "AUTO_OFF_G60",
    "MAX_PATH_LENGTH",
    "MAX_ANGLE",
    "BSPLINE",
];

impl Interpreter<'_> {
    pub(super) fn run_command(&mut self, command: &Command, span: Span) -> Done {
        match command {
            Command::Message(text, values) => self.message(text, values, span),
            Command::Smoothing(on, parameters) => self.smoothing(*on, parameters, span),
            Command::Contouring(on, parameters) => {
                self.contouring(*on, parameters.as_deref(), span)
            }
            Command::DefineSystem(number, values) => {
                let number = self.system_number(number.as_ref())?;
                let system = self.system(values)?;
                self.define_system(number, system, span)
            }
            Command::SystemOn(number, values) => {
                let number = self.system_number(number.as_ref())?;
                let system = match values {
                    Some(values) => {
                        let system = self.system(values)?;
                        self.define_system(number, system, span)?;
                        Some(system)
                    }
                    None => match number {
                        Some(number) => self.frames.stored.get(&number).copied(),
                        None => self.frames.last_defined,
                    },
                };
                match system {
                    Some(system) => self.system_on(system, span),
                    None => Err(
                        Diagnostic::error(span, "this coordinate system is not defined")
                            .help("write #CS ON [x,y,z,a,b,c], or #CS DEF before"),
                    ),
                }
            }
            Command::SystemOff { all } => self.system_off(*all, span),
            Command::RotationOn(parameters) => self.rotation(parameters, span),
            Command::RotationOff => {
                let mut next = self.frames.clone();
                next.rotation = None;
                self.set_frames(next, span)
            }
            Command::Dwell(seconds) => {
                let value = seconds.number(&self.variables)?;
                self.control.dwell(value, seconds.span)
            }
            Command::Noted(name) => {
                self.control.note(name, span);
                Ok(())
            }
        }
    }

    /// `%f`, `%d` and `%s` in the text stand for the values.
    fn message(&mut self, text: &str, values: &[Expression], span: Span) -> Done {
        let values = self.numbers(values)?;
        let mut values = values.iter();
        let mut message = String::new();
        let mut rest = text;
        let mut fits = true;
        while let Some((before, after)) = rest.split_once('%') {
            message.push_str(before);
            let format = after.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
            let shown = match format.chars().next() {
                Some('d' | 'D') => values.next().map(|value| value.trunc().to_string()),
                Some('f' | 'F' | 's' | 'S') => values.next().map(f64::to_string),
                _ => {
                    message.push('%');
                    rest = after;
                    continue;
                }
            };
            fits &= shown.is_some();
            message.push_str(&shown.unwrap_or_default());
            rest = &format[1..];
        }
        message.push_str(rest);
        if !fits || values.next().is_some() {
            return Err(Diagnostic::error(
                span,
                "as many values are needed as the text has %f, %d and %s",
            )
            .help("write #MSG [\"P1 is %f\", P1]"));
        }
        if !message.trim().is_empty() {
            self.control.actions.push(Action::Message(message));
        }
        Ok(())
    }

    /// `#HSC`: corners are rounded within the contour error.
    fn smoothing(&mut self, on: Option<bool>, parameters: &[Parameter], span: Span) -> Done {
        let spline = parameters.iter().any(|given| given.name == "BSPLINE");
        for given in parameters {
            match given.name.as_str() {
                "CONTERROR" => {
                    let error = self.parameter(given)?;
                    let error = self.control.tolerance(error, given.span)?;
                    self.modes.contour_error = Some(error);
                }
                "PATH_DEV" => self.modes.contour_error = Some(self.path_deviation(given)?),
                "OPMODE" if self.parameter(given)? != 1.0 => {
                    return Err(Diagnostic::error(
                        given.span,
                        "splines through the points are not supported",
                    )
                    .help("use OPMODE 1, which rounds the corners"));
                }
                "OPMODE" => {}
                name if NOTED_PARAMETERS.contains(&name) => {
                    if name != "BSPLINE" {
                        self.control.note(&format!("#HSC {name}"), given.span);
                    }
                }
                name => {
                    return Err(Diagnostic::error(
                        given.span,
                        format!("{name} is not a parameter of #HSC that is known"),
                    ));
                }
            }
        }
        match on {
            Some(true) => {
                // The default is in millimetres whatever the unit of the program.
                let default = match spline {
                    true => DEFAULT_SPLINE_ERROR,
                    false => DEFAULT_CONTOUR_ERROR,
                };
                let default = default * self.millimetre();
                let tolerance = self.modes.contour_error.unwrap_or(default);
                self.control.continuous_path(Some(tolerance), span)?;
            }
            // As before the program asked for it.
            Some(false) => self
                .control
                .path_control(self.control.settings.path_mode, span)?,
            None => {}
        }
        self.control.apply_states(false);
        Ok(())
    }

    /// `#CONTOUR MODE`: the deviation of G61 and G261. All else in it tunes the control.
    fn contouring(
        &mut self,
        on: Option<bool>,
        parameters: Option<&[Parameter]>,
        span: Span,
    ) -> Done {
        let tunes = |given: &Parameter| !matches!(given.name.as_str(), "DEV" | "PATH_DEV");
        if parameters.is_none_or(|list| list.iter().any(tunes)) {
            self.control.note("all of #CONTOUR MODE but PATH_DEV", span);
        }
        let parameters = parameters.unwrap_or_default();
        if let Some(given) = parameters.iter().find(|given| given.name == "PATH_DEV") {
            self.modes.contour_deviation = Some(self.path_deviation(given)?);
        }
        match on {
            Some(true) => self.round_contour(span)?,
            // As before the program asked for it.
            Some(false) => self
                .control
                .path_control(self.control.settings.path_mode, span)?,
            None => {}
        }
        self.control.apply_states(false);
        Ok(())
    }

    /// PATH_DEV as machine units. It counts millimetres under G70 too, unless the control is set up otherwise.
    /// (Beckhoff TF5200, Channel parameters, "Contouring method in inch units (P-CHAN-00439)".)
    fn path_deviation(&mut self, given: &Parameter) -> Result<f64, Diagnostic> {
        let value = self.parameter(given)?;
        let (millimetre, unit) = (self.millimetre(), self.control.modal.length_factor);
        // Refuses what is below 0.
        self.control.tolerance(value, given.span)?;
        if unit != millimetre {
            self.control.note_once(
                "PATH_DEV",
                "PATH_DEV is taken in millimetres under G70 too, as by controls whose P-CHAN-00439 is 0",
                given.span,
            );
        }
        Ok(value * millimetre)
    }

    /// A millimetre in machine units.
    fn millimetre(&self) -> f64 {
        match self.control.settings.machine_in_inch {
            true => 1.0 / 25.4,
            false => 1.0,
        }
    }

    /// `#ROTATION ON [ANGLE=30]`.
    fn rotation(&mut self, parameters: &[Parameter], span: Span) -> Done {
        let mut angle = 0.0;
        for given in parameters {
            let value = self.parameter(given)?;
            match given.name.as_str() {
                "ANGLE" => angle = value,
                "CENTER1" | "CENTER2" if value == 0.0 => {}
                "CENTER1" | "CENTER2" => {
                    return Err(Diagnostic::error(
                        given.span,
                        "a centre of rotation beside zero is not supported",
                    )
                    .help("shift zero there with G92 before and rotate about it"));
                }
                name => {
                    return Err(Diagnostic::error(
                        given.span,
                        format!("{name} is not a parameter of #ROTATION that is known"),
                    )
                    .help("write #ROTATION ON [ANGLE=30]"));
                }
            }
        }
        let mut next = self.frames.clone();
        next.rotation = Some((self.control.modal.plane, angle));
        self.set_frames(next, span)
    }

    fn parameter(&self, given: &Parameter) -> Result<f64, Diagnostic> {
        match &given.value {
            Some(value) => value.number(&self.variables),
            None => Err(
                Diagnostic::error(given.span, format!("{} needs a value", given.name))
                    .help(format!("write {}=0.1", given.name)),
            ),
        }
    }

    fn system_number(&self, number: Option<&Expression>) -> Result<Option<u32>, Diagnostic> {
        number
            .map(|number| number.whole(&self.variables, 0))
            .transpose()
    }

    /// Shift and angles; what is left out is 0.
    fn system(&self, values: &[Option<Expression>]) -> Result<System, Diagnostic> {
        let mut system = [0.0; 6];
        for (place, (at, value)) in system.iter_mut().zip(values.iter().enumerate()) {
            if let Some(value) = value {
                let factor = if at < 3 { self.length_factor(0) } else { 1.0 };
                *place = value.number(&self.variables)? * factor;
            }
        }
        Ok(system)
    }
}
