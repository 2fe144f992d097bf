//! Section `[FRAMEPATH]`, and what else in the INI file frame_guard does not start without.

use crate::check::finding::{Findings, Remedy, add, advice, replace};
use crate::machine::ini::Entry;
use crate::wiring::abort::{Abort, COMMAND};
use crate::wiring::settings::{KEYS, SECTION, key};
use crate::wiring::subject::Subject;
use crate::wiring::subroutine_files::{folders, has_tree};

pub fn look(subject: &Subject, findings: &mut Findings) {
    let entries = subject.ini.entries();
    let own: Vec<&Entry> = entries
        .iter()
        .filter(|entry| entry.section == SECTION)
        .collect();
    for (index, entry) in own.iter().enumerate() {
        look_at_key(entry, &own[..index], findings);
    }
    for heading in subject.ini.headings() {
        if heading.name != SECTION && heading.name.eq_ignore_ascii_case(SECTION) {
            let found = format!("section [{}]: frame_guard does not start", heading.name);
            findings.error(&heading.place, found, replace(format!("[{SECTION}]")));
        }
    }
    elsewhere(subject, findings);
    if subject.has_frames() {
        left_out(subject, &own, findings);
        needed(subject, findings);
    }
}

fn look_at_key(entry: &Entry, before: &[&Entry], findings: &mut Findings) {
    let Some(known) = key(&entry.key) else {
        let names: Vec<&str> = KEYS.iter().map(|key| key.name).collect();
        let found = format!(
            "[{SECTION}]{}: there is no such key, and frame_guard does not start",
            entry.key
        );
        return findings.error(
            &entry.place,
            found,
            advice(format!("the keys are {}", names.join(", "))),
        );
    };
    if before.iter().any(|other| other.key == entry.key) {
        let found = format!(
            "[{SECTION}]{} stands there twice, and frame_guard does not start",
            entry.key
        );
        findings.error(&entry.place, found, Remedy::Remove);
    }
    if !known.takes(&entry.raw) {
        let found = format!(
            "[{SECTION}]{} = {}: frame_guard does not start",
            entry.key, entry.raw
        );
        let remedy = format!("{}, and comments on a line of their own", known.possible);
        findings.error(&entry.place, found, advice(remedy));
    }
}

/// Behind a heading that was lost the keys stand in another section.
fn elsewhere(subject: &Subject, findings: &mut Findings) {
    // Those whose names no other program uses.
    let ours = [
        "CLEAR_AT_START",
        "CLEAR_AT_END",
        "CLEAR_ON_ABORT",
        "TOOL_LENGTH",
        "ROTS_CONVENTION",
        "RETRACT_Z",
        "ANALOG_OUTPUT",
        "TYPE_OUTPUT",
    ];
    for entry in subject.ini.entries() {
        if entry.section != SECTION && ours.contains(&entry.key.as_str()) {
            let found = format!(
                "{} stands under [{}], and is read under [{SECTION}] only",
                entry.key, entry.section
            );
            findings.warning(
                &entry.place,
                found,
                add("the line before", format!("[{SECTION}]")),
            );
        }
    }
}

/// What is taken for keys that are not there.
fn left_out(subject: &Subject, own: &[&Entry], findings: &mut Findings) {
    let is_out = |name: &str| !own.iter().any(|entry| entry.key == name);
    let lines: Vec<String> = KEYS
        .iter()
        .filter(|key| is_out(key.name))
        .filter_map(|key| Some(format!("{} = {}", key.name, key.usual?)))
        .collect();
    let place = subject.place_of(SECTION, "");
    if !lines.is_empty() {
        let found = format!(
            "[{SECTION}] leaves out what is taken as {}",
            lines.join(", ")
        );
        let into = format!("[{SECTION}]");
        findings.note(&place, found, Remedy::Add { into, lines });
    }
    if subject.tilt().is_some() && is_out("RETRACT_Z") {
        let found = "programs with CYCLE800 and FR = 1 are refused, since it is not known where to retract to";
        findings.note(
            &place,
            found,
            add(format!("[{SECTION}]"), "RETRACT_Z = ..."),
        );
    }
}

fn needed(subject: &Subject, findings: &mut Findings) {
    let section = "RS274NGC";
    let mut missing = |key: &str, value: &str, why: &str| {
        let line = format!("{key} = {value}");
        let found = format!(
            "frame_guard, and with it LinuxCNC, does not start without [{section}]{line}: {why}"
        );
        match subject.ini.entry(section, key) {
            Some(entry) => findings.error(&entry.place, found, replace(line)),
            None => findings.error(
                &subject.place_of(section, key),
                found,
                add(format!("[{section}]"), line),
            ),
        }
    };
    if subject
        .ini
        .entry(section, "OWORD_NARGS")
        .is_none_or(|entry| entry.raw != "1")
    {
        missing(
            "OWORD_NARGS",
            "1",
            "the subroutines cannot tell a missing value from 0",
        );
    }
    let clears = subject.text(SECTION, "CLEAR_ON_ABORT") != Some("0");
    if clears && subject.text(section, "ON_ABORT_COMMAND").is_none() {
        missing(
            "ON_ABORT_COMMAND",
            COMMAND,
            "[FRAMEPATH]CLEAR_ON_ABORT = 1 depends on it",
        );
    } else if let Some(entry) = subject
        .ini
        .entry(section, "ON_ABORT_COMMAND")
        .filter(|_| clears)
    {
        own_abort(subject, entry, findings);
    }
    let units = subject.text("TRAJ", "LINEAR_UNITS");
    if !subject.has_linear_units() {
        let place = subject.place_of("TRAJ", "LINEAR_UNITS");
        let found = "frame_guard does not start without [TRAJ]LINEAR_UNITS";
        let line = "LINEAR_UNITS = mm";
        match units {
            Some(_) => findings.error(&place, found, replace(line)),
            None => findings.error(&place, found, add("[TRAJ]", line)),
        }
    }
}

fn own_abort(subject: &Subject, entry: &Entry, findings: &mut Findings) {
    let abort = Abort::of(&entry.value, &folders(&subject.ini));
    // What Python or a wizard brings is not known here.
    let is_unknown = has_tree(&subject.ini) || subject.text("PYTHON", "TOPLEVEL").is_some();
    let Some((found, help)) = abort.problem(&entry.value) else {
        return;
    };
    match abort {
        Abort::Missing(_) if is_unknown => findings.warning(&entry.place, found, advice(help)),
        _ => findings.error(&entry.place, found, advice(help)),
    }
}
