//! From cleaned text to the syntax tree, one block at a time: a block that cannot be understood is
//! reported and does not hide the ones after it.

use super::clean::{Clean, clean};
use super::commands::{KNOWN, command, declaration};
use super::expressions::{begins_value, expression, is_parameter, variable};
use super::flow_parser::{NAMES, flow};
use super::reader::{Parsed, Reader};
use super::syntax::{Assignment, Block, Call, Item, Statement, Word};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::Place;
use crate::dialects::expression::{Binary, Expression, ExpressionKind};
use crate::dialects::scanner::is_blank;
use crate::dialects::spelling::did_you_mean;
use crate::source::{Span, Text};

/// The blocks of some lines, which do not end inside of what several lines say together; heads are none.
pub fn parse_blocks(text: Text, diagnostics: &mut Diagnostics) -> Vec<Block> {
    let mut declaring = None;
    let blocks = lines(text, &mut declaring, diagnostics);
    if let Some(span) = declaring {
        diagnostics.push(Diagnostic::error(
            span,
            "the #ENDVAR that belongs to this is missing",
        ));
    }
    blocks
}

/// The same, where a declaration (`#VAR`) may have begun before and may end behind.
pub(super) fn lines(
    text: Text,
    declaring: &mut Option<Span>,
    diagnostics: &mut Diagnostics,
) -> Vec<Block> {
    let clean = clean(text, diagnostics);
    let mut reader = Reader::new(Text {
        text: &clean.text,
        ..text
    });
    let mut blocks = Vec::new();
    while !reader.is_finished() {
        let start = reader.position();
        reader.blanks();
        if reader.peek() != Some('%') {
            let mut block = block(&mut reader, declaring, diagnostics);
            block.place.comment = comment(&clean, start, reader.position());
            blocks.push(block);
        }
        reader.next_line();
    }
    blocks
}

/// What a line that begins a program or subprogram says; see [`head`].
pub(super) fn head_line(
    text: Text,
    diagnostics: &mut Diagnostics,
) -> (Parsed<Option<String>>, Span) {
    let clean = clean(text, diagnostics);
    let mut reader = Reader::new(Text {
        text: &clean.text,
        ..text
    });
    let start = reader.position();
    reader.blanks();
    let parsed = head(&mut reader);
    (parsed, reader.span_from(start))
}

/// `%L NAME`: the name; `%NAME`, `% NAME`: `None`.
fn head(reader: &mut Reader) -> Parsed<Option<String>> {
    reader.advance();
    let separated = reader.rest().get(1..).unwrap_or("").starts_with(is_blank);
    let local = reader.name_ahead() == "L" && separated;
    if !local {
        reader.take_while(|_| true);
        return Ok(None);
    }
    reader.name();
    reader.blanks();
    let name = reader
        .take_while(|c| !c.is_whitespace())
        .to_ascii_uppercase();
    if name.is_empty() {
        return Err(
            reader.error_with_help("the name of the subprogram is missing", "write %L NAME")
        );
    }
    if !reader.is_at_end() {
        return Err(reader.error("nothing more may stand in this line"));
    }
    Ok(Some(name))
}

/// The comments between two places in the text.
fn comment(clean: &Clean, start: usize, end: usize) -> Option<String> {
    let first = clean.comments.partition_point(|(at, _)| *at < start);
    let texts: Vec<&str> = clean
        .comments
        .iter()
        .skip(first)
        .take_while(|(at, _)| *at < end.max(start + 1))
        .map(|(_, text)| text.as_str())
        .filter(|text| !text.is_empty())
        .collect();
    (!texts.is_empty()).then(|| texts.join("; "))
}

