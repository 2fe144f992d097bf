//! The limits of joints that HAL files set for blendtp, and the kinematics behind which these are.

use super::blendtp::{JOINT_LIMITS, LIMITED_JOINTS, jerk_pin};
use super::subject::parameter;
use crate::hal::{self, State, read_script};
use crate::machine::ini::Ini;
use crate::machine::place::Place;

/// What the HAL files of a machine leave behind for its joints.
pub struct JointSettings {
    /// Velocity, acceleration and jerk of joints 0 to 8, machine units, 0 where nothing sets one.
    pub limits: [[f64; LIMITED_JOINTS]; 3],
    /// `[KINS]KINEMATICS`, or what `inner=` names.
    pub kinematics: String,
    /// `machine=` of framekins.
    pub machine: String,
    /// `coordinates=`.
    pub coordinates: String,
    /// Whether X Y Z are the tool centre point although no pin says so: programs turn it on.
    pub turned_on: bool,
    /// The type that programs switch the kinematics to before they move, 0 if none is given.
    pub kinematics_type: Option<i32>,
    /// Whether the kinematics are behind framekins: `inner=`.
    pub is_behind_framekins: bool,
    /// `tool_axes=` of framekins.
    pub tool_axes: String,
    /// The words behind the name of the module in `[KINS]KINEMATICS`.
    in_ini: String,
    state: State,
}

impl JointSettings {
    /// As the HAL files leave it.
    pub fn read(ini: &Ini) -> JointSettings {
        let state = State::run(&read_script(ini, &[]).statements);
        let limits = std::array::from_fn(|kind| {
            std::array::from_fn(|joint| number(&state, &JOINT_LIMITS[kind].pin(joint)))
        });
        let words = ini.text("KINS", "KINEMATICS").unwrap_or("");
        let framekins = state.module("framekins");
        let of_framekins = |name: &str| framekins.and_then(|module| module.parameter(name));
        let given = |name: &str| of_framekins(name).or(parameter(words, name)).unwrap_or("");
        let named = words.split_whitespace().next().unwrap_or("");
        let kinematics = match given("inner") {
            "" => named,
            inner => inner,
        };
        JointSettings {
            limits,
            kinematics: kinematics.to_owned(),
            machine: given("machine").to_owned(),
            coordinates: given("coordinates").to_owned(),
            turned_on: false,
            kinematics_type: None,
            is_behind_framekins: !given("inner").is_empty(),
            tool_axes: given("tool_axes").to_owned(),
            in_ini: words.to_owned(),
            state,
        }
    }

    /// Whether blendtp looks at limits of joints: it does at none where the joints are the axes.
    pub fn is_limited(&self) -> bool {
        let limited = self.limits.iter().flatten().any(|limit| *limit != 0.0);
        limited && !self.is_trivial()
    }

    /// Whether the joints are the axes.
    pub fn is_trivial(&self) -> bool {
        match self.kinematics.as_str() {
            "trivkins" => true,
            "framekins" => ["", "identity"].contains(&self.machine.as_str()),
            _ => false,
        }
    }

    /// Whether X Y Z are the tool centre point.
    pub fn tool_centre_point(&self) -> bool {
        self.turned_on || self.framekins("tool-centre-point") != 0.0
    }

    /// What the module of the kinematics is loaded with.
    pub fn kinematics_parameters(&self) -> Vec<(String, String)> {
        if let Some(module) = self.state.module(&self.kinematics) {
            return module.parameters.clone();
        }
        let words = self.in_ini.split_whitespace().skip(1);
        let parameters = words.filter_map(|word| word.split_once('='));
        parameters
            .map(|(name, value)| (name.to_owned(), value.to_owned()))
            .collect()
    }

    /// The analog output of motion that switches the kinematics to another type.
    pub fn switch_output(&self) -> Option<u32> {
        let switches = ["framekins.inner-type", "motion.switchkins-type"];
        let mut beside = switches.iter().flat_map(|pin| self.state.beside(pin));
        beside.find_map(|(pin, _)| pin.strip_prefix("motion.analog-out-")?.parse().ok())
    }

    /// The pins to which the length of the tool goes.
    pub fn tool_length_pins(&self) -> Vec<String> {
        let beside = self.state.beside("motion.tooloffset.z");
        beside.map(|(pin, _)| pin.clone()).collect()
    }

    /// What HAL files set pins to.
    pub fn pins(&self) -> Vec<(String, f64)> {
        let names = self.state.settings.keys();
        names
            .map(|name| (name.clone(), number(&self.state, name)))
            .collect()
    }

    /// The jerk that HAL files set for an axis, machine units (degrees) and seconds, 0 or infinite where it is not limited, and
    /// where they do.
    pub fn jerk_of_axis(&self, letter: char) -> Option<(f64, &Place)> {
        let setting = self.state.settings.get(&jerk_pin(letter))?;
        Some((hal::number(&setting.value)?, &setting.statement.place))
    }

    /// What a pin of framekins is set to, 0 where nothing sets it.
    pub fn framekins(&self, pin: &str) -> f64 {
        number(&self.state, &format!("framekins.{pin}"))
    }
}

/// What a pin is set to, 0 where nothing sets it.
fn number(state: &State, pin: &str) -> f64 {
    let value = state.settings.get(pin).map_or("", |setting| &setting.value);
    match value.to_ascii_lowercase().as_str() {
        "true" => 1.0,
        text => hal::number(text).unwrap_or(0.0),
    }
}
