//! `[HAL]POSTGUI_HALFILE`: pins of a panel that only AXIS makes.

use crate::check::finding::{Findings, advice};
use crate::wiring::subject::Subject;

/// How the pins of a panel of pyvcp begin that a screen makes.
const PINS: &str = "pyvcp.";

pub fn look(subject: &Subject, findings: &mut Findings) {
    let display = subject.text("DISPLAY", "DISPLAY").unwrap_or("");
    let screen = display.split_whitespace().next().unwrap_or("");
    let has_panel = subject.text("DISPLAY", "PYVCP").is_some();
    if screen == "axis" && has_panel {
        return;
    }
    for entry in subject.ini.all("HAL", "POSTGUI_HALFILE") {
        // That a file is not there is said elsewhere.
        let text = std::fs::read_to_string(subject.path(&entry.value)).unwrap_or_default();
        let mut commands = text
            .lines()
            .map(|line| line.split('#').next().unwrap_or(""));
        if commands.any(|command| command.contains(PINS)) {
            let found = format!(
                "{} links pins of pyvcp, which only axis with [DISPLAY]PYVCP makes: {screen} ends where they are missing",
                entry.value
            );
            let help = "remove this line and [DISPLAY]PYVCP, or set DISPLAY = axis with PYVCP";
            findings.warning(&entry.place, found, advice(help));
        }
    }
}
