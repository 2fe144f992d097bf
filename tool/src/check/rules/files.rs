//! HAL files that are missing, are not read here, or have lines that halcmd refuses.

use crate::check::finding::{Findings, Remedy, add, advice};
use crate::hal::Fix;
use crate::wiring::USUAL_JERK;
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    for unread in &subject.script.unread {
        findings.note(
            &unread.place,
            format!("{} is not read here: {}", unread.name, unread.reason),
            advice("what it does is not looked at; see to it yourself"),
        );
    }
    for problem in &subject.script.problems {
        findings.error(
            &problem.place,
            &problem.found,
            remedy(subject, &problem.remedy),
        );
    }
    for problem in &subject.script.late_problems {
        findings.warning(
            &problem.place,
            &problem.found,
            remedy(subject, &problem.remedy),
        );
    }
    // Lines that were not read may unlink a pin; with TWOPASS the order is another one.
    let sure = subject.script.unread.is_empty() && subject.text("HAL", "TWOPASS").is_none();
    for problem in subject.state.problems.iter().filter(|_| sure) {
        findings.error(
            &problem.place,
            &problem.found,
            remedy(subject, &problem.remedy),
        );
    }
}

fn remedy(subject: &Subject, fix: &Fix) -> Remedy {
    match fix {
        Fix::Advice(text) => advice(text),
        Fix::Key { section, key } => add(
            format!("[{section}]"),
            format!("{key} = {}", likely_value(subject, section, key)),
        ),
    }
}

/// What a key that a HAL file names might be.
fn likely_value(subject: &Subject, section: &str, key: &str) -> String {
    let acceleration = subject.number(section, "MAX_ACCELERATION");
    match (section, key, acceleration) {
        (_, "MAX_JERK", Some(acceleration)) => (acceleration * USUAL_JERK).to_string(),
        ("KINS", "KINEMATICS", _) if subject.has_frames() => super::kinematics::likely(subject),
        ("TABLE", ..) => "0".to_owned(),
        _ => "...".to_owned(),
    }
}