fn block(
    reader: &mut Reader,
    declaring: &mut Option<Span>,
    diagnostics: &mut Diagnostics,
) -> Block {
    let start = reader.position();
    let mut block = Block {
        place: Place {
            span: reader.span_from(start),
            number: None,
            comment: None,
        },
        skip: false,
        label: None,
        statement: Statement::Empty,
    };
    let parsed = prefix(reader, &mut block).and_then(|()| statement(reader, declaring));
    block.statement = parsed.unwrap_or_else(|diagnostic| {
        diagnostics.push(diagnostic);
        Statement::Invalid
    });
    reader.take_while(|_| true);
    // The block ends where its last character stands, before the blanks that comments left.
    let text = reader.text_from(start).trim_end();
    block.place.span.end = start + text.len();
    block
}

fn prefix(reader: &mut Reader, block: &mut Block) -> Parsed<()> {
    if reader.take("/") {
        block.skip = true;
        // A skip level from 1 to 10.
        reader.take_while(|c| c.is_ascii_digit());
    }
    reader.blanks();
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    if reader.peek() == Some('N') && digit(reader.peek_second()) {
        let span = reader.word_span();
        reader.advance();
        let digits = reader.take_while(|c| c.is_ascii_digit());
        let number = digits
            .parse()
            .map_err(|_| Diagnostic::error(span, "this block number is too large"))?;
        block.place.number = Some(number);
        // `N10:` is the target of a jump, as any N10 is here.
        reader.take(":");
    }
    reader.blanks();
    if reader.peek() == Some('[') {
        block.label = Some(label(reader)?);
    }
    Ok(())
}

/// `[NAME]`.
pub(super) fn label(reader: &mut Reader) -> Parsed<String> {
    reader.expect("[")?;
    let name = reader.take_while(|c| c != ']').trim().to_ascii_uppercase();
    reader.expect("]")?;
    if name.is_empty() {
        return Err(reader.error("a label without a name"));
    }
    Ok(name)
}

fn statement(reader: &mut Reader, declaring: &mut Option<Span>) -> Parsed<Statement> {
    if reader.is_at_end() {
        return Ok(Statement::Empty);
    }
    let start = reader.position();
    let name = reader.name_ahead();
    let statement = match reader.peek() {
        Some('#') => {
            reader.advance();
            if reader.keyword("VAR") {
                *declaring = Some(reader.span_from(start));
                Statement::Empty
            } else if reader.keyword("ENDVAR") {
                *declaring = None;
                Statement::Empty
            } else {
                Statement::Command(command(reader, start)?)
            }
        }
        Some('$') => {
            reader.advance();
            Statement::Flow(flow(reader, start)?)
        }
        _ if declaring.is_some() => Statement::Declare(declaration(reader)?),
        Some('L') if name == "LL" || name == "L" => call(reader)?,
        _ => Statement::Items(items(reader)?),
    };
    if !reader.is_at_end() {
        return Err(reader.error_with_help(
            "nothing more may stand in this block",
            "put what follows in a block of its own",
        ));
    }
    Ok(statement)
}

/// `LL NAME`, `L file.nc`, `L "file.nc"`.
fn call(reader: &mut Reader) -> Parsed<Statement> {
    let local = reader.name() == "LL";
    reader.blanks();
    let start = reader.position();
    let name = match reader.text()? {
        Some(text) => text,
        None => reader.take_while(|c| !c.is_whitespace()).to_string(),
    };
    let span = reader.span_from(start);
    let name = name.trim().to_ascii_uppercase();
    if name.is_empty() {
        return Err(reader.error_with_help(
            "the name of the subprogram is missing",
            "write LL NAME for one in this file, L name.nc for a file",
        ));
    }
    if name == "CYCLE" || name.starts_with("V.E.") {
        return Err(
            Diagnostic::error(span, format!("the call of {name} is not supported"))
                .help("post the program with the cycles written out as moves"),
        );
    }
    Ok(Statement::Call(Call { local, name, span }))
}

fn items(reader: &mut Reader) -> Parsed<Vec<Item>> {
    let mut list = Vec::new();
    while !reader.is_at_end() {
        let name = reader.name_ahead();
        let parameter = is_parameter(&name);
        let letter_after_point = |rest: &str| {
            let mut rest = rest.chars().skip(1);
            rest.next() == Some('.') && rest.next().is_some_and(|c| c.is_ascii_alphabetic())
        };
        let v_variable = name == "V" && letter_after_point(reader.rest());
        list.push(if parameter || v_variable {
            Item::Assign(assignment(reader)?)
        } else {
            Item::Word(word(reader)?)
        });
    }
    Ok(list)
}

