//! From tokens to the syntax tree, one block at a time: a block that cannot be understood is reported
//! and does not hide the ones after it.

use super::cursor::{Cursor, Parsed};
use super::expressions::{arguments, expression};
use super::flow_parser;
use super::lexer::tokens;
use super::refusals::refused;
use super::syntax::{Assigned, Assignment, Block, Call, Procedure, Statement, Word, WordValue};
use super::token::{SectionName, Symbol, Token, TokenKind};
use super::word_parser::unknown_word;
use super::words;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::Place;
use crate::dialects::expression::{Expression, ExpressionKind};
use crate::source::{Span, Text};

/// The blocks of some lines; those that begin a section are none.
pub fn parse_blocks(text: Text, diagnostics: &mut Diagnostics) -> Vec<Block> {
    let tokens = tokens(text, diagnostics);
    let lines = tokens.split_inclusive(|token| token.kind == TokenKind::EndOfLine);
    let blocks = lines.filter_map(|line| {
        let (end, tokens) = line.split_last()?;
        match section_name(tokens) {
            Some(_) => None,
            None => parse_block(text, tokens, end.span, diagnostics),
        }
    });
    blocks.collect()
}

/// The name of the section that a line begins.
pub fn section_name(tokens: &[Token]) -> Option<&SectionName> {
    tokens.iter().find_map(|token| match &token.kind {
        TokenKind::Program(section) => Some(section),
        _ => None,
    })
}

fn parse_block(
    text: Text,
    tokens: &[Token],
    end: Span,
    diagnostics: &mut Diagnostics,
) -> Option<Block> {
    let (comment, tokens) = match tokens.split_last() {
        Some((last, before)) => match &last.kind {
            TokenKind::Comment(text) => (Some(text.clone()), before),
            _ => (None, tokens),
        },
        None => return None,
    };
    // Archive files name their directory in a comment; that is no comment of the program.
    let comment = comment.filter(|text| !text.to_ascii_uppercase().starts_with("$PATH="));
    let first = tokens.first().map_or(end, |token| token.span);
    let last = tokens.last().map_or(first, |token| token.span);
    let mut block = Block {
        place: Place {
            span: first.to(last),
            number: None,
            comment,
        },
        skip: false,
        label: None,
        statement: Statement::Empty,
    };
    let mut parser = BlockParser {
        cursor: Cursor::new(
            tokens,
            Span {
                start: last.end,
                end: last.end,
                ..last
            },
        ),
        text,
    };
    if tokens.iter().any(|token| token.kind == TokenKind::Invalid) {
        block.statement = Statement::Invalid;
        return Some(block);
    }
    let parsed = parser.prefix(&mut block).and_then(|()| parser.statement());
    block.statement = parsed.unwrap_or_else(|diagnostic| {
        diagnostics.push(diagnostic);
        Statement::Invalid
    });
    Some(block)
}

/// Parses one block.
pub(super) struct BlockParser<'a> {
    pub(super) cursor: Cursor<'a>,
    text: Text<'a>,
}

