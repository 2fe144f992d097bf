//! `[DISPLAY]USER_COMMAND_FILE`: previews that follow frames.

use crate::check::finding::{Findings, add, advice, replace};
use crate::wiring::own_files::INSTALL;
use crate::wiring::previews::screen;
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    let Some(screen) = screen(subject) else {
        return;
    };
    let value = screen.value(&subject.own_folder());
    let line = format!("USER_COMMAND_FILE = {value}");
    let Some(entry) = subject.ini.entry("DISPLAY", "USER_COMMAND_FILE") else {
        let place = subject.place_of("DISPLAY", "DISPLAY");
        let found = "the preview and the live plot show programs without their frames";
        return findings.warning(&place, found, add("[DISPLAY]", line));
    };
    match std::fs::read_to_string(subject.path(&entry.value)) {
        Err(error) => {
            let found = format!("{} cannot be read: {error}", entry.value);
            let remedy = match entry.value == value {
                true => advice(INSTALL),
                false => replace(line),
            };
            findings.warning(&entry.place, found, remedy);
        }
        Ok(text) if text.contains(screen.module) => {}
        Ok(_) => {
            let found = format!(
                "{} has no word of {}: the preview and the live plot show programs without their frames",
                entry.value, screen.module
            );
            let help = format!("{line}, or add what docs/preview.md says to that file");
            findings.warning(&entry.place, found, advice(help));
        }
    }
}
