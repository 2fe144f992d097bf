//! R parameters and the variables that a program declares.

use super::syntax::VariableKind;
use super::words;
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Value, Variables};
use crate::dialects::indices::{element, parameter_number};
use crate::source::Span;
use std::collections::{BTreeMap, HashMap};

/// How many elements the arrays of a program may have together.
const ELEMENT_LIMIT: usize = 1_000_000;

/// How many R parameters there are.
const R_COUNT: usize = 32768;

/// What a variable, or an array from one of its elements on, is given.
#[derive(Clone, Debug, PartialEq)]
pub enum Filling {
    /// A value.
    One(Value),
    /// A value each; an element without one keeps what it has.
    Each(Vec<Option<Value>>),
    /// The same for so many elements, or for all that follow.
    Same(Value, Option<usize>),
}

#[derive(Clone, Debug)]
struct Variable {
    kind: VariableKind,
    size: Vec<usize>,
    values: Vec<Value>,
}

/// The values of all variables.
#[derive(Clone, Debug)]
pub struct VariableStore {
    /// R parameters belong to the control, the others to the program or subprogram that declares them.
    r: HashMap<u32, f64>,
    scopes: Vec<HashMap<String, Variable>>,
}

impl VariableStore {
    /// With the starting values of the settings, such as `R5`.
    pub fn new(given: &BTreeMap<String, f64>) -> VariableStore {
        let r = given.iter().filter_map(|(name, value)| {
            let number = name.strip_prefix(['R', 'r'])?.parse().ok()?;
            Some((number, *value))
        });
        VariableStore {
            r: r.collect(),
            scopes: vec![HashMap::new()],
        }
    }

    /// A subprogram begins.
    pub fn enter(&mut self) {
        self.scopes.push(HashMap::new());
    }

    /// A subprogram ends.
    pub fn leave(&mut self) {
        self.scopes.pop();
    }

    /// Declares a variable, or an array with these sizes, with one value for all its elements.
    pub fn define(
        &mut self,
        name: &str,
        kind: VariableKind,
        size: Vec<usize>,
        value: Option<Value>,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let count = size
            .iter()
            .try_fold(1_usize, |count, size| count.checked_mul(*size));
        let count = count
            .filter(|count| *count <= ELEMENT_LIMIT)
            .ok_or_else(|| Diagnostic::error(span, "this array is too large"))?;
        let initial = value.unwrap_or(match kind {
            VariableKind::Text => Value::Text(String::new()),
            _ => Value::Number(0.0),
        });
        let initial = converted(kind, initial, span)?;
        if let Some(scope) = self.scopes.last_mut() {
            let values = vec![initial; count];
            scope.insert(name.to_string(), Variable { kind, size, values });
        }
        Ok(())
    }

    /// Gives a variable a value, or values to the elements of an array from `index` on.
    pub fn fill(
        &mut self,
        name: &str,
        index: &[f64],
        filling: Filling,
        span: Span,
    ) -> Result<(), Diagnostic> {
        if let Filling::One(value) = filling {
            return self.assign(name, index, value, span);
        }
        let (begin, length) = self.room(name, index, span)?;
        let too_many = |count: usize| {
            Diagnostic::error(
                span,
                format!(
                    "{count} values, and {} elements from here on",
                    length - begin
                ),
            )
            .help("check the size of the array and the first index")
        };
        let values: Vec<Option<Value>> = match filling {
            Filling::One(_) => Vec::new(),
            Filling::Each(values) => values,
            Filling::Same(_, None) if name == "R" => {
                return Err(
                    Diagnostic::error(span, "REP of R parameters needs a number of them")
                        .help("write REP(0,10)"),
                );
            }
            Filling::Same(value, count) => {
                let count = count.unwrap_or(length - begin);
                if count > length - begin {
                    return Err(too_many(count));
                }
                vec![Some(value); count]
            }
        };
        if values.len() > length - begin {
            return Err(too_many(values.len()));
        }
        for (at, value) in values.into_iter().enumerate() {
            if let Some(value) = value {
                self.put(name, begin + at, value, span)?;
            }
        }
        Ok(())
    }

