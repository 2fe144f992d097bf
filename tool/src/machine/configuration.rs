//! What the INI file says about the machine: servo period, joints, axes and their limits.

use serde::Serialize;

use super::angles;
use super::coordinates::Coordinates;
use super::error::IniError;
use super::ini::Ini;
use super::lathe::is_lathe;
use super::length_unit;

/// Letters of LinuxCNC's axes, in its order.
pub const AXIS_LETTERS: &str = "XYZABCUVW";

/// MemberLimits of a joint or an axis, machine units or degrees, and seconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MemberLimits {
    /// Units per second, above 0.
    pub velocity: f64,
    /// Units per second squared, above 0.
    pub acceleration: f64,
    /// Units per second cubed, above 0; `None`: not limited.
    pub jerk: Option<f64>,
}

/// A joint, or an axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Member {
    /// `joint.0` or `axis.x`: the name of the column in the recording.
    pub name: String,
    /// The letter of the axis that this is, or that this joint moves.
    pub letter: char,
    /// `mm`, `in` or `deg`.
    pub unit: &'static str,
    /// Its limits.
    pub limits: MemberLimits,
    /// Which of them the file does not give, and what LinuxCNC takes instead: for the user to be told.
    #[serde(skip)]
    pub assumed: Vec<String>,
}

impl Member {
    fn is_rotary(&self) -> bool {
        is_rotary(self.letter)
    }
}

/// Whose positions describe the path of the tool in machine coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PathSource {
    /// The joints are X, Y and Z of the machine, whatever frame is programmed.
    Joints,
    /// Other kinematics: the planner's axes are all there is.
    Axes,
}

/// The machine as far as a report needs it.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// `[EMC]MACHINE`, empty if it has no name.
    pub name: String,
    /// Seconds, above 0.
    pub servo_period: f64,
    /// `mm` or `in`.
    pub length_unit: &'static str,
    /// In the order of their numbers.
    pub joints: Vec<Member>,
    /// In the order of [`AXIS_LETTERS`].
    pub axes: Vec<Member>,
    /// Whose positions are compared with the programmed path.
    pub path_source: PathSource,
    /// Whether it is a lathe with X and Z, whose X is a radius.
    pub is_lathe: bool,
}

impl Machine {
    /// Length of a machine unit, mm.
    #[cfg(feature = "linuxcnc")]
    pub fn millimetres(&self) -> f64 {
        match self.length_unit {
            "in" => length_unit::INCH,
            _ => 1.0,
        }
    }

    /// Takes the machine from its INI file.
    ///
    /// # Errors
    /// Missing or unusable sections, keys and limits, with the remedy.
    pub fn from_ini(ini: &Ini) -> Result<Machine, IniError> {
        let period = ini.required_positive(
            "EMCMOT",
            "SERVO_PERIOD",
            "write the servo period in nanoseconds, for example SERVO_PERIOD = 1000000",
        )?;
        if !(1e4..=1e8).contains(&period) {
            return Err(ini.bad_value(
                "EMCMOT",
                "SERVO_PERIOD",
                "the servo period is in nanoseconds, 10000 to 100000000",
            ));
        }
        let length_unit = length_unit::needed(ini)?;
        angles::need_degrees(ini)?;
        let coordinates = Coordinates::from_ini(ini)?;
        let mut joints = Vec::with_capacity(coordinates.joints.len());
        for (number, letter) in coordinates.joints.iter().copied().enumerate() {
            joints.push(joint(ini, number, letter, length_unit)?);
        }
        let mut axes = Vec::new();
        for letter in AXIS_LETTERS
            .chars()
            .filter(|l| coordinates.axes.contains(l))
        {
            let section = format!("AXIS_{letter}");
            let unit = unit_of(letter, length_unit);
            let (limits, mut assumed) = limits(ini, &section, unit, None)?;
            let is_first_rotary = is_rotary(letter) && !axes.iter().any(Member::is_rotary);
            assumed.extend(is_first_rotary.then(|| angles::assumed(ini)).flatten());
            axes.push(Member {
                name: format!("axis.{}", letter.to_ascii_lowercase()),
                letter,
                unit,
                limits,
                assumed,
            });
        }
        let path_source = if coordinates.are_joints {
            PathSource::Joints
        } else {
            PathSource::Axes
        };
        Ok(Machine {
            name: ini.text("EMC", "MACHINE").unwrap_or_default().to_owned(),
            servo_period: period * 1e-9,
            length_unit,
            joints,
            axes,
            path_source,
            is_lathe: is_lathe(ini)
                && ['X', 'Z']
                    .iter()
                    .all(|axis| coordinates.axes.contains(axis)),
        })
    }
}

