//! Screens that end at once with framekins: they take nothing but KINEMATICS_IDENTITY, and behind a frame that turns, an
//! axis is no joint.

use super::subject::Subject;
use std::path::Path;

/// As `[DISPLAY]DISPLAY` names them.
const ENDING: [&str; 2] = ["touchy", "gscreen"];

/// What to take instead.
pub const OTHERS: &str = "DISPLAY = axis, gmoccapy or qtvcp under [DISPLAY]";

/// The screen of a machine, where it is one of those.
pub fn ending(subject: &Subject) -> Option<&'static str> {
    let command = subject
        .text("DISPLAY", "DISPLAY")?
        .split_whitespace()
        .next()?;
    let name = Path::new(command).file_name()?;
    ENDING.into_iter().find(|screen| name == *screen)
}

/// What comes of it.
pub fn why_ending(screen: &str) -> String {
    format!(
        "{screen} ends at its start with framekins: it takes no kinematics but KINEMATICS_IDENTITY"
    )
}