    /// Where an element stands among the elements of its variable in one row, and how many there are.
    fn room(&self, name: &str, index: &[f64], span: Span) -> Result<(usize, usize), Diagnostic> {
        if name == "R" {
            let number = parameter_number(index, "an R parameter", span)?;
            return Ok((number as usize, R_COUNT));
        }
        let variable = self.scopes.last().and_then(|scope| scope.get(name));
        let variable = variable.ok_or_else(|| unknown(name, span))?;
        let at = element(&variable.size, index, span)?;
        Ok((at, variable.values.len()))
    }

    fn put(&mut self, name: &str, at: usize, value: Value, span: Span) -> Result<(), Diagnostic> {
        if name == "R" {
            return self.assign(name, &[at as f64], value, span);
        }
        let variable = self.scopes.last_mut().and_then(|scope| scope.get_mut(name));
        let variable = variable.ok_or_else(|| unknown(name, span))?;
        let kind = variable.kind;
        if let Some(place) = variable.values.get_mut(at) {
            *place = converted(kind, value, span)?;
        }
        Ok(())
    }

    /// Gives a variable a value.
    pub fn assign(
        &mut self,
        name: &str,
        index: &[f64],
        value: Value,
        span: Span,
    ) -> Result<(), Diagnostic> {
        if name == "R" {
            let number = parameter_number(index, "an R parameter", span)?;
            let Value::Number(value) = value else {
                return Err(Diagnostic::error(span, "R parameters are numbers"));
            };
            self.r.insert(number, value);
            return Ok(());
        }
        let (at, _) = self.room(name, index, span)?;
        self.put(name, at, value, span)
    }
}

impl Variables for VariableStore {
    fn value(&self, name: &str, index: &[f64], span: Span) -> Result<Value, Diagnostic> {
        if name == "R" {
            let number = parameter_number(index, "an R parameter", span)?;
            return self
                .r
                .get(&number)
                .map(|value| Value::Number(*value))
                .ok_or_else(|| {
                    Diagnostic::error(
                        span,
                        format!(
                            "R{number} has no value here: the control would take what it had last"
                        ),
                    )
                    .help(format!(
                        "assign it in the program, or give --set R{number}=VALUE"
                    ))
                });
        }
        let variable = self
            .scopes
            .last()
            .and_then(|scope| scope.get(name))
            .ok_or_else(|| unknown(name, span))?;
        let at = element(&variable.size, index, span)?;
        variable
            .values
            .get(at)
            .cloned()
            .ok_or_else(|| Diagnostic::error(span, "there is no such element"))
    }
}

fn unknown(name: &str, span: Span) -> Diagnostic {
    let error = Diagnostic::error(span, format!("`{name}` is not declared"));
    if name.starts_with('$') {
        Diagnostic::error(
            span,
            format!("{name}: system variables cannot be evaluated ahead of time"),
        )
    } else if words::is_reserved(name) {
        words::no_variable(name, span)
    } else {
        error.help(format!("declare it before its first use: DEF REAL {name}"))
    }
}

/// The value as a variable of this kind holds it.
fn converted(kind: VariableKind, value: Value, span: Span) -> Result<Value, Diagnostic> {
    Ok(match (kind, value) {
        (VariableKind::Text, Value::Text(text)) => Value::Text(text),
        (VariableKind::Real, Value::Number(number)) => Value::Number(number),
        (VariableKind::Whole, Value::Number(number)) => Value::Number(number.round()),
        (VariableKind::Truth, Value::Number(number)) => {
            Value::Number(f64::from(u8::from(number != 0.0)))
        }
        _ => {
            return Err(Diagnostic::error(
                span,
                "a text and a number cannot take each other's place",
            ));
        }
    })
}
