//! The codes for the frame commands: `REMAP` lines of the INI file.

use super::subroutine_files::{first, folders, has_tree};
use crate::machine::ini::{Entry, Ini};
use std::path::{Path, PathBuf};

/// The words that the subroutines take, or refuse by name.
const ARGUMENTS: &str = "abcdehijklpqruvwxyz";

/// A code and the subroutine that it calls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Code {
    /// `G77.1`.
    pub code: &'static str,
    /// `code_trans`, the name of a file without its ending.
    pub subroutine: &'static str,
}

impl Code {
    /// The value of `REMAP`.
    pub fn value(&self) -> String {
        match self.code {
            "M6" => format!("M6 modalgroup=6 ngc={}", self.subroutine),
            code => format!(
                "{code} modalgroup=1 argspec={ARGUMENTS} ngc={}",
                self.subroutine
            ),
        }
    }
}

const fn code(code: &'static str, subroutine: &'static str) -> Code {
    Code { code, subroutine }
}

/// All of them.
pub const CODES: [Code; 22] = [
    code("G77", "code_off"),
    code("G77.1", "code_trans"),
    code("G77.2", "code_rot"),
    code("G77.3", "code_rot_rpl"),
    code("G77.4", "code_rots"),
    code("G77.5", "code_scale"),
    code("G77.6", "code_mirror"),
    code("G78", "code_refresh"),
    code("G78.1", "code_atrans"),
    code("G78.2", "code_arot"),
    code("G78.3", "code_arot_rpl"),
    code("G78.4", "code_arots"),
    code("G78.5", "code_ascale"),
    code("G78.6", "code_amirror"),
    code("G79", "code_machine_move"),
    code("G68.2", "code_plane"),
    code("G68.4", "code_plane_on"),
    code("G69", "code_plane_off"),
    code("G53.1", "code_tool_normal"),
    code("G53.6", "code_tool_normal"),
    code("G43.4", "code_tool_centre"),
    code("M6", "frame_tool_change"),
];

/// A line `REMAP = ..`, cut into its parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remap {
    /// In upper case.
    pub code: String,
    /// `modalgroup=`.
    pub group: Option<String>,
    /// `argspec=`.
    pub arguments: Option<String>,
    /// `ngc=`.
    pub subroutine: Option<String>,
}

impl Remap {
    /// Cuts a value.
    pub fn parse(value: &str) -> Remap {
        let mut words = value.split_whitespace();
        let mut remap = Remap {
            code: words.next().unwrap_or("").to_ascii_uppercase(),
            ..Remap::default()
        };
        for word in words {
            let Some((name, value)) = word.split_once('=') else {
                continue;
            };
            let value = Some(value.to_owned());
            match name {
                "modalgroup" => remap.group = value,
                "argspec" => remap.arguments = value,
                "ngc" => remap.subroutine = value,
                _ => {}
            }
        }
        remap
    }
}

/// The code that calls this subroutine of ours: the one that is written, where several do.
pub fn code_of(subroutine: &str, written: &str) -> Option<Code> {
    let mut calling = CODES
        .into_iter()
        .filter(|code| code.subroutine == subroutine);
    let same = calling.clone().find(|code| code.code == written);
    same.or_else(|| calling.next())
}

/// Remaps whose subroutine is in none of the folders in which LinuxCNC looks for its file, with the name of that.
pub fn missing_files(ini: &Ini) -> Vec<(&Entry, String)> {
    if has_tree(ini) {
        return Vec::new();
    }
    let folders = folders(ini);
    let mut missing = Vec::new();
    for entry in ini.all("RS274NGC", "REMAP") {
        let Some(subroutine) = Remap::parse(&entry.value).subroutine else {
            continue;
        };
        if first(&folders, &subroutine).is_none() {
            missing.push((entry, format!("{subroutine}.ngc")));
        }
    }
    missing
}

/// A folder that the INI file names.
pub(super) fn folder(ini: &Ini, name: &str) -> PathBuf {
    match (name.strip_prefix("~/"), std::env::var_os("HOME")) {
        (Some(rest), Some(home)) => Path::new(&home).join(rest),
        _ => ini.file().parent().unwrap_or(Path::new("")).join(name),
    }
}
