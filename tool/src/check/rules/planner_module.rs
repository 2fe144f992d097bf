//! Which planner is loaded: `[TRAJ]TPMOD`, and `loadrt` in HAL files.

use crate::check::finding::{Findings, Remedy, add, advice, replace};
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    parameters(subject, findings);
    let chosen = subject.planner() == "blendtp";
    if let Some(module) = subject.state.module("blendtp") {
        let place = &module.statement.place;
        if chosen {
            findings.error(
                place,
                "blendtp is loaded already, by [TRAJ]TPMOD, and loadrt fails",
                Remedy::Remove,
            );
        } else {
            let found = format!(
                "[TRAJ]TPMOD has loaded {} before the HAL files, and loadrt blendtp fails behind it",
                subject.planner()
            );
            findings.error(
                place,
                found,
                advice("remove this line, and write TPMOD = blendtp under [TRAJ]"),
            );
        }
    } else if !chosen {
        not_loaded(subject, findings);
    }
    if let Some(module) = subject
        .state
        .module("tpmod")
        .filter(|_| subject.has_planner())
    {
        findings.warning(
            &module.statement.place,
            "tpmod is loaded beside blendtp and has nothing to do",
            Remedy::Remove,
        );
    }
}

/// The script `linuxcnc` hands all words to loadrt, and neither planner has a parameter.
fn parameters(subject: &Subject, findings: &mut Findings) {
    let module = subject.planner();
    let words = subject.text("TRAJ", "TPMOD").unwrap_or("");
    let known = matches!(module, "blendtp" | "tpmod");
    if let Some(word) = words.split_whitespace().nth(1).filter(|_| known) {
        let found = format!("LinuxCNC does not start: {module} has no parameter {word}");
        let line = format!("TPMOD = {module}");
        findings.error(&subject.place_of("TRAJ", "TPMOD"), found, replace(line));
    }
}

fn not_loaded(subject: &Subject, findings: &mut Findings) {
    let line = "TPMOD = blendtp";
    let remedy = match subject.ini.entry("TRAJ", "TPMOD") {
        Some(_) => replace(line),
        None => add("[TRAJ]", line),
    };
    if let Some(statement) = subject.first_naming("blendtp") {
        let place = match subject.ini.entry("TRAJ", "TPMOD") {
            Some(entry) => entry.place.clone(),
            None => statement.place.clone(),
        };
        let found = format!(
            "`{}` needs blendtp, and [TRAJ]TPMOD loads {}",
            statement.text,
            subject.planner()
        );
        return findings.error(&place, found, remedy);
    }
    if subject.has_frames() {
        let found = format!(
            "{} does not see frames: it keeps the limits of the axes as the program names them, and a frame that scales or turns asks for more of the joints (under a scale of 3 a rapid moves them at three times their velocity)",
            subject.planner()
        );
        let place = subject.place_of("TRAJ", "TPMOD");
        findings.warning(&place, found, remedy.clone());
    }
    for letter in &subject.axes {
        let section = format!("AXIS_{letter}");
        if subject.planner() == "tpmod" && subject.ini.entry(&section, "MAX_JERK").is_some() {
            let found = format!(
                "[{section}]MAX_JERK has no effect: LinuxCNC's own planner does not know it"
            );
            findings.note(
                &subject.place_of(&section, "MAX_JERK"),
                found,
                remedy.clone(),
            );
        }
    }
}
