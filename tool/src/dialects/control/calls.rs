//! Subprograms inside each other.

use super::{Control, Done, Place};
use crate::diagnostics::Diagnostic;
use crate::program::Action;
use crate::source::Span;

/// How subprograms may be called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CallRules {
    /// How many subprograms may be inside each other.
    pub nesting: usize,
    /// How often a subprogram may be repeated by one call.
    pub passes: u32,
    /// What to write instead of a subprogram that calls itself.
    pub instead_of_recursion: &'static str,
}

impl Control<'_> {
    /// The main program begins.
    pub fn begin_main(&mut self, name: &str) {
        self.running.push(name.to_string());
    }

    /// Whether the block that runs belongs to the main program.
    pub fn is_in_main(&self) -> bool {
        self.running.len() <= 1
    }

    /// Refuses a call that is too deep, repeats too often or leads back to itself.
    pub fn check_call(&self, name: &str, passes: u32, span: Span, rules: &CallRules) -> Done {
        let error = if self.running.iter().any(|running| running == name) {
            Diagnostic::error(span, format!("{name} calls itself"))
                .label(format!(
                    "the calls are: {} > {name}",
                    self.running.join(" > ")
                ))
                .help(rules.instead_of_recursion)
        } else if self.running.len() > rules.nesting {
            Diagnostic::error(
                span,
                format!("more than {} subprograms inside each other", rules.nesting),
            )
        } else if passes > rules.passes {
            Diagnostic::error(
                span,
                format!(
                    "{passes} passes are more than the control allows ({})",
                    rules.passes
                ),
            )
        } else {
            return Ok(());
        };
        Err(error)
    }

    /// A subprogram of the file with this index begins, for the `pass`th of `passes` times. What the
    /// calling block did before is finished.
    pub fn enter(&mut self, name: &str, file: usize, [pass, passes]: [u32; 2], place: &Place) {
        let file = self.sources.file(file).name.clone();
        self.actions.push(Action::Enter {
            name: name.to_string(),
            file,
            pass,
            passes,
        });
        self.finish_marker(place);
        self.running.push(name.to_string());
    }

    /// The subprogram ends.
    pub fn leave(&mut self, name: &str, place: &Place) {
        self.running.pop();
        self.actions.push(Action::Leave {
            name: name.to_string(),
        });
        self.finish_marker(place);
    }

    /// A block for the beginning or the end of a subprogram: it has the line of the call.
    pub fn finish_marker(&mut self, place: &Place) {
        self.finish_block(&Place {
            span: place.span,
            number: None,
            comment: None,
        });
    }
}
