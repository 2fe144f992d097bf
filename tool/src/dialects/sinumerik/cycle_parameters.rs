//! The values that a call gives to a cycle, by the names of its parameters.

use super::cycle_tables::{Parameter, Rule, table};
use super::interpreter::Interpreter;
use super::syntax::Call;
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Value, Variables};
use crate::program::Plane;
use crate::source::Span;

/// The planes that the last digit of `_DMODE` names, from 1 on.
const PLANES: [Plane; 3] = [Plane::Xy, Plane::Zx, Plane::Yz];

/// The call of a cycle whose parameters are known.
pub(super) struct Cycle<'a> {
    /// Its name: `CYCLE83`.
    pub name: &'a str,
    /// Where it stands.
    pub span: Span,
    parameters: Vec<Parameter>,
    values: Vec<Option<Value>>,
    spans: Vec<Option<Span>>,
}

impl Interpreter<'_> {
    /// The values of a call; `None` for a cycle that is not supported.
    pub(super) fn cycle<'a>(&self, call: &'a Call) -> Result<Option<Cycle<'a>>, Diagnostic> {
        let Some(parameters) = table(&call.name) else {
            return Ok(None);
        };
        let cycle = Cycle::new(call, parameters, &self.variables)?;
        cycle.check_plane(self.control.modal.plane)?;
        Ok(Some(cycle))
    }
}

