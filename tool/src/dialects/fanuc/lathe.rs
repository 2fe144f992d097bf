//! Programs of lathes: G90 and G92 are cycles there, G50 sets the limit of the speed, and T names a tool and
//! its offset. They look much like those of mills, and would become something else.

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::words::At;
use crate::dialects::lathe::NOT_TRANSLATED;
use crate::source::Span;

/// T of lathes has two digits for the tool and two for the offset.
const DIGITS: u32 = 4;

/// The tools that a program names and changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToolCalls {
    /// The first T with the digits of a lathe.
    like_lathe: Option<Span>,
    /// Whether M6 has been there.
    changed: bool,
}

impl Interpreter<'_> {
    /// The error of a block whose words only a lathe gives a meaning; what follows has none either.
    pub(super) fn lathe_words(&mut self, words: &BlockWords) -> Option<Diagnostic> {
        self.tool_calls.changed |= words.m.iter().any(|m| m.value == 6);
        if let Some(At {
            value: (_, Some(DIGITS)),
            span,
        }) = words.tool
        {
            self.tool_calls.like_lathe.get_or_insert(span);
        }
        let (beside, word, meaning) = match (words.speed, words.feed) {
            (Some(speed), _) if words.has_g(500) => (
                "S beside G50",
                speed,
                "is the limit of the speed of a lathe",
            ),
            (_, Some(feed)) if words.has_g(920) && words.first_axis().is_some() => {
                ("F beside G92", feed, "is the pitch of a lathe's thread")
            }
            _ => return None,
        };
        let error = Diagnostic::error(word.span, format!("{beside} {meaning}"));
        Some(error.help(format!(
            "{NOT_TRANSLATED}; in a program of a mill write it in a block of its own"
        )))
    }

    /// At the end of the program: a mill changes its tools with M6.
    pub(super) fn check_tool_calls(&mut self) {
        let calls = self.tool_calls;
        // In a program with errors M6 may be in a block that was not understood.
        let is_whole = self.control.diagnostics.errors() == 0;
        let Some(span) = calls.like_lathe.filter(|_| is_whole && !calls.changed) else {
            return;
        };
        self.control.diagnostics.push(
            Diagnostic::error(
                span,
                "T with four digits, and no M6 in the program: the tool and the offset of a lathe",
            )
            .help(format!(
                "{NOT_TRANSLATED}; in a program of a mill write M6 behind T"
            )),
        );
    }
}
