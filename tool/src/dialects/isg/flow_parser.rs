//! Parsing control statements.

use super::expressions::expression;
use super::parser::{assignment, label};
use super::reader::{Parsed, Reader};
use super::syntax::{Flow, Jump, Target};
use crate::diagnostics::Diagnostic;
use crate::dialects::spelling::did_you_mean;

pub(super) const NAMES: [&str; 19] = [
    "IF",
    "ELSEIF",
    "ELSE",
    "ENDIF",
    "FOR",
    "ENDFOR",
    "WHILE",
    "ENDWHILE",
    "DO",
    "ENDDO",
    "REPEAT",
    "UNTIL",
    "SWITCH",
    "CASE",
    "DEFAULT",
    "ENDSWITCH",
    "BREAK",
    "CONTINUE",
    "GOTO",
];

/// A control statement after its `$`, which stands at `start`.
pub fn flow(reader: &mut Reader, start: usize) -> Parsed<Flow> {
    let name = reader.name();
    let span = reader.span_from(start);
    Ok(match name.as_str() {
        "IF" => {
            let condition = condition(reader)?;
            if reader.take("$") {
                if !reader.keyword("GOTO") {
                    return Err(reader.error_with_help(
                        "only $GOTO can stand behind a condition",
                        "put what follows in blocks of their own, up to $ENDIF",
                    ));
                }
                return Ok(Flow::JumpIf(condition, jump(reader)?));
            }
            Flow::If(condition)
        }
        "ELSEIF" => Flow::ElseIf(condition(reader)?),
        "ELSE" => Flow::Else,
        "ENDIF" => Flow::EndIf,
        "FOR" => {
            let first = assignment(reader)?;
            reader.expect(",")?;
            let last = expression(reader)?;
            let step = match reader.take(",") {
                true => Some(expression(reader)?),
                false => None,
            };
            Flow::For(first, last, step)
        }
        "ENDFOR" => Flow::EndFor,
        "WHILE" => Flow::While(condition(reader)?),
        "ENDWHILE" => Flow::EndWhile,
        "DO" => Flow::Do,
        "ENDDO" => Flow::EndDo(condition(reader)?),
        "REPEAT" => Flow::Repeat,
        "UNTIL" => Flow::Until(condition(reader)?),
        "SWITCH" => Flow::Switch(expression(reader)?),
        "CASE" => Flow::Case(expression(reader)?),
        "DEFAULT" => Flow::Default,
        "ENDSWITCH" => Flow::EndSwitch,
        "BREAK" => Flow::Break,
        "CONTINUE" => Flow::Continue,
        "GOTO" => Flow::Jump(jump(reader)?),
        _ => {
            let error = Diagnostic::error(span, format!("`${name}` is not a control statement"));
            let similar = did_you_mean(&name, NAMES.into_iter(), |known| format!("${known}"));
            return Err(match similar {
                Some(similar) => error.help(similar),
                None => error,
            });
        }
    })
}

/// A condition; `=` may stand before it.
fn condition(reader: &mut Reader) -> Parsed<crate::dialects::expression::Expression> {
    reader.take("=");
    expression(reader)
}

/// `N10` or `[NAME]` after `$GOTO`.
fn jump(reader: &mut Reader) -> Parsed<Jump> {
    reader.blanks();
    let start = reader.position();
    let target = if reader.peek() == Some('[') {
        Target::Label(label(reader)?)
    } else {
        let name = reader.name_ahead();
        let number = name
            .strip_prefix('N')
            .and_then(|digits| digits.parse().ok());
        let Some(number) = number else {
            return Err(reader.error_with_help(
                "the target of the jump is missing",
                "write $GOTO N10 or $GOTO [NAME]",
            ));
        };
        reader.name();
        Target::Number(number)
    };
    Ok(Jump {
        target,
        span: reader.span_from(start),
    })
}
