//! From tokens to the syntax tree, one block at a time: a block that cannot be understood is reported
//! and does not hide the ones after it.

use super::expressions::{bracketed, expression, variable, word_value};
use super::syntax::{Assignment, Block, Jump, Statement, Then, Word};
use super::token::{Cursor, Parsed, Token, TokenKind};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::Place;
use crate::dialects::expression::ExpressionKind;
use crate::source::{Span, Text};

/// The highest number of a block.
const HIGHEST_NUMBER: u32 = 99_999_999;

/// A block from its tokens and those of its comments; `None` for an empty line.
pub fn parse_block(
    text: Text,
    tokens: &[Token],
    end: Span,
    diagnostics: &mut Diagnostics,
) -> Option<Block> {
    let mut comments: Vec<&str> = Vec::new();
    let mut words: Vec<Token> = Vec::with_capacity(tokens.len());
    for token in tokens {
        match &token.kind {
            TokenKind::Comment(text) => comments.push(text),
            _ => words.push(token.clone()),
        }
    }
    if words.is_empty() && comments.is_empty() {
        return None;
    }
    let first = words
        .first()
        .or(tokens.first())
        .map_or(end, |token| token.span);
    let last = words.last().map_or(first, |token| token.span);
    let mut block = Block {
        place: Place {
            span: first.to(last),
            number: None,
            comment: (!comments.is_empty()).then(|| comments.join(" ")),
        },
        skip: false,
        statement: Statement::Empty,
    };
    if words.iter().any(|token| token.kind == TokenKind::Invalid) {
        block.statement = Statement::Invalid;
        return Some(block);
    }
    let end = Span {
        start: last.end,
        ..last
    };
    let mut cursor = Cursor::new(&words, end);
    let parsed = prefix(&mut cursor, &mut block).and_then(|()| statement(&mut cursor, text));
    block.statement = parsed.unwrap_or_else(|diagnostic| {
        diagnostics.push(diagnostic);
        Statement::Invalid
    });
    Some(block)
}

/// `/`, `/2` and `N10`, in either order.
fn prefix(cursor: &mut Cursor, block: &mut Block) -> Parsed<()> {
    for _ in 0..2 {
        if !block.skip && cursor.take('/') {
            block.skip = true;
            if let Some(TokenKind::Number(condition)) = cursor.peek() {
                if !(1.0..=9.0).contains(condition) || condition.fract() != 0.0 {
                    return Err(cursor.error("block skip conditions are /1 to /9"));
                }
                cursor.advance();
            }
        }
        if block.place.number.is_none() && cursor.take_letter('N') {
            let number = cursor.whole("a block number")?;
            if number > HIGHEST_NUMBER {
                return Err(cursor.error("block numbers go up to N99999999"));
            }
            block.place.number = Some(number);
        }
    }
    Ok(())
}

fn statement(cursor: &mut Cursor, text: Text) -> Parsed<Statement> {
    let statement = match cursor.peek() {
        None => return Ok(Statement::Empty),
        Some(TokenKind::Symbol('#')) => Statement::Assign(assignment(cursor)?),
        Some(TokenKind::Text(_)) => {
            cursor.advance();
            Statement::Noted("DPRNT")
        }
        Some(TokenKind::Name(name)) => macro_statement(cursor, name)?,
        _ => Statement::Words(words(cursor, text)?),
    };
    if !cursor.is_at_end() {
        return Err(cursor.error_with_help(
            "nothing more may stand in this block",
            "put what follows in a block of its own",
        ));
    }
    Ok(statement)
}

fn macro_statement(cursor: &mut Cursor, name: &str) -> Parsed<Statement> {
    let start = cursor.span();
    match name {
        "GOTO" => Ok(Statement::Goto(jump(cursor)?)),
        "IF" => {
            cursor.advance();
            let condition = bracketed(cursor)?;
            if cursor.take_name("THEN") {
                if !matches!(cursor.peek(), Some(TokenKind::Symbol('#'))) {
                    return Err(cursor.error_with_help(
                        "THEN assigns a value to a variable, and none is here",
                        "write IF[..]GOTO 10, without THEN, or IF[..]THEN #1=5",
                    ));
                }
                return Ok(Statement::If(condition, Then::Assign(assignment(cursor)?)));
            }
            Ok(Statement::If(condition, Then::Goto(jump(cursor)?)))
        }
        "WHILE" => {
            cursor.advance();
            let condition = bracketed(cursor)?;
            if !cursor.take_name("DO") {
                return Err(cursor.error_with_help(
                    "DO is missing here",
                    "write WHILE[#1LT10]DO1, and END1 behind the loop",
                ));
            }
            Ok(Statement::Loop(Some(condition), loop_number(cursor)?))
        }
        "DO" => {
            cursor.advance();
            Ok(Statement::Loop(None, loop_number(cursor)?))
        }
        "END" => {
            cursor.advance();
            Ok(Statement::End(loop_number(cursor)?))
        }
        "POPEN" => {
            cursor.advance();
            Ok(Statement::Noted("POPEN"))
        }
        "PCLOS" => {
            cursor.advance();
            Ok(Statement::Noted("PCLOS"))
        }
        "ELSE" | "ENDIF" | "THEN" => Err(cursor.error_with_help(
            format!("{name} is not supported"),
            "write IF[..]GOTO 10, or IF[..]THEN #1=5 on one line",
        )),
        _ => Err(
            Diagnostic::error(start, format!("a block cannot begin with {name}"))
                .help("write #1=.. to assign a value, or an address before it: X[SIN[30]]"),
        ),
    }
}

