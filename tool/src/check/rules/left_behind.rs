//! What calls framepath's subroutines on a machine that has no framekins: they read its pins, and stop with an error.

use crate::check::finding::{Findings, Remedy, advice, if_missing};
use crate::wiring::abort::Abort;
use crate::wiring::codes::{Remap, code_of};
use crate::wiring::subject::{Subject, is_guard};
use crate::wiring::subroutine_files::folders;

pub fn look(subject: &Subject, findings: &mut Findings) {
    let level = if_missing(subject);
    let why = format!(
        "framekins, whose pins it reads, is not loaded{}",
        subject.unless_unread()
    );
    for entry in subject.all("RS274NGC", "REMAP") {
        let remap = Remap::parse(&entry.value);
        let subroutine = remap.subroutine.as_deref().unwrap_or("");
        if code_of(subroutine, &remap.code).is_some() {
            let loss = match remap.code.as_str() {
                "M6" => "no tool can be changed",
                _ => "the code ends the program",
            };
            let found = format!("{} calls {subroutine}, and {loss}: {why}", remap.code);
            findings.add(level, &entry.place, found, Remedy::Remove);
        }
    }
    let abort = subject.ini.entry("RS274NGC", "ON_ABORT_COMMAND");
    let ours = |command: &str| Abort::of(command, &folders(&subject.ini)) == Abort::Clears;
    if let Some(entry) = abort.filter(|entry| ours(&entry.value)) {
        let found = format!("`{}` fails at each abort: {why}", entry.value);
        let remedy =
            "remove this line, or the call of o<frame_abort> from the subroutine that it calls";
        findings.add(level, &entry.place, found, advice(remedy));
    }
    let mut programs = subject.state.programs.iter();
    if let Some(guard) = programs.find(|program| is_guard(&program.program)) {
        let found = format!("frame_guard does not come up, nor does LinuxCNC: {why}");
        findings.add(level, &guard.statement.place, found, Remedy::Remove);
    }
}
