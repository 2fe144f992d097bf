//! Subprogram calls.

use super::interpreter::Interpreter;
use super::syntax::Call;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Place;
use crate::dialects::control::calls::CallRules;
use crate::dialects::run::Next;

const RULES: CallRules = CallRules {
    nesting: 20,
    passes: 1,
    instead_of_recursion: "repeat with a loop ($FOR, $WHILE)",
};

impl Interpreter<'_> {
    pub(super) fn call(
        &mut self,
        call: &Call,
        place: &Place,
        at: usize,
    ) -> Result<Next, Diagnostic> {
        let key = match call.local {
            true => format!("{}:{}", call.span.file, call.name),
            false => file_stem(call)?.to_string(),
        };
        let control = &mut self.control;
        let found = self
            .library
            .find(&key, control.sources, control.diagnostics);
        let Some(routine) = found else {
            let local = format!("{}:{}", call.span.file, call.name);
            let in_file = self
                .library
                .find(&local, control.sources, control.diagnostics);
            return Err(missing(call, in_file.is_some()));
        };
        if !call.local && call.name.contains('.') && routine.title != call.name {
            return Err(Diagnostic::error(
                call.span,
                format!("{} was not found, but {}", call.name, routine.title),
            )
            .help("write the ending of the file as it is"));
        }
        control.check_call(&routine.title, 1, call.span, &RULES)?;
        control.enter(&routine.title, routine.file, [1, 1], place);
        self.variables.enter();
        let next = self.run_routine(&routine);
        self.variables.leave();
        self.control.leave(&routine.title, place);
        Ok(match next {
            Next::End | Next::Abort => next,
            Next::Return | Next::Block(_) => Next::Block(at + 1),
        })
    }
}

/// The name of a file without its ending.
fn file_stem(call: &Call) -> Result<&str, Diagnostic> {
    if call.name.contains(['/', '\\', ':']) {
        return Err(Diagnostic::error(call.span, "a subprogram with a path")
            .help("write the name of the file only, and give its folder with --subprograms"));
    }
    Ok(call
        .name
        .rsplit_once('.')
        .map_or(&call.name, |(stem, _)| stem))
}

/// `in_file`: whether the file of the call has a local subprogram of this name.
fn missing(call: &Call, in_file: bool) -> Diagnostic {
    let name = &call.name;
    let error = Diagnostic::error(call.span, format!("the subprogram {name} was not found"));
    match call.local {
        true => error.help(format!("it is looked for as %L {name} in this file")),
        false if in_file => error.help(format!(
            "L calls a file; write LL {name} for %L {name} of this file"
        )),
        false => error.help(
            "it is looked for beside the program and in the folders of --subprograms, with the \
             endings .nc .sub .cnc .iso .prg .txt",
        ),
    }
}
