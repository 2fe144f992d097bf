//! Programs of lathes, for the dialects that take those of mills only.

use crate::diagnostics::Diagnostic;
use crate::source::Span;

/// What is said of all of them.
pub const NOT_TRANSLATED: &str = "programs of lathes of this control are not translated";

/// The machine is a lathe.
pub fn on_lathe() -> Diagnostic {
    Diagnostic::error(
        Span::start_of(0),
        "the INI file is that of a lathe: [DISPLAY]LATHE is set, or [TRAJ]COORDINATES has no Y",
    )
    .help(format!(
        "{NOT_TRANSLATED}: post it for LinuxCNC; for a mill give its INI file, --ini"
    ))
}
