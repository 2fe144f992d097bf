//! The files of subroutines: LinuxCNC takes the first one of a name in the folders in which it looks.

use super::codes::folder;
use crate::machine::ini::Ini;
use std::path::{Path, PathBuf};

/// Folders of `[RS274NGC]SUBROUTINE_PATH` beyond this many do not count.
const MOST_FOLDERS: usize = 10;

/// One of framepath's files, without which no frame is set.
pub const SENDER: &str = "frame_send";

/// A subroutine of framepath, and of many who have one for aborts themselves: theirs may come first.
pub const SHARED: &str = "on_abort";

/// All of framepath, which codes, programs and one another call by these names.
pub const OWN: [&str; 67] = [
    "active_plane",
    "amirror",
    "arot",
    "arot_rpl",
    "arots_xy",
    "arots_yz",
    "arots_zx",
    "ascale",
    "ascale_off",
    "atrans",
    "axes_type",
    "code_amirror",
    "code_arot",
    "code_arot_rpl",
    "code_arots",
    "code_ascale",
    "code_atrans",
    "code_machine_move",
    "code_mirror",
    "code_off",
    "code_plane",
    "code_plane_off",
    "code_plane_on",
    "code_refresh",
    "code_rot",
    "code_rot_rpl",
    "code_rots",
    "code_scale",
    "code_tool_centre",
    "code_tool_normal",
    "code_trans",
    "frame_abort",
    "frame_compensation",
    "frame_off",
    "frame_offsets",
    "frame_order",
    "frame_plane",
    "frame_plane_angles",
    "frame_plane_begun",
    "frame_plane_points",
    "frame_plane_vectors",
    "frame_refresh",
    "frame_resume",
    "frame_send",
    "frame_suspend",
    "frame_tool_change",
    "frame_turn",
    "frame_turned",
    "inner_type",
    "machine_axes",
    "machine_move",
    "machine_rapid",
    "mirror",
    "motion_mode",
    "on_abort",
    "retract",
    "rot",
    "rot_rpl",
    "rotary_place",
    "rotary_zero",
    "rots_xy",
    "rots_yz",
    "rots_zx",
    "scale",
    "tool_centre_off",
    "tool_normal",
    "trans",
];

/// A folder in which LinuxCNC looks.
#[derive(Clone, Debug, PartialEq)]
pub struct Folder {
    /// Where it is.
    pub path: PathBuf,
    /// The section and the key that name it; `None`: LinuxCNC runs in it.
    pub key: Option<(&'static str, &'static str)>,
}

/// The folders in their order.
pub fn folders(ini: &Ini) -> Vec<Folder> {
    let text = |section, key| ini.text(section, key).filter(|text| !text.is_empty());
    let named = |name: &str, key| Folder {
        path: folder(ini, name),
        key: Some(key),
    };
    let own = ini.file().parent();
    let own = own.filter(|own| !own.as_os_str().is_empty());
    let mut folders = vec![Folder {
        path: own.unwrap_or(Path::new(".")).to_owned(),
        key: None,
    }];
    let prefix = ("DISPLAY", "PROGRAM_PREFIX");
    folders.extend(text(prefix.0, prefix.1).map(|name| named(name, prefix)));
    let path = ("RS274NGC", "SUBROUTINE_PATH");
    let names = text(path.0, path.1).unwrap_or("").split(':');
    let there = names
        .filter(|name| !name.is_empty())
        .map(|name| named(name, path))
        .filter(|folder| folder.path.exists());
    folders.extend(there.take(MOST_FOLDERS));
    folders
}

/// Whether LinuxCNC looks in a tree of folders as well, behind the others.
pub fn has_tree(ini: &Ini) -> bool {
    ini.text("WIZARD", "WIZARD_ROOT")
        .is_some_and(|text| !text.is_empty())
}

/// The file of a subroutine.
pub fn file(folder: &Path, subroutine: &str) -> PathBuf {
    folder.join(format!("{subroutine}.ngc"))
}

/// The file that LinuxCNC takes for a subroutine.
pub fn first(folders: &[Folder], subroutine: &str) -> Option<PathBuf> {
    let mut files = folders.iter().map(|folder| file(&folder.path, subroutine));
    files.find(|file| file.is_file())
}

/// Whether two names are those of one folder.
fn is_same(one: &Path, other: &Path) -> bool {
    match (one.canonicalize(), other.canonicalize()) {
        (Ok(one), Ok(other)) => one == other,
        _ => one == other,
    }
}

/// The folders before `own`, that of framepath, with subroutines of the same names: these are called in place of framepath's.
pub fn hiding<'a>(folders: &'a [Folder], own: &Path) -> Vec<(&'a Folder, Vec<&'static str>)> {
    let before = folders
        .iter()
        .take_while(|folder| !is_same(&folder.path, own));
    let hides = |folder: &Folder| -> Vec<&'static str> {
        let names = OWN.into_iter().filter(|name| *name != SHARED);
        names
            .filter(|name| file(&folder.path, name).is_file())
            .collect()
    };
    before
        .map(|folder| (folder, hides(folder)))
        .filter(|(_, names)| !names.is_empty())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_files_are_known_by_name() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../hal-component/subroutines");
        let files = std::fs::read_dir(folder).expect("a folder");
        let names = files.map(|file| file.expect("a file").file_name());
        let mut names: Vec<String> = names
            .filter_map(|name| Some(name.to_str()?.strip_suffix(".ngc")?.to_owned()))
            .collect();
        names.sort();
        assert_eq!(names, OWN);
    }
}
