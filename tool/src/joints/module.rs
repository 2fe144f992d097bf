//! Joints behind a kinematics module of LinuxCNC's, or one of a user's own, as the planner asks them here.

use crate::loaded::kinematics::{KinematicsError, KinematicsSettings, LoadedKinematics};
use crate::machine::ini::Ini;
use crate::machine::limits::is_rotary;
use crate::path::Position;
use crate::wiring::blendtp::LIMITED_JOINTS;
use crate::wiring::installed::LinuxCnc;
use crate::wiring::joints::JointSettings;
use framepath::abi::planner::joint_kinematics::{JointKinematics, Measured};
use framepath::abi::planner::joint_limits::{self, FRAMEPATH_MOST_MICROSECONDS};
use framepath::abi::planner::kinematics_module::KinematicsModule;
use framepath::axes::{Axes, AxisLimits};
use framepath::kinematics::ToolAxes;
use framepath::kinematics::inner_tool::tool_turning;
use framepath::machine::JOINT_COUNT;
use framepath::machine_map::JointMap;
use framepath::planner::range::JointSolver;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What the joints of a machine are, with everything that another process needs to ask for them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct ModuleSettings {
    kinematics: KinematicsSettings,
    /// Joints that turn; the others have units of length.
    angular: [bool; LIMITED_JOINTS],
    /// In lengths of which a machine unit has so many.
    lengths: f64,
    /// Its pins to which HAL hands the length of the tool in force.
    tool_pins: Vec<String>,
}

/// The joints, with the module loaded.
#[derive(Clone, Debug)]
pub(super) struct ModuleJoints {
    settings: ModuleSettings,
    loaded: LoadedKinematics,
    /// As blendtp asks them.
    asked: Arc<JointKinematics>,
    /// What that is like; `None` if there are no joints for where the machine begins.
    measured: Option<Measured>,
    /// Where the machine begins, in lengths of the settings.
    home: Axes,
}

impl PartialEq for ModuleJoints {
    fn eq(&self, other: &ModuleJoints) -> bool {
        self.settings == other.settings
    }
}

/// Why blendtp refuses every move with such kinematics.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum KinematicsRefused {
    /// There are more than can have limits.
    #[error("joints 0 to 8 can have limits, but there are {0}")]
    TooMany(usize),
    /// They have no joints for where the machine begins.
    #[error("it does not say where the joints are with the machine at [JOINT_n]HOME")]
    Unknown,
    /// They take too long, microseconds.
    #[error(
        "it takes {0:.1} us for the joints of a place, {FRAMEPATH_MOST_MICROSECONDS} us at most; set all blendtp.joint.* to 0, \
         and the axes keep their limits instead"
    )]
    Slow(f64),
    /// Their answers for a joint are off by so much.
    #[error(
        "what it says of joint {0} is off by {1:.1e}; set all blendtp.joint.* to 0, and the axes keep their limits instead"
    )]
    Rough(usize, f64),
    /// The machine begins at a singular place.
    #[error(
        "the machine stands at a singular place with its joints at [JOINT_n]HOME: jog a joint away from there, plan with \
         another HOME, or set all blendtp.joint.* to 0"
    )]
    Singular,
}

/// The file of a module, in the LinuxCNC that is installed or was built beside this command.
fn module_file(name: &str) -> PathBuf {
    let installed = LinuxCnc::in_path().map(|linuxcnc| linuxcnc.module(name));
    let built = || Path::new(env!("LINUXCNC_MODULES")).join(format!("{name}.so"));
    installed.filter(|file| file.exists()).unwrap_or_else(built)
}

/// What INI and HAL files say of the kinematics.
fn settings(settings: &JointSettings, ini: &Ini) -> KinematicsSettings {
    let count = ini.text("KINS", "JOINTS");
    let joints = count
        .and_then(|text| text.trim().parse().ok())
        .unwrap_or(LIMITED_JOINTS);
    let home = |joint: usize| {
        let home = ini.number(&format!("JOINT_{joint}"), "HOME");
        home.ok().flatten().unwrap_or(0.0)
    };
    KinematicsSettings {
        file: module_file(&settings.kinematics),
        name: settings.kinematics.clone(),
        parameters: settings.kinematics_parameters(),
        pins: settings.pins(),
        joints,
        kind: settings.kinematics_type.unwrap_or(0),
        home: (0..joints.min(JOINT_COUNT)).map(home).collect(),
    }
}

