//! Parsing settable offsets: `$P_UIFR[1]=CTRANS(X,10,Y,20):CROT(Z,30)`, `$P_UIFR[1,X,TR]=10`.

use super::cursor::Parsed;
use super::expressions::expression;
use super::parser::BlockParser;
use super::syntax::{OffsetPart, SettableOffset, Statement};
use super::token::{Symbol, TokenKind};
use crate::dialects::control::words::AXES;
use crate::dialects::expression::Expression;

impl BlockParser<'_> {
    /// The statement that begins with `$P_UIFR`.
    pub(super) fn settable_offset(&mut self) -> Parsed<Statement> {
        let span = self.cursor.span();
        self.cursor.advance();
        self.cursor.expect(Symbol::OpenBracket, "[")?;
        let number = expression(&mut self.cursor)?;
        let mut component = None;
        if self.cursor.take(Symbol::Comma) {
            let axis = self.axis()?;
            self.cursor.expect(Symbol::Comma, ",")?;
            component = Some((axis, self.name("TR, FI or RT")?));
        }
        self.cursor.expect(Symbol::CloseBracket, "]")?;
        self.cursor.expect(Symbol::Assign, "=")?;
        let mut parts = Vec::new();
        match &component {
            Some((axis, name)) => {
                let value = expression(&mut self.cursor)?;
                parts.push((self.part(name)?, vec![(*axis, value)]));
            }
            None => loop {
                let name = self.name("CTRANS, CFINE or CROT")?;
                let part = self.part(&name)?;
                parts.push((part, self.axis_values()?));
                if !self.cursor.take(Symbol::Colon) {
                    break;
                }
            },
        }
        Ok(Statement::SettableOffset(SettableOffset {
            number,
            replaces: component.is_none(),
            parts,
            span: span.to(self.cursor.last_span()),
        }))
    }

    fn name(&mut self, wanted: &str) -> Parsed<String> {
        let Some(TokenKind::Name(name)) = self.cursor.peek() else {
            return Err(self.cursor.error(format!("{wanted} is missing here")));
        };
        self.cursor.advance();
        Ok(name.clone())
    }

    fn part(&self, name: &str) -> Parsed<OffsetPart> {
        match name {
            "CTRANS" | "TR" => Ok(OffsetPart::Coarse),
            "CFINE" | "FI" => Ok(OffsetPart::Fine),
            "CROT" | "RT" => Ok(OffsetPart::Rotation),
            _ => Err(self.error_with_help(
                &format!("{name} in a settable offset is not supported"),
                "LinuxCNC's work offsets shift (CTRANS, CFINE) and turn about Z (CROT); scale and mirror \
                 with SCALE and MIRROR",
            )),
        }
    }

    fn axis(&mut self) -> Parsed<usize> {
        let letter = self.cursor.peek().and_then(TokenKind::letter);
        let axis = letter.and_then(|letter| AXES.iter().position(|axis| axis.starts_with(letter)));
        match axis {
            Some(axis) => {
                self.cursor.advance();
                Ok(axis)
            }
            None => Err(self.error_with_help(
                "the name of an axis is missing here",
                "axes are X Y Z A B C U V W",
            )),
        }
    }

    /// `(X,10,Y,20)`.
    fn axis_values(&mut self) -> Parsed<Vec<(usize, Expression)>> {
        let mut list = Vec::new();
        self.cursor.expect(Symbol::Open, "(")?;
        if self.cursor.take(Symbol::Close) {
            return Ok(list);
        }
        loop {
            let axis = self.axis()?;
            self.cursor.expect(Symbol::Comma, ",")?;
            list.push((axis, expression(&mut self.cursor)?));
            if self.cursor.take(Symbol::Close) {
                return Ok(list);
            }
            self.cursor.expect(Symbol::Comma, ",")?;
        }
    }
}
