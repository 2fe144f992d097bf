//! The words of one block, evaluated and sorted by address.

use super::syntax::{Word, WordValue};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::expression::{Value, Variables};
use crate::source::Span;

/// The axes in the order of LinuxCNC.
pub const AXES: [&str; 9] = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"];

/// A value and where its word stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At<T> {
    /// The value.
    pub value: T,
    /// The word.
    pub span: Span,
}

/// Whether a coordinate is absolute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// As G90 and G91 say.
    Modal,
    /// `AC(..)`.
    Absolute,
    /// `IC(..)`.
    Incremental,
}

/// The tool word.
#[derive(Clone, Debug, PartialEq)]
pub enum ToolWord {
    /// `T3`.
    Number(f64),
    /// `T="MILL_10"`.
    Name(String),
}

/// All words of a block.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlockWords {
    /// G numbers times ten: 591 is G59.1.
    pub g: Vec<At<u32>>,
    pub m: Vec<At<u32>>,
    pub axes: [Option<At<(f64, Dimension)>>; 9],
    /// I J K.
    pub centre: [Option<At<(f64, Dimension)>>; 3],
    pub radius: Option<At<f64>>,
    pub turns: Option<At<f64>>,
    pub feed: Option<At<f64>>,
    pub speed: Option<At<f64>>,
    pub tool: Option<At<()>>,
    pub tool_word: Option<ToolWord>,
    pub offset: Option<At<f64>>,
    /// ADIS or CTOL.
    pub tolerance: Option<At<f64>>,
    pub supa: Option<Span>,
    pub end_of_routine: Option<Span>,
    /// Commands that only tune the control.
    pub noted: Vec<At<String>>,
}

impl BlockWords {
    /// Evaluates the words in their order. `None` when something was wrong with one of them; that has
    /// been reported.
    pub fn collect(
        words: &[Word],
        variables: &dyn Variables,
        diagnostics: &mut Diagnostics,
    ) -> Option<BlockWords> {
        let before = diagnostics.errors();
        let mut block = BlockWords::default();
        let mut failed = false;
        for word in words {
            if let Err(diagnostic) = block.add(word, variables) {
                diagnostics.push(*diagnostic);
                failed = true;
            }
        }
        (!failed && diagnostics.errors() == before).then_some(block)
    }

    fn add(&mut self, word: &Word, variables: &dyn Variables) -> Result<(), Box<Diagnostic>> {
        let span = word.span;
        let address = word.address.as_str();
        if let Some(axis) = AXES.iter().position(|axis| *axis == address) {
            return set(
                &mut self.axes[axis],
                dimensioned(word, variables)?,
                span,
                address,
            );
        }
        if let Some(axis) = ["I", "J", "K"].iter().position(|axis| *axis == address) {
            return set(
                &mut self.centre[axis],
                dimensioned(word, variables)?,
                span,
                address,
            );
        }
        match address {
            "G" => {
                let value = ten_times_code(number(word, variables)?, span)?;
                self.g.push(At { value, span });
                Ok(())
            }
            "M" | "M1" => {
                let value = ten_times_code(number(word, variables)?, span)?;
                if value % 10 != 0 {
                    return Err(error(span, "M numbers are whole"));
                }
                let value = value / 10;
                if address == "M1" && !matches!(value, 3..=5) {
                    return Err(error(span, "only M1=3, M1=4 and M1=5 are supported"));
                }
                self.m.push(At { value, span });
                Ok(())
            }
            "CR" => set(&mut self.radius, number(word, variables)?, span, address),
            "TURN" => set(&mut self.turns, number(word, variables)?, span, address),
            "F" => set(&mut self.feed, number(word, variables)?, span, address),
            "S" | "S1" => set(&mut self.speed, number(word, variables)?, span, "S"),
            "D" => set(&mut self.offset, number(word, variables)?, span, address),
            "ADIS" | "CTOL" => set(&mut self.tolerance, number(word, variables)?, span, address),
            "T" | "T1" => self.tool(word, variables),
            "SUPA" => {
                self.supa = Some(span);
                Ok(())
            }
            "RET" => {
                self.end_of_routine = Some(span);
                Ok(())
            }
            _ if super::words::is_noted(address) => {
                let value = address.to_string();
                self.noted.push(At { value, span });
                Ok(())
            }
            "N" => Err(Box::new(
                Diagnostic::error(span, "the block number stands at the beginning of the block"),
            )),
            "H" => Err(Box::new(
                Diagnostic::error(span, "H functions are not supported")
                    .help("they switch something on this one machine: use an M function that LinuxCNC has"),
            )),
            "P" => Err(Box::new(
                Diagnostic::error(span, "P has no meaning here")
                    .help("P gives the number of passes after a subprogram call: L10 P3"),
            )),
            "RPL" => Err(Box::new(
                Diagnostic::error(span, "RPL has no meaning here").help("it belongs to ROT and AROT"),
            )),
            _ => Err(Box::new(
                Diagnostic::error(span, format!("the address {address} is not supported"))
                    .help("axes are X Y Z A B C U V W"),
            )),
        }
    }

