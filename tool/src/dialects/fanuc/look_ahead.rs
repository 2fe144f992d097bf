//! G5, G5.1, G8, and G103 of Haas controls: how far ahead the control looks.

use super::block_words::{BlockWords, g_name};
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::At;
use crate::source::Span;

/// P of G103: how many blocks, 0 for no limit.
const BLOCKS: [f64; 16] = [
    0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0,
];

/// The letter that says what a function does, its values that only tune the control, and what else the
/// value can be.
fn switch(code: u32) -> (char, &'static [f64], &'static str) {
    match code {
        50 => (
            'P',
            &[0.0, 10_000.0],
            "P0 and P10000 are understood; other values begin moves that the machine stores, or that have a \
             form of their own: post G1",
        ),
        51 => ('Q', &[0.0, 1.0, 2.0, 3.0], "Q0 to Q3 are understood"),
        1030 => ('P', &BLOCKS, "P0 to P15 are understood"),
        _ => ('P', &[0.0, 1.0], "P0 and P1 are understood"),
    }
}

impl Interpreter<'_> {
    /// `G5 P10000`, `G5.1 Q1 R5`, `G5.1 Q3 X0 Y0 Z0`, `G8 P1`. Coordinates beside Q2 and Q3 name axes and
    /// are no motion.
    pub(super) fn look_ahead(&mut self, code: u32, span: Span, words: &mut BlockWords) -> Done {
        let (letter, values, help) = switch(code);
        let given = match letter {
            'Q' => words.q.take(),
            _ => words.p.take().map(|word| At {
                value: word.value.0,
                span: word.span,
            }),
        };
        // G103 alone is that with P0.
        let given = given.or_else(|| (code == 1030).then_some(At { value: 0.0, span }));
        let Some(given) = given.filter(|given| values.contains(&given.value)) else {
            let place = given.map_or(span, |given| given.span);
            return Err(Diagnostic::error(
                place,
                format!("it is not known what {} does here", g_name(code)),
            )
            .help(help));
        };
        if letter == 'Q' {
            // How smooth: from 1 to 10.
            words.radius = None;
        }
        if letter == 'Q' && given.value >= 2.0 {
            words.axes = Default::default();
        }
        if let Some(axis) = words.first_axis() {
            return Err(
                Diagnostic::error(axis, format!("a motion beside {}", g_name(code)))
                    .help("put the motion into a block of its own"),
            );
        }
        self.control.note(&g_name(code), span);
        Ok(())
    }
}
