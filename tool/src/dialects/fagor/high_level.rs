//! Parsing statements in parentheses.

use super::cursor::{Cursor, Parsed};
use super::expressions::{expression, need_truth, parameter, similar_operator, word_value};
use super::syntax::{Assignment, Call, CallKind, HighLevel, Label, Statement};
use super::token::TokenKind;
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Expression, ExpressionKind};
use crate::dialects::spelling::did_you_mean;

/// The statements that are known.
pub(super) const KEYWORDS: [&str; 12] = [
    "IF", "ELSE", "GOTO", "RPT", "SUB", "RET", "CALL", "PCALL", "MCALL", "MDOFF", "MSG", "ERROR",
];

/// How deep IF may be nested in IF.
const IF_LIMIT: u32 = 16;

/// Parses a block that begins with a parenthesis.
pub fn high_level_block(cursor: &mut Cursor) -> Parsed<Statement> {
    let start = cursor.span();
    cursor.expect('(', "(")?;
    if cursor.take_name("SUB") {
        let number = cursor.whole("the number of a subroutine")?;
        cursor.expect(')', ")")?;
        return Ok(Statement::Subroutine(number));
    }
    let mut statement = statement(cursor, 0)?;
    if let Some(similar) = similar_operator(cursor).filter(|_| !cursor.is_symbol(0, ')')) {
        return Err(cursor.error_with_help("this is no operator", similar));
    }
    cursor.expect(')', ")")?;
    if let HighLevel::Repeat { times, span, .. } = &mut statement {
        if cursor.take_letter('N') {
            *times = Some(word_value(cursor)?);
        }
        *span = start.to(cursor.last_span());
    }
    Ok(Statement::High(statement))
}

/// Parses a statement without its parentheses.
fn statement(cursor: &mut Cursor, depth: u32) -> Parsed<HighLevel> {
    let start = cursor.span();
    let name = match cursor.peek() {
        Some(TokenKind::Letter('P')) => return assignments(cursor).map(HighLevel::Assign),
        Some(TokenKind::Name(name)) => name.as_str(),
        _ => return Err(unknown(cursor, "")),
    };
    if !KEYWORDS.contains(&name) {
        return Err(unknown(cursor, name));
    }
    cursor.advance();
    Ok(match name {
        "IF" => {
            if depth > IF_LIMIT {
                return Err(cursor.error("IF is nested too deep"));
            }
            let condition = expression(cursor)?;
            let statement_follows = match cursor.peek() {
                Some(TokenKind::Name(name)) => KEYWORDS.contains(&name.as_str()),
                _ => true,
            };
            if let Some(similar) = similar_operator(cursor).filter(|_| !statement_follows) {
                return Err(cursor.error_with_help("this is no operator", similar));
            }
            need_truth(&condition)?;
            let then = statement(cursor, depth + 1)?;
            let otherwise = match cursor.take_name("ELSE") {
                true => Some(Box::new(statement(cursor, depth + 1)?)),
                false => None,
            };
            HighLevel::If(condition, Box::new(then), otherwise)
        }
        "GOTO" => HighLevel::Goto(label(cursor)?),
        "RPT" => {
            let first = label(cursor)?;
            cursor.expect(',', ",")?;
            HighLevel::Repeat {
                first,
                last: label(cursor)?,
                times: None,
                span: start.to(cursor.last_span()),
            }
        }
        "CALL" => call(cursor, CallKind::Plain)?,
        "PCALL" => call(cursor, CallKind::Parameters)?,
        "MCALL" => call(cursor, CallKind::Modal)?,
        "MDOFF" => HighLevel::ModalOff,
        "RET" => HighLevel::Return(start),
        "MSG" => HighLevel::Message(text(cursor)?),
        "ERROR" => {
            let number = match cursor.peek() {
                Some(TokenKind::Text(_)) => None,
                _ => Some(expression(cursor)?),
            };
            let message = match number.is_none() || cursor.take(',') {
                true => text(cursor)?,
                false => String::new(),
            };
            HighLevel::Error(number, message, start.to(cursor.last_span()))
        }
        _ => {
            return Err(
                Diagnostic::error(start, format!("{name} cannot stand here"))
                    .help("SUB begins a block of its own; ELSE belongs to (IF .. ELSE ..)"),
            );
        }
    })
}

