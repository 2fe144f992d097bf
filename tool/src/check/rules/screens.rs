//! `[DISPLAY]DISPLAY`: screens that end with framekins.

use crate::check::finding::{Findings, advice};
use crate::wiring::screens::{OTHERS, ending, why_ending};
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    if let Some(screen) = ending(subject) {
        let place = subject.place_of("DISPLAY", "DISPLAY");
        findings.error(&place, why_ending(screen), advice(OTHERS));
    }
}
