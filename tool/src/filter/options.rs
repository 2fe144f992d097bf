//! The options of `framepath filter`.

use crate::dialects::Dialect;
use crate::dialects::ini;
use crate::dialects::program_options::ProgramOptions;
use crate::dialects::settings::{Settings, TOLERANCE};
use crate::machine::IniError;
use crate::program::PathControl;
use clap::Args;
use std::path::PathBuf;

/// How frames are carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Backend {
    /// By the frame kinematics: calls of its subroutines, moves as programmed.
    Kinematics,
    /// By rewriting the coordinates: runs on any machine, frames that tilt the plane are refused.
    Program,
    /// By rewriting the coordinates where that is possible, else by the frame kinematics.
    Auto,
}

/// Arguments of `framepath filter`.
#[derive(Clone, Debug, Args)]
pub struct FilterArguments {
    /// The language of the part program
    #[arg(long, value_enum, default_value = "auto")]
    pub dialect: Dialect,
    /// How frames are carried out
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: Backend,
    /// LinuxCNC's unit of length is the inch: programs are taken as inch unless they say otherwise
    #[arg(long)]
    pub machine_in_inch: bool,
    /// How corners are passed until the program changes it: exactly (G61, with stops at corners only),
    /// with a stop at the end of every move (G61.1), rounded by at most --tolerance (G64), or rounded by
    /// at most so many mm (a number: G64 with that P)
    #[arg(long, value_name = "G61|G61.1|G64|P", default_value = "G61", value_parser = path_mode)]
    pub path_mode: PathMode,
    /// By how much corners may be rounded where the program asks for that and names no tolerance, mm;
    /// without this option [FRAMEPATH]TOLERANCE of the INI file of the LinuxCNC that runs the filter, else
    /// 0.01
    #[arg(long, value_name = "MM", value_parser = corner_tolerance)]
    pub tolerance: Option<f64>,
    /// INI file of the machine, for the names and diameters in its tool table, and whether it is a lathe; INI_FILE_NAME of the
    /// environment if it is not given, which LinuxCNC sets
    #[arg(long, value_name = "FILE")]
    pub ini: Option<PathBuf>,
    /// Largest distance of the chords from the ellipse that unequal scales make of an arc, machine
    /// units
    #[arg(long, value_name = "LENGTH", default_value_t = 0.005, value_parser = tolerance)]
    pub chord_tolerance: f64,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramOptions,
    /// The part program
    pub file: PathBuf,
}

impl FilterArguments {
    /// The settings of the control that is imitated.
    ///
    /// # Errors
    ///
    /// What is wrong with the INI file that LinuxCNC names.
    pub fn settings(&self) -> Result<Settings, IniError> {
        let millimetre = match self.machine_in_inch {
            true => 1.0 / 25.4,
            false => 1.0,
        };
        let ini_file = self.ini_file();
        let tolerance = match (self.tolerance, &ini_file) {
            (Some(tolerance), _) => tolerance,
            (None, Some(file)) => ini::tolerance(file)?.unwrap_or(TOLERANCE),
            (None, None) => TOLERANCE,
        };
        let path_mode = match self.path_mode {
            PathMode::Exact(control) => control,
            PathMode::Rounded(own) => PathControl::Continuous {
                tolerance: own.unwrap_or(tolerance) * millimetre,
            },
        };
        Ok(Settings {
            machine_in_inch: self.machine_in_inch,
            path_mode,
            tolerance: tolerance * millimetre,
            ..self
                .program
                .settings(&self.file, ini_file, self.machine_in_inch)?
        })
    }

    /// Options that say two things of the same, of which one would be settled in silence.
    ///
    /// # Errors
    ///
    /// The first of them.
    pub fn contradiction(&self) -> Result<(), String> {
        self.program.contradiction()
    }

    /// What is to be said of the INI file: the lines that LinuxCNC passes over.
    pub(super) fn warnings(&self) -> Vec<String> {
        self.ini_file()
            .map_or(Vec::new(), |file| ini::warnings(&file))
    }

    /// The INI file of the LinuxCNC that runs the filter: the script that starts it names the file to all that it
    /// runs.
    fn ini_file(&self) -> Option<PathBuf> {
        let set = || std::env::var_os("INI_FILE_NAME").filter(|name| !name.is_empty());
        self.ini.clone().or_else(|| set().map(PathBuf::from))
    }
}

/// How corners are passed from the first line on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathMode {
    /// G61 or G61.1.
    Exact(PathControl),
    /// G64, with this P in mm if it is given.
    Rounded(Option<f64>),
}

fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if (1e-6..=10.0).contains(&value) => Ok(value),
        _ => Err("a length from 0.000001 to 10 is needed".to_string()),
    }
}

fn path_mode(text: &str) -> Result<PathMode, String> {
    Ok(match text.to_ascii_uppercase().as_str() {
        "G61" => PathMode::Exact(PathControl::ExactPath),
        "G61.1" => PathMode::Exact(PathControl::ExactStop),
        "G64" => PathMode::Rounded(None),
        _ => PathMode::Rounded(Some(corner_tolerance(text).map_err(|_| {
            "write G61, G61.1, G64 or a tolerance from 0.001 to 10 mm".to_string()
        })?)),
    })
}

fn corner_tolerance(text: &str) -> Result<f64, String> {
    match text.parse() {
        // LinuxCNC takes G64 P0 for no limit at all.
        Ok(value) if ini::TOLERANCES.contains(&value) => Ok(value),
        _ => Err("a tolerance from 0.001 to 10 mm is needed".to_string()),
    }
}