fn unknown(cursor: &Cursor, name: &str) -> Diagnostic {
    let known = [
        "SYMBOL", "DIGIT", "KEYCZ", "TRACE", "WKEY", "WBUF", "SYSTEM", "ODW", "DW", "SK", "WRITE",
        "OPEN", "EXEC", "REPOS", "PROBE", "DIGITIZE", "PAGE", "SYSTAT", "SAVELIST",
    ];
    if known.contains(&name) {
        return cursor.error_with_help(
            format!("({name} ..) is not supported"),
            "screens, files, keys and probes of the other control cannot be evaluated ahead of time",
        );
    }
    // TOR1 and the like: what the tool table holds.
    if ["TOR", "TOL", "TOI", "TOK", "ORGX", "ORGY", "ORGZ"].contains(&name) {
        return cursor.error_with_help(
            format!("{name}, a table of the control, cannot be written by a program here"),
            "enter tools into LinuxCNC's tool table, and zero offsets at the machine",
        );
    }
    if let Some(similar) = did_you_mean(name, KEYWORDS.into_iter(), |known| format!("({known} ..)"))
    {
        return cursor.error_with_help(
            format!("({name} ..) is not a statement of this dialect"),
            similar,
        );
    }
    cursor.error_with_help(
        "this is not a statement that is known",
        "comments begin with ; and statements in parentheses are IF, GOTO, RPT, SUB, RET, CALL, \
         PCALL, MCALL, MDOFF, MSG, ERROR and P1=..",
    )
}

/// `N10`, or `10` after a comma.
fn label(cursor: &mut Cursor) -> Parsed<Label> {
    let start = cursor.span();
    cursor.take_letter('N');
    let number = cursor.whole("a block number")?;
    Ok(Label {
        number,
        span: start.to(cursor.last_span()),
    })
}

fn text(cursor: &mut Cursor) -> Parsed<String> {
    match cursor.peek() {
        Some(TokenKind::Text(text)) => {
            cursor.advance();
            Ok(text.clone())
        }
        _ => Err(cursor.error_with_help(
            "a text between double quotes is missing here",
            "write (MSG \"text\")",
        )),
    }
}

fn call(cursor: &mut Cursor, kind: CallKind) -> Parsed<HighLevel> {
    let start = cursor.last_span();
    let number = expression(cursor)?;
    let span = start.to(number.span);
    let mut arguments = Vec::new();
    while kind != CallKind::Plain && cursor.take(',') {
        arguments.push(argument(cursor)?);
    }
    Ok(HighLevel::Call(Call {
        kind,
        number,
        arguments,
        span,
    }))
}

/// `P3=5`, or `D=5`: the letters A to Z are P0 to P25.
fn argument(cursor: &mut Cursor) -> Parsed<Assignment> {
    let start = cursor.span();
    let Some(TokenKind::Letter(letter)) = cursor.peek() else {
        return Err(cursor.error_with_help(
            "a parameter is missing here",
            "write (PCALL 10, A=5) or (PCALL 10, P0=5): A to Z are P0 to P25",
        ));
    };
    let is_numbered = *letter == 'P' && {
        let mut ahead = cursor.clone();
        ahead.advance();
        !ahead.take('=')
    };
    let parameter = if is_numbered {
        parameter_index(cursor)?
    } else {
        cursor.advance();
        let number = u32::from(*letter) - u32::from('A');
        Expression {
            kind: ExpressionKind::Number(f64::from(number)),
            span: start,
        }
    };
    assignment_to(cursor, parameter)
}

fn assignments(cursor: &mut Cursor) -> Parsed<Vec<Assignment>> {
    let mut list = Vec::new();
    loop {
        if !matches!(cursor.peek(), Some(TokenKind::Letter('P'))) {
            return Err(cursor.error("a parameter is missing here"));
        }
        let parameter = parameter_index(cursor)?;
        list.push(assignment_to(cursor, parameter)?);
        if !cursor.take(',') {
            return Ok(list);
        }
    }
}

/// The number of a parameter that is written to.
fn parameter_index(cursor: &mut Cursor) -> Parsed<Expression> {
    let variable = parameter(cursor, 0)?;
    match variable.kind {
        ExpressionKind::Variable(_, index) if index.len() == 1 => {
            Ok(index.into_iter().next().unwrap_or(Expression {
                kind: ExpressionKind::Number(0.0),
                span: variable.span,
            }))
        }
        _ => Err(Diagnostic::error(
            variable.span,
            "only a parameter can be given a value",
        )),
    }
}

fn assignment_to(cursor: &mut Cursor, parameter: Expression) -> Parsed<Assignment> {
    let span = cursor.last_span();
    cursor.expect('=', "=")?;
    Ok(Assignment {
        span: parameter.span.to(span),
        parameter,
        value: expression(cursor)?,
    })
}
