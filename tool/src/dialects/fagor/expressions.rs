//! Parsing arithmetic. From the strongest to the weakest: functions, NOT and signs; EXP and MOD; `* /`;
//! `+ -`; comparisons; AND and XOR; OR. (Fagor, CNC 8055 Programming Manual, high-level language,
//! "Operators" and "Expressions".)
//!
//! Between numbers AND, OR, XOR and NOT would work on their bits; they are understood between
//! comparisons only.

use super::cursor::{Cursor, Parsed};
use super::token::TokenKind;
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Binary, Expression, ExpressionKind, FUNCTIONS, Function, Unary};
use crate::dialects::operators::{DEPTH_LIMIT, Grammar};
use crate::dialects::spelling::did_you_mean;

const GRAMMAR: Grammar<char, String> = Grammar {
    levels: 6,
    operator,
    check: check_logic,
    operand: unary,
};

/// Parses one expression.
pub fn expression(cursor: &mut Cursor) -> Parsed<Expression> {
    GRAMMAR.parse(cursor, 0, 0)
}

/// Parses `P1` or a number, with a sign: the value of a word.
pub fn word_value(cursor: &mut Cursor) -> Parsed<Expression> {
    let start = cursor.span();
    let minus = cursor.take('-');
    if !minus {
        cursor.take('+');
    }
    let operand = match cursor.peek() {
        Some(TokenKind::Number(number)) => {
            cursor.advance();
            ExpressionKind::Number(*number)
        }
        Some(TokenKind::Letter('P')) => parameter(cursor, 0)?.kind,
        _ => return Err(cursor.error("a value is missing here")),
    };
    let operand = Expression {
        kind: operand,
        span: start.to(cursor.last_span()),
    };
    Ok(match minus {
        true => Expression {
            span: operand.span,
            kind: ExpressionKind::Unary(Unary::Negate, Box::new(operand)),
        },
        false => operand,
    })
}

/// Operators with names, and their levels.
const OPERATORS: [(&str, Binary, usize); 11] = [
    ("OR", Binary::Or, 0),
    ("AND", Binary::And, 1),
    ("XOR", Binary::ExclusiveOr, 1),
    ("EQ", Binary::Equal, 2),
    ("NE", Binary::NotEqual, 2),
    ("GT", Binary::Greater, 2),
    ("GE", Binary::GreaterOrEqual, 2),
    ("LT", Binary::Less, 2),
    ("LE", Binary::LessOrEqual, 2),
    ("EXP", Binary::Power, 5),
    ("MOD", Binary::Remainder, 5),
];

fn operator(token: Option<&TokenKind>, at_level: usize) -> Option<Binary> {
    let (operator, its_level) = match token? {
        TokenKind::Symbol('+') => (Binary::Add, 3),
        TokenKind::Symbol('-') => (Binary::Subtract, 3),
        TokenKind::Symbol('*') => (Binary::Multiply, 4),
        TokenKind::Symbol('/') => (Binary::Divide, 4),
        TokenKind::Name(name) => {
            let mut operators = OPERATORS.into_iter();
            let (_, operator, level) = operators.find(|(known, ..)| known == name)?;
            (operator, level)
        }
        _ => return None,
    };
    (its_level == at_level).then_some(operator)
}

/// AND, OR and XOR stand between comparisons.
fn check_logic(binary: Binary, operand: &Expression) -> Parsed<()> {
    match binary.is_logic() {
        true => need_truth(operand),
        false => Ok(()),
    }
}

/// Whether an expression is a comparison or made of comparisons.
fn is_truth(expression: &Expression) -> bool {
    match &expression.kind {
        ExpressionKind::Binary(binary, _, _) => binary.is_comparison() || binary.is_logic(),
        ExpressionKind::Unary(unary, _) => *unary == Unary::Not,
        ExpressionKind::Group(inner) => is_truth(inner),
        _ => false,
    }
}

/// Refuses a number where only a comparison has a meaning that is kept.
pub fn need_truth(operand: &Expression) -> Parsed<()> {
    if is_truth(operand) {
        return Ok(());
    }
    Err(Diagnostic::error(
        operand.span,
        "a comparison is needed here, this is a number",
    )
    .help("write P1 NE 0; AND, OR, XOR and NOT on the bits of numbers are not supported"))
}

