//! From cleaned text to the syntax tree, one block at a time: a block that cannot be understood is
//! reported and does not hide the ones after it.

use super::clean::{Clean, clean};
use super::commands::{command, declaration};
use super::expressions::{begins_value, expression, is_parameter, variable};
use super::flow_parser::flow;
use super::reader::{Parsed, Reader};
use super::structure::Structure;
use super::syntax::{Assignment, Block, Call, Item, Routine, Statement, Word};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::expression::{Binary, Expression, ExpressionKind};
use crate::source::{Sources, Span, Text};

/// The programs and subprograms of a file; see [`crate::dialects::library::Parse`].
pub fn parse(
    text: Text,
    stem: &str,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) -> Vec<Routine> {
    let file = text.file;
    let clean = clean(text, diagnostics);
    let mut reader = Reader::new(Text {
        text: &clean.text,
        ..text
    });
    let file_name = |path: &str| {
        let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
        name.to_ascii_uppercase()
    };
    let main = Routine {
        name: stem.to_string(),
        title: file_name(&sources.file(file).name),
        main: true,
        file,
        blocks: Vec::new(),
        structure: Structure::default(),
    };
    let mut routines = vec![main.clone()];
    let mut declaring = None;
    while !reader.is_finished() {
        let start = reader.position();
        reader.blanks();
        if reader.peek() == Some('%') {
            match head(&mut reader) {
                Ok(Some(title)) => {
                    let name = format!("{file}:{title}");
                    if routines.iter().any(|known| known.name == name) {
                        let twice = format!("{title} is in this file twice");
                        let error = Diagnostic::error(reader.span_from(start), twice);
                        diagnostics.push(error.help("give one of them another name"));
                    }
                    routines.push(Routine {
                        name,
                        title,
                        main: false,
                        ..main.clone()
                    });
                }
                Ok(None) => routines.push(main.clone()),
                Err(diagnostic) => {
                    diagnostics.push(*diagnostic);
                    // A subprogram that nothing can call: its blocks are not the program's.
                    routines.push(Routine {
                        main: false,
                        ..main.clone()
                    });
                }
            }
            reader.next_line();
            continue;
        }
        let mut block = block(&mut reader, &mut declaring, diagnostics);
        block.comment = comment(&clean, start, reader.position());
        if let Some(routine) = routines.last_mut() {
            routine.blocks.push(block);
        }
        reader.next_line();
    }
    if let Some(span) = declaring {
        diagnostics.push(Diagnostic::error(
            span,
            "the #ENDVAR that belongs to this is missing",
        ));
    }
    // The main program may have a head or not: what stands before the first head is none if empty.
    let is_content = |routine: &Routine| !crate::dialects::library::Routine::is_empty(routine);
    let several = routines.len() > 1;
    routines.retain(|routine| !several || !routine.main || is_content(routine));
    for routine in &mut routines {
        routine.structure = Structure::of(&routine.blocks, diagnostics);
    }
    routines
}

/// `%L NAME`: the name; `%NAME`, `% NAME`: `None`.
fn head(reader: &mut Reader) -> Parsed<Option<String>> {
    reader.advance();
    let separated = reader
        .rest()
        .get(1..)
        .unwrap_or("")
        .starts_with([' ', '\t']);
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
        span: reader.span_from(start),
        number: None,
        skip: false,
        label: None,
        statement: Statement::Empty,
        comment: None,
    };
    let parsed = prefix(reader, &mut block).and_then(|()| statement(reader, declaring));
    block.statement = parsed.unwrap_or_else(|diagnostic| {
        diagnostics.push(*diagnostic);
        Statement::Invalid
    });
    reader.take_while(|_| true);
    // The block ends where its last character stands, before the blanks that comments left.
    let text = reader.text_from(start).trim_end();
    block.span.end = start + text.len();
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
            .map_err(|_| Box::new(Diagnostic::error(span, "this block number is too large")))?;
        block.number = Some(number);
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
        return Err(Box::new(
            Diagnostic::error(span, format!("the call of {name} is not supported"))
                .help("post the program with the cycles written out as moves"),
        ));
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
        return Err(Box::new(
            Diagnostic::error(at_word, format!("`{whole}` is not a word of this dialect"))
                .help("commands begin with # (#MSG) or $ ($IF), calls with LL or L"),
        ));
    }
    reader.take("=");
    if reader.is_at_end() {
        return Err(Box::new(
            Diagnostic::error(
                reader.span_from(start),
                format!("the value of {address} is missing"),
            )
            .help(format!("write {address}10 or {address}=P1")),
        ));
    }
    let value = expression(reader)?;
    let end = reader.position();
    let second = match reader.take("=") || (is_dwell(address, &value) && has_time(reader)) {
        true => Some(expression(reader)?),
        false => None,
    };
    let mut span = reader.span_from(start);
    if second.is_none() {
        span.end = end;
    }
    Ok(Word {
        address,
        value,
        second,
        span,
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
