//! Arithmetic of part programs: the tree that the parsers of all dialects build, and its value.

use crate::diagnostics::Diagnostic;
use crate::source::Span;
use framepath::frame::angle::sin_cos_degrees;

/// An expression and where it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    /// What it is.
    pub kind: ExpressionKind,
    /// Where it was written.
    pub span: Span,
}

/// The kinds of expressions.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpressionKind {
    /// A number.
    Number(f64),
    /// A text in quotes.
    Text(String),
    /// A variable, with its index if it is an element of an array.
    Variable(String, Vec<Expression>),
    /// A sign or a negation.
    Unary(Unary, Box<Expression>),
    /// Two operands.
    Binary(Binary, Box<Expression>, Box<Expression>),
    /// A function of numbers.
    Function(Function, Vec<Expression>),
    /// In parentheses. Kept, because without them some mixtures of operators are refused.
    Group(Box<Expression>),
}

/// Operators with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unary {
    /// `-`.
    Negate,
    /// NOT.
    Not,
    /// All bits of a whole number of 32 bits.
    BitNot,
}

/// Operators with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names are the operators")]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    WholeDivide,
    Remainder,
    Power,
    And,
    Or,
    ExclusiveOr,
    BitAnd,
    BitOr,
    BitExclusiveOr,
    Concatenate,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

impl Binary {
    /// Whether the result is a truth value made from two numbers.
    pub fn is_comparison(self) -> bool {
        use Binary::*;
        matches!(
            self,
            Equal | NotEqual | Less | LessOrEqual | Greater | GreaterOrEqual
        )
    }

    /// Whether the operands are truth values.
    pub fn is_logic(self) -> bool {
        matches!(self, Binary::And | Binary::Or | Binary::ExclusiveOr)
    }
}

/// Functions; angles in degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names are the functions")]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan2,
    SquareRoot,
    Absolute,
    Square,
    Truncate,
    Round,
    NaturalLogarithm,
    DecimalLogarithm,
    Exponential,
    /// The next whole number upwards; of positive numbers only.
    RoundUp,
    /// The arc tangent from -90 to 90 degrees.
    Atan,
    /// `ARG(x, y)`: the direction of a point, from 0 to 360 degrees.
    Direction,
    Minimum,
    Maximum,
    /// `BOUND(least, largest, value)`.
    Bound,
}

/// Functions that several dialects call by these names.
pub const FUNCTIONS: [(&str, Function); 11] = [
    ("SIN", Function::Sin),
    ("COS", Function::Cos),
    ("TAN", Function::Tan),
    ("ASIN", Function::Asin),
    ("ACOS", Function::Acos),
    ("ATAN", Function::Atan),
    ("SQRT", Function::SquareRoot),
    ("ABS", Function::Absolute),
    ("ROUND", Function::Round),
    ("LN", Function::NaturalLogarithm),
    ("LOG", Function::DecimalLogarithm),
];

impl Function {
    /// For which arguments it has a value.
    fn domain(self) -> &'static str {
        match self {
            Function::SquareRoot => "a root is of a number that is not negative",
            Function::NaturalLogarithm | Function::DecimalLogarithm => {
                "a logarithm is of a number above 0"
            }
            Function::Asin | Function::Acos => {
                "the sine and the cosine of an angle go from -1 to 1"
            }
            Function::Tan => "the tangent of 90 degrees is infinite",
            Function::RoundUp => {
                "whether a negative number is rounded up towards 0 or away from it is not known: round its \
                 absolute value, or to the nearest whole number"
            }
            Function::Bound => "the least value comes first, then the largest, then the number",
            _ => "check the values of its arguments: the result is too large",
        }
    }

    /// How many arguments it takes.
    pub fn arguments(self) -> usize {
        match self {
            Function::Atan2 | Function::Direction | Function::Minimum | Function::Maximum => 2,
            Function::Bound => 3,
            _ => 1,
        }
    }
}

/// A value while a program is evaluated.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number, or a truth value as 1 or 0. Always finite.
    Number(f64),
    /// A text.
    Text(String),
}

/// Where the values of variables come from.
pub trait Variables {
    /// The value of a variable, or of an element of an array; an error at `span` if there is none.
    fn value(&self, name: &str, index: &[f64], span: Span) -> Result<Value, Diagnostic>;
}

impl Expression {
    /// The value of the expression; never an infinite number or NaN.
    pub fn evaluate(&self, variables: &dyn Variables) -> Result<Value, Diagnostic> {
        let value = match &self.kind {
            ExpressionKind::Number(number) => Value::Number(*number),
            ExpressionKind::Text(text) => Value::Text(text.clone()),
            ExpressionKind::Group(inner) => inner.evaluate(variables)?,
            ExpressionKind::Variable(name, index) => {
                let index = numbers(index, variables)?;
                variables.value(name, &index, self.span)?
            }
            ExpressionKind::Unary(operator, operand) => {
                let operand = operand.number(variables)?;
                Value::Number(match operator {
                    Unary::Negate => -operand,
                    Unary::Not => truth(operand == 0.0),
                    Unary::BitNot => f64::from(!self.bits(operand)?),
                })
            }
            ExpressionKind::Binary(operator, left, right) => {
                self.binary(*operator, left, right, variables)?
            }
            ExpressionKind::Function(function, arguments) => {
                let arguments = numbers(arguments, variables)?;
                Value::Number(apply(*function, &arguments).ok_or_else(|| {
                    self.error("this function has no value for these arguments")
                        .help(function.domain())
                })?)
            }
        };
        match value {
            Value::Number(number) if !number.is_finite() => {
                Err(self.error("the result is not a finite number"))
            }
            _ => Ok(value),
        }
    }