fn unary(cursor: &mut Cursor, depth: u32) -> Parsed<Expression> {
    let start = cursor.span();
    if depth > DEPTH_LIMIT {
        return Err(cursor.error("too many signs or functions"));
    }
    let sign = if cursor.take('-') {
        Unary::Negate
    } else if cursor.take_name("NOT") {
        Unary::Not
    } else if cursor.take('+') {
        return unary(cursor, depth + 1);
    } else {
        return primary(cursor, depth);
    };
    let operand = unary(cursor, depth + 1)?;
    if sign == Unary::Not {
        need_truth(&operand)?;
    }
    Ok(Expression {
        span: start.to(operand.span),
        kind: ExpressionKind::Unary(sign, Box::new(operand)),
    })
}

fn primary(cursor: &mut Cursor, depth: u32) -> Parsed<Expression> {
    let start = cursor.span();
    let kind = match cursor.peek() {
        Some(TokenKind::Number(number)) => {
            cursor.advance();
            ExpressionKind::Number(*number)
        }
        Some(TokenKind::Symbol('(')) => {
            cursor.advance();
            let inner = GRAMMAR.parse(cursor, 0, depth + 1)?;
            cursor.expect(')', ")")?;
            ExpressionKind::Group(Box::new(inner))
        }
        Some(TokenKind::Letter('P')) => return parameter(cursor, depth),
        Some(TokenKind::Name(name)) if name == "PI" => {
            cursor.advance();
            ExpressionKind::Number(std::f64::consts::PI)
        }
        Some(TokenKind::Name(name)) => function_call(cursor, name, depth)?,
        _ => return Err(cursor.error("a value is missing here")),
    };
    Ok(Expression {
        kind,
        span: start.to(cursor.last_span()),
    })
}

/// `P1`, or `P(expression)`.
pub fn parameter(cursor: &mut Cursor, depth: u32) -> Parsed<Expression> {
    let start = cursor.span();
    cursor.take_letter('P');
    let span = cursor.span();
    let index = if cursor.take('(') {
        let index = GRAMMAR.parse(cursor, 0, depth + 1)?;
        cursor.expect(')', ")")?;
        index
    } else {
        let number = cursor.whole("the number of a parameter")?;
        Expression {
            kind: ExpressionKind::Number(f64::from(number)),
            span,
        }
    };
    Ok(Expression {
        kind: ExpressionKind::Variable("P".to_string(), vec![index]),
        span: start.to(cursor.last_span()),
    })
}

fn function_call(cursor: &mut Cursor, name: &str, depth: u32) -> Parsed<ExpressionKind> {
    let Some(function) = function(name) else {
        let known = functions().map(|(known, _)| known);
        let help = did_you_mean(name, known, str::to_string).unwrap_or_else(|| {
            "variables of the control are not supported: use a parameter and --set P1=VALUE"
                .to_string()
        });
        return Err(
            cursor.error_with_help(format!("{name} cannot be evaluated ahead of time"), help)
        );
    };
    cursor.advance();
    let arguments = if function.arguments() == 1 {
        vec![unary(cursor, depth + 1)?]
    } else {
        cursor.expect('(', "(")?;
        let mut list = vec![GRAMMAR.parse(cursor, 0, depth + 1)?];
        while list.len() < function.arguments() {
            cursor.expect(',', ",")?;
            list.push(GRAMMAR.parse(cursor, 0, depth + 1)?);
        }
        cursor.expect(')', ")")?;
        list
    };
    Ok(ExpressionKind::Function(function, arguments))
}

/// All functions; angles in degrees.
fn functions() -> impl Iterator<Item = (&'static str, Function)> {
    let own = [
        ("ARG", Function::Direction),
        ("FIX", Function::Truncate),
        ("FUP", Function::RoundUp),
    ];
    FUNCTIONS.into_iter().chain(own)
}

fn function(name: &str) -> Option<Function> {
    let found = functions().find(|(known, _)| *known == name);
    found.map(|(_, function)| function)
}

/// What may have been meant where an operator or the end of a statement is missing.
pub fn similar_operator(cursor: &Cursor) -> Option<String> {
    let known = OPERATORS.into_iter().map(|(known, ..)| known);
    did_you_mean(cursor.peek()?.name()?, known, str::to_string)
}
