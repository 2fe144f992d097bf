//! From tokens to the syntax tree, one block at a time: a block that cannot be understood is reported
//! and does not hide the ones after it.

use super::cursor::{Cursor, Parsed};
use super::expressions::word_value;
use super::high_level::{KEYWORDS, high_level_block};
use super::lexer::tokens;
use super::syntax::{Block, Statement, Word};
use super::token::{Token, TokenKind};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::Place;
use crate::dialects::spelling::did_you_mean;
use crate::source::{Span, Text};

/// The blocks of some lines; the header of the program is none.
pub fn parse_blocks(text: Text, diagnostics: &mut Diagnostics) -> Vec<Block> {
    let tokens = tokens(text, diagnostics);
    let lines = tokens.split_inclusive(|token| token.kind == TokenKind::EndOfLine);
    let blocks = lines.filter_map(|line| {
        let (end, tokens) = line.split_last()?;
        match header(tokens) {
            Some(_) => None,
            None => parse_block(text, tokens, end.span, diagnostics),
        }
    });
    blocks.collect()
}

/// The name of the program in a line that is its header, and where it stands.
pub fn header(tokens: &[Token]) -> Option<(&String, Span)> {
    match tokens.first() {
        Some(Token {
            kind: TokenKind::Program(name),
            span,
        }) => Some((name, *span)),
        _ => None,
    }
}

fn parse_block(
    text: Text,
    tokens: &[Token],
    end: Span,
    diagnostics: &mut Diagnostics,
) -> Option<Block> {
    let (last, before) = tokens.split_last()?;
    let (comment, tokens) = match &last.kind {
        TokenKind::Comment(text) => (Some(text.clone()), before),
        _ => (None, tokens),
    };
    let first = tokens.first().map_or(end, |token| token.span);
    let last = tokens.last().map_or(first, |token| token.span);
    let mut block = Block {
        place: Place {
            span: first.to(last),
            number: None,
            comment,
        },
        skip: false,
        statement: Statement::Empty,
    };
    if tokens.iter().any(|token| token.kind == TokenKind::Invalid) {
        block.statement = Statement::Invalid;
        return Some(block);
    }
    let mut cursor = Cursor::new(
        tokens,
        Span {
            start: last.end,
            ..last
        },
    );
    let parsed = prefix(&mut cursor, &mut block).and_then(|()| statement(&mut cursor, text));
    block.statement = parsed.unwrap_or_else(|diagnostic| {
        diagnostics.push(diagnostic);
        Statement::Invalid
    });
    Some(block)
}

/// `/`, `/2` and `N10`.
fn prefix(cursor: &mut Cursor, block: &mut Block) -> Parsed<()> {
    if cursor.take('/') {
        block.skip = true;
        if let Some(TokenKind::Number(condition)) = cursor.peek() {
            if ![1.0, 2.0, 3.0].contains(condition) {
                return Err(cursor.error("block skip conditions are /1, /2 and /3"));
            }
            cursor.advance();
        }
    }
    if cursor.take_letter('N') {
        block.place.number = Some(cursor.whole("a block number")?);
    }
    Ok(())
}

fn statement(cursor: &mut Cursor, text: Text) -> Parsed<Statement> {
    let statement = match cursor.peek() {
        None => return Ok(Statement::Empty),
        Some(TokenKind::Symbol('(')) => high_level_block(cursor)?,
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

/// `GOTO N10` without parentheses would be words without values.
fn refuse_bare_statement(cursor: &Cursor, text: Text) -> Parsed<()> {
    let mut ahead = cursor.clone();
    let start = ahead.span();
    while matches!(ahead.peek(), Some(TokenKind::Letter(_)))
        && (ahead.span() == start || ahead.is_adjacent())
    {
        ahead.advance();
    }
    let span = start.to(ahead.last_span());
    let name = text.slice(span.start..span.end).to_ascii_uppercase();
    // Fewer letters are addresses: G14 names axes without values.
    let known = KEYWORDS.into_iter().filter(|_| name.len() > 2);
    match did_you_mean(&name, known, |known| format!("({known} ..)")) {
        None => Ok(()),
        Some(similar) => Err(Diagnostic::error(
            span,
            format!("`{name}` is not a word of this dialect"),
        )
        .help(format!("statements stand in parentheses; {similar}"))),
    }
}

fn words(cursor: &mut Cursor, text: Text) -> Parsed<Vec<Word>> {
    let mut list = Vec::new();
    refuse_bare_statement(cursor, text)?;
    while let Some(token) = cursor.peek() {
        let start = cursor.span();
        let letter = match token {
            TokenKind::Letter(letter) => *letter,
            TokenKind::Symbol('(') => {
                return Err(cursor.error_with_help(
                    "a statement in parentheses stands alone in its block",
                    "put it in a block of its own; comments begin with ;",
                ));
            }
            _ => {
                return Err(cursor.error_with_help(
                    "an address is missing here",
                    "a block consists of words such as G1, X10 or XP1",
                ));
            }
        };
        if letter == 'P' && !list.iter().any(Word::is_pattern) {
            return Err(cursor.error_with_help(
                "a parameter stands here without an address",
                "write XP1 for a value, or (P1=5) to assign one",
            ));
        }
        cursor.advance();
        // G11 to G14 name axes without a value.
        let bare = match cursor.peek() {
            None => true,
            Some(TokenKind::Letter(next)) => *next != 'P',
            _ => false,
        };
        let value = match bare {
            true => None,
            false => Some(word_value(cursor).map_err(|error| missing_value(error, letter))?),
        };
        let span = start.to(cursor.last_span());
        let digits = text.slice(start.end..span.end).trim();
        list.push(Word {
            letter,
            value,
            digits: digits.to_string(),
            span,
        });
    }
    Ok(list)
}

fn missing_value(error: Diagnostic, letter: char) -> Diagnostic {
    Diagnostic::error(
        error.span,
        format!("the value of {letter} is missing or not a number"),
    )
    .help(format!("write {letter}10 or {letter}P1"))
}