    /// The value, which must be a number.
    pub fn number(&self, variables: &dyn Variables) -> Result<f64, Diagnostic> {
        match self.evaluate(variables)? {
            Value::Number(number) => Ok(number),
            Value::Text(_) => Err(self.error("a number is needed here, this is a text")),
        }
    }

    /// The value, which must be a whole number of at least `least`.
    pub fn whole(&self, variables: &dyn Variables, least: u32) -> Result<u32, Diagnostic> {
        let number = self.number(variables)?;
        if number.fract() != 0.0 || number < f64::from(least) || number > f64::from(u32::MAX) {
            return Err(self.error(format!(
                "{number} does not fit here: a whole number of at least {least} is needed"
            )));
        }
        Ok(number as u32)
    }

    fn binary(
        &self,
        operator: Binary,
        left: &Expression,
        right: &Expression,
        variables: &dyn Variables,
    ) -> Result<Value, Diagnostic> {
        let (left_value, right_value) = (left.evaluate(variables)?, right.evaluate(variables)?);
        if operator == Binary::Concatenate {
            return Ok(Value::Text(text(&left_value) + &text(&right_value)));
        }
        let (a, b) = match (left_value, right_value) {
            (Value::Number(a), Value::Number(b)) => (a, b),
            (Value::Text(a), Value::Text(b)) if operator == Binary::Equal => {
                return Ok(Value::Number(truth(a == b)));
            }
            (Value::Text(a), Value::Text(b)) if operator == Binary::NotEqual => {
                return Ok(Value::Number(truth(a != b)));
            }
            _ => return Err(self.error("texts can only be joined (<<) or compared for equality")),
        };
        let divides = matches!(
            operator,
            Binary::Divide | Binary::WholeDivide | Binary::Remainder
        );
        if divides && b == 0.0 {
            return Err(Diagnostic::error(right.span, "division by zero: this is 0"));
        }
        let same = equal(a, b);
        Ok(Value::Number(match operator {
            Binary::Add => a + b,
            Binary::Subtract => a - b,
            Binary::Multiply => a * b,
            Binary::Divide => a / b,
            Binary::WholeDivide => (a / b).trunc(),
            Binary::Remainder => a % b,
            Binary::Power => a.powf(b),
            Binary::And => truth(a != 0.0 && b != 0.0),
            Binary::Or => truth(a != 0.0 || b != 0.0),
            Binary::ExclusiveOr => truth((a != 0.0) != (b != 0.0)),
            Binary::BitAnd => f64::from(left.bits(a)? & right.bits(b)?),
            Binary::BitOr => f64::from(left.bits(a)? | right.bits(b)?),
            Binary::BitExclusiveOr => f64::from(left.bits(a)? ^ right.bits(b)?),
            Binary::Equal => truth(same),
            Binary::NotEqual => truth(!same),
            Binary::Less => truth(a < b && !same),
            Binary::LessOrEqual => truth(a < b || same),
            Binary::Greater => truth(a > b && !same),
            Binary::GreaterOrEqual => truth(a > b || same),
            Binary::Concatenate => unreachable!("texts were joined above"),
        }))
    }

    /// The bits of a value of this expression.
    fn bits(&self, value: f64) -> Result<i32, Diagnostic> {
        let fits =
            value.fract() == 0.0 && (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&value);
        match fits {
            true => Ok(value as i32),
            false => Err(self.error(format!(
                "{value} has no bits: a whole number of 32 bits is needed here"
            ))),
        }
    }

    fn error(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(self.span, message)
    }
}

/// A value as it appears in a message.
pub fn text(value: &Value) -> String {
    match value {
        Value::Number(number) => number.to_string(),
        Value::Text(text) => text.clone(),
    }
}

fn numbers(list: &[Expression], variables: &dyn Variables) -> Result<Vec<f64>, Diagnostic> {
    list.iter().map(|item| item.number(variables)).collect()
}

fn truth(value: bool) -> f64 {
    f64::from(u8::from(value))
}

/// Equality as controls test it: with a relative tolerance, so that 0.1 + 0.2 == 0.3.
fn equal(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * a.abs().max(b.abs())
}

fn apply(function: Function, arguments: &[f64]) -> Option<f64> {
    let value = match (function, arguments) {
        (Function::Sin, [a]) => sin_cos_degrees(*a).0,
        (Function::Cos, [a]) => sin_cos_degrees(*a).1,
        (Function::Tan, [a]) => {
            let (sin, cos) = sin_cos_degrees(*a);
            sin / cos
        }
        (Function::Asin, [a]) => a.asin().to_degrees(),
        (Function::Acos, [a]) => a.acos().to_degrees(),
        (Function::Atan2, [y, x]) => y.atan2(*x).to_degrees(),
        (Function::SquareRoot, [a]) => a.sqrt(),
        (Function::Absolute, [a]) => a.abs(),
        (Function::Square, [a]) => a * a,
        (Function::Truncate, [a]) => a.trunc(),
        (Function::Round, [a]) => a.round(),
        (Function::NaturalLogarithm, [a]) => a.ln(),
        (Function::DecimalLogarithm, [a]) => a.log10(),
        (Function::RoundUp, [a]) if *a >= 0.0 || a.fract() == 0.0 => a.ceil(),
        (Function::Atan, [a]) => a.atan().to_degrees(),
        (Function::Direction, [x, y]) => y.atan2(*x).to_degrees().rem_euclid(360.0),
        (Function::Exponential, [a]) => a.exp(),
        (Function::Minimum, [a, b]) => a.min(*b),
        (Function::Maximum, [a, b]) => a.max(*b),
        (Function::Bound, [least, largest, a]) if least <= largest => a.max(*least).min(*largest),
        _ => return None,
    };
    value.is_finite().then_some(value)
}
