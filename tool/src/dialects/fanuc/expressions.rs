//! Parsing arithmetic. From the strongest to the weakest: functions and signs; `* /`, AND and MOD; `+ -`,
//! OR and XOR; comparisons. (Fanuc, Series 30i, User's Manual, "Custom macro: arithmetic and logic
//! operation".)

use super::token::{Cursor, Parsed, TokenKind};
use crate::dialects::expression::{Binary, Expression, ExpressionKind, Function, Unary};
use crate::dialects::operators::{DEPTH_LIMIT, Grammar};

const GRAMMAR: Grammar<char, Option<u32>> = Grammar {
    levels: 3,
    operator,
    check: |_, _| Ok(()),
    operand: unary,
};

/// Parses one expression.
pub fn expression(cursor: &mut Cursor) -> Parsed<Expression> {
    GRAMMAR.parse(cursor, 0, 0)
}

/// Parses an expression in brackets.
pub fn bracketed(cursor: &mut Cursor) -> Parsed<Expression> {
    cursor.expect('[', "[")?;
    let inner = expression(cursor)?;
    cursor.expect(']', "]")?;
    Ok(inner)
}

/// Parses a number, `#1` or an expression in brackets, with a sign: the value of a word.
pub fn word_value(cursor: &mut Cursor) -> Parsed<Expression> {
    match (cursor.peek(), cursor.peek_at(1)) {
        (Some(TokenKind::Symbol('+' | '-')), Some(TokenKind::Symbol('+' | '-'))) => {
            Err(cursor.error("a word has one sign"))
        }
        (Some(TokenKind::Name(_)), _) => Err(cursor.error_with_help(
            "a value is missing here",
            "write functions in brackets: X[SIN[30]]",
        )),
        _ => unary(cursor, 0),
    }
}

fn operator(token: Option<&TokenKind>, at_level: usize) -> Option<Binary> {
    use Binary::*;
    let (operator, its_level) = match token? {
        TokenKind::Symbol('+') => (Add, 1),
        TokenKind::Symbol('-') => (Subtract, 1),
        TokenKind::Symbol('*') => (Multiply, 2),
        TokenKind::Symbol('/') => (Divide, 2),
        TokenKind::Name(name) => match name.as_str() {
            "EQ" => (Equal, 0),
            "NE" => (NotEqual, 0),
            "GT" => (Greater, 0),
            "GE" => (GreaterOrEqual, 0),
            "LT" => (Less, 0),
            "LE" => (LessOrEqual, 0),
            "OR" => (Or, 1),
            "XOR" => (ExclusiveOr, 1),
            "AND" => (And, 2),
            "MOD" => (Remainder, 2),
            _ => return None,
        },
        _ => return None,
    };
    (its_level == at_level).then_some(operator)
}

fn unary(cursor: &mut Cursor, depth: u32) -> Parsed<Expression> {
    let start = cursor.span();
    if depth > DEPTH_LIMIT {
        return Err(cursor.error("too many signs or functions"));
    }
    if cursor.take('+') {
        return unary(cursor, depth + 1);
    }
    if !cursor.take('-') {
        return primary(cursor, depth);
    }
    let operand = unary(cursor, depth + 1)?;
    Ok(Expression {
        span: start.to(operand.span),
        kind: ExpressionKind::Unary(Unary::Negate, Box::new(operand)),
    })
}

fn primary(cursor: &mut Cursor, depth: u32) -> Parsed<Expression> {
    let start = cursor.span();
    let kind = match cursor.peek() {
        Some(TokenKind::Number(number)) => {
            cursor.advance();
            ExpressionKind::Number(*number)
        }
        Some(TokenKind::Symbol('[')) => ExpressionKind::Group(Box::new(inner(cursor, depth)?)),
        Some(TokenKind::Symbol('#')) => return variable(cursor, depth),
        Some(TokenKind::Name(name)) => function_call(cursor, name, depth)?,
        _ => return Err(cursor.error("a value is missing here")),
    };
    Ok(Expression {
        kind,
        span: start.to(cursor.last_span()),
    })
}