    fn tool(&mut self, word: &Word, variables: &dyn Variables) -> Result<(), Box<Diagnostic>> {
        set(&mut self.tool, (), word.span, "T")?;
        let WordValue::Plain(value) = &word.value else {
            return Err(error(word.span, "a tool number or a name is needed here"));
        };
        self.tool_word = Some(match value.evaluate(variables)? {
            Value::Number(number) => ToolWord::Number(number),
            Value::Text(name) => ToolWord::Name(name),
        });
        Ok(())
    }

    /// Whether any axis is named.
    pub fn names_an_axis(&self) -> bool {
        self.axes.iter().any(Option::is_some)
    }

    /// Where the first axis word stands.
    pub fn first_axis(&self) -> Option<Span> {
        let spans = self.axes.iter().flatten().map(|axis| axis.span);
        spans.min_by_key(|span| span.start)
    }

    /// Whether I, J, K or CR is there.
    pub fn names_a_centre(&self) -> bool {
        self.radius.is_some() || self.centre.iter().any(Option::is_some)
    }
}

fn error(span: Span, message: &str) -> Box<Diagnostic> {
    Box::new(Diagnostic::error(span, message))
}

fn set<T>(
    place: &mut Option<At<T>>,
    value: T,
    span: Span,
    address: &str,
) -> Result<(), Box<Diagnostic>> {
    if place.is_some() {
        return Err(error(span, &format!("{address} is in this block twice")));
    }
    *place = Some(At { value, span });
    Ok(())
}

fn number(word: &Word, variables: &dyn Variables) -> Result<f64, Box<Diagnostic>> {
    match &word.value {
        WordValue::Plain(value) => value.number(variables),
        _ => Err(error(word.span, "AC and IC belong to axes and to I, J, K")),
    }
}

fn dimensioned(
    word: &Word,
    variables: &dyn Variables,
) -> Result<(f64, Dimension), Box<Diagnostic>> {
    let (value, dimension) = match &word.value {
        WordValue::Plain(value) => (value, Dimension::Modal),
        WordValue::Absolute(value) => (value, Dimension::Absolute),
        WordValue::Incremental(value) => (value, Dimension::Incremental),
        WordValue::None => return Err(error(word.span, "a value is missing here")),
    };
    Ok((value.number(variables)?, dimension))
}

/// Numbers of G and M functions have at most one decimal.
fn ten_times_code(number: f64, span: Span) -> Result<u32, Box<Diagnostic>> {
    let tenfold = (number * 10.0).round();
    if !(0.0..=99990.0).contains(&tenfold) || (tenfold - number * 10.0).abs() > 1e-9 {
        return Err(error(span, "this is not the number of a function"));
    }
    Ok(tenfold as u32)
}
