//! The machine that is looked at: its INI file, what its HAL files leave behind, and what follows from both.

use super::framekins::{USUAL_TYPE_OUTPUT, external_offset};
use super::own_files::{self, GUARD_FILE};
use super::settings;
use super::subroutine_files::{Folder, SENDER, file};
use crate::hal::{Module, Script, State, Statement};
use crate::machine::IniError;
use crate::machine::configuration::AXIS_LETTERS;
use crate::machine::ini::{Entry, Ini};
use crate::machine::length_unit;
use crate::machine::numbers;
use crate::machine::place::Place;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The name of frame_guard in HAL.
pub const GUARD: &str = "frame-guard";

/// Everything that is known of it.
#[derive(Debug)]
pub struct Subject {
    /// The INI file.
    pub ini: Ini,
    /// Its lines that are nothing.
    pub ini_problems: Vec<IniError>,
    /// What is given to halcmd.
    pub script: Script,
    /// What is there behind it.
    pub state: State,
    /// Letters of the axes, in LinuxCNC's order.
    pub axes: Vec<char>,
    /// The letter of each joint, where each joint is an axis; empty behind other kinematics.
    pub joints: Vec<char>,
}

/// Whether a file lies with the operator's panel (hal-component/panel).
fn is_of_panel(file: &Path) -> bool {
    file.parent()
        .is_some_and(|folder| folder.ends_with("panel"))
}

impl Subject {
    /// Brings it all together.
    pub fn new(ini: Ini, ini_problems: Vec<IniError>, script: Script) -> Subject {
        let state = State::run(&script.statements);
        let axes = axes(&ini);
        let joints = joints(&ini, extra_joints(&state));
        Subject {
            ini,
            ini_problems,
            script,
            state,
            axes,
            joints,
        }
    }

