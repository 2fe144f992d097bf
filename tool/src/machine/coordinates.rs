//! The letters of joints and axes: from `[KINS]KINEMATICS`, `[KINS]JOINTS` and `[TRAJ]COORDINATES`.

use super::configuration::AXIS_LETTERS;
use super::error::IniError;
use super::ini::Ini;
use super::numbers;

/// The letters of joints and axes.
pub(super) struct Coordinates {
    /// The axis that each joint moves, or the one whose unit it most likely has.
    pub joints: Vec<char>,
    /// The axes, in any order.
    pub axes: Vec<char>,
    /// Whether the first joints are X, Y and Z of the machine.
    pub are_joints: bool,
}

impl Coordinates {
    /// `coordinates=` of `[KINS]KINEMATICS` for joints and axes; without it all of [`AXIS_LETTERS`] as far as there
    /// are joints, like trivkins. The axes are those of `[TRAJ]COORDINATES`, as LinuxCNC has them; where it names none, those
    /// of the joints.
    pub fn from_ini(ini: &Ini) -> Result<Self, IniError> {
        let text = ini.required_text(
            "KINS",
            "KINEMATICS",
            "write for example KINEMATICS = framekins coordinates=XYZ",
        )?;
        let mut words = text.split_whitespace();
        let are_joints = matches!(words.next(), Some("trivkins" | "framekins"));
        let remedy = "coordinates= takes letters out of XYZABCUVW, one for each joint";
        let named = match words.find_map(|word| word.strip_prefix("coordinates=")) {
            Some(text) => {
                Some(letters(text).ok_or_else(|| ini.bad_value("KINS", "KINEMATICS", remedy))?)
            }
            None => None,
        };
        let count = joints_of(ini)?;
        let in_order = AXIS_LETTERS.chars().take(count).collect::<Vec<_>>();
        let (joints, axes) = match (named, ini.text("TRAJ", "COORDINATES")) {
            (Some(named), text) => (named.clone(), axes_of_motion(text).unwrap_or(named)),
            (None, Some(text)) if !are_joints => {
                let remedy = "write the letters of the axes out of XYZABCUVW, for example XYZAC";
                let axes =
                    letters(text).ok_or_else(|| ini.bad_value("TRAJ", "COORDINATES", remedy))?;
                let joints = if axes.len() == count {
                    axes.clone()
                } else {
                    in_order
                };
                (joints, axes)
            }
            (None, text) => (in_order.clone(), axes_of_motion(text).unwrap_or(in_order)),
        };
        if joints.is_empty() {
            return Err(ini.missing(
                "JOINT_0",
                "MAX_VELOCITY",
                "the file describes no joint; add a section [JOINT_n] for each",
            ));
        }
        Ok(Self {
            joints,
            axes,
            are_joints,
        })
    }
}

/// The axes of `[TRAJ]COORDINATES`: LinuxCNC looks for their letters, and passes over what is between them. `None` if there
/// are none.
fn axes_of_motion(coordinates: Option<&str>) -> Option<Vec<char>> {
    let text = coordinates?.to_ascii_uppercase();
    let axes: Vec<char> = AXIS_LETTERS.chars().filter(|l| text.contains(*l)).collect();
    (!axes.is_empty()).then_some(axes)
}

/// `[KINS]JOINTS`, without it as many as have a section.
fn joints_of(ini: &Ini) -> Result<usize, IniError> {
    let Some(said) = ini.entry("KINS", "JOINTS") else {
        return Ok((0..AXIS_LETTERS.len())
            .take_while(|number| ini.has_section(&format!("JOINT_{number}")))
            .count());
    };
    let remedy = "write how many joints the machine has, a whole number";
    let count = numbers::number(said).filter(|count| *count >= 0.0);
    let count = count.map(|count| count as usize);
    count.ok_or_else(|| ini.bad_value("KINS", "JOINTS", remedy))
}

/// The letters of axes in a text, spaces left out; `None` if there are other ones.
fn letters(text: &str) -> Option<Vec<char>> {
    let letters = text.to_ascii_uppercase();
    letters
        .chars()
        .filter(|letter| !letter.is_whitespace())
        .map(|letter| AXIS_LETTERS.contains(letter).then_some(letter))
        .collect()
}
