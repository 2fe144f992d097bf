//! The files of remapped codes: without one of them LinuxCNC runs no program at all.

use crate::check::finding::{Findings, advice};
use crate::wiring::codes::missing_files;
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    for (entry, file) in missing_files(&subject.ini) {
        let found = format!(
            "{file} is in no folder of [RS274NGC]SUBROUTINE_PATH or [DISPLAY]PROGRAM_PREFIX, and LinuxCNC runs no program"
        );
        let remedy = "correct the name or the folders, or remove this line";
        findings.error(&entry.place, found, advice(remedy));
    }
}