    /// The folder in which LinuxCNC runs.
    pub fn folder(&self) -> PathBuf {
        match self.ini.file().parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
            _ => PathBuf::from("."),
        }
    }

    /// A file or folder that the INI file or a HAL file names.
    pub fn path(&self, name: &str) -> PathBuf {
        match (name.strip_prefix("~/"), std::env::var_os("HOME")) {
            (Some(rest), Some(home)) => Path::new(&home).join(rest),
            _ => self.folder().join(name),
        }
    }

    /// The text of a key that is not empty.
    pub fn text(&self, section: &str, key: &str) -> Option<&str> {
        self.ini.text(section, key).filter(|text| !text.is_empty())
    }

    /// The finite number that LinuxCNC reads.
    pub fn number(&self, section: &str, key: &str) -> Option<f64> {
        let entry = self.ini.entry(section, key)?;
        numbers::number(entry).filter(|number| number.is_finite())
    }

    /// The place of a key, else of its section, else of the file.
    pub fn place_of(&self, section: &str, key: &str) -> Place {
        if let Some(entry) = self.ini.entry(section, key) {
            return entry.place.clone();
        }
        let heading = self
            .ini
            .headings()
            .iter()
            .find(|heading| heading.name == section);
        heading.map_or_else(
            || Place::file(self.ini.file()),
            |heading| heading.place.clone(),
        )
    }

    /// Whether LinuxCNC plans with blendtp.
    pub fn has_planner(&self) -> bool {
        self.planner() == "blendtp" || self.state.module("blendtp").is_some()
    }

    /// `[TRAJ]TPMOD`, without parameters.
    pub fn planner(&self) -> &str {
        let words = self.text("TRAJ", "TPMOD").unwrap_or("tpmod");
        words.split_whitespace().next().unwrap_or("tpmod")
    }

    /// The module of `[KINS]KINEMATICS`.
    pub fn kinematics(&self) -> &str {
        let words = self.text("KINS", "KINEMATICS").unwrap_or("");
        words.split_whitespace().next().unwrap_or("")
    }

    /// A parameter of `[KINS]KINEMATICS`.
    pub fn kinematics_parameter(&self, name: &str) -> Option<&str> {
        parameter(self.text("KINS", "KINEMATICS")?, name)
    }

    /// Whether the machine is to have frames: something names framekins.
    pub fn has_frames(&self) -> bool {
        self.kinematics() == "framekins"
            || self.state.module("framekins").is_some()
            || self.first_naming("framekins").is_some()
    }

    /// The kinematics module that framekins is loaded before: `inner=`.
    pub fn inner(&self) -> Option<&str> {
        let module = self.state.module("framekins")?;
        module.parameter("inner").filter(|inner| !inner.is_empty())
    }

    /// The axis that tilts the table, `A` or `B`.
    pub fn tilt(&self) -> Option<char> {
        let module = self.state.module("framekins");
        let loaded = module.and_then(|module| module.parameter("machine"));
        match loaded.or(self.kinematics_parameter("machine")) {
            Some("xyzac") => Some('A'),
            Some("xyzbc") => Some('B'),
            _ => None,
        }
    }

    /// The first line of the HAL files with a word that is this name, or begins with it and a point.
    pub fn first_naming(&self, name: &str) -> Option<&Statement> {
        let names = |text: &str| {
            text.strip_prefix(name)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        let statements = self.script.statements.iter();
        statements.into_iter().find(|statement| {
            statement.words.iter().skip(1).any(|word| names(&word.text)) || names(statement.word(0))
        })
    }

    /// The machine unit, `mm` or `in`; `None` where it is another one, or none is given.
    pub fn length_unit(&self) -> Option<&'static str> {
        length_unit::meant(self.text("TRAJ", "LINEAR_UNITS")?)
    }

    /// Whether the machine unit is the inch.
    pub fn is_in_inches(&self) -> bool {
        self.length_unit() == Some("in")
    }

    /// Whether frame_guard understands `[TRAJ]LINEAR_UNITS`.
    pub fn has_linear_units(&self) -> bool {
        let units = self.text("TRAJ", "LINEAR_UNITS").unwrap_or("");
        let is_possible = |units: f64| units > 0.0 && units.is_finite();
        self.length_unit().is_some() || units.parse().is_ok_and(is_possible)
    }

    /// The module of motion.
    pub fn motion(&self) -> Option<&Module> {
        self.state.module("motmod")
    }

    /// How many joints motmod has beside those that the kinematics move.
    pub fn extra_joints(&self) -> usize {
        extra_joints(&self.state)
    }

    /// Whether LinuxCNC takes programs before the machine is homed.
    pub fn may_run_unhomed(&self) -> bool {
        let text = self.text("TRAJ", "NO_FORCE_HOMING").unwrap_or("");
        leading_number(text).is_some_and(|number| number != 0.0)
    }

    /// To be said behind that a line was not found.
    pub fn unless_unread(&self) -> String {
        match self.script.unread.first() {
            None => String::new(),
            Some(unread) => format!(
                " (unless {}, which is not read here, sees to it)",
                unread.name
            ),
        }
    }

    /// The HAL file for lines of ours: the last one that names framekins or blendtp, else the last one at all. Those of the
    /// operator's panel serve many machines.
    pub fn hal_file(&self) -> String {
        let ours = |statement: &&Statement| {
            let names = |module| statement.text.contains(module);
            (names("framekins") || names("blendtp")) && !is_of_panel(&statement.place.file)
        };
        let statement = self.script.statements.iter().rfind(ours);
        let named = statement.map(|statement| statement.place.file.to_path_buf());
        let own = |file: &&PathBuf| !file.starts_with(crate::hal::HALLIB) && !is_of_panel(file);
        let last = self.script.files.iter().rfind(own);
        match named.or_else(|| last.cloned()) {
            Some(file) => file.display().to_string(),
            None => "a HAL file of [HAL]HALFILE".to_owned(),
        }
    }

    /// A place for what is missing in the HAL files: the line that loads this module, else the HAL file.
    pub fn place_of_module(&self, module: &str) -> Place {
        if let Some(module) = self.state.module(module) {
            return module.statement.place.clone();
        }
        match self.script.files.last() {
            Some(file) => Place::file(file),
            None => self.place_of("HAL", "HALFILE"),
        }
    }

    /// The analog output with which frames begin.
    pub fn first_output(&self) -> u32 {
        let text = self.text("FRAMEPATH", "ANALOG_OUTPUT").unwrap_or("0");
        let key = settings::key("ANALOG_OUTPUT");
        match key.is_some_and(|key| key.takes(text)) {
            true => text.parse().unwrap_or(0),
            false => 0,
        }
    }

    /// The analog output with which G43.4 chooses the type of the kinematics behind framekins.
    pub fn type_output(&self) -> u32 {
        let text = self.text("FRAMEPATH", "TYPE_OUTPUT").unwrap_or("");
        let key = settings::key("TYPE_OUTPUT");
        match key.is_some_and(|key| key.takes(text)) {
            true => text.parse().unwrap_or(USUAL_TYPE_OUTPUT),
            false => USUAL_TYPE_OUTPUT,
        }
    }

    /// The axes that HAL files let have an external offset.
    pub fn external_offsets(&self) -> Vec<char> {
        let is_on = |letter: &char| {
            let pin = format!("axis.{}.eoffset-enable", letter.to_ascii_lowercase());
            let set = self.state.settings.get(&pin);
            let set = set.is_some_and(|setting| {
                !["0", "false"].contains(&setting.value.to_ascii_lowercase().as_str())
            });
            set || self.state.signal_of(&pin).is_some()
        };
        self.axes.iter().copied().filter(is_on).collect()
    }

    /// The net by which framekins is told of one.
    pub fn external_offset_line(&self, letter: char) -> String {
        let [pin, source] = external_offset(letter);
        match self.state.signal_of(&source) {
            Some(signal) => format!("net {signal} => {pin}"),
            None => format!(
                "net external-offset-{} {source} => {pin}",
                letter.to_ascii_lowercase()
            ),
        }
    }

    /// The folders of SUBROUTINE_PATH, as they are named.
    pub fn subroutine_folders(&self) -> Vec<&str> {
        let path = self.text("RS274NGC", "SUBROUTINE_PATH").unwrap_or("");
        path.split(':')
            .filter(|folder| !folder.is_empty())
            .collect()
    }

    /// The folder of framepath's subroutines, as the INI file or the HAL file names it.
    pub fn own_folder(&self) -> String {
        let has_frames = |folder: &&str| file(&self.path(folder), SENDER).is_file();
        if let Some(folder) = self.subroutine_folders().into_iter().find(has_frames) {
            return folder.trim_end_matches('/').to_owned();
        }
        let guard = self
            .state
            .programs
            .iter()
            .find(|program| is_guard(&program.program));
        let folder = guard.and_then(|guard| guard.program.strip_suffix("/frame_guard.py"));
        let is_there = |folder: &&str| self.path(folder).join(GUARD_FILE).is_file();
        let folder = folder.filter(is_there).map(str::to_owned);
        folder.unwrap_or_else(own_files::subroutines)
    }

    /// Subroutines that hide framepath's: the place of what names their folder, what was found, and what to do.
    pub fn hidden(&self, folder: &Folder, names: &[&str]) -> (Place, String, String) {
        let (place, named) = match folder.key {
            Some((section, key)) => (self.place_of(section, key), format!("[{section}]{key}")),
            None => (
                Place::file(self.ini.file()),
                "the folder in which LinuxCNC runs".to_owned(),
            ),
        };
        let files: Vec<String> = names.iter().map(|name| format!("{name}.ngc")).collect();
        let found = format!(
            "LinuxCNC finds {} in {} ({named}) before those of framepath, and frame commands call what is there",
            files.join(", "),
            folder.path.display()
        );
        let help = "give these files and their subroutines other names, or move them".to_owned();
        (place, found, help)
    }

    /// All keys of this name that LinuxCNC reads.
    pub fn all(&self, section: &str, key: &str) -> Vec<&Entry> {
        self.ini.all(section, key)
    }
}