/// The number of a loop is 1 to 3.
fn loop_number(cursor: &mut Cursor) -> Parsed<u32> {
    match cursor.peek() {
        Some(TokenKind::Number(number)) if [1.0, 2.0, 3.0].contains(number) => {
            cursor.advance();
            Ok(*number as u32)
        }
        _ => Err(cursor.error("the number of a loop is missing here: 1, 2 or 3")),
    }
}

/// `GOTO 10`, `GOTO #1`, `GOTO[#1+10]`.
fn jump(cursor: &mut Cursor) -> Parsed<Jump> {
    let start = cursor.span();
    if !cursor.take_name("GOTO") {
        return Err(cursor.error_with_help(
            "GOTO or THEN is missing here",
            "write IF[#1EQ0]GOTO 10, or IF[#1EQ0]THEN #1=5",
        ));
    }
    if cursor.take_letter('N') {
        return Err(Diagnostic::error(
            cursor.last_span(),
            "the number of a block stands without N here",
        )
        .help("write GOTO 10"));
    }
    let number = word_value(cursor)?;
    Ok(Jump {
        number,
        span: start.to(cursor.last_span()),
    })
}

fn assignment(cursor: &mut Cursor) -> Parsed<Assignment> {
    let start = cursor.span();
    let variable = variable(cursor, 0)?;
    let span = start.to(cursor.last_span());
    cursor.expect('=', "=")?;
    let value = expression(cursor)?;
    let ExpressionKind::Variable(_, mut index) = variable.kind else {
        return Err(cursor.error("a variable is missing here"));
    };
    let variable = index
        .pop()
        .ok_or_else(|| cursor.error("a variable is missing here"))?;
    Ok(Assignment {
        variable,
        value,
        span,
    })
}

fn words(cursor: &mut Cursor, text: Text) -> Parsed<Vec<Word>> {
    let mut list = Vec::new();
    while let Some(token) = cursor.peek() {
        let start = cursor.span();
        let comma = cursor.take(',');
        let letter = match (cursor.peek(), token) {
            (Some(TokenKind::Letter(letter)), _) => *letter,
            (_, TokenKind::Symbol('/')) => {
                return Err(cursor.error_with_help(
                    "/ stands at the beginning of a block",
                    "put what may be left out in a block of its own: /X10.",
                ));
            }
            (_, TokenKind::Program(_)) => {
                return Err(cursor.error("a program begins on a line of its own"));
            }
            _ => {
                return Err(cursor.error_with_help(
                    "an address is missing here",
                    "a block consists of words such as G1, X10. or X#1",
                ));
            }
        };
        cursor.advance();
        let next = cursor.peek();
        let value = word_value(cursor).map_err(|error| missing_value(error, letter, next))?;
        let span = start.to(cursor.last_span());
        let digits = text.slice(cursor.last_span().start..span.end);
        let literal = match &value.kind {
            ExpressionKind::Number(_) => true,
            ExpressionKind::Unary(_, operand) => matches!(operand.kind, ExpressionKind::Number(_)),
            _ => false,
        };
        let plain = literal && digits.bytes().all(|byte| byte.is_ascii_digit());
        list.push(Word {
            letter,
            comma,
            value,
            pointless: plain.then_some(digits.len() as u32),
            span,
        });
    }
    Ok(list)
}

/// `next` is what stands behind the letter.
fn missing_value(error: Diagnostic, letter: char, next: Option<&TokenKind>) -> Diagnostic {
    let name = match (letter, next) {
        ('G', Some(TokenKind::Letter('O'))) => Some("GOTO"),
        ('T', Some(TokenKind::Letter('H'))) => Some("THEN"),
        ('E', Some(TokenKind::Letter('N'))) => Some("END"),
        _ => None,
    };
    let value = format!("write {letter}10., {letter}#1 or {letter}[#1+1]");
    Diagnostic::error(
        error.span,
        format!("the value of {letter} is missing or not a number"),
    )
    .help(match name {
        Some(name) => format!("{value}, or the name {name} with all its letters"),
        None => value,
    })
}
