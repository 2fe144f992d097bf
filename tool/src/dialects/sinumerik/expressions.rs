//! Parsing arithmetic. From the strongest to the weakest: `NOT`, `B_NOT` and signs; `* / DIV MOD`; `+ -`;
//! `B_AND`; `B_XOR`; `B_OR`; `AND`; `XOR`; `OR`; `<<`; comparisons. (Siemens, Programming Manual Job Planning, "Operators".)
//!
//! Comparisons are the weakest, so that `R1 > 5 AND R2 < 3` means `R1 > (5 AND R2) < 3` to the
//! control. Nobody means that: such mixtures are refused unless parentheses say what is meant.

use super::cursor::{Cursor, Parsed};
use super::token::{SectionName, Symbol, TokenKind};
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Binary, Expression, ExpressionKind, Function, Unary};
use crate::dialects::operators::{DEPTH_LIMIT, Grammar};

const GRAMMAR: Grammar<Symbol, SectionName> = Grammar {
    levels: 10,
    operator,
    check: check_comparison,
    operand: unary,
};

/// Parses one expression.
pub fn expression(cursor: &mut Cursor) -> Parsed<Expression> {
    GRAMMAR.parse(cursor, 0, 0)
}

/// Parses `a, b, c` up to the closing mark, which is taken; an argument may be left out.
pub fn arguments(
    cursor: &mut Cursor,
    close: Symbol,
    shown: &str,
) -> Parsed<Vec<Option<Expression>>> {
    list(cursor, close, shown, 0)
}

fn list(
    cursor: &mut Cursor,
    close: Symbol,
    shown: &str,
    depth: u32,
) -> Parsed<Vec<Option<Expression>>> {
    let mut list = Vec::new();
    if cursor.take(close) {
        return Ok(list);
    }
    loop {
        let left_out = cursor.is_symbol(0, Symbol::Comma) || cursor.is_symbol(0, close);
        list.push(if left_out {
            None
        } else {
            Some(GRAMMAR.parse(cursor, 0, depth)?)
        });
        if cursor.take(close) {
            return Ok(list);
        }
        if !cursor.take(Symbol::Comma) {
            return Err(cursor.error(format!("`,` or `{shown}` is missing here")));
        }
    }
}

fn operator(token: Option<&TokenKind>, at_level: usize) -> Option<Binary> {
    use Binary::*;
    let (operator, its_level) = match token? {
        TokenKind::Symbol(symbol) => match symbol {
            Symbol::Equal => (Equal, 0),
            Symbol::NotEqual => (NotEqual, 0),
            Symbol::Less => (Less, 0),
            Symbol::LessOrEqual => (LessOrEqual, 0),
            Symbol::Greater => (Greater, 0),
            Symbol::GreaterOrEqual => (GreaterOrEqual, 0),
            Symbol::Concatenate => (Concatenate, 1),
            Symbol::Plus => (Add, 8),
            Symbol::Minus => (Subtract, 8),
            Symbol::Star => (Multiply, 9),
            Symbol::Slash => (Divide, 9),
            _ => return None,
        },
        TokenKind::Name(name) => match name.as_str() {
            "OR" => (Or, 2),
            "XOR" => (ExclusiveOr, 3),
            "AND" => (And, 4),
            "B_OR" => (BitOr, 5),
            "B_XOR" => (BitExclusiveOr, 6),
            "B_AND" => (BitAnd, 7),
            "DIV" => (WholeDivide, 9),
            "MOD" => (Remainder, 9),
            _ => return None,
        },
        _ => return None,
    };
    (its_level == at_level).then_some(operator)
}

/// Nothing that is a truth is compared.
fn check_comparison(binary: Binary, operand: &Expression) -> Parsed<()> {
    match binary.is_comparison() {
        true => refuse_mixture(operand),
        false => Ok(()),
    }
}

fn refuse_mixture(operand: &Expression) -> Parsed<()> {
    let mixed = match &operand.kind {
        ExpressionKind::Binary(binary, _, _) => binary.is_comparison() || binary.is_logic(),
        ExpressionKind::Unary(unary, _) => *unary == Unary::Not,
        _ => false,
    };
    if !mixed {
        return Ok(());
    }
    Err(Diagnostic::error(
        operand.span,
        "comparisons bind weaker than AND, OR and NOT: this is compared, not the parts of it",
    )
    .help("put each comparison in parentheses: (R1 > 5) AND (R2 < 3)"))
}

