//! `[RS274NGC]SUBROUTINE_PATH`: the folder with the frame commands.

use crate::check::finding::{Findings, add, advice, replace};
use crate::wiring::subject::Subject;

/// One of the files that every frame command needs.
const FILE: &str = "frame_send.ngc";

pub fn look(subject: &Subject, findings: &mut Findings) {
    let folders = subject.subroutine_folders();
    let place = subject.place_of("RS274NGC", "SUBROUTINE_PATH");
    for folder in folders
        .iter()
        .filter(|folder| !subject.path(folder).is_dir())
    {
        let found = format!("SUBROUTINE_PATH names {folder}, which is not there");
        findings.warning(&place, found, advice("correct or remove it"));
    }
    let is_there = |folder: &&str| subject.path(folder).join(FILE).is_file();
    if folders.iter().any(is_there) {
        return;
    }
    let own = subject.own_folder();
    let found = "the frame commands are not found: no folder of [RS274NGC]SUBROUTINE_PATH has framepath's subroutines";
    match subject.ini.entry("RS274NGC", "SUBROUTINE_PATH") {
        Some(entry) => {
            let own = if folders.contains(&own.as_str()) {
                crate::wiring::SUBROUTINES
            } else {
                &own
            };
            findings.error(
                &place,
                found,
                replace(format!("SUBROUTINE_PATH = {}:{own}", entry.value)),
            );
        }
        None => findings.error(
            &place,
            found,
            add("[RS274NGC]", format!("SUBROUTINE_PATH = {own}")),
        ),
    }
}
