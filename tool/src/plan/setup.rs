//! The machine to plan for: an INI file, or options with stated defaults.

use super::PlanArguments;
use super::error::PlanError;
use super::soft_limits::SoftLimits;
use super::spindle::SpeedLimits;
use super::start::at_home;
use crate::canon::tool_table::{Tool, read_tool_table};
use crate::canon::{CanonError, Surroundings};
use crate::joints::{Joints, are_axes, tool_tilt_axis};
use crate::machine::above_joints::AboveJoint;
use crate::machine::configuration::{AXIS_LETTERS, Machine, UNLIMITED};
use crate::machine::ini::Ini;
use crate::machine::limits::{Jerk, Limits, infinite_for_none, is_rotary};
use crate::path::Position;
use crate::wiring::blendtp::{jerk_pin, least_jerk};
use crate::wiring::codes::missing_files;
use crate::wiring::joints::JointSettings;
use crate::wiring::user_codes::user_codes;
use framepath::axes::AXIS_COUNT;
use std::path::{Path, PathBuf};

/// The machine. Lengths are millimetres unless it says machine units.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Where the limits come from and which options have changed the plan, for the reader.
    pub origin: String,
    /// Name of the machine, empty if it has none.
    pub machine: String,
    /// The INI file.
    pub ini: Option<PathBuf>,
    /// Seconds.
    pub period: f64,
    /// `mm` or `in`.
    pub unit: &'static str,
    /// Length of a machine unit, mm.
    pub millimetres: f64,
    /// Whether it is a lathe, whose X is a radius.
    pub is_lathe: bool,
    /// Velocity and acceleration of each axis, mm (degrees) and seconds.
    pub(super) limits: Limits,
    /// Jerk of each axis, mm (degrees) per second cubed, infinite where it is not limited.
    pub jerk: [f64; AXIS_COUNT],
    /// What is known of the joints.
    pub(super) joints: Joints,
    /// Limits of axes that are above those of their joints, where the joints are the axes.
    pub(super) above_joints: Vec<AboveJoint>,
    /// Soft limits, where the joints are the axes.
    pub(super) soft_limits: Option<SoftLimits>,
    /// The axis that tilts the tool while C turns it, with the tool centre point on.
    pub(super) tool_tilt_axis: Option<usize>,
    /// Which axes the machine has.
    pub axes: [bool; AXIS_COUNT],
    /// Greatest velocity along the path, mm/s.
    pub velocity_limit: f64,
    /// What the speed of the spindle is limited to.
    pub spindle: SpeedLimits,
    /// How far rotary axes may leave the program, degrees; 0: as many as P has millimetres.
    pub rotary_tolerance: f64,
    /// Tolerance of short moves under G64 without P, mm.
    pub default_tolerance: f64,
    /// Whether corners are rounded on their inner side only.
    pub corners_inside: bool,
    /// What the interpreter finds around it.
    pub surroundings: Surroundings,
    /// Files that the INI file names and that are read with it.
    pub read: Vec<PathBuf>,
    /// The file of a remapped code that is not there: with it LinuxCNC runs no program.
    missing_file: Option<String>,
    /// What the INI file does not say, and what LinuxCNC takes instead: for the user to be told.
    pub assumed: Vec<String>,
}

impl Setup {
    /// # Errors
    /// An INI file that is missing or lacks limits, options that make no sense.
    pub fn new(arguments: &PlanArguments) -> Result<Setup, PlanError> {
        let mut setup = match &arguments.ini {
            Some(file) => from_ini(file, arguments)?,
            None => without_ini(),
        };
        let mut changed = Vec::new();
        if arguments.tool_centre_point {
            changed.push("--tool-centre-point".to_owned());
        }
        if let Some(kind) = arguments.kinematics_type {
            changed.push(format!("--kinematics-type {kind}"));
        }
        if let Some(limits) = &arguments.limits {
            setup.limits.apply(limits);
            changed.push(format!("--limits {limits}"));
        }
        if let Some(jerk) = arguments.jerk {
            setup.jerk = jerk.of_axes(&setup.limits).map(infinite_for_none);
            setup.refuse_jerk(jerk)?;
            setup.joints = setup.joints.with_jerk(jerk, 1.0 / setup.millimetres);
            changed.push(format!("--jerk {jerk}"));
        } else if setup.ini.is_none() {
            let jerk = Jerk::Accelerations(DEFAULT_JERK).of_axes(&setup.limits);
            setup.jerk = jerk.map(infinite_for_none);
        }
        if let Some(period) = arguments.period {
            setup.period = period;
            changed.push(format!("--period {period}"));
        }
        if let Some(velocity) = arguments.velocity_limit {
            setup.velocity_limit = velocity;
            changed.push(format!("--velocity-limit {velocity}"));
        }
        if let Some(feed) = arguments.feed_at_least {
            changed.push(format!("--feed-at-least {feed} (not of G95)"));
        }
        if let Some(tolerance) = arguments.rotary_tolerance {
            setup.rotary_tolerance = tolerance;
            changed.push(format!("--rotary-tolerance {tolerance}"));
        }
        if let Some(tolerance) = arguments.default_tolerance {
            setup.default_tolerance = tolerance * setup.millimetres;
            changed.push(format!("--default-tolerance {tolerance}"));
        }
        if arguments.skip_blocks {
            setup.surroundings.skip_blocks = true;
            changed.push("--skip-blocks".to_owned());
        }
        if arguments.corners_inside {
            setup.corners_inside = true;
            changed.push("--corners-inside".to_owned());
        }
        if !changed.is_empty() {
            setup.origin = format!("{}, changed by {}", setup.origin, changed.join(" "));
        }
        Ok(setup)
    }

