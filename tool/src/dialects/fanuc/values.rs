//! The values of expressions. A variable can be vacant: it counts as 0 in arithmetic, is equal to nothing
//! but another vacant one, and a word with a vacant value is not there. (Fanuc, Series 30i, User's
//! Manual, "Custom macro: undefined variable".)

use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{
    Binary, Expression, ExpressionKind, Function, Value, Variables as NoVariables,
};
use crate::source::Span;

/// A number, or nothing where the value is vacant.
pub type Reading = Result<Option<f64>, Diagnostic>;

/// Where the values of variables come from.
pub trait Lookup {
    /// The value of a variable by its number.
    fn read(&self, number: f64, span: Span) -> Reading;

    /// To multiples of what ROUND rounds; `None` where that is not known.
    fn least_increment(&self) -> Option<f64> {
        Some(1.0)
    }
}

/// The variables for the value of a word: ROUND rounds to the least increment of its address there.
pub struct InWord<'a> {
    /// The variables.
    pub lookup: &'a dyn Lookup,
    /// The least increment.
    pub step: Option<f64>,
}

impl Lookup for InWord<'_> {
    fn read(&self, number: f64, span: Span) -> Reading {
        self.lookup.read(number, span)
    }

    fn least_increment(&self) -> Option<f64> {
        self.step
    }
}

/// The value of an expression.
pub fn value(expression: &Expression, lookup: &dyn Lookup) -> Reading {
    let literal = |operand: &Expression| -> Result<Expression, Diagnostic> {
        Ok(Expression {
            kind: ExpressionKind::Number(number(operand, lookup)?),
            span: operand.span,
        })
    };
    let kind = match &expression.kind {
        ExpressionKind::Variable(_, index) => {
            let index = index
                .first()
                .map_or(Ok(0.0), |index| number(index, lookup))?;
            return lookup.read(index, expression.span);
        }
        ExpressionKind::Group(inner) => return value(inner, lookup),
        ExpressionKind::Binary(operator @ (Binary::Equal | Binary::NotEqual), left, right) => {
            let vacant = [value(left, lookup)?, value(right, lookup)?].map(|side| side.is_none());
            if vacant != [false; 2] {
                let equal = vacant == [true; 2];
                let holds = equal == (*operator == Binary::Equal);
                return Ok(Some(f64::from(u8::from(holds))));
            }
            ExpressionKind::Binary(
                *operator,
                Box::new(literal(left)?),
                Box::new(literal(right)?),
            )
        }
        ExpressionKind::Binary(operator, left, right) if operator.is_logic() => {
            let [left, right] = [bits(left, lookup)?, bits(right, lookup)?];
            let value = match operator {
                Binary::And => left & right,
                Binary::Or => left | right,
                _ => left ^ right,
            };
            return Ok(Some(f64::from(value)));
        }
        ExpressionKind::Binary(operator, left, right) => ExpressionKind::Binary(
            *operator,
            Box::new(literal(left)?),
            Box::new(literal(right)?),
        ),
        ExpressionKind::Function(Function::Round, arguments) => {
            let value = arguments
                .first()
                .map_or(Ok(0.0), |value| number(value, lookup))?;
            let step = lookup.least_increment().ok_or_else(|| {
                Diagnostic::error(
                    expression.span,
                    "what ROUND rounds to is a setting of the control here",
                )
                .help("assign it before: #1=ROUND[#1] rounds to whole numbers")
            })?;
            return Ok(Some((value / step).round() * step));
        }
        ExpressionKind::Function(Function::RoundUp, arguments) => {
            // Away from zero.
            let value = arguments
                .first()
                .map_or(Ok(0.0), |value| number(value, lookup))?;
            return Ok(Some(value.abs().ceil().copysign(value)));
        }
        ExpressionKind::Function(function, arguments) => {
            let literals: Result<Vec<Expression>, _> = arguments.iter().map(literal).collect();
            ExpressionKind::Function(*function, literals?)
        }
        ExpressionKind::Unary(sign, operand) => {
            // The sign of a vacant value leaves it vacant.
            if value(operand, lookup)?.is_none() {
                return Ok(None);
            }
            ExpressionKind::Unary(*sign, Box::new(literal(operand)?))
        }
        other => other.clone(),
    };
    let arithmetic = Expression {
        kind,
        span: expression.span,
    };
    let value = arithmetic.number(&Nothing)?;
    Ok(Some(match arithmetic.kind {
        // The control answers from 270 to 90 degrees.
        ExpressionKind::Function(Function::Asin, _) => value.rem_euclid(360.0),
        _ => value,
    }))
}

/// The value of an expression; a vacant one is 0.
pub fn number(expression: &Expression, lookup: &dyn Lookup) -> Result<f64, Diagnostic> {
    Ok(value(expression, lookup)?.unwrap_or(0.0))
}

/// The value as bits.
fn bits(expression: &Expression, lookup: &dyn Lookup) -> Result<i32, Diagnostic> {
    let value = number(expression, lookup)?;
    let range = f64::from(i32::MIN)..=f64::from(i32::MAX);
    match value.fract() == 0.0 && range.contains(&value) {
        true => Ok(value as i32),
        false => Err(
            Diagnostic::error(expression.span, format!("{value} has no bits"))
                .help("AND, OR and XOR join comparisons, or the bits of whole numbers"),
        ),
    }
}

/// Variables have been replaced by their values.
struct Nothing;

impl NoVariables for Nothing {
    fn value(&self, _: &str, _: &[f64], span: Span) -> Result<Value, Diagnostic> {
        Err(Diagnostic::error(span, "this has no value"))
    }
}
