//! Parsing arithmetic. From the strongest to the weakest: functions, NOT and signs; EXP and MOD; `* /`;
//! `+ -`; comparisons; AND and XOR; OR. (Fagor, CNC 8055 Programming Manual, high-level language,
//! "Operators" and "Expressions".)
//!
//! Between numbers AND, OR, XOR and NOT would work on their bits; they are understood between
//! comparisons only.

use super::cursor::{Cursor, Parsed};
use super::token::TokenKind;
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Binary, Expression, ExpressionKind, Function, Unary};
use crate::dialects::operators::{DEPTH_LIMIT, Grammar};

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

fn operator(token: Option<&TokenKind>, at_level: usize) -> Option<Binary> {
    use Binary::*;
    let (operator, its_level) = match token? {
        TokenKind::Symbol('+') => (Add, 3),
        TokenKind::Symbol('-') => (Subtract, 3),
        TokenKind::Symbol('*') => (Multiply, 4),
        TokenKind::Symbol('/') => (Divide, 4),
        TokenKind::Name(name) => match name.as_str() {
            "OR" => (Or, 0),
            "AND" => (And, 1),
            "XOR" => (ExclusiveOr, 1),
            "EQ" => (Equal, 2),
            "NE" => (NotEqual, 2),
            "GT" => (Greater, 2),
            "GE" => (GreaterOrEqual, 2),
            "LT" => (Less, 2),
            "LE" => (LessOrEqual, 2),
            "EXP" => (Power, 5),
            "MOD" => (Remainder, 5),
            _ => return None,
        },
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
    Err(Box::new(
        Diagnostic::error(
            operand.span,
            "a comparison is needed here, this is a number",
        )
        .help("write P1 NE 0; AND, OR, XOR and NOT on the bits of numbers are not supported"),
    ))
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
        return Err(cursor.error_with_help(
            format!("{name} cannot be evaluated ahead of time"),
            "variables of the control are not supported: use a parameter and --set P1=VALUE",
        ));
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

fn function(name: &str) -> Option<Function> {
    Some(match name {
        "SIN" => Function::Sin,
        "COS" => Function::Cos,
        "TAN" => Function::Tan,
        "ASIN" => Function::Asin,
        "ACOS" => Function::Acos,
        "ATAN" => Function::Atan,
        "ARG" => Function::Direction,
        "ABS" => Function::Absolute,
        "LN" => Function::NaturalLogarithm,
        "LOG" => Function::DecimalLogarithm,
        "SQRT" => Function::SquareRoot,
        "ROUND" => Function::Round,
        "FIX" => Function::Truncate,
        "FUP" => Function::RoundUp,
        _ => return None,
    })
}