/// The axis, 3 for A or 4 for B, that tilts the tool while C turns it, as framekins finds it out of the module behind it.
pub(super) fn tool_tilt_axis(joints: &JointSettings, ini: &Ini) -> Option<usize> {
    let mut loaded = LoadedKinematics::load(&settings(joints, ini)).ok()?;
    let (place, axes) = *loaded.home();
    let said = ToolAxes::from_text(joints.tool_axes.as_bytes())?;
    let chain = tool_turning(&mut loaded, &axes, &place, &said)
        .ok()?
        .chain?;
    chain.tilt_axis_below_c()
}

/// Where the machine stands with its joints at `[JOINT_n]HOME`, as its kinematics module says, machine units.
///
/// # Errors
/// Why it cannot be asked here.
pub(crate) fn position_at_home(joints: &JointSettings, ini: &Ini) -> Result<Axes, KinematicsError> {
    Ok(LoadedKinematics::load(&settings(joints, ini))?.home().1)
}

impl ModuleJoints {
    /// # Errors
    /// A module that cannot be asked here.
    pub(super) fn load(
        joints: &JointSettings,
        ini: &Ini,
        lengths: f64,
    ) -> Result<ModuleJoints, KinematicsError> {
        let angular = |joint: usize| {
            let kind = ini.text(&format!("JOINT_{joint}"), "TYPE").unwrap_or("");
            kind.eq_ignore_ascii_case("ANGULAR")
        };
        ModuleJoints::new(ModuleSettings {
            kinematics: settings(joints, ini),
            angular: std::array::from_fn(angular),
            lengths,
            tool_pins: joints
                .tool_length_pins()
                .into_iter()
                .filter(|pin| pin.split('.').next() == Some(joints.kinematics.as_str()))
                .collect(),
        })
    }

    /// # Errors
    /// A module that cannot be asked here.
    pub(super) fn new(settings: ModuleSettings) -> Result<ModuleJoints, KinematicsError> {
        let loaded = LoadedKinematics::load(&settings.kinematics)?;
        let mut asked = loaded.as_asked();
        let (joints, position) = loaded.home();
        let measured = asked.measure(position, joints, settings.kinematics.joints);
        let lengths = settings.lengths;
        Ok(ModuleJoints {
            asked: Arc::new(asked),
            measured,
            home: in_lengths(position, lengths),
            settings,
            loaded,
        })
    }

    /// What another process makes the same of.
    pub(super) fn into_settings(self) -> ModuleSettings {
        self.settings
    }

    /// Whether the joints are the axes.
    pub(super) fn is_trivial(&self) -> bool {
        self.loaded.is_trivial()
    }

    /// Of the module.
    pub(super) fn name(&self) -> &str {
        &self.settings.kinematics.name
    }

    pub(super) fn count(&self) -> usize {
        self.settings.kinematics.joints
    }

    /// See [`super::LimitedJoints::set_tool_length`].
    pub(super) fn set_tool_length(&self, length: f64) -> bool {
        for pin in &self.settings.tool_pins {
            self.loaded.put(pin, length / self.settings.lengths);
        }
        !self.settings.tool_pins.is_empty()
    }

    pub(super) fn home(&self) -> &Axes {
        &self.home
    }

    /// See [`super::LimitedJoints::on_the_way`].
    pub(super) fn on_the_way(&self) -> (KinematicsModule, [f64; JOINT_COUNT]) {
        let mut module = self.loaded.as_module();
        module.count = self.count();
        let (joints, position) = self.loaded.home();
        // The arm that the machine has there is kept from then on.
        module.begin(position, joints);
        (module, *joints)
    }

