//! Part programs of other controls, for the commands that read them: [`mod@open`] opens one and finds
//! out its language; here are the path that it programs and the text of what is wrong with it.

mod open;

pub(crate) use open::{Opened, open};

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::settings::Settings;
use crate::dialects::{Dialect, evaluate};
use crate::program::contour::ContourMove;
use crate::program::trace::{self, Setup, TraceError};
use crate::program::{Action, Compensation, Program};
use crate::source::Sources;
use std::path::Path;

/// Why a program was not translated or traced: all that is wrong with it, as text for standard error.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct Refused(pub String);

/// The contour of a part program, machine coordinates; see [`trace::contour`].
///
/// # Errors
///
/// The text of all errors in the program, as `framepath filter` shows them.
pub fn contour(
    dialect: Dialect,
    file: &Path,
    settings: &Settings,
    setup: &Setup,
) -> Result<Vec<ContourMove>, Refused> {
    let opened = open(dialect, file, &settings.reading)?;
    let mut sources = opened.sources()?;
    let mut diagnostics = Diagnostics::default();
    let program = evaluate(
        opened.dialect,
        file,
        settings,
        &mut sources,
        &mut diagnostics,
    );
    diagnostics.append(compensated(&program));
    if diagnostics.errors() > 0 {
        return Err(refusal(&diagnostics, &sources));
    }
    trace::contour(&program, setup, &settings.arc_tolerance).map_err(|error| {
        let (origin, message) = match error {
            TraceError::Arc(origin, _) => (origin, "this arc does not reach its end"),
            TraceError::Frame(origin, _) => (origin, "the frame of this move has no inverse"),
        };
        diagnostics.push(Diagnostic::error(origin.span, message));
        refusal(&diagnostics, &sources)
    })
}

/// That the radius of a tool decides where the machine goes, and the path is that without it: where it begins to.
fn compensated(program: &Program) -> Diagnostics {
    let mut diagnostics = Diagnostics::default();
    let on =
        |action: &Action| matches!(action, Action::Compensation(on) if *on != Compensation::Off);
    let first = program
        .blocks
        .iter()
        .find(|block| block.actions.iter().any(on));
    if let Some(block) = first {
        let message = "the path of the tool beside the programmed one (G41, G42) is not worked out here, so that nothing can be \
                       compared with it";
        diagnostics.push(Diagnostic::error(block.origin.span, message).help(
            "leave --dialect and --tolerance out: limits are judged without them; or record a program without G41 and G42",
        ));
    }
    diagnostics
}

/// All errors, and how many there are.
pub(crate) fn refusal(diagnostics: &Diagnostics, sources: &Sources) -> Refused {
    let mut text = diagnostics.render(sources);
    let errors = match diagnostics.errors() {
        1 => "1 error".to_string(),
        count => format!("{count} errors"),
    };
    text.push_str(&format!("{errors}: nothing was written\n"));
    Refused(text)
}
