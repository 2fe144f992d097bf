//! What LinuxCNC's task controller reads: numbers alone, or LinuxCNC does not start.

use crate::check::finding::{Findings, advice};
use crate::machine::ini::Entry;
use crate::machine::numbers::{self, Form};
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    for entry in subject.ini.entries() {
        let counts = subject.ini.entry(&entry.section, &entry.key) == Some(entry);
        let is_number = numbers::number(entry).is_some_and(|number| !number.is_nan());
        if !counts || entry.raw.is_empty() || is_number || !is_read(subject, entry) {
            continue;
        }
        let kind = match numbers::form(&entry.section, &entry.key) {
            Form::Number => "number",
            Form::Whole => "whole number",
            Form::OfModule | Form::Other => continue,
        };
        let found = format!(
            "LinuxCNC does not start, or never switches on: [{}]{} = {} is no {kind}",
            entry.section, entry.key, entry.raw
        );
        let remedy = advice(format!(
            "a {kind} alone: decimals behind a point, none above 1.8e308, and a comment in a line of its own"
        ));
        findings.error(&entry.place, found, remedy);
    }
}

/// Whether this machine has what the section is about, and the module of motion does not complain of the key.
fn is_read(subject: &Subject, entry: &Entry) -> bool {
    let key = format!("[{}]{}", entry.section, entry.key);
    let motion = subject.motion();
    if motion.is_some_and(|motion| motion.statement.text.contains(&key)) {
        return false;
    }
    // HAL files alone read it, and what of its first word is no number the rule of the pin tells.
    if entry.key == "MAX_JERK" {
        return subject.has_planner() && entry.raw.contains(char::is_whitespace);
    }
    match entry.section.split_once('_') {
        Some(("AXIS", letter)) => subject.axes.iter().any(|axis| axis.to_string() == letter),
        Some(("JOINT", number)) => {
            let joints = subject.text("KINS", "JOINTS");
            let joints = joints.and_then(|joints| joints.parse::<u32>().ok());
            number
                .parse::<u32>()
                .is_ok_and(|number| number < joints.unwrap_or(16))
        }
        _ => true,
    }
}
