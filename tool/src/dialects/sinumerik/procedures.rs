//! Subprograms with parameters (PROC), and those that run after each motion (MCALL).

use super::drilling::is_drilling;
use super::interpreter::Interpreter;
use super::routine::Routine;
use super::syntax::{Assigned, Block, Call, Parameter, Procedure, Statement, VariableKind};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::expression::{Expression, ExpressionKind, Value};
use crate::dialects::run::Next;
use crate::source::Span;

/// A subprogram that runs after each motion.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalCall {
    call: Call,
    running: bool,
}

/// Variables of the caller and the values that they get at the end.
pub(super) type Returned = Vec<(String, Vec<f64>, Value, Span)>;

/// A parameter with the value that a call gives it.
pub(super) struct Argument {
    name: String,
    kind: VariableKind,
    value: Option<Value>,
    span: Span,
    /// The variable of the caller that gets the value at the end (VAR).
    returns_to: Option<(String, Vec<f64>)>,
}

impl Interpreter<'_> {
    /// The head of a subprogram; one without PROC has neither parameters nor attributes.
    pub(super) fn head(&mut self, routine: &Routine) -> Procedure {
        let control = &mut self.control;
        let says = |block: &Block| block.statement != Statement::Empty;
        let head = routine
            .blocks
            .find(control.sources, control.diagnostics, says);
        match head.as_ref().map(|block| &block.statement) {
            Some(Statement::Procedure(head)) => head.clone(),
            _ => Procedure::default(),
        }
    }

    /// The values for the parameters of a subprogram, worked out where it is called.
    pub(super) fn arguments(
        &self,
        call: &Call,
        parameters: &[Parameter],
    ) -> Result<Vec<Argument>, Diagnostic> {
        if call.arguments.len() > parameters.len() {
            let name = &call.name;
            return Err(match parameters.len() {
                0 => Diagnostic::error(call.span, format!("{name} takes no values in parentheses"))
                    .help("declare them: PROC NAME(REAL DEPTH), or pass them in R parameters"),
                count => Diagnostic::error(
                    call.span,
                    format!(
                        "{name} takes {count} values, and {} are given",
                        call.arguments.len()
                    ),
                ),
            });
        }
        let given = call.arguments.iter().chain(std::iter::repeat(&None));
        parameters
            .iter()
            .zip(given)
            .map(|(parameter, given)| self.argument(parameter, given.as_ref(), call.span))
            .collect()
    }

    fn argument(
        &self,
        parameter: &Parameter,
        given: Option<&Expression>,
        span: Span,
    ) -> Result<Argument, Diagnostic> {
        let definition = &parameter.definition;
        let returns_to = match (parameter.returns, given.map(|given| &given.kind)) {
            (false, _) => None,
            (true, Some(ExpressionKind::Variable(name, index))) => {
                let index: Result<Vec<f64>, _> = index
                    .iter()
                    .map(|index| index.number(&self.variables))
                    .collect();
                Some((name.clone(), index?))
            }
            (true, _) => {
                return Err(Diagnostic::error(
                    given.map_or(span, |given| given.span),
                    format!(
                        "{} returns a value: a variable is needed here",
                        definition.name
                    ),
                )
                .help("declare a variable with DEF and name it in the call"));
            }
        };
        let initial = match &definition.value {
            Some(Assigned::One(value)) => Some(value),
            _ => None,
        };
        let value = match given.or(initial) {
            Some(value) => Some(value.evaluate(&self.variables)?),
            None => None,
        };
        Ok(Argument {
            name: definition.name.clone(),
            kind: definition.kind,
            value,
            span,
            returns_to,
        })
    }

    /// Declares the parameters in the subprogram that has begun.
    pub(super) fn define_parameters(&mut self, arguments: &[Argument]) -> Done {
        for argument in arguments {
            self.variables.define(
                &argument.name,
                argument.kind,
                Vec::new(),
                argument.value.clone(),
                argument.span,
            )?;
        }
        Ok(())
    }

    /// The values that go back to the caller, while the subprogram still has its variables.
    pub(super) fn returned(&self, arguments: &[Argument]) -> Result<Returned, Diagnostic> {
        use crate::dialects::expression::Variables;
        let mut list = Vec::new();
        for argument in arguments {
            if let Some((name, index)) = &argument.returns_to {
                let value = self.variables.value(&argument.name, &[], argument.span)?;
                list.push((name.clone(), index.clone(), value, argument.span));
            }
        }
        Ok(list)
    }

    /// Gives them to its variables.
    pub(super) fn assign_returned(&mut self, list: Returned) -> Done {
        for (name, index, value, span) in list {
            self.variables.assign(&name, &index, value, span)?;
        }
        Ok(())
    }

    /// `MCALL NAME(..)`, `MCALL`.
    pub(super) fn set_modal_call(&mut self, call: Option<&Call>) -> Done {
        if let Some(call) = call
            && matches!(
                call.name.as_str(),
                "POCKET3" | "POCKET4" | "SLOT1" | "LONGHOLE" | "CYCLE72"
            )
        {
            return Err(Diagnostic::error(
                call.span,
                format!("{} as a modal cycle is not supported", call.name),
            )
            .help("it has its own place: call it once for each, without MCALL"));
        }
        let drills = call.is_some_and(|call| is_drilling(&call.name));
        self.control.modal_cycle(drills);
        self.modal_call = None;
        if let Some(call) = call {
            self.modal_call = Some(ModalCall {
                call: self.call_with_values(call)?,
                running: false,
            });
        }
        Ok(())
    }

    /// A modal call with its arguments worked out where MCALL stands: variables that change later, and those of a
    /// subprogram that moves, are others.
    fn call_with_values(&mut self, call: &Call) -> Result<Call, Diagnostic> {
        if !is_drilling(&call.name) {
            self.refuse_returned(call)?;
        }
        let value = |given: &Expression| {
            let kind = match given.evaluate(&self.variables)? {
                Value::Number(number) => ExpressionKind::Number(number),
                Value::Text(text) => ExpressionKind::Text(text),
            };
            let span = given.span;
            Ok(Expression { kind, span })
        };
        let mut valued = call.clone();
        for given in valued.arguments.iter_mut().chain([&mut valued.passes]) {
            *given = given.as_ref().map(value).transpose()?;
        }
        Ok(valued)
    }

    /// Refuses VAR parameters in a modal call: their variable may not be there where the subprogram runs.
    fn refuse_returned(&mut self, call: &Call) -> Done {
        let (sources, diagnostics) = (&mut *self.control.sources, &mut *self.control.diagnostics);
        let Some(routine) = self.library.find(&call.name, sources, diagnostics) else {
            return Ok(());
        };
        let parameters = self.head(&routine).parameters;
        let mut returned = parameters.iter().filter(|parameter| parameter.returns);
        match returned.next() {
            None => Ok(()),
            Some(parameter) => Err(Diagnostic::error(
                call.span,
                format!(
                    "a modal call, and {} returns a value (VAR)",
                    parameter.definition.name
                ),
            )
            .help(
                "return it in an R parameter, or call the subprogram at each place without MCALL",
            )),
        }
    }

    /// Runs the modal subprogram after a motion. What it moves itself does not call it again.
    pub(super) fn run_modal_call(&mut self, block: &Block, at: usize) -> Result<Next, Diagnostic> {
        let next = Next::Block(at + 1);
        let Some(modal) = self.modal_call.clone().filter(|modal| !modal.running) else {
            return Ok(next);
        };
        self.set_running(true);
        let goes_on = self.try_call(&modal.call, block);
        self.set_running(false);
        Ok(if goes_on? { next } else { Next::Abort })
    }

    fn set_running(&mut self, running: bool) {
        if let Some(modal) = &mut self.modal_call {
            modal.running = running;
        }
    }
}
