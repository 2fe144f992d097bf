//! Comments behind values that LinuxCNC takes whole.

use crate::check::finding::{Findings, replace};
use crate::wiring::comments::{commented, found, line};
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    for entry in commented(subject) {
        findings.error(&entry.place, found(entry), replace(line(entry)));
    }
}
