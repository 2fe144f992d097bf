//! The operator's panel: `[HAL]POSTGUI_HALFILE` links pins that only AXIS makes, `[DISPLAY]EMBED_TAB_COMMAND` puts it into a screen.

use crate::check::finding::{Findings, advice, replace};
use crate::machine::ini::Entry;
use crate::wiring::subject::Subject;
use std::path::{Path, PathBuf};

/// How the pins of a panel of pyvcp begin that a screen makes.
const PINS: &str = "pyvcp.";
/// The panel of gladevcp.
const PANEL: &str = "panel.ui";

/// What it wants of its folder on a machine.
struct Files {
    /// What links it.
    nets: &'static str,
    /// What shows it as a window of its own.
    window: &'static str,
}

const OF_A_MILL: Files = Files {
    nets: "panel.hal",
    window: "panel_window.hal",
};

/// With lamps of A and C.
const OF_A_TABLE: Files = Files {
    nets: "panel_ui_xyzac.hal",
    window: "panel_window_xyzac.hal",
};

fn files(subject: &Subject) -> &'static Files {
    match ['A', 'C'].iter().all(|axis| subject.axes.contains(axis)) {
        true => &OF_A_TABLE,
        false => &OF_A_MILL,
    }
}

pub fn look(subject: &Subject, findings: &mut Findings) {
    look_for_pins(subject, findings);
    for entry in subject.ini.all("DISPLAY", "EMBED_TAB_COMMAND") {
        look_at_tab(subject, entry, findings);
    }
}

fn look_for_pins(subject: &Subject, findings: &mut Findings) {
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
            findings.warning(&entry.place, found, advice(instead(screen, subject)));
        }
    }
}

/// What to write for the panel in this screen.
fn instead(screen: &str, subject: &Subject) -> String {
    let folder = panel_folder(subject);
    match screen {
        "gmoccapy" => format!(
            "remove this line and [DISPLAY]PYVCP; in gmoccapy [DISPLAY]EMBED_TAB_NAME = Frames, EMBED_TAB_LOCATION = ntb_preview \
             and EMBED_TAB_COMMAND = {} show the panel",
            tab(&folder, subject)
        ),
        "qtvcp" => format!(
            "remove [DISPLAY]PYVCP, and write POSTGUI_HALFILE = {} in place of this line, which shows the panel as a window",
            folder.join(files(subject).window).display()
        ),
        _ => "remove this line and [DISPLAY]PYVCP, or set DISPLAY = axis with PYVCP".to_owned(),
    }
}

/// The folder of panels, beside that of the subroutines.
fn panel_folder(subject: &Subject) -> PathBuf {
    Path::new(&subject.own_folder()).with_file_name("panel")
}

/// The command that puts the panel of this folder into a screen.
fn tab(folder: &Path, subject: &Subject) -> String {
    let [nets, panel] = [files(subject).nets, PANEL].map(|file| folder.join(file));
    format!(
        "gladevcp -x {{XID}} -c pyvcp -H {} {}",
        nets.display(),
        panel.display()
    )
}

/// A tab with our panel: gladevcp says where nobody sees it what it misses, and the tab stays empty or its lamps dark.
fn look_at_tab(subject: &Subject, entry: &Entry, findings: &mut Findings) {
    let words: Vec<&str> = entry.value.split_whitespace().collect();
    let is_panel = |word: &&&str| {
        Path::new(word)
            .file_name()
            .is_some_and(|name| name == PANEL)
    };
    let Some(panel) = words.iter().find(is_panel) else {
        return;
    };
    let behind = |option: &str| {
        let place = words.iter().position(|word| *word == option)?;
        words.get(place + 1).copied()
    };
    let folder = Path::new(panel).parent().unwrap_or(Path::new(""));
    let expected = files(subject).nets;
    let mut refuse = |found: String| {
        findings.warning(&entry.place, found, replace(line(folder, subject)));
    };
    if behind("-c") != Some("pyvcp") {
        refuse(format!(
            "{panel} without -c pyvcp: {expected} finds no pins to link"
        ));
    }
    match behind("-H") {
        None => refuse(format!(
            "{panel} without -H: nothing links the panel, its lamps stay dark"
        )),
        Some(nets) if !subject.path(nets).is_file() => {
            refuse(format!(
                "{nets} is not there: nothing links the panel, which does not come up"
            ));
        }
        Some(nets) if is_of_a_mill(nets) && expected == OF_A_TABLE.nets => {
            let found = format!("{panel} linked by {nets}: it has no lamps of A and C then");
            findings.note(&entry.place, found, replace(line(folder, subject)));
        }
        Some(_) => {}
    }
    if !subject.path(panel).is_file() {
        let found = format!("{panel} is not there: the tab stays empty");
        let mend = replace(line(&panel_folder(subject), subject));
        findings.warning(&entry.place, found, mend);
    }
}

/// Whether these nets are those of a mill.
fn is_of_a_mill(nets: &str) -> bool {
    let name = Path::new(nets).file_name();
    name.is_some_and(|name| name == OF_A_MILL.nets)
}

fn line(folder: &Path, subject: &Subject) -> String {
    format!("EMBED_TAB_COMMAND = {}", tab(folder, subject))
}
