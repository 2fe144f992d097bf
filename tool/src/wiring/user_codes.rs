//! M100 to M199: programs of the machine, which LinuxCNC's task controller looks for when it starts.

use super::codes::folder;
use crate::machine::ini::Ini;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

/// Where it looks without `[DISPLAY]PROGRAM_PREFIX`.
const USUAL_PREFIX: &str = "nc_files";

/// Folders of `[RS274NGC]USER_M_PATH` beyond this many do not count.
const MOST_FOLDERS: usize = 5;

/// The codes whose file is in one of the folders, and may be run.
pub fn user_codes(ini: &Ini) -> Vec<u32> {
    let text = |section, key| ini.text(section, key).filter(|text| !text.is_empty());
    let prefix = text("DISPLAY", "PROGRAM_PREFIX").unwrap_or(USUAL_PREFIX);
    let path = text("RS274NGC", "USER_M_PATH").unwrap_or("");
    let named = path.split(':').filter(|name| !name.is_empty());
    let named = std::iter::once(prefix).chain(named.take(MOST_FOLDERS));
    let folders: Vec<_> = named.map(|name| folder(ini, name.trim())).collect();
    let is_there = |code: &u32| {
        let name = format!("M{code}");
        folders.iter().any(|folder| is_program(&folder.join(&name)))
    };
    (100..=199).filter(is_there).collect()
}

/// Whether its owner may run a file.
fn is_program(file: &Path) -> bool {
    let metadata = std::fs::metadata(file);
    metadata.is_ok_and(|metadata| metadata.permissions().mode() & 0o100 != 0)
}