    /// The first axis that would take too long to its acceleration, so that blendtp refuses every move of it, and the least
    /// jerk that is taken there.
    fn too_little_jerk(&self, limits: &Limits) -> Option<(usize, f64)> {
        let axes = (0..AXIS_COUNT).filter(|&axis| self.axes[axis]);
        axes.map(|axis| (axis, least_jerk_of(limits.acceleration[axis])))
            .find(|&(axis, least)| self.jerk[axis] < least)
    }

    fn refuse_jerk(&self, jerk: Jerk) -> Result<(), PlanError> {
        let Some((axis, least)) = self.too_little_jerk(&self.limits) else {
            return Ok(());
        };
        let unit = if is_rotary(axis) { "degrees" } else { "mm" };
        Err(PlanError::Option(format!(
            "--jerk {jerk}: blendtp refuses every move of {} with less than {least} {unit}/s3, a fifth of its acceleration; \
             write at least that, or unlimited",
            framepath::axes::AXIS_LETTERS[axis]
        )))
    }

    /// That the interpreter does not find the file of a remapped code it says as if it were the program.
    pub(super) fn explained(&self, error: PlanError) -> PlanError {
        let in_no_line = matches!(
            &error,
            PlanError::Program(CanonError::Refused { line: 0, .. })
        );
        match &self.missing_file {
            Some(problem) if in_no_line => PlanError::Option(problem.clone()),
            _ => error,
        }
    }

    /// What holds for the axes: velocity, acceleration, jerk, shape (3, 9), mm (degrees) and seconds. Where joints have limits of
    /// their own, axes keep their velocities alone.
    pub(super) fn bounds(&self) -> [[f64; AXIS_COUNT]; 3] {
        match self.joints.limited() {
            None => [self.limits.velocity, self.limits.acceleration, self.jerk],
            Some(_) => [
                self.limits.velocity,
                [f64::INFINITY; AXIS_COUNT],
                [f64::INFINITY; AXIS_COUNT],
            ],
        }
    }

    /// Machine units that an axis counts for one mm, or one degree.
    pub fn scale(&self, axis: usize) -> f64 {
        if is_rotary(axis) {
            1.0
        } else {
            1.0 / self.millimetres
        }
    }

    /// `mm`, `in` or `deg`.
    pub fn unit_of(&self, axis: usize) -> &'static str {
        if is_rotary(axis) { "deg" } else { self.unit }
    }
}

/// Jerk limits where nothing says otherwise, accelerations per second.
pub const DEFAULT_JERK: f64 = 20.0;

fn without_ini() -> Setup {
    Setup {
        origin:
            "no INI file: 100 mm/s (degrees/s), 1000 mm/s2, 20 accelerations per second of jerk"
                .to_owned(),
        machine: String::new(),
        ini: None,
        period: 0.001,
        unit: "mm",
        millimetres: 1.0,
        is_lathe: false,
        limits: Limits::default(),
        jerk: [f64::INFINITY; AXIS_COUNT],
        joints: Joints::Axes,
        above_joints: Vec::new(),
        soft_limits: None,
        tool_tilt_axis: None,
        axes: [true; AXIS_COUNT],
        velocity_limit: f64::INFINITY,
        spindle: SpeedLimits::default(),
        rotary_tolerance: 0.0,
        default_tolerance: DEFAULT_TOLERANCE,
        corners_inside: false,
        surroundings: Surroundings::default(),
        read: Vec::new(),
        missing_file: None,
        assumed: Vec::new(),
    }
}

