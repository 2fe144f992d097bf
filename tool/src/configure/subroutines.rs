//! The folder of framepath's subroutines, that LinuxCNC finds them there, and what it calls when something is aborted.

use super::edits::Edits;
use crate::machine::place::Place;
use crate::wiring::abort::{Abort, COMMAND};
use crate::wiring::settings::SECTION;
use crate::wiring::subject::Subject;
use crate::wiring::subroutine_files::{Folder, SENDER, file, folders, hiding};

const INI_SECTION: &str = "RS274NGC";

/// What HAL files and `SUBROUTINE_PATH` read otherwise, beside blanks.
const MARKS: [char; 8] = [':', '#', ';', '"', '\'', '$', '[', '~'];

/// Adds it all; what is in the way is refused.
pub fn write(subject: &Subject, own: &str, edits: &mut Edits) {
    if !is_usable(subject, own, edits) {
        return;
    }
    match subject.text(INI_SECTION, "SUBROUTINE_PATH") {
        Some(path) if path.split(':').any(|folder| folder == own) => {}
        Some(path) => edits.set(INI_SECTION, "SUBROUTINE_PATH", &format!("{path}:{own}")),
        None => edits.set(INI_SECTION, "SUBROUTINE_PATH", own),
    }
    let nargs = subject.ini.entry(INI_SECTION, "OWORD_NARGS");
    // With a comment behind it, it is not 1 for frame_guard.
    if nargs.is_none_or(|entry| entry.raw != "1") {
        edits.set(INI_SECTION, "OWORD_NARGS", "1");
    }
    let mut all = folders(&subject.ini);
    let path = subject.path(own);
    for (folder, names) in hiding(&all, &path) {
        let (place, found, help) = subject.hidden(folder, &names);
        edits.refuse(&place, found, help);
    }
    let key = Some((INI_SECTION, "SUBROUTINE_PATH"));
    all.push(Folder { path, key });
    abort(subject, &all, edits);
}

/// Whether HAL files can name the folder, and it is that of framepath.
fn is_usable(subject: &Subject, own: &str, edits: &mut Edits) -> bool {
    let place = Place::file(subject.ini.file());
    if let Some(mark) = own
        .chars()
        .find(|mark| mark.is_whitespace() || MARKS.contains(mark))
    {
        let what = match mark {
            ' ' => "a blank".to_owned(),
            mark => format!("`{mark}`"),
        };
        let found = format!(
            "--subroutines {own} has {what}, at which LinuxCNC does not read the name of a folder as it is"
        );
        let help = "a folder with another name, or a link to this one: ln -s";
        edits.refuse(&place, found, help);
        return false;
    }
    let folder = subject.path(own);
    let is_there = |path: std::path::PathBuf| path.is_file();
    let is_own = is_there(folder.join("frame_guard.py")) && is_there(file(&folder, SENDER));
    if !is_own {
        let found = match folder.is_dir() {
            true => format!("--subroutines {own} has no frame_guard.py or no {SENDER}.ngc"),
            false => format!("--subroutines {own}: {} is not there", folder.display()),
        };
        let help = "--subroutines with the folder share/framepath/subroutines below the PREFIX of make install, as seen from that of the INI file";
        edits.refuse(&place, found, help);
        return false;
    }
    true
}

/// A subroutine of the user's for aborts stays, if it calls ours.
fn abort(subject: &Subject, folders: &[Folder], edits: &mut Edits) {
    let Some(entry) = subject.ini.entry(INI_SECTION, "ON_ABORT_COMMAND") else {
        return edits.set(INI_SECTION, "ON_ABORT_COMMAND", COMMAND);
    };
    if subject.text(SECTION, "CLEAR_ON_ABORT") == Some("0") {
        return;
    }
    if let Some((found, help)) = Abort::of(&entry.value, folders).problem(&entry.value) {
        edits.refuse(&entry.place, found, help);
    }
}
