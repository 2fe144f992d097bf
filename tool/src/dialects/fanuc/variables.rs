//! Variables: #1 to #33 belong to the macro that runs, #100 to #199 and #500 to #999 to all programs.

use super::values::Reading;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::source::Span;
use std::collections::{BTreeMap, HashMap};

/// The local variables of a macro; `None` for one that is vacant.
pub type Locals = HashMap<u32, Option<f64>>;

/// The values of all variables of programs.
#[derive(Clone, Debug)]
pub struct Variables {
    common: HashMap<u32, Option<f64>>,
    /// Of the main program, and of the macros inside each other.
    levels: Vec<Locals>,
}

/// Where a variable is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// #0, which is always vacant.
    Vacant,
    /// #1 to #33.
    Local(u32),
    /// #100 to #199 and #500 to #999.
    Common(u32),
    /// #1000 and up.
    System(u32),
}

impl Variables {
    /// With the starting values of the settings, such as `#500`.
    pub fn new(given: &BTreeMap<String, f64>) -> Variables {
        let mut variables = Variables {
            common: HashMap::new(),
            levels: vec![Locals::new()],
        };
        for (name, value) in given {
            let number = name
                .strip_prefix('#')
                .and_then(|number| number.parse().ok());
            match number {
                Some(number @ 1..=33) => variables.set_local(number, Some(*value)),
                Some(number) => {
                    variables.common.insert(number, Some(*value));
                }
                None => {}
            }
        }
        variables
    }

    /// A macro with these local variables begins.
    pub fn enter(&mut self, locals: Locals) {
        self.levels.push(locals);
    }

    /// It ends; its local variables.
    pub fn leave(&mut self) -> Locals {
        match self.levels.len() {
            1 => Locals::new(),
            _ => self.levels.pop().unwrap_or_default(),
        }
    }

    fn set_local(&mut self, number: u32, value: Option<f64>) {
        if let Some(level) = self.levels.last_mut() {
            level.insert(number, value);
        }
    }

    /// Gives a variable of a program a value.
    pub fn set(&mut self, place: Place, value: Option<f64>, span: Span) -> Done {
        match place {
            Place::Local(number) => self.set_local(number, value),
            Place::Common(number) => {
                self.common.insert(number, value);
            }
            Place::Vacant | Place::System(_) => {
                return Err(
                    Diagnostic::error(span, "#0 is always vacant and takes no value")
                        .help("use #1 to #33, #100 to #199 or #500 to #999"),
                );
            }
        }
        Ok(())
    }

    /// The value of a local or common variable.
    pub fn get(&self, place: Place, span: Span) -> Reading {
        let (number, value) = match place {
            Place::Vacant | Place::System(_) => return Ok(None),
            Place::Local(number) => {
                let value = self.levels.last().and_then(|level| level.get(&number));
                // What a macro was not given is vacant.
                if value.is_none() && self.levels.len() > 1 {
                    return Ok(None);
                }
                (number, value)
            }
            Place::Common(number) => (number, self.common.get(&number)),
        };
        value.copied().ok_or_else(|| {
            Diagnostic::error(
                span,
                format!("#{number} has no value here: the control would take what it had last"),
            )
            .help(format!(
                "assign it in the program: #{number}=5, or give --set '#{number}=5'"
            ))
        })
    }
}

/// Where the variable with this number is kept.
pub fn place(number: f64, span: Span) -> Result<Place, Diagnostic> {
    if number.fract() == 0.0 && (0.0..=99_999.0).contains(&number) {
        match number as u32 {
            0 => return Ok(Place::Vacant),
            local @ 1..=33 => return Ok(Place::Local(local)),
            common @ (100..=199 | 500..=999) => return Ok(Place::Common(common)),
            system @ 1000.. => return Ok(Place::System(system)),
            _ => {}
        }
    }
    Err(Diagnostic::error(span, format!("there is no variable #{number}")).help(
            "#1 to #33 are local, #100 to #199 and #500 to #999 common, #1000 and up those of the control",
        ))
}