/// The axes that turn.
pub(crate) fn is_rotary(letter: char) -> bool {
    matches!(letter, 'A' | 'B' | 'C')
}

/// The unit of an axis: degrees, or that of lengths.
pub(crate) fn unit_of(letter: char, length_unit: &'static str) -> &'static str {
    if is_rotary(letter) {
        "deg"
    } else {
        length_unit
    }
}

fn joint(
    ini: &Ini,
    number: usize,
    letter: char,
    length_unit: &'static str,
) -> Result<Member, IniError> {
    let section = format!("JOINT_{number}");
    let unit = match ini.text(&section, "TYPE") {
        Some("ANGULAR") => "deg",
        Some("LINEAR") => length_unit,
        None => unit_of(letter, length_unit),
        Some(_) => return Err(ini.bad_value(&section, "TYPE", "LINEAR or ANGULAR")),
    };
    // A joint that moves an axis one to one shares the jerk limit of the axis.
    let axis_jerk = ini.optional_limit(&format!("AXIS_{letter}"), "MAX_JERK")?;
    let (limits, assumed) = limits(ini, &section, unit, axis_jerk)?;
    Ok(Member {
        name: format!("joint.{number}"),
        letter,
        unit,
        limits,
        assumed,
    })
}

/// What LinuxCNC takes for a velocity or acceleration of an axis or a joint that the INI file does not give.
pub(crate) const DEFAULT_LIMIT: f64 = 1.0;

/// Stands for a velocity or acceleration that is infinite, which LinuxCNC takes as well: no machine reaches it.
pub const UNLIMITED: f64 = 1e9;

/// The limits of an axis or a joint, and what is said of those that are missing.
fn limits(
    ini: &Ini,
    section: &str,
    unit: &str,
    other_jerk: Option<f64>,
) -> Result<(MemberLimits, Vec<String>), IniError> {
    let mut assumed = Vec::new();
    let mut limit = |key: &str, seconds: &str, example: &str| match ini.text(section, key) {
        Some(_) => ini.required_positive(section, key, ""),
        None => {
            let unit = format!("{unit}/{seconds}");
            assumed.push(taken_instead(ini, section, key, &unit, example));
            Ok(DEFAULT_LIMIT)
        }
    };
    let limits = MemberLimits {
        velocity: limit("MAX_VELOCITY", "s", "100")?.min(UNLIMITED),
        acceleration: limit("MAX_ACCELERATION", "s2", "1000")?.min(UNLIMITED),
        jerk: ini.optional_limit(section, "MAX_JERK")?.or(other_jerk),
    };
    Ok((limits, assumed))
}

/// What is said of a velocity or an acceleration that is missing, which LinuxCNC has all the same.
pub(crate) fn taken_instead(
    ini: &Ini,
    section: &str,
    key: &str,
    unit: &str,
    example: &str,
) -> String {
    let remedy = format!(
        "LinuxCNC takes {DEFAULT_LIMIT} {unit} then, and so does this: write for example {key} = {example}"
    );
    ini.missing(section, key, &remedy).to_string()
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use std::path::Path;

    /// A three-axis mill: 100 mm/s, 1000 mm/s2, 20000 mm/s3, 1 ms.
    pub const MILL: &str = "\
[EMC]
MACHINE = Test mill
[EMCMOT]
SERVO_PERIOD = 1000000
[TRAJ]
LINEAR_UNITS = mm
[KINS]
KINEMATICS = framekins coordinates=XYZ
[AXIS_X]
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
MAX_JERK = 20000
[AXIS_Y]
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
MAX_JERK = 20000
[AXIS_Z]
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
MAX_JERK = 20000
[JOINT_0]
TYPE = LINEAR
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
[JOINT_1]
TYPE = LINEAR
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
MAX_JERK = 15000
[JOINT_2]
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
";

    /// The machine of an INI text.
    pub fn machine(text: &str) -> Result<Machine, IniError> {
        Machine::from_ini(&Ini::parse(Path::new("mill.ini"), text)?)
    }

    #[test]
    fn limits_units_and_letters_come_from_the_file() {
        let mill = machine(MILL).expect("a valid machine");
        assert_eq!(mill.servo_period, 0.001);
        assert_eq!(mill.path_source, PathSource::Joints);
        assert_eq!(mill.joints.len(), 3);
        assert_eq!(mill.joints[0].limits.jerk, Some(20000.0));
        assert_eq!(mill.joints[1].limits.jerk, Some(15000.0));
        assert_eq!(mill.axes[2].name, "axis.z");
    }

    #[test]
    fn gantries_and_rotary_joints_are_understood() {
        let text = MILL.replace("coordinates=XYZ", "coordinates=xyy");
        let gantry = machine(&text).expect("a valid machine");
        let letters: String = gantry.joints.iter().map(|joint| joint.letter).collect();
        assert_eq!((letters.as_str(), gantry.axes.len()), ("XYY", 2));

        let text = MILL
            .replace("coordinates=XYZ", "coordinates=XYC")
            .replace("AXIS_Z", "AXIS_C");
        let rotary = machine(&text).expect("a valid machine");
        assert_eq!((rotary.joints[2].unit, rotary.axes[2].unit), ("deg", "deg"));
    }

    #[test]
    fn other_kinematics_have_the_axes_that_linuxcnc_gives_them() {
        let table = MILL
            .replace(
                "framekins coordinates=XYZ",
                "xyzac-trt-kins sparm=identityfirst",
            )
            .replace("[TRAJ]", "[TRAJ]\nCOORDINATES = X Y c")
            .replace("AXIS_Z", "AXIS_C");
        let letters = |members: &[Member]| members.iter().map(|m| m.letter).collect::<String>();
        let machine_of = |text: &str| machine(text).expect("a valid machine");
        let found = machine_of(&table);
        assert_eq!(
            (letters(&found.axes), letters(&found.joints)),
            ("XYC".into(), "XYC".into())
        );
        assert_eq!(
            (found.joints[2].unit, found.path_source),
            ("deg", PathSource::Axes)
        );
        // as many joints as it likes, and sections of more
        let fewer = table
            .replace("= X Y c", "= XC")
            .replace("[KINS]", "[KINS]\nJOINTS = 2");
        assert_eq!(letters(&machine_of(&fewer).joints), "XC");
        let wrong = machine(&fewer.replace("JOINTS = 2", "JOINTS = two")).expect_err("an error");
        assert!(wrong.to_string().contains("[KINS]JOINTS"), "{wrong}");
        let found = machine_of(&table.replace("= X Y c", "= XC"));
        assert_eq!(
            (letters(&found.axes), letters(&found.joints)),
            ("XC".into(), "XYZ".into())
        );
        let wrong = machine(&table.replace("= X Y c", "= XQ")).expect_err("an error");
        assert!(wrong.to_string().contains("[TRAJ]COORDINATES"), "{wrong}");
    }

    #[test]
    fn the_axes_are_those_that_motion_has_of_the_kinematics() {
        let letters = |members: &[Member]| members.iter().map(|m| m.letter).collect::<String>();
        for (kinematics, coordinates, axes, joints) in [
            ("trivkins", "X Z", "XZ", "XYZ"),
            ("trivkins coordinates=XZ", "Z, X", "XZ", "XZ"),
            ("framekins coordinates=XYYZ", "XYZ", "XYZ", "XYYZ"),
        ] {
            let text = MILL
                .replace("framekins coordinates=XYZ", kinematics)
                .replace("[TRAJ]", &format!("[TRAJ]\nCOORDINATES = {coordinates}"));
            let found = machine(&text).expect("a valid machine");
            assert_eq!(
                (&*letters(&found.axes), &*letters(&found.joints)),
                (axes, joints),
                "{kinematics}"
            );
        }
    }

    #[test]
    fn what_is_missing_or_wrong_is_named_with_the_remedy() {
        let message = |from: &str, to: &str| {
            let changed = MILL.replacen(from, to, 1);
            assert_ne!(changed, MILL, "the change took place");
            machine(&changed).expect_err("an error").to_string()
        };
        assert_eq!(
            message("SERVO_PERIOD = 1000000", ""),
            "mill.ini: [EMCMOT]SERVO_PERIOD is missing: write the servo period in nanoseconds, \
             for example SERVO_PERIOD = 1000000"
        );
        for period in ["0.001", "1000"] {
            let period = format!("SERVO_PERIOD = {period}");
            assert!(message("SERVO_PERIOD = 1000000", &period).contains("nanoseconds"));
        }
        assert!(message("LINEAR_UNITS = mm", "LINEAR_UNITS = furlong").contains("mm or inch"));
        assert!(message("[KINS]", "[KINEMA]").starts_with("mill.ini: [KINS]KINEMATICS"));
        assert!(message("coordinates=XYZ", "coordinates=XYQ").contains("XYZABCUVW"));
        assert!(message("LINEAR_UNITS = mm", "LINEAR_UNITS = 2.0").contains("mm or inch"));
        assert!(message("MAX_VELOCITY = 100", "MAX_VELOCITY = 0").contains("above 0"));
        assert!(message("TYPE = LINEAR", "TYPE = LINEA").contains("LINEAR or ANGULAR"));
    }

    #[test]
    fn a_unit_of_angles_that_is_missing_is_told_once_where_something_turns() {
        let assumed = |text: &str| {
            let axes = machine(text).expect("a valid machine").axes;
            Vec::from_iter(axes.into_iter().flat_map(|axis| axis.assumed))
        };
        let tables = MILL
            .replace("coordinates=XYZ", "coordinates=XAC")
            .replace("AXIS_Y", "AXIS_A")
            .replace("AXIS_Z", "AXIS_C");
        assert_eq!(
            assumed(&tables),
            [
                "mill.ini: [TRAJ]ANGULAR_UNITS is missing: LinuxCNC does not start without it, and degrees are taken \
                 here: write ANGULAR_UNITS = degree"
            ]
        );
        let named = tables.replace("[TRAJ]", "[TRAJ]\nANGULAR_UNITS = degree");
        assert_eq!(assumed(&named), [""; 0]);
        assert_eq!(assumed(MILL), [""; 0], "nothing turns");
    }

    #[test]
    fn limits_that_are_missing_are_those_that_linuxcnc_takes_and_told() {
        let assumed = |machine: &Machine| {
            let members = machine.joints.iter().chain(&machine.axes);
            members
                .flat_map(|member| member.assumed.clone())
                .collect::<Vec<_>>()
        };
        assert_eq!(
            assumed(&machine(MILL).expect("a valid machine")),
            [""; 0],
            "nothing is missing"
        );
        let text = MILL.replace("[AXIS_Y]", "[AXIS_J]").replace(
            "[JOINT_2]\nMAX_VELOCITY = 100",
            "[JOINT_2]\nMAXIMAL_VELOCITY = 100",
        );
        let found = machine(&text).expect("a valid machine");
        let [y, joint] = [&found.axes[1].limits, &found.joints[2].limits];
        assert_eq!(
            (y.velocity, y.acceleration, joint.velocity),
            (1.0, 1.0, 1.0)
        );
        assert_eq!(
            assumed(&found),
            [
                "mill.ini: [JOINT_2]MAX_VELOCITY is missing: LinuxCNC takes 1 mm/s then, and so does this: write for \
                 example MAX_VELOCITY = 100",
                "mill.ini: [AXIS_Y]MAX_VELOCITY is missing: LinuxCNC takes 1 mm/s then, and so does this: write for \
                 example MAX_VELOCITY = 100",
                "mill.ini: [AXIS_Y]MAX_ACCELERATION is missing: LinuxCNC takes 1 mm/s2 then, and so does this: write \
                 for example MAX_ACCELERATION = 1000",
            ]
        );
    }
}
