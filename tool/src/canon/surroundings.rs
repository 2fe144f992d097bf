//! What the interpreter finds around it: INI file, numbered parameters, tools, position.

use super::tool_table::Tool;
use crate::path::Position;
use framepath::axes::{AXIS_COUNT, AXIS_LETTERS};
use std::io;
use std::path::{Path, PathBuf};

/// The machine as the interpreter sees it. The default is a machine in millimetres at zero that has
/// no INI file, no parameters and every tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Surroundings {
    /// Absolute path of the INI file: the interpreter takes subroutines, remaps and others from it.
    pub ini: Option<PathBuf>,
    /// Its text with that of the files that it includes, which the interpreter reads in its place, in the folder of the INI file;
    /// `None` if it includes none.
    pub expanded_ini: Option<String>,
    /// File of numbered parameters, which is copied. One that does not exist counts as empty, as
    /// for LinuxCNC.
    pub parameters: Option<PathBuf>,
    /// Length of the machine's unit, mm.
    pub unit: f64,
    /// Where the machine stands.
    pub start: Position,
    /// The axes that there are, in the order of a position: words of others are refused.
    pub axes: [bool; AXIS_COUNT],
    /// Code that runs before the program, empty for none.
    pub startup: String,
    /// Whether blocks that begin with a slash are left out, as with LinuxCNC's block delete.
    pub skip_blocks: bool,
    /// All tools there are; `None`: every number is a tool without length and radius.
    pub tools: Option<Vec<Tool>>,
    /// Number of the tool that the spindle holds at the start, 0 for none.
    pub held: i32,
    /// The analog output that switches the kinematics, and the type that moves are planned with, `None` for that of the first
    /// one: moves with another type are refused.
    pub kinematics_switch: Option<(u32, Option<i32>)>,
    /// The codes M100 to M199 that are programs of the machine.
    pub user_codes: Vec<u32>,
}

impl Default for Surroundings {
    fn default() -> Self {
        Surroundings {
            ini: None,
            expanded_ini: None,
            parameters: None,
            unit: 1.0,
            start: [0.0; 9],
            axes: [true; AXIS_COUNT],
            startup: String::new(),
            skip_blocks: false,
            tools: None,
            held: 0,
            kinematics_switch: None,
            user_codes: Vec::new(),
        }
    }
}

impl Surroundings {
    /// Nothing but a machine that stands there, mm and degrees.
    pub fn standing_at(start: &Position) -> Surroundings {
        Surroundings {
            start: *start,
            ..Surroundings::default()
        }
    }

    /// Writes what the interpreter program reads; an error comes with its file.
    pub(super) fn write(
        &self,
        parameters: &Path,
        settings: &Path,
    ) -> Result<(), (PathBuf, io::Error)> {
        let known = match &self.parameters {
            Some(file) => match std::fs::read(file) {
                Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
                known => known.map_err(|error| (file.clone(), error))?,
            },
            None => Vec::new(),
        };
        std::fs::write(parameters, known).map_err(|error| (parameters.to_owned(), error))?;
        std::fs::write(settings, self.text()).map_err(|error| (settings.to_owned(), error))
    }

    /// The settings as `interpreter/settings.cc` reads them.
    fn text(&self) -> String {
        let numbers = |numbers: &[f64]| -> String {
            let words = numbers.iter().map(|number| format!(" {number:e}"));
            words.collect()
        };
        let mut text = format!("UNIT {:e}\nSTART{}\n", self.unit, numbers(&self.start));
        let axes = AXIS_LETTERS.iter().zip(self.axes);
        let axes: String = axes
            .filter(|(_, there)| *there)
            .map(|(letter, _)| letter)
            .collect();
        text += &format!("AXES {axes}\n");
        if !self.startup.trim().is_empty() {
            text += &format!("STARTUP {}\n", self.startup.trim());
        }
        if self.skip_blocks {
            text += "SKIP\n";
        }
        if self.held != 0 {
            text += &format!("HELD {}\n", self.held);
        }
        if let Some((output, kind)) = self.kinematics_switch {
            text += &format!("SWITCH {output} {}\n", kind.unwrap_or(-1));
        }
        for code in &self.user_codes {
            text += &format!("USER {code}\n");
        }
        if let Some(tools) = &self.tools {
            text += "TABLE\n";
            for tool in tools {
                let angles = [tool.diameter, tool.front_angle, tool.back_angle];
                text += &format!(
                    "TOOL {} {}{}{} {}\n",
                    tool.number,
                    tool.pocket,
                    numbers(&tool.offset),
                    numbers(&angles),
                    tool.orientation
                );
            }
        }
        text
    }
}
