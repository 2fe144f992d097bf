//! Parsing words: an address and its value.

use super::cursor::Parsed;
use super::expressions::expression;
use super::parser::BlockParser;
use super::syntax::{Way, Word, WordValue};
use super::token::{Symbol, TokenKind};
use super::words;
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Expression, ExpressionKind};
use crate::source::Span;

impl BlockParser<'_> {
    /// Words up to the end of the block.
    pub(super) fn word_list(&mut self) -> Parsed<Vec<Word>> {
        let mut list = Vec::new();
        while let Some(token) = self.cursor.peek() {
            list.push(match token {
                TokenKind::Letter(letter) => self.letter_word(*letter)?,
                TokenKind::Name(name) => self.named_word(name)?,
                _ => {
                    return Err(self.error_with_help(
                        "an address is missing here",
                        "a block consists of words such as G1, X10 or F=R5",
                    ));
                }
            });
        }
        Ok(list)
    }

    fn letter_word(&mut self, letter: char) -> Parsed<Word> {
        let start = self.cursor.span();
        if matches!(letter, 'R' | 'L') {
            return Err(self.error_with_help(
                match letter {
                    'R' => "values for variables and other words cannot stand in one block",
                    _ => "a subprogram call stands alone in its block",
                },
                "put it in a block of its own",
            ));
        }
        self.cursor.advance();
        let mut address = letter.to_string();
        // M1=3, S1=500, X1=10: the number belongs to the address.
        if let (Some(TokenKind::Number(number)), true, true) = (
            self.cursor.peek(),
            self.cursor.is_adjacent(),
            self.cursor.is_symbol(1, Symbol::Assign),
        ) {
            address.push_str(&number.to_string());
            self.cursor.advance();
        }
        self.word_value(address, start)
    }

    fn named_word(&mut self, name: &str) -> Parsed<Word> {
        let span = self.cursor.span();
        if name == "SETMS" {
            return self.master_spindle(span);
        }
        if words::is_noted(name) {
            return self.noted(name, span);
        }
        if words::is_flag(name) {
            self.cursor.advance();
            return Ok(Word {
                address: name.to_string(),
                value: WordValue::None,
                span,
            });
        }
        if words::is_address(name) {
            self.cursor.advance();
            if matches!(name, "SPOS" | "SPOSA" | "LIMS") {
                self.first_spindle(name)?;
            }
            if !self.cursor.is_symbol(0, Symbol::Assign) {
                return Err(self.cursor.error(format!("`=` is missing after {name}")));
            }
            return self.word_value(name.to_string(), span);
        }
        if words::is_statement(name) {
            return Err(self.error_with_help(
                &format!("{name} stands alone in its block"),
                "put it in a block of its own",
            ));
        }
        self.refuse_known(name, span)?;
        if self.cursor.is_symbol(1, Symbol::Open) && words::similar(name).is_none() {
            return Err(self.not_alone(name));
        }
        Err(unknown_word(name, span))
    }

    /// The spindle of `SPOS[1]=90`.
    fn first_spindle(&mut self, name: &str) -> Parsed<()> {
        if !self.cursor.take(Symbol::OpenBracket) {
            return Ok(());
        }
        let spindle = expression(&mut self.cursor)?;
        self.cursor.expect(Symbol::CloseBracket, "]")?;
        let shown = match spindle.kind {
            ExpressionKind::Number(1.0) => return Ok(()),
            ExpressionKind::Number(number) => number.to_string(),
            _ => "..".to_string(),
        };
        Err(Diagnostic::error(
            spindle.span,
            format!("{name}[{shown}]: only the first spindle is supported"),
        )
        .help(format!(
            "LinuxCNC's spindle 0 is that of {name}[1]: write the number, or leave it out"
        )))
    }

    /// `SETMS`, `SETMS(1)`.
    fn master_spindle(&mut self, span: Span) -> Parsed<Word> {
        self.cursor.advance();
        let mut value = WordValue::None;
        if self.cursor.take(Symbol::Open) {
            value = WordValue::Plain(expression(&mut self.cursor)?);
            self.cursor.expect(Symbol::Close, ")")?;
        }
        Ok(Word {
            address: "SETMS".to_string(),
            value,
            span: span.to(self.cursor.last_span()),
        })
    }

    /// A command that is left out: `SOFT`, `FGROUP(X,Y)`, `ACC[X]=50`.
    fn noted(&mut self, name: &str, span: Span) -> Parsed<Word> {
        self.cursor.advance();
        if self.cursor.is_symbol(0, Symbol::Open) {
            self.skip_to(Symbol::Open, Symbol::Close, ")")?;
        } else if self.cursor.is_symbol(0, Symbol::OpenBracket) {
            self.skip_to(Symbol::OpenBracket, Symbol::CloseBracket, "]")?;
        }
        if self.cursor.take(Symbol::Assign) {
            expression(&mut self.cursor)?;
        }
        Ok(Word {
            address: name.to_string(),
            value: WordValue::None,
            span,
        })
    }

    /// Takes what stands in parentheses or brackets, of which nothing is needed: names of axes too.
    fn skip_to(&mut self, open: Symbol, close: Symbol, shown: &str) -> Parsed<()> {
        let mut depth = 0_u32;
        while let Some(token) = self.cursor.advance() {
            match token.kind.symbol() {
                Some(symbol) if symbol == open => depth += 1,
                Some(symbol) if symbol == close => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return Ok(());
            }
        }
        Err(self.cursor.error(format!("`{shown}` is missing here")))
    }

    fn word_value(&mut self, address: String, start: Span) -> Parsed<Word> {
        let value = if self.cursor.take(Symbol::Assign) {
            self.assigned_value()?
        } else {
            WordValue::Plain(self.signed_number(&address)?)
        };
        let span = start.to(self.cursor.last_span());
        Ok(Word {
            address,
            value,
            span,
        })
    }

    fn assigned_value(&mut self) -> Parsed<WordValue> {
        if let (Some(TokenKind::Name(name)), true) =
            (self.cursor.peek(), self.cursor.is_symbol(1, Symbol::Open))
        {
            match name.as_str() {
                "AC" | "IC" => {
                    self.cursor.advance();
                    self.cursor.advance();
                    let value = expression(&mut self.cursor)?;
                    self.cursor.expect(Symbol::Close, ")")?;
                    return Ok(match name.as_str() {
                        "AC" => WordValue::Absolute(value),
                        _ => WordValue::Incremental(value),
                    });
                }
                "DC" | "ACP" | "ACN" => {
                    let way = match name.as_str() {
                        "DC" => Way::Shorter,
                        "ACP" => Way::Positive,
                        _ => Way::Negative,
                    };
                    self.cursor.advance();
                    self.cursor.advance();
                    let angle = expression(&mut self.cursor)?;
                    self.cursor.expect(Symbol::Close, ")")?;
                    return Ok(WordValue::Angle(way, angle));
                }
                _ => {}
            }
        }
        expression(&mut self.cursor).map(WordValue::Plain)
    }

    fn signed_number(&mut self, address: &str) -> Parsed<Expression> {
        let start = self.cursor.span();
        let minus = self.cursor.take(Symbol::Minus);
        if !minus {
            self.cursor.take(Symbol::Plus);
        }
        let Some(TokenKind::Number(number)) = self.cursor.peek() else {
            return Err(Diagnostic::error(
                start,
                format!("the value of {address} is missing or not a number"),
            )
            .help(format!("write {address}10 or {address}=expression")));
        };
        self.cursor.advance();
        Ok(Expression {
            kind: ExpressionKind::Number(if minus { -number } else { *number }),
            span: start.to(self.cursor.last_span()),
        })
    }
}

/// An error for a name that means nothing, with a guess at what was meant.
pub(super) fn unknown_word(name: &str, span: Span) -> Diagnostic {
    let error = Diagnostic::error(span, format!("`{name}` is not a word of this dialect"));
    match words::similar(name) {
        Some(similar) => error.help(format!("did you mean {similar}?")),
        None => error,
    }
}