fn unary(cursor: &mut Cursor, depth: u32) -> Parsed<Expression> {
    let start = cursor.span();
    if depth > DEPTH_LIMIT {
        return Err(cursor.error("too many signs"));
    }
    let sign = if cursor.take(Symbol::Minus) {
        Unary::Negate
    } else if cursor.take_name("NOT") {
        Unary::Not
    } else if cursor.take_name("B_NOT") {
        Unary::BitNot
    } else if cursor.take(Symbol::Plus) {
        return unary(cursor, depth + 1);
    } else {
        return primary(cursor, depth);
    };
    let operand = unary(cursor, depth + 1)?;
    Ok(Expression {
        span: start.to(operand.span),
        kind: ExpressionKind::Unary(sign, Box::new(operand)),
    })
}

fn primary(cursor: &mut Cursor, depth: u32) -> Parsed<Expression> {
    let start = cursor.span();
    let Some(token) = cursor.peek() else {
        return Err(cursor.error("a value is missing here"));
    };
    let kind = match token {
        TokenKind::Number(number) => {
            cursor.advance();
            ExpressionKind::Number(*number)
        }
        TokenKind::Text(text) => {
            cursor.advance();
            ExpressionKind::Text(text.clone())
        }
        TokenKind::Symbol(Symbol::Open) => {
            cursor.advance();
            let inner = GRAMMAR.parse(cursor, 0, depth + 1)?;
            cursor.expect(Symbol::Close, ")")?;
            ExpressionKind::Group(Box::new(inner))
        }
        TokenKind::Letter('R') => {
            cursor.advance();
            r_parameter(cursor, depth)?
        }
        TokenKind::Name(name) => {
            cursor.advance();
            named(cursor, name, depth)?
        }
        _ => return Err(cursor.error("a value is missing here")),
    };
    Ok(Expression {
        kind,
        span: start.to(cursor.last_span()),
    })
}

fn r_parameter(cursor: &mut Cursor, depth: u32) -> Parsed<ExpressionKind> {
    let index = if cursor.take(Symbol::OpenBracket) {
        let index = GRAMMAR.parse(cursor, 0, depth + 1)?;
        cursor.expect(Symbol::CloseBracket, "]")?;
        index
    } else {
        let span = cursor.span();
        let number = cursor.whole("the number of an R parameter")?;
        Expression {
            kind: ExpressionKind::Number(f64::from(number)),
            span,
        }
    };
    Ok(ExpressionKind::Variable("R".to_string(), vec![index]))
}

fn named(cursor: &mut Cursor, name: &str, depth: u32) -> Parsed<ExpressionKind> {
    let start = cursor.last_span();
    match name {
        "TRUE" => return Ok(ExpressionKind::Number(1.0)),
        "FALSE" => return Ok(ExpressionKind::Number(0.0)),
        "PI" | "$PI" => return Ok(ExpressionKind::Number(std::f64::consts::PI)),
        _ if name.starts_with('$') => {
            return Err(Diagnostic::error(
                start,
                format!("{name} cannot be evaluated ahead of time"),
            )
            .help("system variables are not supported: use an R parameter and --set"));
        }
        _ => {}
    }
    if cursor.take(Symbol::Open) {
        let function = function(name).ok_or_else(|| {
            Diagnostic::error(
                start,
                format!("`{name}` is not a function that can be used here"),
            )
        })?;
        let list = list(cursor, Symbol::Close, ")", depth + 1)?;
        let given: Option<Vec<Expression>> = list.into_iter().collect();
        return match given {
            Some(given) if given.len() == function.arguments() => {
                Ok(ExpressionKind::Function(function, given))
            }
            _ => Err(Diagnostic::error(
                start,
                format!("{name} needs {} values", function.arguments()),
            )),
        };
    }
    if cursor.take(Symbol::OpenBracket) {
        let index: Option<Vec<Expression>> = list(cursor, Symbol::CloseBracket, "]", depth + 1)?
            .into_iter()
            .collect();
        return index
            .map(|index| ExpressionKind::Variable(name.to_string(), index))
            .ok_or_else(|| Diagnostic::error(start, "an index is missing"));
    }
    Ok(ExpressionKind::Variable(name.to_string(), Vec::new()))
}

fn function(name: &str) -> Option<Function> {
    Some(match name {
        "SIN" => Function::Sin,
        "COS" => Function::Cos,
        "TAN" => Function::Tan,
        "ASIN" => Function::Asin,
        "ACOS" => Function::Acos,
        "ATAN2" => Function::Atan2,
        "SQRT" => Function::SquareRoot,
        "ABS" => Function::Absolute,
        "POT" => Function::Square,
        "TRUNC" => Function::Truncate,
        "ROUND" => Function::Round,
        "LN" => Function::NaturalLogarithm,
        "EXP" => Function::Exponential,
        "MINVAL" => Function::Minimum,
        "MAXVAL" => Function::Maximum,
        "BOUND" => Function::Bound,
        _ => return None,
    })
}
