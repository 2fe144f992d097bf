//! Lines and sections of the INI file that LinuxCNC reads otherwise than they look, and what it cannot do without.

use crate::check::finding::{Findings, add, advice, replace};
use crate::machine::IniError;
use crate::machine::place::Place;
use crate::wiring::subject::{Subject, shared};

pub fn look(subject: &Subject, findings: &mut Findings) {
    for problem in &subject.ini_problems {
        let (file, line, found) = match problem {
            IniError::Line {
                file,
                line,
                problem,
            } => (
                file,
                *line,
                format!("LinuxCNC passes over this line: {problem}"),
            ),
            IniError::Unread {
                file,
                line,
                problem,
            } => (
                file,
                *line,
                format!("this line is not read here: {problem}"),
            ),
            IniError::Refused {
                file,
                line,
                problem,
                remedy,
            } => {
                let place = Place::new(&shared(file), *line, 0);
                findings.error(&place, problem, advice(remedy));
                continue;
            }
            _ => continue,
        };
        let place = Place::new(&shared(file), line, 0);
        findings.warning(&place, found, advice("correct or remove it"));
    }
    for heading in subject.ini.headings() {
        if let Some(first) = &heading.first {
            let found = format!(
                "LinuxCNC does not read this section: [{}] is there already, in line {}",
                heading.name, first.line
            );
            findings.warning(
                &heading.place,
                found,
                advice("move its keys to the first one"),
            );
        }
        if heading.name.trim() != heading.name {
            let found = format!(
                "LinuxCNC does not find the section [{}], with blanks in its brackets",
                heading.name
            );
            findings.warning(
                &heading.place,
                found,
                replace(format!("[{}]", heading.name.trim())),
            );
        }
    }
    match is_ini(subject) {
        true => needed(subject, findings),
        false => findings.error(
            &Place::file(subject.ini.file()),
            "this is no INI file of LinuxCNC: there is no key under [EMC], [KINS], [TRAJ], [EMCMOT] or [HAL]",
            advice("name the INI file of a machine, a text file in UTF-8"),
        ),
    }
}

/// Whether there is anything that LinuxCNC looks for.
fn is_ini(subject: &Subject) -> bool {
    let sections = ["EMC", "KINS", "TRAJ", "EMCMOT", "HAL"];
    sections
        .iter()
        .any(|section| subject.ini.has_section(section))
}

/// Whether the file is for this LinuxCNC.
pub fn is_current(subject: &Subject) -> bool {
    subject.text("EMC", "VERSION") == Some("1.1")
}

/// Sections and keys, what is usual, and what is wrong without them.
const NEEDED: [(&str, &str, &str, &str); 4] = [
    (
        "TASK",
        "TASK",
        "milltask",
        "LinuxCNC does not start without [TASK]TASK, the program that reads part programs",
    ),
    (
        "DISPLAY",
        "DISPLAY",
        "axis",
        "LinuxCNC does not start without [DISPLAY]DISPLAY, the screen",
    ),
    (
        "TRAJ",
        "LINEAR_UNITS",
        "mm",
        "LinuxCNC does not start without [TRAJ]LINEAR_UNITS, the unit of lengths",
    ),
    (
        "TRAJ",
        "ANGULAR_UNITS",
        "degree",
        "LinuxCNC does not start without [TRAJ]ANGULAR_UNITS, the unit of angles",
    ),
];

/// The script `linuxcnc`, or its task controller, ends without these.
fn needed(subject: &Subject, findings: &mut Findings) {
    // update_ini writes what is missing.
    match subject.ini.entry("EMC", "VERSION") {
        Some(entry) if entry.value == "1.1" => {}
        Some(entry) => {
            let found = "the file is for another LinuxCNC, which changes it by update_ini first";
            let remedy = advice("start LinuxCNC once with a screen, or run update_ini");
            return findings.warning(&entry.place, found, remedy);
        }
        None => {
            let found = "without [EMC]VERSION LinuxCNC wants to change the file by update_ini";
            return findings.warning(
                &subject.place_of("EMC", "VERSION"),
                found,
                add("[EMC]", "VERSION = 1.1"),
            );
        }
    }
    if subject.text("KINS", "JOINTS").is_none() {
        let count = subject.joints.len().max(subject.axes.len()).clamp(1, 16);
        findings.error(
            &subject.place_of("KINS", "JOINTS"),
            "LinuxCNC does not start without [KINS]JOINTS, the number of joints",
            add("[KINS]", format!("JOINTS = {count}")),
        );
    }
    for (section, key, usual, found) in NEEDED {
        if subject.text(section, key).is_none_or(str::is_empty) {
            findings.error(
                &subject.place_of(section, key),
                found,
                add(format!("[{section}]"), format!("{key} = {usual}")),
            );
        }
    }
    if subject.text("KINS", "KINEMATICS").is_none() && !subject.has_frames() {
        let letters: String = subject.axes.iter().collect();
        findings.error(
            &subject.place_of("KINS", "KINEMATICS"),
            "LinuxCNC does not start without [KINS]KINEMATICS",
            add(
                "[KINS]",
                format!("KINEMATICS = trivkins coordinates={letters}"),
            ),
        );
    }
}
