//! Programs of lathes (models T): X is a diameter there, and its cycles have the numbers of other functions.
//! They look like those of mills, and would become parts of twice the size.

use crate::diagnostics::Diagnostic;
use crate::dialects::lathe::{NOT_TRANSLATED, on_lathe};
use crate::dialects::settings::Settings;
use crate::source::Span;
use std::path::Path;

/// The ending of programs of lathes.
const EXTENSION: &str = "pit";

/// The error for a program of a lathe, or on one; `None` for one of a mill.
pub fn refusal(path: &Path, settings: &Settings) -> Option<Diagnostic> {
    if settings.lathe {
        return Some(on_lathe());
    }
    let extension = path.extension()?;
    let error = Diagnostic::error(
        Span::start_of(0),
        "the ending .pit is that of programs of lathes, whose X is a diameter",
    );
    extension.eq_ignore_ascii_case(EXTENSION).then(|| {
        error.help(format!(
            "{NOT_TRANSLATED}: post it for LinuxCNC; give one of a mill the ending .pim"
        ))
    })
}
