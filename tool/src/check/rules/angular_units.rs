//! Angles of another unit than the degree, which neither module knows.

use crate::check::finding::{Findings, advice};
use crate::machine::angles;
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    if angles::are_degrees(&subject.ini) {
        return;
    }
    // That there is none is told with the other keys that LinuxCNC needs.
    let units = subject.text("TRAJ", "ANGULAR_UNITS").unwrap_or("");
    if units.is_empty() {
        return;
    }
    findings.error(
        &subject.place_of("TRAJ", "ANGULAR_UNITS"),
        format!("[TRAJ]ANGULAR_UNITS = {units}: {}", angles::PROBLEM),
        advice(angles::REMEDY),
    );
}
