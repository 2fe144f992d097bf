//! The modules as files: that LinuxCNC finds them, and that they are built for it.

use crate::check::finding::{Findings, advice};
use crate::machine::place::Place;
use crate::wiring::installed::{LinuxCnc, built_for, series};
use crate::wiring::subject::Subject;

const INSTALL: &str = "in framepath's sources: make install";
const INSTALL_AGAIN: &str = "in framepath's sources: make install again";

/// Looks at those that are loaded; without a LinuxCNC here there is nothing to be looked at.
pub fn look(subject: &Subject, linuxcnc: Option<&LinuxCnc>, findings: &mut Findings) {
    let Some(linuxcnc) = linuxcnc else {
        return;
    };
    for (name, place) in loaded(subject) {
        look_at_file(linuxcnc, name, &place, findings);
    }
}

/// The modules of ours, with the lines that load them.
fn loaded(subject: &Subject) -> Vec<(&'static str, Place)> {
    let mut loaded = Vec::new();
    for name in ["blendtp", "framekins"] {
        if name == subject.planner() {
            loaded.push((name, subject.place_of("TRAJ", "TPMOD")));
        }
        if let Some(module) = subject.state.module(name) {
            loaded.push((name, module.statement.place.clone()));
        }
    }
    loaded
}

fn look_at_file(linuxcnc: &LinuxCnc, name: &str, place: &Place, findings: &mut Findings) {
    let file = linuxcnc.module(name);
    let shown = file.display();
    if !file.exists() {
        let found = format!("{shown} is not there, and LinuxCNC does not start");
        return findings.error(place, found, advice(INSTALL));
    }
    let version = match built_for(&file) {
        Ok(Some(version)) => version,
        // Built where no version was known: it compares structures when it is loaded.
        Ok(None) => return,
        Err(error) => {
            let found = format!("{shown} cannot be read: {error}");
            return findings.error(place, found, advice(INSTALL_AGAIN));
        }
    };
    let (Some(needed), Some(installed)) = (series(&version), series(&linuxcnc.version)) else {
        return;
    };
    let found = format!(
        "{shown} is built for LinuxCNC {version}, and {} is installed",
        linuxcnc.version
    );
    if needed != installed {
        let found = format!("{found}: it refuses to be loaded, and LinuxCNC does not start");
        findings.error(place, found, advice(INSTALL_AGAIN));
    } else if version != linuxcnc.version {
        let found = format!(
            "{found}, of the same series: it looks at motion's memory when it is loaded, and should fit"
        );
        findings.note(place, found, advice(INSTALL_AGAIN));
    }
}