/// Of the planner, in machine units.
const DEFAULT_TOLERANCE: f64 = framepath::planner::Blending::DEFAULT_TOLERANCE;

fn from_ini(file: &Path, arguments: &PlanArguments) -> Result<Setup, PlanError> {
    let ini = Ini::read(file)?;
    let machine = Machine::from_ini(&ini)?;
    let millimetres = machine.millimetres();
    let mut setup = Setup {
        origin: file.display().to_string(),
        machine: machine.name.clone(),
        period: machine.servo_period,
        unit: machine.length_unit,
        millimetres,
        is_lathe: machine.is_lathe,
        axes: [false; AXIS_COUNT],
        default_tolerance: DEFAULT_TOLERANCE * millimetres,
        assumed: ini
            .passed_over()
            .iter()
            .chain(machine.axes.iter().flat_map(|axis| &axis.assumed))
            .cloned()
            .collect(),
        ..without_ini()
    };
    setup.limits.take_from(&machine);
    for member in &machine.axes {
        let Some(axis) = AXIS_LETTERS.find(member.letter) else {
            continue;
        };
        let unit = 1.0 / setup.scale(axis);
        setup.axes[axis] = true;
        setup.jerk[axis] = member.limits.jerk.unwrap_or(f64::INFINITY) * unit;
    }
    if arguments.jerk.is_none() {
        refuse_jerk_of_ini(&ini, &setup, arguments)?;
    }
    if let Some(velocity) = ini.path_velocity()? {
        setup.velocity_limit = velocity * millimetres;
    }
    let mut joints = JointSettings::read(&ini);
    joints.turned_on = arguments.tool_centre_point;
    joints.kinematics_type = arguments.kinematics_type;
    if arguments.jerk.is_none() {
        setup.assumed.extend(other_jerk(&machine, &joints));
    }
    setup.joints = Joints::from_settings(&joints, &ini, setup.period, 1.0)?;
    if are_axes(&joints) && setup.joints.limited().is_none() {
        take_above_joints(&mut setup, &ini, &machine, arguments);
    }
    setup.soft_limits = SoftLimits::from_ini(&ini, &machine, &joints)?;
    setup.tool_tilt_axis = tool_tilt_axis(&joints, &ini);
    setup.spindle = SpeedLimits::from_ini(&ini)?;
    let start = at_home(&ini, &machine, &joints, &mut setup.assumed)?;
    setup.surroundings = surroundings(&ini, file, millimetres, start, &mut setup.assumed)?;
    setup.surroundings.axes = setup.axes;
    setup.read = files_read(&ini, file);
    setup.missing_file = missing_files(&ini).first().map(|(entry, file)| {
        format!(
            "{}:{}: [RS274NGC]REMAP = {}: {file} is in no folder of [RS274NGC]SUBROUTINE_PATH or [DISPLAY]PROGRAM_PREFIX, and \
             LinuxCNC runs no program: correct the name or the folders",
            entry.place.file.display(), entry.place.line, entry.value
        )
    });
    // Limits of axes hold with each type.
    let planned = setup.joints.limited();
    let kind = planned.map(|_| joints.kinematics_type.unwrap_or(0));
    let output = joints.switch_output();
    setup.surroundings.kinematics_switch = output.map(|output| (output, kind));
    setup.ini.clone_from(&setup.surroundings.ini);
    Ok(setup)
}

/// A line for each axis whose jerk HAL files set to another one than that of the INI file, with which the plan is.
fn other_jerk(machine: &Machine, joints: &JointSettings) -> Vec<String> {
    let axes = machine.axes.iter();
    let other = axes.filter_map(|axis| {
        let letter = axis.letter;
        let (jerk, place) = joints.jerk_of_axis(letter)?;
        let is_limit = |jerk: &f64| *jerk > 0.0 && jerk.is_finite();
        if Some(jerk).filter(is_limit) == axis.limits.jerk {
            return None;
        }
        let planned = match axis.limits.jerk {
            Some(planned) => format!("[AXIS_{letter}]MAX_JERK = {planned}"),
            None => "a jerk that is not limited".to_owned(),
        };
        Some(format!(
            "{place}: {} is set to {jerk}, and the plan is with {planned}: write the same in both, or plan with --jerk",
            jerk_pin(letter)
        ))
    });
    other.collect()
}

