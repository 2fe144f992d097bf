//! Limits of axes above those of the joints that these axes are: planners look at the axes alone, and ask too much of the joints.

#[cfg(feature = "linuxcnc")]
use super::configuration::Machine;
use super::ini::Ini;
use super::numbers;
use std::fmt;

/// One of them.
#[derive(Clone, Debug, PartialEq)]
pub struct AboveJoint {
    /// The axis.
    pub letter: char,
    /// The number of its joint.
    pub joint: usize,
    /// `MAX_VELOCITY` or `MAX_ACCELERATION`.
    pub key: &'static str,
    /// Machine units or degrees, and seconds.
    pub of_axis: f64,
    /// The same.
    pub of_joint: f64,
}

impl fmt::Display for AboveJoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let AboveJoint {
            letter,
            joint,
            key,
            of_axis,
            of_joint,
        } = self;
        write!(
            f,
            "[AXIS_{letter}]{key} = {of_axis} asks more of the joint than [JOINT_{joint}]{key} = {of_joint}"
        )
    }
}

impl AboveJoint {
    /// Those of an axis and one of its joints.
    pub fn of(ini: &Ini, letter: char, joint: usize) -> Vec<AboveJoint> {
        let number = |section: String, key| {
            let number = numbers::number(ini.entry(&section, key)?);
            number.filter(|number| number.is_finite())
        };
        let keys = ["MAX_VELOCITY", "MAX_ACCELERATION"];
        let found = keys.into_iter().filter_map(|key| {
            let of_axis = number(format!("AXIS_{letter}"), key)?;
            let of_joint = number(format!("JOINT_{joint}"), key)?;
            (of_axis > of_joint).then_some(AboveJoint {
                letter,
                joint,
                key,
                of_axis,
                of_joint,
            })
        });
        found.collect()
    }

    /// Those of a machine whose joints are its axes.
    #[cfg(feature = "linuxcnc")]
    pub fn of_machine(ini: &Ini, machine: &Machine) -> Vec<AboveJoint> {
        let joints = machine.joints.iter().enumerate();
        joints
            .flat_map(|(number, joint)| AboveJoint::of(ini, joint.letter, number))
            .collect()
    }

    /// In a line for the user: where it stands, and what to write instead.
    pub fn warning(&self, ini: &Ini) -> String {
        let entry = ini.entry(&format!("AXIS_{}", self.letter), self.key);
        let place = entry.map_or_else(String::new, |entry| format!("{}: ", entry.place));
        format!("{place}{self}: write {} = {}", self.key, self.of_joint)
    }
}