impl BlockParser<'_> {
    fn prefix(&mut self, block: &mut Block) -> Parsed<()> {
        if self.cursor.take(Symbol::Slash) {
            block.skip = true;
            if let Some(TokenKind::Number(level)) = self.cursor.peek() {
                if !(0.0..=9.0).contains(level) || level.fract() != 0.0 {
                    return Err(self.cursor.error("skip levels go from /0 to /9"));
                }
                self.cursor.advance();
            }
        }
        let numbered = matches!(self.cursor.peek_at(1), Some(TokenKind::Number(_)));
        if numbered && (self.cursor.take_letter('N') || self.cursor.take(Symbol::Colon)) {
            block.place.number = Some(self.cursor.whole("a block number")?);
        }
        if let (Some(TokenKind::Name(name)), true) =
            (self.cursor.peek(), self.cursor.is_symbol(1, Symbol::Colon))
        {
            block.label = Some(name.clone());
            self.cursor.advance();
            self.cursor.advance();
        }
        Ok(())
    }

    fn statement(&mut self) -> Parsed<Statement> {
        let statement = match self.cursor.peek() {
            None => return Ok(Statement::Empty),
            Some(TokenKind::Letter('L')) => self.numbered_call()?,
            Some(TokenKind::Letter('R')) => self.assignments()?,
            Some(TokenKind::Name(name)) => match self.named_statement(name)? {
                Some(statement) => statement,
                None => self.words()?,
            },
            _ => self.words()?,
        };
        if !self.cursor.is_at_end() {
            return Err(self.error_with_help(
                "nothing more may stand in this block",
                "put what follows in a block of its own",
            ));
        }
        Ok(statement)
    }

    /// Statements that begin with a name; `None` if it is a word among others.
    fn named_statement(&mut self, name: &str) -> Parsed<Option<Statement>> {
        if words::is_address(name) || words::is_flag(name) || words::is_noted(name) {
            return Ok(None);
        }
        if let Some(flow) = flow_parser::flow(self, name)? {
            return Ok(Some(flow));
        }
        let keyword = self.cursor.span();
        if let Some(command) = words::frame_keyword(name) {
            self.cursor.advance();
            let words = self.word_list()?;
            return Ok(Some(Statement::Frame {
                command,
                keyword,
                words,
            }));
        }
        if name == "$P_UIFR" {
            return self.settable_offset().map(Some);
        }
        self.refuse_known(name, keyword)?;
        if self.is_assignment() {
            return self.assignments().map(Some);
        }
        if name == "MSG" {
            return self.message().map(Some);
        }
        if name == "STOPRE" {
            self.cursor.advance();
            return Ok(Some(Statement::Nothing));
        }
        if name == "PROC" {
            return self.procedure().map(Some);
        }
        if name == "MCALL" {
            return self.modal_call().map(Some);
        }
        if matches!(name, "CALL" | "EXTCALL") {
            return self.call_by_text(name).map(Some);
        }
        if name == "SETAL" {
            self.cursor.advance();
            self.cursor.expect(Symbol::Open, "(")?;
            let list = arguments(&mut self.cursor, Symbol::Close, ")")?;
            return Ok(Some(Statement::Alarm(
                list.into_iter().flatten().collect(),
                keyword,
            )));
        }
        if name == "RET" {
            self.cursor.advance();
            return Ok(Some(Statement::Words(vec![Word {
                address: "RET".to_string(),
                value: WordValue::None,
                span: keyword,
            }])));
        }
        if name == "EXTERN" {
            // It declares a subprogram that its call finds without it.
            while self.cursor.advance().is_some() {}
            return Ok(Some(Statement::Noted(name.to_string())));
        }
        if words::is_reserved(name) {
            return Err(self.cursor.error(format!("{name} does not begin a block")));
        }
        self.call().map(Some)
    }

    /// `PROC NAME DISPLOF`: the head of a subprogram. The name is that of the file or section.
    fn procedure(&mut self) -> Parsed<Statement> {
        self.cursor.advance();
        self.procedure_name()?;
        let parameters = match self.cursor.is_symbol(0, Symbol::Open) {
            true => flow_parser::parameters(self)?,
            false => Vec::new(),
        };
        let mut saves = false;
        while let Some(TokenKind::Name(attribute)) = self.cursor.peek() {
            match attribute.as_str() {
                "SAVE" => saves = true,
                "DISPLOF" | "DISPLON" | "SBLOF" | "SBLON" => {}
                _ => break,
            }
            self.cursor.advance();
        }
        Ok(Statement::Procedure(Procedure { parameters, saves }))
    }

    /// `POCKET`, `L10`.
    fn procedure_name(&mut self) -> Parsed<()> {
        if self.cursor.take_letter('L') {
            return self.cursor.whole("the number of a subprogram").map(|_| ());
        }
        match self.cursor.peek() {
            Some(TokenKind::Name(_) | TokenKind::Letter(_)) => {
                self.cursor.advance();
                Ok(())
            }
            _ => Err(self.error_with_help(
                "the name of the subprogram is missing",
                "write it behind PROC: PROC POCKET(REAL DEPTH)",
            )),
        }
    }

    /// `MCALL POCKET(5)`, `MCALL`.
    fn modal_call(&mut self) -> Parsed<Statement> {
        self.cursor.advance();
        if self.cursor.is_at_end() {
            return Ok(Statement::ModalCall(None));
        }
        let statement = match self.cursor.peek() {
            Some(TokenKind::Letter('L')) => self.numbered_call()?,
            _ => self.call()?,
        };
        match statement {
            Statement::Call(call) if call.passes.is_none() => Ok(Statement::ModalCall(Some(call))),
            _ => Err(self.cursor.error("a modal call has no P")),
        }
    }

    /// `CALL "NAME"`, `EXTCALL "NAME"`, `EXTCALL(FOLDER << "NAME")`.
    fn call_by_text(&mut self, keyword: &str) -> Parsed<Statement> {
        self.cursor.advance();
        let is_text = matches!(
            self.cursor.peek(),
            Some(TokenKind::Text(_) | TokenKind::Name(_) | TokenKind::Symbol(Symbol::Open))
        );
        if !is_text {
            return Err(self.error_with_help(
                &format!("{keyword} needs the name of a subprogram as a text"),
                &format!("write {keyword} \"POCKET\""),
            ));
        }
        expression(&mut self.cursor).map(Statement::CallByText)
    }

    pub(super) fn refuse_known(&self, name: &str, span: Span) -> Parsed<()> {
        let reason = match refused(name) {
            Some(reason) => reason,
            None if name.starts_with('$') => "system variables cannot be evaluated ahead of time",
            None => return Ok(()),
        };
        Err(Diagnostic::error(span, format!("{name} is not supported")).help(reason))
    }

    /// `L10`, `L10 P3`: leading zeros belong to the name.
    fn numbered_call(&mut self) -> Parsed<Statement> {
        let start = self.cursor.span();
        self.cursor.advance();
        if !matches!(self.cursor.peek(), Some(TokenKind::Number(_))) {
            return Err(self
                .cursor
                .error("the number of the subprogram is missing: L10"));
        }
        self.cursor.whole("the number of a subprogram")?;
        let span = start.to(self.cursor.last_span());
        let digits = self.text.slice(self.cursor.last_span().start..span.end);
        let passes = self.passes()?;
        Ok(Statement::Call(Call {
            name: format!("L{digits}"),
            span,
            arguments: Vec::new(),
            passes,
        }))
    }

    fn call(&mut self) -> Parsed<Statement> {
        let span = self.cursor.span();
        let name = match self.cursor.advance().map(|token| &token.kind) {
            Some(TokenKind::Name(name)) => name.clone(),
            _ => return Err(self.cursor.error("the name of a subprogram is missing")),
        };
        let has_values = self.cursor.take(Symbol::Open);
        let arguments = match has_values {
            true => arguments(&mut self.cursor, Symbol::Close, ")")?,
            false => Vec::new(),
        };
        let passes = self.passes()?;
        if !self.cursor.is_at_end() {
            return Err(match has_values {
                true => self.not_alone(&name),
                // A call stands alone: this is a word that nobody knows, among others.
                false => unknown_word(&name, span),
            });
        }
        Ok(Statement::Call(Call {
            name,
            span,
            arguments,
            passes,
        }))
    }

    /// An error for what stands beside the call of a subprogram.
    pub(super) fn not_alone(&self, name: &str) -> Diagnostic {
        self.error_with_help(
            &format!("the call of {name} stands alone in its block"),
            "put what stands beside it in a block of its own",
        )
    }

    pub(super) fn passes(&mut self) -> Parsed<Option<Expression>> {
        if !self.cursor.take_letter('P') {
            return Ok(None);
        }
        self.cursor.take(Symbol::Assign);
        expression(&mut self.cursor).map(Some)
    }

    fn message(&mut self) -> Parsed<Statement> {
        self.cursor.advance();
        self.cursor.expect(Symbol::Open, "(")?;
        let list = arguments(&mut self.cursor, Symbol::Close, ")")?;
        Ok(Statement::Message(list.into_iter().next().flatten()))
    }

    fn is_assignment(&self) -> bool {
        self.cursor.is_symbol(1, Symbol::Assign) || self.cursor.is_symbol(1, Symbol::OpenBracket)
    }

    fn assignments(&mut self) -> Parsed<Statement> {
        let mut list = Vec::new();
        while !self.cursor.is_at_end() {
            let is_variable = match self.cursor.peek() {
                Some(TokenKind::Letter('R')) => true,
                Some(TokenKind::Name(name)) => !words::is_reserved(name) && self.is_assignment(),
                _ => false,
            };
            if !is_variable {
                return Err(self.not_assigned(list.is_empty()));
            }
            list.push(self.assignment()?);
        }
        Ok(Statement::Assign(list))
    }

    /// An error for what is no variable where one is given a value.
    fn not_assigned(&self, first: bool) -> Diagnostic {
        if let Some(TokenKind::Name(name)) = self.cursor.peek() {
            let known = self.refuse_known(name, self.cursor.span());
            if let Err(refusal) = known {
                return refusal;
            }
            if first {
                return words::no_variable(name, self.cursor.span());
            }
        }
        self.error_with_help(
            "values for variables and other words cannot stand in one block",
            "put the assignments in a block of their own",
        )
    }

    /// One `name = value`.
    pub(super) fn assignment(&mut self) -> Parsed<Assignment> {
        let (name, index, span) = self.variable()?;
        self.cursor.expect(Symbol::Assign, "=")?;
        let value = self.assigned(false)?;
        Ok(Assignment {
            name,
            index,
            value,
            span,
        })
    }

    /// A value, `SET(..)`, `REP(..)`; where an array is declared also `(1, 2, 3)`.
    pub(super) fn assigned(&mut self, declares_array: bool) -> Parsed<Assigned> {
        let is_list = self.cursor.is_symbol(1, Symbol::Open);
        if is_list && self.cursor.take_name("SET") || declares_array && self.starts_list() {
            self.cursor.expect(Symbol::Open, "(")?;
            let list = arguments(&mut self.cursor, Symbol::Close, ")")?;
            return Ok(Assigned::Set(list));
        }
        if !(is_list && self.cursor.take_name("REP")) {
            return expression(&mut self.cursor).map(Assigned::One);
        }
        self.cursor.advance();
        let mut list = arguments(&mut self.cursor, Symbol::Close, ")")?.into_iter();
        match (list.next().flatten(), list.next(), list.next()) {
            (Some(value), count, None) => Ok(Assigned::Repeat(value, count.flatten())),
            _ => Err(self.error_with_help(
                "REP needs a value, and takes a number of elements behind it",
                "write REP(0) or REP(0,10)",
            )),
        }
    }

    fn starts_list(&self) -> bool {
        self.cursor.is_symbol(0, Symbol::Open)
    }

    /// A variable that is written to.
    fn variable(&mut self) -> Parsed<(String, Vec<Expression>, Span)> {
        // A variable has the form of an expression; the equals sign ends it.
        let variable = match self.cursor.peek() {
            Some(TokenKind::Name(name)) if name.starts_with('$') => {
                self.refuse_known(name, self.cursor.span())?;
                expression(&mut self.cursor)?
            }
            Some(TokenKind::Letter('R') | TokenKind::Name(_)) => expression(&mut self.cursor)?,
            _ => return Err(self.cursor.error("the name of a variable is missing")),
        };
        match variable.kind {
            ExpressionKind::Variable(name, index) => Ok((name, index, variable.span)),
            _ => Err(Diagnostic::error(
                variable.span,
                "only a variable can be given a value",
            )),
        }
    }

    fn words(&mut self) -> Parsed<Statement> {
        self.word_list().map(Statement::Words)
    }

    pub(super) fn error_with_help(&self, message: &str, help: &str) -> Diagnostic {
        Diagnostic::error(self.cursor.span(), message).help(help)
    }
}
