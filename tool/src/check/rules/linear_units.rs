//! Lengths of another unit than the millimetre and the inch, which the commands do not know.

use crate::check::finding::{Findings, advice};
use crate::machine::length_unit;
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    // That there is none is told with the other keys that LinuxCNC needs.
    let Some(units) = subject
        .text("TRAJ", "LINEAR_UNITS")
        .filter(|units| !units.is_empty())
    else {
        return;
    };
    let is_number = subject.has_linear_units();
    // What frame_guard does not start with is said there.
    if subject.length_unit().is_some() || (subject.has_frames() && !is_number) {
        return;
    }
    let place = subject.place_of("TRAJ", "LINEAR_UNITS");
    let found = format!("[TRAJ]LINEAR_UNITS = {units}: {}", length_unit::PROBLEM);
    let help = advice("LINEAR_UNITS = mm, or inch, and all lengths in that unit");
    match is_number {
        true => findings.warning(&place, found, help),
        false => findings.error(&place, found, help),
    }
}
