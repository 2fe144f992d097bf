//! P parameters and the variables V.P., V.L. and V.S.

use super::syntax::Declaration;
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Value, Variables};
use crate::dialects::indices::{element, parameter_number};
use crate::source::Span;
use std::collections::{BTreeMap, HashMap};

/// How many elements the arrays of a program may have together.
const ELEMENT_LIMIT: usize = 1_000_000;

#[derive(Clone, Debug)]
struct Variable {
    size: Vec<usize>,
    /// The least and the greatest value of whole numbers.
    whole: Option<[f64; 2]>,
    values: Vec<f64>,
}

/// The values of all variables.
#[derive(Clone, Debug)]
pub struct VariableStore {
    parameters: HashMap<u32, f64>,
    /// V.P. and V.S.
    global: HashMap<String, Variable>,
    /// V.L. of the routines that are running, the innermost last.
    local: Vec<HashMap<String, Variable>>,
}

impl VariableStore {
    /// With the starting values of the settings, such as `P5` and `V.P.NAME`.
    pub fn new(given: &BTreeMap<String, f64>) -> VariableStore {
        let number = |name: &str| {
            name.strip_prefix('P')
                .and_then(|digits| digits.parse().ok())
        };
        let parameters = given
            .iter()
            .filter_map(|(name, value)| Some((number(name)?, *value)));
        let named = given.iter().filter(|(name, _)| name.starts_with("V."));
        VariableStore {
            parameters: parameters.collect(),
            global: named
                .map(|(name, value)| (name.clone(), Variable::single(*value)))
                .collect(),
            local: vec![HashMap::new()],
        }
    }

    /// A subprogram begins.
    pub fn enter(&mut self) {
        self.local.push(HashMap::new());
    }

    /// A subprogram ends.
    pub fn leave(&mut self) {
        self.local.pop();
    }

    /// Carries out a declaration whose sizes and values are evaluated.
    pub fn declare(
        &mut self,
        declaration: &Declaration,
        size: Vec<usize>,
        values: Vec<f64>,
    ) -> Result<(), Diagnostic> {
        let span = declaration.span;
        let count = size
            .iter()
            .try_fold(1_usize, |count, size| count.checked_mul(*size));
        let in_use = |variables: &HashMap<String, Variable>| -> usize {
            variables
                .values()
                .map(|variable| variable.values.len())
                .sum()
        };
        let used = in_use(&self.global) + self.local.iter().map(in_use).sum::<usize>();
        let count = count
            .filter(|count| count.saturating_add(used) <= ELEMENT_LIMIT)
            .ok_or_else(|| Diagnostic::error(span, "this array is too large"))?;
        if values.len() > 1 && values.len() != count {
            return Err(Diagnostic::error(
                span,
                format!("{} values for {count} elements", values.len()),
            ));
        }
        for value in &values {
            check_whole(declaration.whole, *value, span)?;
        }
        let values = match values.as_slice() {
            [] => vec![0.0; count],
            [single] => vec![*single; count],
            _ => values,
        };
        let variable = Variable {
            size,
            whole: declaration.whole,
            values,
        };
        self.scope(&declaration.name)
            .insert(declaration.name.clone(), variable);
        Ok(())
    }

    fn scope(&mut self, name: &str) -> &mut HashMap<String, Variable> {
        match self.local.last_mut() {
            Some(local) if name.starts_with("V.L.") => local,
            _ => &mut self.global,
        }
    }

    fn variable(&self, name: &str) -> Option<&Variable> {
        match self.local.last() {
            Some(local) if name.starts_with("V.L.") => local.get(name),
            _ => self.global.get(name),
        }
    }

    /// Gives a variable a value. Variables come into being when they get their first one.
    pub fn assign(
        &mut self,
        name: &str,
        index: &[f64],
        value: f64,
        span: Span,
    ) -> Result<(), Diagnostic> {
        if name == "P" {
            self.parameters
                .insert(parameter_number(index, "a P parameter", span)?, value);
            return Ok(());
        }
        let scope = self.scope(name);
        let Some(variable) = scope.get_mut(name) else {
            if !index.is_empty() {
                return Err(unknown(name, span));
            }
            scope.insert(name.to_string(), Variable::single(value));
            return Ok(());
        };
        check_whole(variable.whole, value, span)?;
        let at = element(&variable.size, index, span)?;
        if let Some(place) = variable.values.get_mut(at) {
            *place = value;
        }
        Ok(())
    }
}

impl Variable {
    fn single(value: f64) -> Variable {
        Variable {
            size: Vec::new(),
            whole: None,
            values: vec![value],
        }
    }
}

impl Variables for VariableStore {
    fn value(&self, name: &str, index: &[f64], span: Span) -> Result<Value, Diagnostic> {
        if name == "P" {
            let number = parameter_number(index, "a P parameter", span)?;
            let value = self.parameters.get(&number).copied();
            return value.map(Value::Number).ok_or_else(|| {
                Diagnostic::error(span, format!("P{number} has no value here")).help(format!(
                    "assign it in the program, or give --set P{number}=VALUE"
                ))
            });
        }
        let variable = self.variable(name).ok_or_else(|| unknown(name, span))?;
        let at = element(&variable.size, index, span)?;
        variable
            .values
            .get(at)
            .map(|value| Value::Number(*value))
            .ok_or_else(|| Diagnostic::error(span, "there is no such element"))
    }
}

fn unknown(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error(span, format!("{name} has no value here")).help(format!(
        "declare it between #VAR and #ENDVAR, or give --set {name}=VALUE"
    ))
}

/// The control would round by rules of its own.
fn check_whole(whole: Option<[f64; 2]>, value: f64, span: Span) -> Result<(), Diagnostic> {
    let Some([least, most]) = whole else {
        return Ok(());
    };
    if value.fract() == 0.0 {
        return match (least..=most).contains(&value) {
            true => Ok(()),
            false => Err(Diagnostic::error(
                span,
                format!(
                    "{value} does not fit into a variable for whole numbers from {least} to {most}"
                ),
            )
            .help("declare a type that has room for it, such as SGN32 or REAL64")),
        };
    }
    Err(Diagnostic::error(
        span,
        format!("{value} does not fit into a variable for whole numbers"),
    )
    .help("round it with INT[..] or ROUND[..], or declare the variable REAL64"))
}