/// `P1 = 5`, `P1 += 5`.
pub(super) fn assignment(reader: &mut Reader) -> Parsed<Assignment> {
    let (name, index, span) = variable(reader)?;
    let operators = [
        ("+=", Binary::Add),
        ("-=", Binary::Subtract),
        ("*=", Binary::Multiply),
        ("/=", Binary::Divide),
    ];
    let changing = operators
        .into_iter()
        .find(|(symbol, _)| reader.take(symbol));
    if changing.is_none() {
        reader.expect("=")?;
    }
    let mut value = expression(reader)?;
    if let Some((_, operator)) = changing {
        let old = Expression {
            kind: ExpressionKind::Variable(name.clone(), index.clone()),
            span,
        };
        value = Expression {
            span: value.span,
            kind: ExpressionKind::Binary(operator, Box::new(old), Box::new(value)),
        };
    }
    Ok(Assignment {
        name,
        index,
        value,
        span,
    })
}

/// An address and its value: `X10`, `X=P1`, `X[2*P1]`, `G159=2`.
fn word(reader: &mut Reader) -> Parsed<Word> {
    let start = reader.position();
    let Some(address @ 'A'..='Z') = reader.peek() else {
        return Err(reader.error_with_help(
            "an address is missing here",
            "a block consists of words such as G1, X10 or F=P5",
        ));
    };
    let whole = reader.name_ahead();
    reader.advance();
    let ahead = reader.name_ahead();
    if ahead.starts_with(|c: char| c.is_ascii_alphabetic()) && !begins_value(&ahead) {
        let mut at_word = reader.span_from(start);
        at_word.end = start + whole.len();
        return Err(
            Diagnostic::error(at_word, format!("`{whole}` is not a word of this dialect"))
                .help(meant(&whole)),
        );
    }
    reader.take("=");
    if reader.is_at_end() {
        return Err(Diagnostic::error(
            reader.span_from(start),
            format!("the value of {address} is missing"),
        )
        .help(format!("write {address}10 or {address}=P1")));
    }
    let value = expression(reader)?;
    // The search for operators goes over blanks.
    let end = start + reader.text_from(start).trim_end().len();
    if address == 'G' && reader.peek() == Some('[') {
        return Err(Diagnostic::error(
            reader.span_from(start),
            "a G function with arguments is a subprogram of the other control",
        )
        .help("post the program with what it does written out as moves"));
    }
    let second = match reader.take("=") || (is_dwell(address, &value) && has_time(reader)) {
        true => Some(expression(reader)?),
        false => None,
    };
    let mut span = reader.span_from(start);
    span.end = match second {
        None => end,
        Some(_) => start + reader.text_from(start).trim_end().len(),
    };
    Ok(Word {
        address,
        value,
        second,
        span,
    })
}

/// What may have been meant by a name without its mark.
fn meant(name: &str) -> String {
    let known = KNOWN.into_iter().chain(NAMES);
    let shown = |known: &str| match NAMES.contains(&known) {
        true => format!("${known}"),
        false => format!("#{known}"),
    };
    did_you_mean(name, known, shown).unwrap_or_else(|| {
        "commands begin with # (#MSG) or $ ($IF), calls with LL or L".to_string()
    })
}

fn is_dwell(address: char, value: &Expression) -> bool {
    address == 'G' && value.kind == ExpressionKind::Number(4.0)
}

/// `G04 2.5`, `G04 P1`: the time may stand without an address.
fn has_time(reader: &Reader) -> bool {
    let mut ahead = reader.clone();
    ahead.blanks();
    match ahead.peek() {
        Some('0'..='9' | '.' | '[') => true,
        Some('P' | 'V') => begins_value(&ahead.name_ahead()),
        _ => false,
    }
}
