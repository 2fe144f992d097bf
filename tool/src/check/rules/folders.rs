//! Files that LinuxCNC writes, and folders that it must be able to write into.

use crate::check::finding::{Findings, Level, add, advice};
use crate::wiring::subject::Subject;
use std::path::Path;

pub fn look(subject: &Subject, findings: &mut Findings) {
    let files = [
        (
            "RS274NGC",
            "PARAMETER_FILE",
            "work offsets and parameters are not kept",
        ),
        (
            "EMCIO",
            "TOOL_TABLE",
            "tools that are measured are not kept",
        ),
        ("TRAJ", "POSITION_FILE", "positions are not kept"),
    ];
    for (section, key, loss) in files {
        let Some(name) = subject.text(section, key) else {
            continue;
        };
        let path = subject.path(name);
        let folder = path.parent().unwrap_or(Path::new("."));
        let place = subject.place_of(section, key);
        let remedy = advice(
            "copy the configuration to a folder of your own, or give yourself the right to write there",
        );
        if !folder.is_dir() {
            let found = format!("the folder of {name} is not there, and {loss}");
            findings.add(
                Level::Warning,
                &place,
                found,
                advice(format!("mkdir -p {}", folder.display())),
            );
        } else if !may_write(folder) || (path.exists() && !may_write(&path)) {
            let found = format!("{} may not be written, and {loss}", path.display());
            findings.add(Level::Warning, &place, found, remedy);
        }
    }
    if subject.text("RS274NGC", "PARAMETER_FILE").is_none() {
        let found = "work offsets are kept in rs274ngc.var";
        findings.note(
            &subject.place_of("RS274NGC", ""),
            found,
            add("[RS274NGC]", "PARAMETER_FILE = machine.var"),
        );
    }
    table(subject, findings);
}

/// Without its tool table LinuxCNC has no tools.
fn table(subject: &Subject, findings: &mut Findings) {
    let Some(name) = subject
        .text("EMCIO", "TOOL_TABLE")
        .filter(|_| subject.text("EMCIO", "DB_PROGRAM").is_none())
    else {
        return;
    };
    if !subject.path(name).is_file() {
        let found = format!("the tool table {name} is not there");
        findings.warning(
            &subject.place_of("EMCIO", "TOOL_TABLE"),
            found,
            advice(format!("touch {}", subject.path(name).display())),
        );
    }
}

#[cfg(unix)]
fn may_write(path: &Path) -> bool {
    rustix::fs::access(path, rustix::fs::Access::WRITE_OK).is_ok()
}

#[cfg(not(unix))]
fn may_write(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|data| !data.permissions().readonly())
}
