//! Comments behind values that are texts: LinuxCNC takes them for a part of the text.

use super::subject::Subject;
use crate::machine::ini::Entry;

/// Keys whose text LinuxCNC compares, loads, or takes for the name of a file. Elsewhere the mark may be meant, as in a title,
/// a G code or what a shell runs.
const KEYS: [(&str, &[&str]); 7] = [
    ("EMC", &["VERSION"]),
    ("EMCIO", &["TOOL_TABLE"]),
    ("EMCMOT", &["EMCMOT", "HOMEMOD"]),
    (
        "RS274NGC",
        &[
            "ON_ABORT_COMMAND",
            "PARAMETER_FILE",
            "SUBROUTINE_PATH",
            "USER_M_PATH",
        ],
    ),
    (
        "TRAJ",
        &[
            "ANGULAR_UNITS",
            "COORDINATES",
            "LINEAR_UNITS",
            "POSITION_FILE",
        ],
    ),
    ("PYTHON", &["PATH_APPEND", "PATH_PREPEND", "TOPLEVEL"]),
    ("WIZARD", &["WIZARD_ROOT"]),
];

/// The keys that have one and are read.
pub fn commented(subject: &Subject) -> Vec<&Entry> {
    let entries = subject.ini.entries().iter();
    let counts = |entry: &&Entry| subject.ini.entry(&entry.section, &entry.key) == Some(*entry);
    entries
        .filter(|entry| entry.raw != entry.value && is_text(entry))
        .filter(|entry| is_used(subject, entry))
        .filter(counts)
        .collect()
}

/// What is wrong with one.
pub fn found(entry: &Entry) -> String {
    format!(
        "LinuxCNC reads the comment as a part of the value: [{}]{} = {}",
        entry.section, entry.key, entry.raw
    )
}

/// The line without it.
pub fn line(entry: &Entry) -> String {
    format!("{} = {}", entry.key, entry.value)
}

fn is_text(entry: &Entry) -> bool {
    let mut keys = KEYS.iter().filter(|(section, _)| *section == entry.section);
    keys.any(|(_, keys)| keys.contains(&entry.key.as_str()))
}

fn is_used(subject: &Subject, entry: &Entry) -> bool {
    match entry.key.as_str() {
        // A block: G code has comments behind a semicolon.
        "ON_ABORT_COMMAND" => entry.raw[entry.value.len()..].trim_start().starts_with('#'),
        // HAL files may name motmod themselves.
        "EMCMOT" => {
            let forms = ["[EMCMOT]EMCMOT", "[EMCMOT](EMCMOT)"];
            let motion = subject.motion();
            motion.is_some_and(|motion| {
                forms
                    .iter()
                    .any(|form| motion.statement.text.contains(form))
            })
        }
        _ => true,
    }
}