/// The line that starts frame_guard from this folder.
pub fn guard_line(folder: &str) -> String {
    format!("loadusr -Wn {GUARD} {folder}/{GUARD_FILE}")
}

/// Whether a program is frame_guard.
pub fn is_guard(program: &str) -> bool {
    Path::new(program)
        .file_name()
        .is_some_and(|name| name == GUARD_FILE)
}

/// A parameter of a line like `framekins coordinates=XYZ`.
pub fn parameter<'a>(words: &'a str, name: &str) -> Option<&'a str> {
    let mut parameters = words
        .split_whitespace()
        .filter_map(|word| word.split_once('='));
    parameters.find_map(|(known, value)| (known == name).then_some(value))
}

/// The finite number that a text begins with.
pub fn leading_number(text: &str) -> Option<f64> {
    leading_float(text).filter(|number| number.is_finite())
}

/// The number that a text begins with; HAL takes `inf` and `nan` for one as well.
fn leading_float(text: &str) -> Option<f64> {
    let word = text
        .split(|c: char| c.is_whitespace() || ",;#".contains(c))
        .next()?;
    word.parse().ok()
}

fn axes(ini: &Ini) -> Vec<char> {
    let named = ini
        .text("TRAJ", "COORDINATES")
        .filter(|text| !text.is_empty());
    let kinematics = ini.text("KINS", "KINEMATICS").unwrap_or("");
    let letters = named
        .or_else(|| parameter(kinematics, "coordinates"))
        .unwrap_or("");
    let letters = letters.to_ascii_uppercase();
    AXIS_LETTERS
        .chars()
        .filter(|letter| letters.contains(*letter))
        .collect()
}

/// As trivkins takes them, and framekins on a machine in which each joint is an axis. On a machine with a tilting
/// table of framekins they are the same without the tool centre point.
fn joints(ini: &Ini, beside: usize) -> Vec<char> {
    let kinematics = ini.text("KINS", "KINEMATICS").unwrap_or("");
    let module = kinematics.split_whitespace().next().unwrap_or("");
    if !matches!(module, "trivkins" | "framekins") {
        return Vec::new();
    }
    let count = ini
        .text("KINS", "JOINTS")
        .and_then(|text| text.trim().parse::<usize>().ok());
    let count = count.map_or(16, |count| count.saturating_sub(beside));
    let letters = parameter(kinematics, "coordinates")
        .unwrap_or(AXIS_LETTERS)
        .to_ascii_uppercase();
    letters.chars().take(count).collect()
}

fn extra_joints(state: &State) -> usize {
    let motion = state.module("motmod");
    let text = motion.and_then(|motion| motion.parameter("num_extrajoints"));
    text.and_then(|text| text.parse().ok()).unwrap_or(0)
}

/// The file of a place, shared.
pub fn shared(file: &Path) -> Arc<Path> {
    Arc::from(file)
}
