//! Subprogram calls.

use super::interpreter::{Interpreter, Next};
use super::syntax::{Block, Call, Statement};
use super::words;
use crate::diagnostics::Diagnostic;
use crate::program::Action;

/// How many subprograms may be inside each other.
const NESTING_LIMIT: usize = 11;

/// How often a subprogram may be repeated by one call.
const PASS_LIMIT: u32 = 9999;

impl Interpreter<'_> {
    pub(super) fn call(&mut self, call: &Call, block: &Block, file: usize, at: usize) -> Next {
        let diagnostic = match self.try_call(call, block, file) {
            Ok(true) => return Next::Block(at + 1),
            Ok(false) => return Next::Abort,
            Err(diagnostic) => diagnostic,
        };
        self.diagnostics.push(*diagnostic);
        // What a subprogram would have done is unknown; what follows can be checked all the same.
        self.modal.forget_position();
        self.modal.has_feed = true;
        Next::Block(at + 1)
    }

    fn try_call(
        &mut self,
        call: &Call,
        block: &Block,
        file: usize,
    ) -> Result<bool, Box<Diagnostic>> {
        let name = call.name.as_str();
        if self.control_cycle(call)? {
            self.finish_marker(block, file);
            return Ok(true);
        }
        let Some(routine) = self.library.find(name, self.sources, self.diagnostics) else {
            return Err(missing(call));
        };
        if !call.arguments.is_empty() {
            return Err(Box::new(
                Diagnostic::error(call.span, format!("{name} takes no values in parentheses"))
                    .help("pass values in R parameters"),
            ));
        }
        if self.running.iter().any(|running| running == name) {
            return Err(Box::new(
                Diagnostic::error(call.span, format!("{name} calls itself"))
                    .label(format!(
                        "the calls are: {} > {name}",
                        self.running.join(" > ")
                    ))
                    .help("repeat with P (L10 P3) or with a loop"),
            ));
        }
        if self.running.len() > NESTING_LIMIT {
            return Err(Box::new(Diagnostic::error(
                call.span,
                format!("more than {NESTING_LIMIT} subprograms inside each other"),
            )));
        }
        let passes = match &call.passes {
            Some(passes) => passes.whole(&self.variables, 1)?,
            None => 1,
        };
        if passes > PASS_LIMIT {
            return Err(Box::new(Diagnostic::error(
                call.span,
                format!("{passes} passes are more than the control allows ({PASS_LIMIT})"),
            )));
        }
        self.running.push(name.to_string());
        let mut goes_on = true;
        for pass in 1..=passes {
            let file_name = self.sources.file(routine.file).name.clone();
            self.actions.push(Action::Enter {
                name: name.to_string(),
                file: file_name,
                pass,
                passes,
            });
            self.finish_marker(block, file);
            self.variables.enter();
            goes_on = self.run_routine(&routine);
            self.variables.leave();
            self.actions.push(Action::Leave {
                name: name.to_string(),
            });
            self.finish_marker(block, file);
            if !goes_on {
                break;
            }
        }
        self.running.pop();
        Ok(goes_on)
    }

    /// Cycles of the control that set modes: `CYCLE832(tolerance, ..)` and `CYCLE800()`. `false` for
    /// any other name.
    fn control_cycle(&mut self, call: &Call) -> Result<bool, Box<Diagnostic>> {
        match call.name.as_str() {
            "CYCLE832" => {
                let tolerance = match call.arguments.first() {
                    Some(Some(tolerance)) => Some(tolerance.number(&self.variables)?),
                    _ => None,
                };
                self.continuous_path(tolerance, call.span)?;
            }
            // With values it would tilt the plane; without, it ends what was never begun.
            "CYCLE800" if call.arguments.iter().all(Option::is_none) => {
                self.note("CYCLE800()", call.span);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// A block for the beginning or the end of a subprogram: it has the line of the call.
    fn finish_marker(&mut self, block: &Block, file: usize) {
        let marker = Block {
            number: None,
            comment: None,
            statement: Statement::Empty,
            ..block.clone()
        };
        self.finish_block(&marker, file);
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
