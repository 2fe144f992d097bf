//! Where the files of ours are that configurations name: subroutines, and previews beside them.

use std::path::Path;

/// Where packages put the subroutines, and `make install` without a PREFIX.
const USUAL: &str = "/usr/share/framepath/subroutines";

/// What HAL starts of them: a folder without it is not theirs.
pub const GUARD_FILE: &str = "frame_guard.py";

/// What to do where the files are not in the folder that is named already.
pub const INSTALL: &str =
    "in framepath's sources: make install; or name the folder where these files are";

/// The folder of the subroutines that were installed with this command: below `share` beside its own folder, else the
/// usual one.
pub fn subroutines() -> String {
    let program = std::env::current_exe().ok();
    let beside = program.and_then(|program| installed_with(&program));
    beside.unwrap_or_else(|| USUAL.to_owned())
}

fn installed_with(program: &Path) -> Option<String> {
    let folder = program.parent()?.with_file_name("share");
    let folder = folder.join("framepath/subroutines");
    let folder = Some(folder).filter(|folder| folder.join(GUARD_FILE).is_file())?;
    folder.to_str().map(str::to_owned)
}
