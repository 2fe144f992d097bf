//! External offsets of axes, which framekins has to know of where LinuxCNC switches its kinematics.

use crate::check::finding::{Findings, add};
use crate::wiring::framekins::external_offset;
use crate::wiring::installed::{LinuxCnc, series};
use crate::wiring::subject::Subject;

/// From here on LinuxCNC takes them off by itself.
const KNOWN_TO_MOTION: (u32, u32) = (2, 10);

pub fn look(subject: &Subject, linuxcnc: Option<&LinuxCnc>, findings: &mut Findings) {
    let running = linuxcnc.and_then(|linuxcnc| series(&linuxcnc.version));
    if running.is_some_and(|series| series >= KNOWN_TO_MOTION) {
        return;
    }
    for letter in subject.external_offsets() {
        let [pin, source] = external_offset(letter);
        if subject.state.signal_of(&pin).is_some() {
            continue;
        }
        let found = format!(
            "{source} is an external offset that framekins is not told of: in LinuxCNC 2.9 the joints would jump by it where a frame comes or goes, and the machine is switched off there{}",
            subject.unless_unread()
        );
        let remedy = add(subject.hal_file(), subject.external_offset_line(letter));
        findings.warning(&subject.place_of_module("framekins"), found, remedy);
    }
}
