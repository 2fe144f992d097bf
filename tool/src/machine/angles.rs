//! The unit of angles, `[TRAJ]ANGULAR_UNITS`: the degree. LinuxCNC would hand other units to its planner and kinematics, and take
//! limits in them; here, and in blendtp and framekins, an angle is a number of degrees.

use super::error::IniError;
use super::ini::Ini;

/// What is wrong with another one.
pub const PROBLEM: &str = "angles are in degrees here, in blendtp and in framekins";

/// What a user writes instead.
pub const REMEDY: &str =
    "ANGULAR_UNITS = degree, and all limits, speeds and places of rotary axes in degrees";

/// Whether it is the degree, as it is taken to be where nothing is said.
pub fn are_degrees(ini: &Ini) -> bool {
    let Some(text) = ini.text("TRAJ", "ANGULAR_UNITS") else {
        return true;
    };
    // LinuxCNC 2.9 also takes how many units a degree has.
    let is_one = || text.parse::<f64>().is_ok_and(|units| units == 1.0);
    text.eq_ignore_ascii_case("degree") || text.eq_ignore_ascii_case("deg") || is_one()
}

/// What is said of a machine with a rotary axis whose INI file does not name the unit; `None` where it does.
pub fn assumed(ini: &Ini) -> Option<String> {
    let remedy = "LinuxCNC does not start without it, and degrees are taken here: write ANGULAR_UNITS = degree";
    let is_missing = ini.text("TRAJ", "ANGULAR_UNITS").is_none();
    is_missing.then(|| ini.missing("TRAJ", "ANGULAR_UNITS", remedy).to_string())
}

/// Refuses another one.
///
/// # Errors
/// The unit, with the remedy.
pub fn need_degrees(ini: &Ini) -> Result<(), IniError> {
    if are_degrees(ini) {
        return Ok(());
    }
    let problem = format!("{PROBLEM}: write {REMEDY}");
    Err(ini.bad_value("TRAJ", "ANGULAR_UNITS", &problem))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn degrees_alone_are_taken() {
        let needed = |line: &str| {
            let text = format!("[TRAJ]\n{line}\n");
            need_degrees(&Ini::parse(Path::new("mill.ini"), &text).expect("a file"))
        };
        for unit in ["degree", "DEG", "1.0"] {
            needed(&format!("ANGULAR_UNITS = {unit}")).expect("degrees");
        }
        needed("LINEAR_UNITS = mm").expect("degrees");
        for unit in ["rad", "radian", "grad", "gon", "0.9", "turn"] {
            let error = needed(&format!("ANGULAR_UNITS = {unit}")).expect_err("an error");
            let named = format!("[TRAJ]ANGULAR_UNITS = {unit}: angles are in degrees here");
            assert!(error.to_string().contains(&named), "{error}");
        }
    }
}
