//! `[RS274NGC]SUBROUTINE_PATH`: the folder with the frame commands, and that LinuxCNC finds these there.

use crate::check::finding::{Findings, add, advice, replace};
use crate::wiring::own_files::INSTALL;
use crate::wiring::subject::Subject;
use crate::wiring::subroutine_files::{self, SENDER, file};

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
    let is_there = |folder: &&str| file(&subject.path(folder), SENDER).is_file();
    if let Some(folder) = folders.iter().copied().find(is_there) {
        return hidden(subject, folder, findings);
    }
    let own = subject.own_folder();
    let found = "the frame commands are not found: no folder of [RS274NGC]SUBROUTINE_PATH has framepath's subroutines";
    match subject.ini.entry("RS274NGC", "SUBROUTINE_PATH") {
        Some(_) if folders.contains(&own.as_str()) => {
            findings.error(&place, found, advice(INSTALL));
        }
        Some(entry) => {
            let line = format!("SUBROUTINE_PATH = {}:{own}", entry.value);
            findings.error(&place, found, replace(line));
        }
        None => {
            let line = format!("SUBROUTINE_PATH = {own}");
            findings.error(&place, found, add("[RS274NGC]", line));
        }
    }
}

/// Files of the same names in folders before ours.
fn hidden(subject: &Subject, own: &str, findings: &mut Findings) {
    let folders = subroutine_files::folders(&subject.ini);
    for (folder, names) in subroutine_files::hiding(&folders, &subject.path(own)) {
        let (place, found, help) = subject.hidden(folder, &names);
        findings.error(&place, found, advice(help));
    }
}
