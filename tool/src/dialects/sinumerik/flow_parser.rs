//! Parsing conditions, loops, jumps and declarations.

use super::cursor::Parsed;
use super::expressions::{arguments, expression};
use super::parser::BlockParser;
use super::syntax::{
    Definition, Direction, Flow, Jump, Parameter, RepeatPart, Statement, Target, VariableKind,
};
use super::token::{Symbol, TokenKind};
use super::words;

/// The statement that begins with `name`, if it is one of those here.
pub(super) fn flow(parser: &mut BlockParser, name: &str) -> Parsed<Option<Statement>> {
    let flow = match name {
        "IF" => {
            parser.cursor.advance();
            let condition = expression(&mut parser.cursor)?;
            match direction(parser) {
                Some(direction) => Flow::JumpIf(condition, jump(parser, direction)?),
                None => Flow::If(condition),
            }
        }
        "ELSE" => keyword(parser, Flow::Else),
        "ENDIF" => keyword(parser, Flow::EndIf),
        "WHILE" => {
            parser.cursor.advance();
            Flow::While(expression(&mut parser.cursor)?)
        }
        "ENDWHILE" => keyword(parser, Flow::EndWhile),
        "FOR" => {
            parser.cursor.advance();
            let start = parser.assignment()?;
            if !parser.cursor.take_name("TO") {
                return Err(parser.cursor.error("`TO` is missing here"));
            }
            Flow::For(start, expression(&mut parser.cursor)?)
        }
        "ENDFOR" => keyword(parser, Flow::EndFor),
        "LOOP" => keyword(parser, Flow::Loop),
        "ENDLOOP" => keyword(parser, Flow::EndLoop),
        "REPEAT" => {
            parser.cursor.advance();
            match parser.cursor.is_at_end() {
                true => Flow::Repeat,
                false => Flow::RepeatPart(repeat_part(parser, false)?),
            }
        }
        "REPEATB" => {
            parser.cursor.advance();
            Flow::RepeatPart(repeat_part(parser, true)?)
        }
        "UNTIL" => {
            parser.cursor.advance();
            Flow::Until(expression(&mut parser.cursor)?)
        }
        "CASE" => case(parser)?,
        "DEF" => return definitions(parser).map(Some),
        _ => match direction(parser) {
            Some(direction) => Flow::Jump(jump(parser, direction)?),
            None => return Ok(None),
        },
    };
    Ok(Some(Statement::Flow(flow)))
}

fn keyword(parser: &mut BlockParser, flow: Flow) -> Flow {
    parser.cursor.advance();
    flow
}

/// Takes `GOTOF` and its like.
fn direction(parser: &mut BlockParser) -> Option<Direction> {
    let direction = match parser.cursor.peek() {
        Some(TokenKind::Name(name)) => match name.as_str() {
            "GOTOF" => Direction::Forward,
            "GOTOB" => Direction::Backward,
            "GOTO" => Direction::Either,
            "GOTOC" => Direction::Optional,
            _ => return None,
        },
        _ => return None,
    };
    parser.cursor.advance();
    Some(direction)
}

/// The labels and `P=2` of REPEAT and REPEATB.
fn repeat_part(parser: &mut BlockParser, one_block: bool) -> Parsed<RepeatPart> {
    let start = parser.cursor.span();
    let first = target(parser)?;
    let has_last = !one_block
        && !parser.cursor.is_at_end()
        && !matches!(parser.cursor.peek(), Some(TokenKind::Letter('P')));
    let last = match has_last {
        true => Some(target(parser)?),
        false => None,
    };
    let span = start.to(parser.cursor.last_span());
    Ok(RepeatPart {
        first,
        last,
        one_block,
        times: parser.passes()?,
        span,
    })
}

/// The target of a jump that is not a branch of CASE, where only labels and numbers stand.
fn jump(parser: &mut BlockParser, direction: Direction) -> Parsed<Jump> {
    let start = parser.cursor.span();
    let is_text = match parser.cursor.peek() {
        Some(TokenKind::Text(_) | TokenKind::Symbol(Symbol::Open)) => true,
        Some(TokenKind::Name(_)) => [Symbol::OpenBracket, Symbol::Concatenate]
            .into_iter()
            .any(|symbol| parser.cursor.is_symbol(1, symbol)),
        _ => false,
    };
    if !is_text {
        return branch(parser, direction);
    }
    Ok(Jump {
        direction,
        target: Target::Text(expression(&mut parser.cursor)?),
        span: start.to(parser.cursor.last_span()),
    })
}

fn branch(parser: &mut BlockParser, direction: Direction) -> Parsed<Jump> {
    let start = parser.cursor.span();
    let target = target(parser)?;
    Ok(Jump {
        direction,
        target,
        span: start.to(parser.cursor.last_span()),
    })
}