fn inner(cursor: &mut Cursor, depth: u32) -> Parsed<Expression> {
    cursor.expect('[', "[")?;
    let inner = GRAMMAR.parse(cursor, 0, depth + 1)?;
    cursor.expect(']', "]")?;
    Ok(inner)
}

/// `#1`, or `#[expression]`.
pub fn variable(cursor: &mut Cursor, depth: u32) -> Parsed<Expression> {
    let start = cursor.span();
    cursor.expect('#', "#")?;
    let span = cursor.span();
    let index = if cursor.is_symbol(0, '[') {
        inner(cursor, depth)?
    } else if cursor.is_symbol(0, '#') {
        return Err(cursor.error_with_help(
            "the number of a variable stands in brackets here",
            "write #[#1]",
        ));
    } else {
        let number = cursor.whole("the number of a variable")?;
        Expression {
            kind: ExpressionKind::Number(f64::from(number)),
            span,
        }
    };
    Ok(Expression {
        kind: ExpressionKind::Variable("#".to_string(), vec![index]),
        span: start.to(cursor.last_span()),
    })
}

fn function_call(cursor: &mut Cursor, name: &str, depth: u32) -> Parsed<ExpressionKind> {
    let Some(function) = function(name) else {
        return Err(cursor.error_with_help(
            format!("{name} cannot be evaluated ahead of time"),
            "functions are SIN COS TAN ASIN ACOS ATAN SQRT ABS ROUND FIX FUP LN EXP POW",
        ));
    };
    cursor.advance();
    if name == "POW" {
        cursor.expect('[', "[")?;
        let base = GRAMMAR.parse(cursor, 0, depth + 1)?;
        cursor.expect(',', ",")?;
        let exponent = GRAMMAR.parse(cursor, 0, depth + 1)?;
        cursor.expect(']', "]")?;
        let operands = (Box::new(base), Box::new(exponent));
        return Ok(ExpressionKind::Binary(
            Binary::Power,
            operands.0,
            operands.1,
        ));
    }
    if name == "ATAN" {
        return arc_tangent(cursor, depth);
    }
    let argument = inner(cursor, depth)?;
    Ok(ExpressionKind::Function(function, vec![argument]))
}

/// ATAN[t], or the direction of a point: ATAN[y]/[x], ATAN[y,x].
fn arc_tangent(cursor: &mut Cursor, depth: u32) -> Parsed<ExpressionKind> {
    cursor.expect('[', "[")?;
    let first = GRAMMAR.parse(cursor, 0, depth + 1)?;
    let x = if cursor.take(',') {
        let x = GRAMMAR.parse(cursor, 0, depth + 1)?;
        cursor.expect(']', "]")?;
        x
    } else {
        cursor.expect(']', "]")?;
        if !(cursor.is_symbol(0, '/') && cursor.is_symbol(1, '[')) {
            return Ok(ExpressionKind::Function(Function::Atan, vec![first]));
        }
        cursor.take('/');
        inner(cursor, depth)?
    };
    Ok(ExpressionKind::Function(
        Function::Direction,
        vec![x, first],
    ))
}

fn function(name: &str) -> Option<Function> {
    Some(match name {
        "SIN" => Function::Sin,
        "COS" => Function::Cos,
        "TAN" => Function::Tan,
        "ASIN" => Function::Asin,
        "ACOS" => Function::Acos,
        "ATAN" => Function::Atan,
        "ABS" => Function::Absolute,
        "LN" => Function::NaturalLogarithm,
        "EXP" | "POW" => Function::Exponential,
        "SQRT" | "SQR" => Function::SquareRoot,
        "ROUND" | "RND" => Function::Round,
        "FIX" => Function::Truncate,
        "FUP" => Function::RoundUp,
        _ => return None,
    })
}
