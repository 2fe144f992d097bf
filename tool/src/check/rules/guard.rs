//! frame_guard: that it is started, and how.

use crate::check::finding::{Findings, add, advice, if_missing, replace};
use crate::hal::Program;
use crate::wiring::own_files::{self, GUARD_FILE, INSTALL};
use crate::wiring::subject::{GUARD, Subject, guard_line, is_guard};
use std::path::Path;

pub fn look(subject: &Subject, findings: &mut Findings) {
    let programs = subject.state.programs.iter();
    let guards: Vec<&Program> = programs
        .filter(|program| is_guard(&program.program))
        .collect();
    let line = guard_line(&subject.own_folder());
    let [guard, others @ ..] = guards.as_slice() else {
        let place = subject.place_of_module("framekins");
        let found = format!(
            "frame_guard is not started, and framekins takes no frame without it{}",
            subject.unless_unread()
        );
        return findings.add(
            if_missing(subject),
            &place,
            found,
            add(subject.hal_file(), line),
        );
    };
    for other in others {
        let found = "frame_guard is started already";
        findings.error(
            &other.statement.place,
            found,
            crate::check::finding::Remedy::Remove,
        );
    }
    start(subject, guard, findings);
    file(subject, guard, findings);
}

fn start(subject: &Subject, guard: &Program, findings: &mut Findings) {
    let place = &guard.statement.place;
    let line = format!("loadusr -Wn {GUARD} {}", guard.program);
    let waits = guard
        .options
        .iter()
        .any(|option| option.starts_with('-') && option.contains('W'));
    let is_named = guard.options.iter().any(|option| option == GUARD);
    if !waits || !is_named {
        let found =
            "LinuxCNC does not wait for frame_guard, and starts although its settings are refused";
        findings.error(place, found, replace(line));
    }
    let modules = subject.state.modules.iter();
    let loaded = modules
        .take(guard.modules_before)
        .any(|module| module.name == "framekins");
    if subject.state.module("framekins").is_some() && !loaded {
        let found = "frame_guard is started before framekins is loaded, and does not come up";
        findings.error(
            place,
            found,
            advice("move this line to the end of the HAL file"),
        );
    }
}

fn file(subject: &Subject, guard: &Program, findings: &mut Findings) {
    let place = &guard.statement.place;
    let path = subject.path(&guard.program);
    if !guard.program.contains('/') {
        // Found through PATH.
        return;
    }
    if !path.is_file() {
        let found = format!(
            "{} is not there, and LinuxCNC does not start",
            path.display()
        );
        let own = own_files::subroutines();
        let remedy = match guard.program == format!("{own}/{GUARD_FILE}") {
            true => INSTALL.to_owned(),
            false => format!(
                "{}, or where the subroutines of framepath are",
                guard_line(&own)
            ),
        };
        findings.error(place, found, advice(remedy));
    } else if !is_executable(&path) {
        let found = format!(
            "{} may not be executed, and LinuxCNC does not start",
            path.display()
        );
        findings.error(place, found, advice(format!("chmod +x {}", path.display())));
    }
}

#[cfg(unix)]
fn is_executable(path: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt;
    std::fs::metadata(path).is_ok_and(|data| data.permissions().mode() & 0o111 != 0)
}

#[cfg(not(unix))]
fn is_executable(_: &Path) -> bool {
    true
}
