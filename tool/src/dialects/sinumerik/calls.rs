//! Subprogram calls.

use super::drilling::is_drilling;
use super::interpreter::Interpreter;
use super::procedures::{Argument, Returned};
use super::routine::Routine;
use super::syntax::{Block, Call};
use super::words;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::calls::CallRules;
use crate::dialects::run::Next;
use std::rc::Rc;

const RULES: CallRules = CallRules {
    nesting: 11,
    passes: 9999,
    instead_of_recursion: "repeat with P (L10 P3) or with a loop",
};

impl Interpreter<'_> {
    pub(super) fn call(&mut self, call: &Call, block: &Block, at: usize) -> Next {
        let called = self.try_call(call, block);
        self.after_call(called, at)
    }

    /// Where the flow goes after a call: whether the program goes on, or what is wrong with it.
    pub(super) fn after_call(&mut self, called: Result<bool, Diagnostic>, at: usize) -> Next {
        let diagnostic = match called {
            Ok(true) => return Next::Block(at + 1),
            Ok(false) => return Next::Abort,
            Err(diagnostic) => diagnostic,
        };
        self.control.diagnostics.push(diagnostic);
        // What a subprogram would have done is unknown; what follows can be checked all the same.
        self.control.modal.forget_position();
        self.control.modal.has_feed = true;
        Next::Block(at + 1)
    }

    pub(super) fn try_call(&mut self, call: &Call, block: &Block) -> Result<bool, Diagnostic> {
        let name = call.name.as_str();
        if self.control_cycle(call, block)? {
            self.contour_end = None;
            self.control.finish_marker(&block.place);
            return Ok(true);
        }
        let Some(routine) = self
            .library
            .find(name, self.control.sources, self.control.diagnostics)
        else {
            return Err(missing(call));
        };
        self.run_call(call, &routine, block)
    }

    /// Runs a subprogram as often as the call says; whether the program goes on.
    pub(super) fn run_call(
        &mut self,
        call: &Call,
        routine: &Rc<Routine>,
        block: &Block,
    ) -> Result<bool, Diagnostic> {
        let name = call.name.as_str();
        let head = self.head(routine);
        let arguments = self.arguments(call, &head.parameters)?;
        let passes = match &call.passes {
            Some(passes) => passes.whole(&self.variables, 1)?,
            None => 1,
        };
        self.control.check_call(name, passes, call.span, &RULES)?;
        let place = &block.place;
        let mut goes_on = true;
        for pass in 1..=passes {
            self.control
                .enter(name, routine.file, [pass, passes], place);
            self.variables.enter();
            let kept = head.saves.then(|| self.keep_modes());
            let outcome = self.run_pass(routine, &arguments);
            self.variables.leave();
            self.control.leave(name, place);
            let returned;
            (goes_on, returned) = outcome?;
            self.assign_returned(returned)?;
            if let Some(kept) = kept {
                self.restore_modes(kept, call.span)?;
                self.control.finish_marker(place);
            }
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
    ) -> Result<(bool, Returned), Diagnostic> {
        self.define_parameters(arguments)?;
        let goes_on = self.run_routine(routine);
        Ok((goes_on, self.returned(arguments)?))
    }

    /// Cycles of the control. `false` for any other name.
    fn control_cycle(&mut self, call: &Call, block: &Block) -> Result<bool, Diagnostic> {
        let name = call.name.as_str();
        let mills = matches!(
            name,
            "CYCLE72" | "POCKET3" | "POCKET4" | "SLOT1" | "LONGHOLE"
        );
        if mills || is_drilling(name) {
            self.refuse_tool_of_before(call.span)?;
        }
        match name {
            "CYCLE832" => self.high_speed_settings(call)?,
            "CYCLE800" => self.swivel(call)?,
            name if is_drilling(name) => {
                self.control.begin_cycle();
                self.drill(call)?;
                self.control.end_cycle();
            }
            "CYCLE72" => self.mill_contour(call, block)?,
            "POCKET3" | "POCKET4" | "SLOT1" | "LONGHOLE" => self.mill(call)?,
            "HOLES1" | "HOLES2" | "CYCLE801" | "CYCLE802" => {
                return self.pattern(call, block).map(|()| true);
            }
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

fn missing(call: &Call) -> Diagnostic {
    let name = &call.name;
    let searched = format!(
        "a subprogram is looked for as a section %_N_{name}_SPF of this file, and as {}.spf beside it \
         and in the folders of --subprograms",
        name.to_ascii_lowercase()
    );
    let is_numbered = name.starts_with('L') && name[1..].chars().all(|c| c.is_ascii_digit());

    match words::similar(name) {
        _ if is_cycle(name) => {
            Diagnostic::error(call.span, format!("the cycle {name} is not supported"))
                .help("post the program with the cycles written out as moves")
        }
        Some(similar) if !is_numbered => Diagnostic::error(call.span, unknown(name))
            .help(format!("did you mean {similar}? If not: {searched}")),
        None if call.arguments.is_empty() && !is_numbered => {
            Diagnostic::error(call.span, unknown(name)).help(searched)
        }
        _ => Diagnostic::error(call.span, format!("the subprogram {name} was not found"))
            .help(searched),
    }
}

fn unknown(name: &str) -> String {
    format!("`{name}` is neither a word of this dialect nor a subprogram that can be found")
}