/// A label or a block number.
fn target(parser: &mut BlockParser) -> Parsed<Target> {
    Ok(match parser.cursor.peek() {
        Some(TokenKind::Name(label)) => {
            parser.cursor.advance();
            Target::Label(label.clone())
        }
        Some(TokenKind::Letter('N')) => {
            parser.cursor.advance();
            Target::Number(parser.cursor.whole("a block number")?)
        }
        Some(TokenKind::Symbol(Symbol::Colon)) => {
            parser.cursor.advance();
            Target::Number(parser.cursor.whole("a block number")?)
        }
        _ => {
            return Err(parser.error_with_help(
                "the label is missing here",
                "name a label or a block number: GOTOF END_OF_PART, GOTOB N100",
            ));
        }
    })
}

fn case(parser: &mut BlockParser) -> Parsed<Flow> {
    parser.cursor.advance();
    let value = expression(&mut parser.cursor)?;
    if !parser.cursor.take_name("OF") {
        return Err(parser.cursor.error("`OF` is missing here"));
    }
    let mut cases = Vec::new();
    let mut default = None;
    while !parser.cursor.is_at_end() {
        let is_default = parser.cursor.take_name("DEFAULT");
        let constant = match is_default {
            true => None,
            false => Some(expression(&mut parser.cursor)?),
        };
        let Some(direction) = direction(parser) else {
            return Err(parser
                .cursor
                .error("a jump (GOTOF, GOTOB, GOTO) is missing here"));
        };
        let jump = branch(parser, direction)?;
        match constant {
            Some(constant) => cases.push((constant, jump)),
            None => {
                default = Some(jump);
                break;
            }
        }
    }
    Ok(Flow::Case(value, cases, default))
}

/// `DEF REAL A, B[3] = 2`: the words between DEF and the type (NCK, PHU and so on) do not occur in
/// part programs.
fn definitions(parser: &mut BlockParser) -> Parsed<Statement> {
    parser.cursor.advance();
    let kind = variable_kind(parser)?;
    let mut list = Vec::new();
    loop {
        list.push(definition(parser, kind)?);
        if !parser.cursor.take(Symbol::Comma) {
            return Ok(Statement::Define(list));
        }
    }
}

/// `PROC NAME(REAL A, VAR INT B, REAL C=5)`; the name is taken.
pub(super) fn parameters(parser: &mut BlockParser) -> Parsed<Vec<Parameter>> {
    let mut list = Vec::new();
    parser.cursor.expect(Symbol::Open, "(")?;
    if parser.cursor.take(Symbol::Close) {
        return Ok(list);
    }
    loop {
        let returns = parser.cursor.take_name("VAR");
        let kind = variable_kind(parser)?;
        let definition = definition(parser, kind)?;
        if !definition.size.is_empty() {
            return Err(crate::diagnostics::Diagnostic::error(
                definition.span,
                "arrays as parameters are not supported",
            ));
        }
        list.push(Parameter {
            returns,
            definition,
        });
        if parser.cursor.take(Symbol::Close) {
            return Ok(list);
        }
        parser.cursor.expect(Symbol::Comma, ",")?;
    }
}

/// `REAL`, `INT`, `BOOL`, `STRING`, `STRING[20]`.
fn variable_kind(parser: &mut BlockParser) -> Parsed<VariableKind> {
    let kind = match parser.cursor.peek() {
        Some(TokenKind::Name(name)) => match name.as_str() {
            "INT" => VariableKind::Whole,
            "REAL" => VariableKind::Real,
            "BOOL" => VariableKind::Truth,
            "STRING" | "CHAR" => VariableKind::Text,
            _ => {
                return Err(parser.error_with_help(
                    &format!("variables of the type {name} are not supported"),
                    "use INT, REAL, BOOL or STRING",
                ));
            }
        },
        _ => return Err(parser.cursor.error("the type of the variable is missing")),
    };
    parser.cursor.advance();
    if kind == VariableKind::Text && parser.cursor.take(Symbol::OpenBracket) {
        // The length of a text does not matter here.
        arguments(&mut parser.cursor, Symbol::CloseBracket, "]")?;
    }
    Ok(kind)
}

fn definition(parser: &mut BlockParser, kind: VariableKind) -> Parsed<Definition> {
    let span = parser.cursor.span();
    let name = match parser.cursor.peek() {
        Some(TokenKind::Name(name)) if !words::is_reserved(name) && !name.starts_with('$') => {
            name.clone()
        }
        Some(TokenKind::Name(name)) if words::is_reserved(name) => {
            parser.refuse_known(name, span)?;
            return Err(words::no_variable(name, span));
        }
        _ => {
            return Err(parser.error_with_help(
                "this cannot be the name of a variable",
                "use two letters or more that are no command",
            ));
        }
    };
    parser.cursor.advance();
    let mut size = Vec::new();
    if parser.cursor.take(Symbol::OpenBracket) {
        for item in arguments(&mut parser.cursor, Symbol::CloseBracket, "]")? {
            size.push(item.ok_or_else(|| parser.cursor.error("the size of the array is missing"))?);
        }
    }
    let value = match parser.cursor.take(Symbol::Assign) {
        true => Some(parser.assigned(!size.is_empty())?),
        false => None,
    };
    Ok(Definition {
        name,
        span,
        kind,
        size,
        value,
    })
}
