//! P parameters: P0 to P25 belong to the nesting level of parameters, the others to the control.

use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Value, Variables};
use crate::source::Span;
use std::collections::{BTreeMap, HashMap};

/// The highest local parameter.
const LAST_LOCAL: u32 = 25;

/// The values of all parameters.
#[derive(Clone, Debug)]
pub struct Parameters {
    global: HashMap<u32, f64>,
    levels: Vec<HashMap<u32, f64>>,
}

impl Parameters {
    /// With the starting values of the settings, such as `P5`.
    pub fn new(given: &BTreeMap<String, f64>) -> Parameters {
        let mut parameters = Parameters {
            global: HashMap::new(),
            levels: vec![HashMap::new()],
        };
        for (name, value) in given {
            if let Some(number) = name.strip_prefix('P').and_then(|n| n.parse().ok()) {
                parameters.set(number, *value);
            }
        }
        parameters
    }

    /// A subroutine with parameters of its own begins.
    pub fn enter(&mut self, given: &[(u32, f64)]) {
        self.levels.push(HashMap::new());
        for (number, value) in given {
            self.set(*number, *value);
        }
    }

    /// It ends.
    pub fn leave(&mut self) {
        self.levels.pop();
    }

    /// Gives a parameter a value.
    pub fn assign(&mut self, number: f64, value: f64, span: Span) -> Result<(), Diagnostic> {
        let number = checked(number, span)?;
        self.set(number, value);
        Ok(())
    }

    fn set(&mut self, number: u32, value: f64) {
        let place = match self.levels.last_mut() {
            Some(level) if number <= LAST_LOCAL => level,
            _ => &mut self.global,
        };
        place.insert(number, value);
    }
}

/// The number of a parameter that there is.
pub fn checked(number: f64, span: Span) -> Result<u32, Diagnostic> {
    let exists = matches!(number, 0.0..=299.0 | 1000.0..=1255.0 | 2000.0..=2255.0);
    if exists && number.fract() == 0.0 {
        return Ok(number as u32);
    }
    Err(
        Diagnostic::error(span, format!("there is no parameter P{number}"))
            .help("P0 to P25 are local, P26 to P299, P1000 to P1255 and P2000 to P2255 global"),
    )
}

impl Variables for Parameters {
    fn value(&self, _name: &str, index: &[f64], span: Span) -> Result<Value, Diagnostic> {
        let number = checked(index.first().copied().unwrap_or(-1.0), span)?;
        let place = match self.levels.last() {
            Some(level) if number <= LAST_LOCAL => level,
            _ => &self.global,
        };
        match place.get(&number) {
            Some(value) => Ok(Value::Number(*value)),
            None => Err(Diagnostic::error(
                span,
                format!("P{number} has no value here: the control would take what it had last"),
            )
            .help(format!(
                "assign it in the program: (P{number}=5), or give --set P{number}=5"
            ))),
        }
    }
}
