//! Subprogram calls.

use super::interpreter::{Interpreter, Next, place};
use super::procedures::{Argument, Returned};
use super::routine::Routine;
use super::syntax::{Block, Call};
use super::words;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::calls::CallRules;
use std::rc::Rc;

const RULES: CallRules = CallRules {
    nesting: 11,
    passes: 9999,
    instead_of_recursion: "repeat with P (L10 P3) or with a loop",
};

impl Interpreter<'_> {
    pub(super) fn call(&mut self, call: &Call, block: &Block, at: usize) -> Next {
        let diagnostic = match self.try_call(call, block) {
            Ok(true) => return Next::Block(at + 1),
            Ok(false) => return Next::Abort,
            Err(diagnostic) => diagnostic,
        };
        self.control.diagnostics.push(*diagnostic);
        // What a subprogram would have done is unknown; what follows can be checked all the same.
        self.control.modal.forget_position();
        self.control.modal.has_feed = true;
        Next::Block(at + 1)
    }

    pub(super) fn try_call(&mut self, call: &Call, block: &Block) -> Result<bool, Box<Diagnostic>> {
        let name = call.name.as_str();
        if self.control_cycle(call, block)? {
            self.control.finish_marker(&place(block));
            return Ok(true);
        }
        let Some(routine) = self
            .library
            .find(name, self.control.sources, self.control.diagnostics)
        else {
            return Err(missing(call));
        };
        let arguments = self.arguments(call, &routine)?;
        let passes = match &call.passes {
            Some(passes) => passes.whole(&self.variables, 1)?,
            None => 1,
        };
        self.control.check_call(name, passes, call.span, &RULES)?;
        let place = place(block);
        let mut goes_on = true;
        for pass in 1..=passes {
            self.control
                .enter(name, routine.file, [pass, passes], &place);
            self.variables.enter();
            let outcome = self.run_pass(&routine, &arguments);
            self.variables.leave();
            self.control.leave(name, &place);
            let returned;
            (goes_on, returned) = outcome?;
            self.assign_returned(returned)?;
            if !goes_on {
                break;
            }
        }
        Ok(goes_on)
    }

    /// Whether the program goes on, and what goes back to the caller.
    fn run_pass(
        &mut self,
        routine: &Rc<Routine>,
        arguments: &[Argument],
    ) -> Result<(bool, Returned), Box<Diagnostic>> {
        self.define_parameters(arguments)?;
        let goes_on = self.run_routine(routine);
        Ok((goes_on, self.returned(arguments)?))
    }

    /// Cycles of the control. `false` for any other name.
    fn control_cycle(&mut self, call: &Call, block: &Block) -> Result<bool, Box<Diagnostic>> {
        match call.name.as_str() {
            "CYCLE832" => {
                let tolerance = match call.arguments.first() {
                    Some(Some(tolerance)) => Some(tolerance.number(&self.variables)?),
                    _ => None,
                };
                self.control.continuous_path(tolerance, call.span)?;
                self.control.apply_states(false);
            }
            "CYCLE800" => self.swivel(call)?,
            "CYCLE81" | "CYCLE82" | "CYCLE83" | "CYCLE84" | "CYCLE840" | "CYCLE85" | "CYCLE86"
            | "CYCLE87" | "CYCLE88" | "CYCLE89" => self.drill(call)?,
            "HOLES1" | "HOLES2" => return self.holes(call, block).map(|()| true),
            _ => return Ok(false),
        }
        Ok(true)
    }
}

/// Whether a name is that of a cycle of the control: `CYCLE81`, `HOLES1`, `POCKET3`.
fn is_cycle(name: &str) -> bool {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let cycles = ["CYCLE", "HOLES", "POCKET", "SLOT", "LONGHOLE"];
    stem.len() < name.len() && cycles.contains(&stem)
}

fn missing(call: &Call) -> Box<Diagnostic> {
    let name = &call.name;
    let error = match words::similar(name) {
        Some(similar) => Diagnostic::error(
            call.span,
            format!("`{name}` is neither a command nor a subprogram that can be found"),
        )
        .help(format!("did you mean {similar}?")),
        None if is_cycle(name) => {
            Diagnostic::error(call.span, format!("the cycle {name} is not supported"))
                .help("post the program with the cycles written out as moves")
        }
        None => Diagnostic::error(call.span, format!("the subprogram {name} was not found")).help(
            format!(
                "it is looked for as a section %_N_{name}_SPF of this file, and as {}.spf beside it \
                 and in the folders of --subprograms",
                name.to_ascii_lowercase()
            ),
        ),
    };
    Box::new(error)
}
