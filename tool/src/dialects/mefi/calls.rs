//! `G71 L100`: the call of a subprogram.

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Place;
use crate::dialects::control::calls::CallRules;
use crate::dialects::run::Next;
use crate::source::Span;

const RULES: CallRules = CallRules {
    nesting: 10,
    passes: 9999,
    instead_of_recursion: "repeat with P (G71 L100 P3)",
};

impl Interpreter<'_> {
    pub(super) fn call(
        &mut self,
        span: Span,
        words: &BlockWords,
        place: &Place,
        following: Next,
    ) -> Result<Next, Diagnostic> {
        let mut rest = words.clone();
        let (label, passes, offset) = (rest.label.take(), rest.passes.take(), rest.offset.take());
        let other = rest.beside_axes(71).map(|(_, other)| other);
        if let Some(other) = other.or(rest.motion.first_axis()) {
            return Err(Diagnostic::error(
                other,
                "this cannot stand in one block with the call of a subprogram",
            )
            .help("a call is G71 L100, with D3 for the tool offset and P3 for three passes"));
        }
        let Some(label) = label else {
            return Err(
                Diagnostic::error(span, "G71 needs the number of a subprogram")
                    .help("write G71 L100"),
            );
        };
        let name = format!("L{}", label.value);
        if let Some(offset) = offset {
            self.tool_offset(offset)?;
            self.control.apply_states(false);
        }
        let passes = match passes {
            None => 1,
            Some(passes)
                if passes.value.fract() == 0.0 && (1.0..=99_999.0).contains(&passes.value) =>
            {
                if words.passes_by_q {
                    self.control.diagnostics.push(Diagnostic::warning(
                        passes.span,
                        format!("Q is taken as the number of passes: {}", passes.value),
                    ));
                }
                passes.value as u32
            }
            Some(passes) => {
                return Err(Diagnostic::error(
                    passes.span,
                    "the number of passes is a whole number from 1",
                ));
            }
        };
        let control = &mut self.control;
        let routine = self
            .library
            .find(&name, control.sources, control.diagnostics)
            .ok_or_else(|| {
                let file = name.to_ascii_lowercase();
                Diagnostic::error(label.span, format!("the subprogram {name} was not found")).help(
                        format!(
                            "it is looked for as G79 {name} in this file, and as {file}.nc beside it and \
                             in the folders of --subprograms"
                        ),
                    )
            })?;
        control.check_call(&name, passes, label.span, &RULES)?;
        self.control.finish_block(place);
        for pass in 1..=passes {
            // Passes of a subprogram that does nothing take memory too.
            if !self.control.count_block(place.span) {
                return Ok(Next::Abort);
            }
            self.control
                .enter(&name, routine.file, [pass, passes], place);
            let next = self.run_routine(&routine);
            self.control.leave(&name, place);
            if matches!(next, Next::End | Next::Abort) {
                return Ok(next);
            }
        }
        Ok(following)
    }
}