impl<'a> Cycle<'a> {
    fn new(
        call: &'a Call,
        parameters: Vec<Parameter>,
        variables: &dyn Variables,
    ) -> Result<Cycle<'a>, Diagnostic> {
        let given = call.arguments.len();
        if given > parameters.len() {
            return Err(Diagnostic::error(
                call.span,
                format!(
                    "{} takes {} values, and {given} are given",
                    call.name,
                    parameters.len()
                ),
            ));
        }
        let mut values = Vec::new();
        for argument in &call.arguments {
            values.push(match argument {
                Some(argument) => Some(argument.evaluate(variables)?),
                None => None,
            });
        }
        let spans = call.arguments.iter();
        let cycle = Cycle {
            name: &call.name,
            span: call.span,
            parameters,
            values,
            spans: spans
                .map(|argument| argument.as_ref().map(|argument| argument.span))
                .collect(),
        };
        cycle.check_rules()?;
        Ok(cycle)
    }

    fn check_rules(&self) -> Result<(), Diagnostic> {
        for (parameter, value) in self.parameters.iter().zip(&self.values) {
            let Rule::Zero(instead) = parameter.rule else {
                continue;
            };
            let is_zero = match value {
                None => true,
                Some(Value::Text(text)) => text.is_empty(),
                Some(Value::Number(number)) => *number == 0.0,
            };
            if !is_zero {
                return Err(self.unsupported(parameter.name, instead));
            }
        }
        Ok(())
    }

    /// The units of `_DMODE` name the plane in which the cycle acts; what stands before them concerns the
    /// display of the control.
    fn check_plane(&self, active: Plane) -> Result<(), Diagnostic> {
        if !self.has("_DMODE") {
            return Ok(());
        }
        let digit = self.digit("_DMODE", 0)?;
        let plane = (digit as usize).checked_sub(1).map(|at| PLANES.get(at));
        match plane {
            None => Ok(()),
            Some(Some(plane)) if *plane == active => Ok(()),
            _ => Err(self.unsupported(
                "_DMODE",
                "its last digit names another plane than the active one: write G17, G18 or G19 before",
            )),
        }
    }

    /// Whether the cycle has such a parameter, given or not.
    pub fn has(&self, name: &str) -> bool {
        self.parameters
            .iter()
            .any(|parameter| parameter.name == name)
    }

    fn at(&self, name: &str) -> usize {
        let at = self
            .parameters
            .iter()
            .position(|parameter| parameter.name == name);
        debug_assert!(at.is_some(), "{} has no {name}", self.name);
        at.unwrap_or(usize::MAX)
    }

    /// Where a parameter stands; the name of the cycle where it is left out.
    pub fn span_of(&self, name: &str) -> Span {
        let span = self.spans.get(self.at(name)).copied().flatten();
        span.unwrap_or(self.span)
    }

    /// The number of a parameter; `None` where it is left out.
    pub fn number(&self, name: &str) -> Result<Option<f64>, Diagnostic> {
        match self.values.get(self.at(name)) {
            Some(Some(Value::Number(number))) => Ok(Some(*number)),
            Some(Some(Value::Text(text))) if !text.is_empty() => Err(Diagnostic::error(
                self.span_of(name),
                format!("{name} of {} is a number, not a text", self.name),
            )),
            _ => Ok(None),
        }
    }

    /// The same, 0 where it is left out.
    pub fn or_zero(&self, name: &str) -> Result<f64, Diagnostic> {
        self.number(name).map(|number| number.unwrap_or(0.0))
    }

    /// The same; `None` for 0 too.
    pub fn nonzero(&self, name: &str) -> Result<Option<f64>, Diagnostic> {
        self.number(name)
            .map(|number| number.filter(|number| *number != 0.0))
    }

    /// The number of a parameter that must be there. `meaning` is shown behind its name.
    pub fn needed(&self, name: &str, meaning: &str) -> Result<f64, Diagnostic> {
        self.number(name)?
            .ok_or_else(|| self.missing(&format!("{name}, {meaning}")))
    }

    /// The error for a parameter that is left out.
    pub fn missing(&self, what: &str) -> Diagnostic {
        Diagnostic::error(self.span, format!("{} needs {what}", self.name))
    }

    /// One decimal digit of `_AMODE`, 0 for the units; 0 in a cycle without it.
    pub fn mode(&self, place: u32) -> Result<u32, Diagnostic> {
        match self.has("_AMODE") {
            true => self.digit("_AMODE", place),
            false => Ok(0),
        }
    }

    /// Refuses digits of `_AMODE` at other places than these, and digits above 2.
    pub fn check_modes(&self, places: &[u32]) -> Result<(), Diagnostic> {
        match self.has("_AMODE") {
            true => self.check_digits("_AMODE", places, 2),
            false => Ok(()),
        }
    }

    /// The text of a parameter; `None` where it is left out or empty.
    pub fn text(&self, name: &str) -> Option<&str> {
        match self.values.get(self.at(name)) {
            Some(Some(Value::Text(text))) if !text.is_empty() => Some(text),
            _ => None,
        }
    }

    /// One decimal digit of a parameter, 0 for the units.
    pub fn digit(&self, name: &str, place: u32) -> Result<u32, Diagnostic> {
        let number = self.or_zero(name)?;
        if number.fract() != 0.0 || !(0.0..4e9).contains(&number) {
            return Err(
                self.unsupported(name, "its digits are modes: a whole number of at least 0")
            );
        }
        Ok(number as u32 / 10_u32.pow(place) % 10)
    }

    /// Refuses a parameter that has other digits than 0 at other places than these, or larger ones than
    /// `most` at them.
    pub fn check_digits(&self, name: &str, places: &[u32], most: u32) -> Result<(), Diagnostic> {
        for place in 0..10 {
            let digit = self.digit(name, place)?;
            let allowed = match places.contains(&place) {
                true => most,
                false => 0,
            };
            if digit > allowed {
                return Err(self.unsupported(name, NOT_KNOWN));
            }
        }
        Ok(())
    }

    /// The error for a value that is not supported, with what to write instead.
    pub fn unsupported(&self, name: &str, instead: &str) -> Diagnostic {
        let value = match self.values.get(self.at(name)) {
            Some(Some(Value::Number(number))) => number.to_string(),
            Some(Some(Value::Text(text))) => format!("\"{text}\""),
            _ => "0".to_string(),
        };
        Diagnostic::error(
            self.span_of(name),
            format!("{name} = {value} of {} is not supported", self.name),
        )
        .help(instead)
    }
}

const NOT_KNOWN: &str = "one of its digits asks for a mode that is not translated: post the program with the moves of the cycle";
