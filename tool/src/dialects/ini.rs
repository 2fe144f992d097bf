//! Section [FRAMEPATH] of the INI file of the LinuxCNC that runs the filter.

use crate::machine::IniError;
use crate::machine::ini::Ini;
use crate::machine::lathe;
use crate::wiring::settings::SECTION;
use std::ops::RangeInclusive;
use std::path::Path;

pub use crate::wiring::settings::{PLACES, TOLERANCES};

/// TOLERANCE, mm; `None` where it is not set.
///
/// # Errors
///
/// When the file cannot be read or the value is out of range.
pub fn tolerance(file: &Path) -> Result<Option<f64>, IniError> {
    let problem = "a tolerance from 0.001 to 10 mm is needed";
    number(file, "TOLERANCE", &TOLERANCES, problem)
}

/// RETRACT_Z, mm; see [`tolerance`].
///
/// # Errors
///
/// When the file cannot be read or the value is out of range.
pub fn retract_z(file: &Path) -> Result<Option<f64>, IniError> {
    let problem = "a place of the machine in mm is needed";
    number(file, "RETRACT_Z", &PLACES, problem)
}

/// Whether the machine is a lathe.
///
/// # Errors
///
/// When the file cannot be read.
pub fn is_lathe(file: &Path) -> Result<bool, IniError> {
    Ok(lathe::is_lathe(&Ini::read(file)?))
}

/// Whether X is a diameter (G7) when LinuxCNC has started.
///
/// # Errors
///
/// When the file cannot be read.
pub fn begins_in_diameters(file: &Path) -> Result<bool, IniError> {
    let ini = Ini::read(file)?;
    let code = ini.text("RS274NGC", "RS274NGC_STARTUP_CODE").unwrap_or("");
    let code: String = code.split_whitespace().collect();
    let mut words = code.split(['G', 'g']).skip(1);
    Ok(words.any(|word| {
        let number = word.trim_start_matches('0');
        number.starts_with('7')
            && !number[1..].starts_with(|c: char| c.is_ascii_digit() || c == '.')
    }))
}

/// The lines that LinuxCNC passes over.
pub fn warnings(file: &Path) -> Vec<String> {
    let passed_over = |ini: Ini| ini.passed_over().to_vec();
    // That it cannot be read is said by who needs a value of it.
    let lines = Ini::read(file).map(passed_over).unwrap_or_default();
    lines
        .iter()
        .map(|line| format!("warning: {line}"))
        .collect()
}

fn number(
    file: &Path,
    key: &str,
    range: &RangeInclusive<f64>,
    problem: &str,
) -> Result<Option<f64>, IniError> {
    let ini = Ini::read(file)?;
    match ini.number(SECTION, key)? {
        Some(value) if !range.contains(&value) => Err(ini.bad_value(SECTION, key, problem)),
        value => Ok(value),
    }
}