/// Limits of axes above those of their joints, with a warning; an option takes the place of those of the axes.
fn take_above_joints(setup: &mut Setup, ini: &Ini, machine: &Machine, arguments: &PlanArguments) {
    if arguments.limits.is_some() {
        return;
    }
    setup.above_joints = AboveJoint::of_machine(ini, machine);
    let warnings = setup.above_joints.iter().map(|above| above.warning(ini));
    setup.assumed.extend(warnings);
}

/// Of an axis whose acceleration is not limited blendtp takes any.
fn least_jerk_of(acceleration: f64) -> f64 {
    match acceleration >= UNLIMITED {
        true => 0.0,
        false => least_jerk(acceleration),
    }
}

/// Refuses too little jerk of the INI file beside its accelerations, which an option may have changed.
fn refuse_jerk_of_ini(
    ini: &Ini,
    setup: &Setup,
    arguments: &PlanArguments,
) -> Result<(), PlanError> {
    let mut limits = setup.limits;
    if let Some(changes) = &arguments.limits {
        limits.apply(changes);
    }
    let Some((axis, least)) = setup.too_little_jerk(&limits) else {
        return Ok(());
    };
    let section = format!("AXIS_{}", framepath::axes::AXIS_LETTERS[axis]);
    let problem = format!(
        "blendtp refuses every move: it has to be 0 (not limited) or at least {}, a fifth of the acceleration",
        least * setup.scale(axis)
    );
    Err(ini.bad_value(&section, "MAX_JERK", &problem).into())
}

/// What the INI file includes, the tool table and the numbered parameters.
fn files_read(ini: &Ini, file: &Path) -> Vec<PathBuf> {
    let folder = file.parent().unwrap_or(Path::new(""));
    let named = [("EMCIO", "TOOL_TABLE"), ("RS274NGC", "PARAMETER_FILE")];
    let named = named.map(|(section, key)| ini.text(section, key));
    let named = named.into_iter().flatten().map(|name| folder.join(name));
    let included = ini
        .entries()
        .iter()
        .map(|entry| entry.place.file.to_path_buf());
    included.chain(named).collect()
}

/// A changer that puts tools back where there is room has in pocket 0 what the spindle holds. Of several
/// lines LinuxCNC takes the last.
fn in_the_spindle(tools: &[Tool]) -> i32 {
    let held = tools.iter().rfind(|tool| tool.pocket == 0);
    held.map_or(0, |tool| tool.number)
}

/// What LinuxCNC's task hands the interpreter.
fn surroundings(
    ini: &Ini,
    file: &Path,
    unit: f64,
    start: Position,
    assumed: &mut Vec<String>,
) -> Result<Surroundings, PlanError> {
    // LinuxCNC looks beside a link to an INI file, not beside the file itself.
    let absolute = std::path::absolute(file).map_err(|source| crate::machine::IniError::Read {
        file: file.to_owned(),
        source,
    })?;
    let folder = absolute.parent().unwrap_or(Path::new("/")).to_owned();
    let named = |section, key| ini.text(section, key).filter(|name| !name.is_empty());
    if named("EMCIO", "DB_PROGRAM").is_some() {
        let problem = "tools of a database are not read: plan with a copy of the INI file that has a TOOL_TABLE in its place";
        return Err(ini.bad_value("EMCIO", "DB_PROGRAM", problem).into());
    }
    let tools = match named("EMCIO", "TOOL_TABLE") {
        Some(name) if !folder.join(name).exists() => {
            let problem = "there is no such file: LinuxCNC has no tools then, and so has this";
            assumed.push(ini.bad_value("EMCIO", "TOOL_TABLE", problem).to_string());
            Some(Vec::new())
        }
        Some(name) => {
            let table = read_tool_table(&folder.join(name))?;
            assumed.extend(table.warnings);
            Some(table.tools)
        }
        None => None,
    };
    let random = ini.number("EMCIO", "RANDOM_TOOLCHANGER")?.unwrap_or(0.0) != 0.0;
    Ok(Surroundings {
        parameters: named("RS274NGC", "PARAMETER_FILE").map(|name| folder.join(name)),
        unit,
        start,
        axes: [true; AXIS_COUNT],
        skip_blocks: false,
        startup: named("RS274NGC", "RS274NGC_STARTUP_CODE")
            .unwrap_or_default()
            .to_owned(),
        held: tools
            .as_deref()
            .filter(|_| random)
            .map_or(0, in_the_spindle),
        kinematics_switch: None,
        user_codes: user_codes(ini),
        tools,
        ini: Some(absolute),
        expanded_ini: ini.expanded().map(str::to_owned),
    })
}
