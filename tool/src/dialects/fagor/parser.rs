//! From tokens to the syntax tree, one block at a time: a block that cannot be understood is reported
//! and does not hide the ones after it.

use super::cursor::{Cursor, Parsed};
use super::expressions::word_value;
use super::high_level::high_level_block;
use super::syntax::{Block, HighLevel, Section, Statement, Word};
use super::token::{Token, TokenKind};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::{Span, Text};

/// The name in the header and the sections of a file: the main program first, then its subroutines.
pub fn parse(
    text: Text,
    tokens: &[Token],
    diagnostics: &mut Diagnostics,
) -> (Option<String>, Vec<Section>) {
    let mut name = None;
    let mut main = Section {
        subroutine: None,
        blocks: Vec::new(),
    };
    let mut subroutines: Vec<Section> = Vec::new();
    let mut open: Option<(Section, Span)> = None;
    for line in tokens.split_inclusive(|token| token.kind == TokenKind::EndOfLine) {
        let Some((end, tokens)) = line.split_last() else {
            continue;
        };
        if let Some(Token {
            kind: TokenKind::Program(header),
            span,
        }) = tokens.first()
        {
            if name.is_some() || !main.blocks.iter().all(is_empty) || !subroutines.is_empty() {
                diagnostics.push(
                    Diagnostic::error(*span, "a second program begins in the same file")
                        .help("keep one program with its subroutines in the file"),
                );
            }
            name = Some(header.clone());
            continue;
        }
        let Some(block) = parse_block(text, tokens, end.span, diagnostics) else {
            continue;
        };
        match (&block.statement, &mut open) {
            (Statement::Subroutine(number), None) => {
                let section = Section {
                    subroutine: Some(*number),
                    blocks: Vec::new(),
                };
                open = Some((section, block.span));
            }
            (Statement::Subroutine(_), Some((_, first))) => {
                let line = line_of(text, *first);
                diagnostics.push(
                    Diagnostic::error(block.span, "a subroutine begins inside of another")
                        .help(format!("end the one of line {line} with (RET)")),
                );
            }
            (Statement::High(HighLevel::Return(_)), Some(_)) => {
                if let Some((mut section, _)) = open.take() {
                    section.blocks.push(block);
                    subroutines.push(section);
                }
            }
            (_, Some((section, _))) => section.blocks.push(block),
            (_, None) => main.blocks.push(block),
        }
    }
    if let Some((section, span)) = open {
        diagnostics.push(
            Diagnostic::error(span, "this subroutine does not end")
                .help("put (RET) into a block of its own at its end"),
        );
        subroutines.push(section);
    }
    subroutines.insert(0, main);
    (name, subroutines)
}

fn line_of(text: Text, span: Span) -> usize {
    let before = text.slice(text.start..span.start);
    before.matches('\n').count() + 1
}

/// Whether a block holds nothing but a comment.
pub fn is_empty(block: &Block) -> bool {
    block.statement == Statement::Empty
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
        span: first.to(last),
        number: None,
        skip: false,
        statement: Statement::Empty,
        comment,
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
        diagnostics.push(*diagnostic);
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
        block.number = Some(cursor.whole("a block number")?);
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

fn words(cursor: &mut Cursor, text: Text) -> Parsed<Vec<Word>> {
    let mut list = Vec::new();
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
        if letter == 'P' {
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
            false => Some(word_value(cursor).map_err(|error| missing_value(*error, letter))?),
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

fn missing_value(error: Diagnostic, letter: char) -> Box<Diagnostic> {
    Box::new(
        Diagnostic::error(
            error.span,
            format!("the value of {letter} is missing or not a number"),
        )
        .help(format!("write {letter}10 or {letter}P1")),
    )
}