    pub(super) fn is_angular(&self, joint: usize) -> bool {
        self.settings.angular.get(joint).copied().unwrap_or(false)
    }

    /// What a machine unit of a joint, or a degree, is here; `None` if there is no such joint.
    pub(super) fn unit(&self, joint: usize) -> Option<f64> {
        let is_angular = self.is_angular(joint);
        let unit = if is_angular {
            1.0
        } else {
            self.settings.lengths
        };
        (joint < self.count()).then_some(unit)
    }

    /// Whether blendtp keeps limits, shape (3, 9), behind them.
    ///
    /// # Errors
    /// What it says where it does not.
    pub(super) fn check(&self, limits: &[Position; 3]) -> Result<(), KinematicsRefused> {
        let count = self.count();
        if count > LIMITED_JOINTS {
            return Err(KinematicsRefused::TooMany(count));
        }
        let of_machine = |order: usize| {
            Axes::from_fn(|joint, _| limits[order][joint] / self.unit(joint).unwrap_or(1.0))
        };
        let limits = AxisLimits {
            velocity: of_machine(0),
            acceleration: of_machine(1),
            jerk: of_machine(2),
        };
        let measured = self.measured.ok_or(KinematicsRefused::Unknown)?;
        let fastest = limits.velocity.iter().copied().filter(|v| v.is_finite());
        let fastest = fastest.fold(0.0, f64::max);
        joint_limits::check(&measured, &limits, count, fastest).map_err(|refused| match refused
            .code
        {
            joint_limits::FRAMEPATH_JOINTS_SLOW => KinematicsRefused::Slow(refused.value),
            _ => KinematicsRefused::Rough(refused.joint, refused.value),
        })?;
        let map = JointMap::new(|_, derivatives, _| *derivatives, &limits, 0.0);
        let (_, position) = self.loaded.home();
        if self.asked.is_singular(position, map.shares()) {
            return Err(KinematicsRefused::Singular);
        }
        Ok(())
    }

    /// The joints for a position; `None` where there are none.
    pub(super) fn joints(&self, position: &Axes) -> Option<[f64; JOINT_COUNT]> {
        // The planner asks several times in a servo period, and what that takes is measured with it.
        if self.settings.lengths == 1.0 {
            return self.loaded.joints(position, &self.loaded.home().0);
        }
        let position = in_lengths(position, 1.0 / self.settings.lengths);
        let mut joints = self.loaded.joints(&position, &self.loaded.home().0)?;
        for (number, joint) in joints.iter_mut().enumerate() {
            *joint *= self.unit(number).unwrap_or(1.0);
        }
        Some(joints)
    }

    /// See [`super::LimitedJoints::position`].
    pub(super) fn position(&self, joints: &[f64; JOINT_COUNT], near: &Axes) -> Axes {
        let own = std::array::from_fn(|joint| joints[joint] / self.unit(joint).unwrap_or(1.0));
        let near = in_lengths(near, 1.0 / self.settings.lengths);
        let position = self.loaded.position(&own, &near);
        let position = position.unwrap_or(Axes::repeat(f64::NAN));
        in_lengths(&position, self.settings.lengths)
    }

    /// See [`super::LimitedJoints::derivatives`].
    pub(super) fn derivatives(
        &self,
        position: &Axes,
        derivatives: &[Axes; 3],
        shares: &[Axes; 3],
    ) -> [Axes; 3] {
        let to_machine = 1.0 / self.settings.lengths;
        let units = Axes::from_fn(|joint, _| self.unit(joint).unwrap_or(1.0));
        let found = self.asked.by_numbers(
            &in_lengths(position, to_machine),
            &derivatives
                .each_ref()
                .map(|axes| in_lengths(axes, to_machine)),
            &shares.map(|share| share.component_mul(&units)),
        );
        found.map(|joints| joints.component_mul(&units))
    }
}

/// A position, or a derivative of it, in lengths of which one of its own has so many.
fn in_lengths(axes: &Axes, lengths: f64) -> Axes {
    Axes::from_fn(|axis, _| axes[axis] * if is_rotary(axis) { 1.0 } else { lengths })
}
