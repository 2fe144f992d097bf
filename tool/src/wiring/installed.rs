//! The LinuxCNC that would run a configuration: where it takes its modules from, and for which LinuxCNC those are built.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Stands in the file of a module before the version of the LinuxCNC that it is built for (linuxcnc_version.h).
const MARK: &[u8] = b"framepath built for LinuxCNC ";

/// No version is longer.
const LONGEST_VERSION: usize = 64;

/// What the script `linuxcnc` says of itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinuxCnc {
    /// Where modules are.
    pub modules: PathBuf,
    /// `2.9.0~pre1`; empty where the script does not say.
    pub version: String,
}

impl LinuxCnc {
    /// The one that the command `linuxcnc` starts; `None` where there is none, or where it is no script of LinuxCNC's.
    pub fn in_path() -> Option<LinuxCnc> {
        let folders = std::env::var_os("PATH")?;
        let script = std::env::split_paths(&folders)
            .map(|folder| folder.join("linuxcnc"))
            .find(|file| file.is_file())?;
        LinuxCnc::started_by(&script)
    }

    /// The one whose modules are in this folder: that of `PATH`, or the one that the folder is a part of, installed or built
    /// to be run in place.
    #[cfg(feature = "linuxcnc")]
    pub fn of_modules(folder: &Path) -> Option<LinuxCnc> {
        let folder = fs::canonicalize(folder).ok()?;
        let scripts = ["../scripts/linuxcnc", "../../../bin/linuxcnc"];
        let around = scripts
            .iter()
            .filter_map(|script| LinuxCnc::started_by(&folder.join(script)));
        LinuxCnc::in_path()
            .into_iter()
            .chain(around)
            .find(|found| fs::canonicalize(&found.modules).is_ok_and(|modules| modules == folder))
    }

    fn started_by(script: &Path) -> Option<LinuxCnc> {
        LinuxCnc::of_script(&String::from_utf8_lossy(&fs::read(script).ok()?))
    }

    fn of_script(text: &str) -> Option<LinuxCnc> {
        Some(LinuxCnc {
            modules: PathBuf::from(variable(text, "LINUXCNC_RTLIB_DIR")?),
            version: variable(text, "LINUXCNCVERSION").unwrap_or_default(),
        })
    }

    /// The file of a module.
    pub fn module(&self, name: &str) -> PathBuf {
        self.modules.join(format!("{name}.so"))
    }
}

/// The first value that a script gives a variable, at the beginning of a line.
fn variable(script: &str, name: &str) -> Option<String> {
    let value = script
        .lines()
        .find_map(|line| line.strip_prefix(name)?.strip_prefix('='))?;
    let value = value.split([';', ' ', '\t']).next().unwrap_or("");
    let value = value.trim_matches('"');
    (!value.is_empty()).then(|| value.to_owned())
}

/// The version of the LinuxCNC that a module of ours is built for; `None` where its file does not say.
///
/// # Errors
/// A file that cannot be read.
pub fn built_for(module: &Path) -> io::Result<Option<String>> {
    let bytes = fs::read(module)?;
    let place = bytes.windows(MARK.len()).position(|found| found == MARK);
    Ok(place.and_then(|place| {
        let rest = &bytes[place + MARK.len()..];
        let length = rest
            .iter()
            .take(LONGEST_VERSION)
            .position(|byte| *byte == 0)?;
        let version = std::str::from_utf8(&rest[..length]).ok()?;
        (!version.is_empty()).then(|| version.to_owned())
    }))
}

/// The series of a version, `2.9` of `2.9.0~pre1`.
pub fn series(version: &str) -> Option<(u32, u32)> {
    let mut numbers = version.split(|c: char| !c.is_ascii_digit());
    let major = numbers.next()?.parse().ok()?;
    Some((major, numbers.next()?.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_script_says_where_modules_are_and_which_version_it_is() {
        let text = "#!/bin/bash\n# LINUXCNCVERSION=\"1\"\nLINUXCNC_RTLIB_DIR=/opt/rtlib\n\
                    LINUXCNCVERSION=\"2.10.0~pre1\"; export LINUXCNCVERSION\n";
        let found = LinuxCnc::of_script(text).expect("a script of LinuxCNC");
        assert_eq!(found.module("blendtp"), Path::new("/opt/rtlib/blendtp.so"));
        assert_eq!(found.version, "2.10.0~pre1");
        assert_eq!(LinuxCnc::of_script("exec elsewhere\n"), None);
    }

    #[test]
    fn versions_of_a_series() {
        assert_eq!(series("2.9.0~pre1+git2023"), Some((2, 9)));
        assert_eq!(series("2.10"), Some((2, 10)));
        assert_eq!(series("master"), None);
    }

    #[test]
    fn a_module_says_what_it_is_built_for() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("blendtp.so");
        let cases: [(&[u8], Option<&str>); 3] = [
            (
                b"\x7fELF\0framepath built for LinuxCNC 2.9.4\0rest",
                Some("2.9.4"),
            ),
            (b"\x7fELF\0framepath built for LinuxCNC \0rest", None),
            (b"\x7fELF\0framepath built for LinuxCNC 2.9.4", None),
        ];
        for (bytes, version) in cases {
            fs::write(&file, bytes).expect("written");
            assert_eq!(built_for(&file).expect("read").as_deref(), version);
        }
    }
}
