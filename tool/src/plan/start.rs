//! Where the machine begins: with its joints at home.

use crate::joints::{is_table, position_at_home};
use crate::machine::IniError;
use crate::machine::configuration::{AXIS_LETTERS, Machine};
use crate::machine::ini::Ini;
use crate::machine::limits::is_rotary;
use crate::path::Position;
use crate::wiring::joints::JointSettings;

/// Where `[JOINT_n]HOME` leads, mm and degrees. Where the kinematics cannot be asked, the numbers themselves, with a word in
/// `assumed`.
///
/// # Errors
/// A home that is no number.
pub fn at_home(
    ini: &Ini,
    machine: &Machine,
    settings: &JointSettings,
    assumed: &mut Vec<String>,
) -> Result<Position, IniError> {
    let unit = |axis: usize| {
        if is_rotary(axis) {
            1.0
        } else {
            machine.millimetres()
        }
    };
    if !settings.is_trivial() && !is_table(settings) {
        match position_at_home(settings, ini) {
            Ok(position) => return Ok(std::array::from_fn(|axis| position[axis] * unit(axis))),
            Err(why) => assumed.push(format!(
                "{}: [KINS]KINEMATICS: where the machine is with its joints at [JOINT_n]HOME is not known, since {} cannot be \
                 asked here ({why}): the plan begins with these numbers as X, Y, Z",
                ini.file().display(),
                settings.kinematics
            )),
        }
    }
    let mut start = [0.0; 9];
    for (number, joint) in machine.joints.iter().enumerate() {
        if let Some(axis) = AXIS_LETTERS.find(joint.letter) {
            let home = ini.number(&format!("JOINT_{number}"), "HOME")?;
            start[axis] = home.unwrap_or(0.0) * unit(axis);
        }
    }
    Ok(start)
}
