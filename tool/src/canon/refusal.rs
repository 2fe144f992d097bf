//! What a refusal of the interpreter means where its own words name another cause.

use crate::dialects::guess::surely;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// How much of a program is looked at for its language, bytes.
const HEAD: u64 = 1 << 16;

/// Modules that only LinuxCNC's task controller has for the Python of remaps.
const OF_TASK: [&str; 2] = ["emccanon", "emctask"];

/// What the interpreter says of a number in the file of parameters, and of one in a program.
pub const NO_SUCH_PARAMETER: &str = "Parameter number out of range";

/// What it says where it finds none of the files that it is to open.
pub const NO_FILE: &str = "File not open";

/// What it says beside that of a remapped code.
const NO_REMAP: &str = "INTERP_REMAP: NGC file not found: ngc=";

/// As the interpreter names characters: it knows all of these that the machine has.
const AXES: [char; 9] = ['x', 'y', 'z', 'a', 'b', 'c', 'u', 'v', 'w'];

/// What is to be said behind a message, which may be nothing.
pub fn behind(message: &str, has_ini: bool) -> &'static str {
    if message.starts_with("File ended with no percent sign") {
        return ": end it with a line M2 (or M30)";
    }
    if let Some(rest) = message.strip_prefix("Bad character '")
        && rest.starts_with(AXES)
    {
        return ": the machine has no such axis, since [TRAJ]COORDINATES (or [KINS]KINEMATICS) does not name it";
    }
    let user_code = message.strip_prefix("Unknown m code used: M");
    let user_code = user_code.and_then(|code| code.trim().parse::<u32>().ok());
    let is_user_code = user_code.is_some_and(|code| (100..=199).contains(&code));
    let is_undefined = message.starts_with("Named parameter") && message.contains("not defined");
    match (is_user_code, is_undefined && message.contains("#<_hal[")) {
        (true, _) if has_ini => {
            ": it is a program of the machine, and no file that may be run has this name in the folders of \
             [DISPLAY]PROGRAM_PREFIX and [RS274NGC]USER_M_PATH"
        }
        (true, _) => {
            ": it is a program of the machine, which is looked for where the INI file says: name that with --ini"
        }
        (_, true) => {
            ": it is a pin of HAL, and there are none here, where no machine runs: write the number that it has in its place"
        }
        _ => "",
    }
}

/// The same behind what was said beside a message.
pub fn behind_words(said: &str) -> String {
    match said.split_once(NO_REMAP) {
        Some((_, name)) => {
            let name = name.lines().next().unwrap_or_default().trim();
            format!(
                "\n  help: put {name}.ngc into a folder of [DISPLAY]PROGRAM_PREFIX or [RS274NGC]SUBROUTINE_PATH (they count from \
                 the folder of the INI file); LinuxCNC finds nothing in a folder whose path has a blank"
            )
        }
        None => behind_python(said),
    }
}

/// The same behind what Python has said.
fn behind_python(said: &str) -> String {
    let without = "plan with a copy of the INI file without [PYTHON] and the lines REMAP with python=, py=, prolog= or epilog=";
    let missing = said.rsplit_once("No module named '").map(|(_, name)| name);
    let missing = missing.and_then(|name| name.split('\'').next());
    let help = match missing {
        Some(name) if OF_TASK.contains(&name) => format!(
            "the configuration has remaps in Python that import {name}, which only LinuxCNC's own task has: {without}"
        ),
        Some(name) => format!(
            "the Python of the remaps imports {name}, which is in no folder of [PYTHON]PATH_PREPEND and PATH_APPEND (they \
             count from the folder of the INI file): correct these, or {without}"
        ),
        None if said.contains("ImportError") => {
            format!("the Python of the remaps cannot be imported: correct it, or {without}")
        }
        None => return String::new(),
    };
    format!("\n  help: {help}")
}

/// What is to be done first with a program that is surely one of another control.
pub fn of_another_control(file: &Path) -> String {
    let mut head = Vec::new();
    let read = File::open(file).and_then(|opened| opened.take(HEAD).read_to_end(&mut head));
    let dialect = read
        .ok()
        .and_then(|_| surely(file, &String::from_utf8_lossy(&head)));
    let Some(dialect) = dialect else {
        return String::new();
    };
    let mut written = file.with_extension("ngc");
    if written == file {
        written = file.with_extension("filtered.ngc");
    }
    format!(
        "\n  help: taken as {}: framepath filter {} > {} first",
        dialect.name(),
        file.display(),
        written.display()
    )
}
