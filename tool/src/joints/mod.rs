//! Joints with limits of their own, behind a table of framekins or a kinematics module: what the planner asks of them.

mod error;
mod module;
mod table;
mod told;

use crate::machine::ini::Ini;
use crate::machine::limits::{Jerk, infinite_for_none, is_rotary};
use crate::path::Position;
use crate::wiring::blendtp::LIMITED_JOINTS;
use crate::wiring::joints::JointSettings;
use framepath::abi::planner::kinematics_module::KinematicsModule;
use framepath::axes::Axes;
use framepath::machine::JOINT_COUNT;
use framepath::planner::JerkLimit;
use module::ModuleJoints;
use serde::{Deserialize, Serialize};
use table::{Table, TableError, TableMachine, own_table};
use told::Told;

pub use error::JointsError;
pub(crate) use module::position_at_home;

/// How close to a position the joints for it have to lead, units of length: kinematics that iterate are not exact.
const REACHED: f64 = 1e-3;

/// What is known of joints with limits.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Joints {
    /// There are none.
    Axes,
    /// There are, behind a module that cannot be asked here: its name, and why.
    Unknown(String),
    /// There are, and they are known.
    Limited(Box<LimitedJoints>),
}

/// Joints with their limits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Told", into = "Told")]
pub(crate) struct LimitedJoints {
    behind: Behind,
    limits: [Position; 3],
    /// See [`tool_tilt_axis`].
    pub(crate) tool_tilt_axis: Option<usize>,
    begin: Begin,
}

/// What positions and joints are counted from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Begin {
    position: Position,
    joints: Position,
}

/// What makes joints of a position.
#[derive(Clone, Debug, PartialEq)]
enum Behind {
    Table(Table, TableMachine),
    Module(Box<ModuleJoints>),
}

impl Joints {
    /// In lengths of which a machine unit has so many: 1 for machine units. `period`: of the servo thread, s.
    ///
    /// # Errors
    /// Limits with which blendtp refuses every move, kinematics that framekins does not take.
    pub(crate) fn from_settings(
        settings: &JointSettings,
        ini: &Ini,
        period: f64,
        lengths: f64,
    ) -> Result<Joints, JointsError> {
        let table = own_table(settings);
        if settings.turned_on && !(settings.is_limited() && table.is_some()) {
            return Err(JointsError::NoTable(ini.file().to_owned()));
        }
        if settings.kinematics_type.is_some() && !(settings.is_limited() && table.is_none()) {
            return Err(JointsError::NoTypes(ini.file().to_owned()));
        }
        if !settings.is_limited() {
            return Ok(Joints::Axes);
        }
        if table.is_none() {
            return Joints::of_module(settings, ini, period, lengths);
        }
        let refused =
            |why: TableError| ini.bad_value("KINS", "KINEMATICS", why.to_string().as_str());
        let table = Table::new(settings, lengths);
        let machine = table.machine().map_err(refused)?;
        let unit = |joint: usize| {
            let axis = machine.coordinates().axis_of_joint(joint)?;
            Some(if is_rotary(axis) { 1.0 } else { lengths })
        };
        Ok(Joints::Limited(Box::new(LimitedJoints {
            limits: limits(settings, unit, period)?,
            behind: Behind::Table(table, TableMachine::new(machine)),
            tool_tilt_axis: tool_tilt_axis(settings, ini),
            begin: Begin::default(),
        })))
    }

    /// Those behind a module of LinuxCNC's.
    fn of_module(
        settings: &JointSettings,
        ini: &Ini,
        period: f64,
        lengths: f64,
    ) -> Result<Joints, JointsError> {
        let kinematics = settings.kinematics.clone();
        let joints = match ModuleJoints::load(settings, ini, lengths) {
            Ok(joints) => joints,
            Err(why) if let Some(kind) = settings.kinematics_type => {
                let why = why.to_string();
                return Err(JointsError::NoType { kind, why });
            }
            Err(why) => return Ok(Joints::Unknown(format!("{kinematics} ({why})"))),
        };
        if joints.is_trivial() {
            return Ok(Joints::Axes);
        }
        let limits = limits(settings, |joint| joints.unit(joint), period)?;
        joints
            .check(&limits)
            .map_err(|why| JointsError::Module { kinematics, why })?;
        Ok(Joints::Limited(Box::new(LimitedJoints {
            behind: Behind::Module(Box::new(joints)),
            limits,
            tool_tilt_axis: tool_tilt_axis(settings, ini),
            begin: Begin::default(),
        })))
    }

    /// The same with another limit of jerk. A mm has so many `lengths`.
    pub(crate) fn with_jerk(self, jerk: Jerk, lengths: f64) -> Joints {
        match self {
            Joints::Limited(joints) => Joints::Limited(Box::new(joints.with_jerk(jerk, lengths))),
            others => others,
        }
    }

    /// The joints whose limits are known to hold.
    pub(crate) fn limited(&self) -> Option<&LimitedJoints> {
        match self {
            Joints::Limited(joints) => Some(joints),
            _ => None,
        }
    }
}

impl LimitedJoints {
    /// The machine, for the reader.
    pub(crate) fn told(&self) -> String {
        match &self.behind {
            Behind::Table(table, _) => table.told(),
            Behind::Module(joints) => joints.name().to_owned(),
        }
    }

    /// Velocity, acceleration, jerk, shape (3, 9); infinite where there is none.
    pub(crate) fn limits(&self) -> &[Position; 3] {
        &self.limits
    }

    /// How many joints there are.
    pub(crate) fn count(&self) -> usize {
        match &self.behind {
            Behind::Table(_, machine) => machine.now().coordinates().joint_count(),
            Behind::Module(joints) => joints.count(),
        }
    }

    /// The axis that a joint moves, 0 to 8; `None` where there is none, or where it moves several.
    pub(crate) fn axis(&self, joint: usize) -> Option<usize> {
        match &self.behind {
            Behind::Table(_, machine) => machine.now().coordinates().axis_of_joint(joint),
            Behind::Module(_) => None,
        }
    }

    /// Whether a joint turns.
    pub(crate) fn is_rotary(&self, joint: usize) -> bool {
        match &self.behind {
            Behind::Table(..) => self.axis(joint).is_some_and(is_rotary),
            Behind::Module(joints) => joints.is_angular(joint),
        }
    }

    /// Where the machine begins, in units of its own: with its joints at home, where that is known by them alone.
    pub(crate) fn home(&self) -> Option<Axes> {
        match &self.behind {
            Behind::Table(..) => None,
            Behind::Module(joints) => Some(*joints.home()),
        }
    }

    /// What blendtp asks for joints on the way of a move, in machine units, and the joints of home; `None` for a table,
    /// whose joints do not jump.
    pub(crate) fn on_the_way(&self) -> Option<(KinematicsModule, [f64; JOINT_COUNT])> {
        match &self.behind {
            Behind::Table(..) => None,
            Behind::Module(joints) => Some(joints.on_the_way()),
        }
    }

    /// From here on the tool has this length along Z, in lengths of the joints, if HAL hands it to the kinematics; whether it does.
    pub(crate) fn set_tool_length(&self, length: f64) -> bool {
        match &self.behind {
            Behind::Table(table, machine) => {
                table.takes_tool_length && machine.set_tool_length(table, length)
            }
            Behind::Module(joints) => joints.set_tool_length(length),
        }
    }

    /// What another jet takes, nanoseconds: blendtp measures it, and plans about as far in a servo period.
    pub(crate) fn nanoseconds(&self) -> f64 {
        match &self.behind {
            Behind::Table(..) => 100.0,
            Behind::Module(_) => 700.0,
        }
    }

    /// The same joints with another limit of jerk. A mm has so many `lengths`.
    pub(crate) fn with_jerk(&self, jerk: Jerk, lengths: f64) -> LimitedJoints {
        let mut joints = self.clone();
        for joint in 0..LIMITED_JOINTS {
            let unit = if joint < self.count() && !self.is_rotary(joint) {
                lengths
            } else {
                1.0
            };
            let asked = jerk.of_axis(self.limits[1][joint] / unit) * unit;
            joints.limits[2][joint] = infinite_for_none(asked);
        }
        joints
    }

    /// The same joints for positions that are counted from this one of the machine, where they count from 0 as well.
    pub(crate) fn beginning_at(&self, position: &Axes) -> LimitedJoints {
        let mut joints = self.clone();
        joints.begin = Begin {
            position: (*position).into(),
            ..Begin::default()
        };
        joints.begin.joints = joints.at(&[0.0; 9]);
        joints
    }

    /// Where a position is on the machine.
    fn on_machine(&self, position: &Axes) -> Axes {
        position + Axes::from(self.begin.position)
    }

    /// The joints for a position, shape (9), from where they begin; 0 where there is none. Not a number where the machine does
    /// not reach it.
    pub(crate) fn at(&self, position: &Position) -> Position {
        let mut joints = [0.0; JOINT_COUNT];
        if !self.move_to(&Axes::from(*position), &mut joints) {
            return [f64::NAN; 9];
        }
        std::array::from_fn(|joint| joints[joint] - self.begin.joints[joint])
    }

    /// The same for as many joints as LinuxCNC has, from those of before. What is no joint stays as it is; `false` where
    /// the machine does not reach the position.
    pub(crate) fn move_to(&self, position: &Axes, joints: &mut [f64; JOINT_COUNT]) -> bool {
        let position = self.on_machine(position);
        match &self.behind {
            Behind::Table(_, machine) => {
                machine.now().inverse(&position, joints);
                true
            }
            Behind::Module(module) => match module.joints(&position) {
                Some(found) => {
                    *joints = found;
                    true
                }
                None => false,
            },
        }
    }

    /// The position that joints stand for. Axes that the machine does not have, and where kinematics begin that iterate, as
    /// in `near`; not a number where there is no such place.
    pub(crate) fn position(&self, joints: &[f64; JOINT_COUNT], near: &Axes) -> Axes {
        let position = match &self.behind {
            Behind::Table(_, machine) => machine.now().forward(joints),
            Behind::Module(module) => module.position(joints, &self.on_machine(near)),
        };
        position - Axes::from(self.begin.position)
    }

    /// Whether the machine gets to a position: some kinematics have joints for one out of reach, too, and these lead
    /// elsewhere.
    pub(crate) fn reaches(&self, position: &Axes) -> bool {
        let mut joints = [0.0; JOINT_COUNT];
        self.move_to(position, &mut joints) && {
            let off = self.position(&joints, position) - position;
            (0..3).all(|axis| off[axis].abs() < REACHED)
        }
    }

    /// Three derivatives of the joints for a position and its derivatives by the same parameter, all shape (9). `shares` as
    /// of [`framepath::machine_map::JointMap`]: how exact they have to be where they are found by numbers.
    pub(crate) fn derivatives(
        &self,
        position: &Axes,
        derivatives: &[Axes; 3],
        shares: &[Axes; 3],
    ) -> [Axes; 3] {
        let position = &self.on_machine(position);
        match &self.behind {
            Behind::Table(_, machine) => machine.derivatives(position, derivatives),
            Behind::Module(module) => module.derivatives(position, derivatives, shares),
        }
    }

    /// The same in closed form; `None` behind a module.
    pub(crate) fn exact_derivatives(
        &self,
        position: &Axes,
        derivatives: &[Axes; 3],
    ) -> Option<[Axes; 3]> {
        let position = &self.on_machine(position);
        match &self.behind {
            Behind::Table(_, machine) => Some(machine.derivatives(position, derivatives)),
            Behind::Module(_) => None,
        }
    }
}

/// Whether each joint is an axis.
pub(crate) fn are_axes(settings: &JointSettings) -> bool {
    settings.is_trivial() || is_table(settings) && !settings.tool_centre_point()
}

/// Whether the kinematics are a tilting table of framekins.
pub(crate) fn is_table(settings: &JointSettings) -> bool {
    own_table(settings).is_some()
}

/// The axis, 3 for A or 4 for B, that tilts the tool while C turns it, as framekins tells blendtp.
pub(crate) fn tool_tilt_axis(settings: &JointSettings, ini: &Ini) -> Option<usize> {
    match own_table(settings) {
        Some(tilt) => settings.tool_centre_point().then_some(tilt.axis()),
        None if settings.is_behind_framekins => module::tool_tilt_axis(settings, ini),
        None => None,
    }
}

/// Of joints whose machine units, or degrees, are that much here; `None` for what is no joint.
fn limits(
    settings: &JointSettings,
    unit: impl Fn(usize) -> Option<f64>,
    period: f64,
) -> Result<[Position; 3], JointsError> {
    let mut limits = [[f64::INFINITY; LIMITED_JOINTS]; 3];
    for joint in 0..LIMITED_JOINTS {
        let Some(unit) = unit(joint) else {
            continue;
        };
        let [velocity, acceleration, jerk] = settings.limits.map(|limits| limits[joint]);
        for (limit, quantity) in [(velocity, "velocity"), (acceleration, "acceleration")] {
            let is_endless = quantity == "acceleration" && limit.is_infinite();
            if limit.is_nan() || limit <= 0.0 || is_endless {
                return Err(JointsError::NotPositive {
                    joint,
                    quantity,
                    limit,
                });
            }
        }
        let jerk = match JerkLimit::new(jerk, acceleration, period) {
            JerkLimit::Limited(jerk) => jerk,
            JerkLimit::Unlimited { .. } => f64::INFINITY,
            JerkLimit::Refused { smallest } => {
                return Err(JointsError::Jerk {
                    joint,
                    limit: jerk,
                    smallest,
                });
            }
        };
        for (limits, limit) in limits.iter_mut().zip([velocity, acceleration, jerk]) {
            limits[joint] = limit * unit;
        }
    }
    Ok(limits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::differences::Differences;

    fn joints() -> LimitedJoints {
        let table = Table {
            name: "xyzac".to_owned(),
            coordinates: "XYZAC".to_owned(),
            rotation_point: [10.0, -20.0, 5.0],
            offset: [0.0, 3.0, 40.0],
            tool_offset: 25.0,
            conventional: true,
            tool_centre_point: true,
            takes_tool_length: true,
        };
        let machine = TableMachine::new(table.machine().expect("a table"));
        LimitedJoints {
            behind: Behind::Table(table, machine),
            limits: [[100.0; 9], [1000.0; 9], [f64::INFINITY; 9]],
            tool_tilt_axis: Some(3),
            begin: Begin::default(),
        }
    }

    #[test]
    fn another_process_has_the_same_joints() {
        let bytes = postcard::to_stdvec(&joints()).expect("bytes");
        let back: LimitedJoints = postcard::from_bytes(&bytes).expect("joints");
        assert_eq!(back, joints());
        let place = [1.0, 2.0, 3.0, 30.0, 0.0, 50.0, 0.0, 0.0, 0.0];
        let mut there = [0.0; JOINT_COUNT];
        joints().move_to(&Axes::from(place), &mut there);
        assert!((back.position(&there, &Axes::zeros()) - Axes::from(place)).amax() < 1e-12);
    }

    #[test]
    fn the_length_of_the_tool_is_that_of_all_copies() {
        let (joints, level) = (joints(), [1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let (copy, turned) = (
            joints.clone(),
            [1.0, 2.0, 3.0, 30.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        );
        let before = [joints.at(&level), joints.at(&turned)];
        assert!(joints.set_tool_length(125.0));
        assert_eq!(copy, joints);
        assert_eq!(copy.at(&level), before[0]);
        // by hand: 100 more turn by 30 degrees the other way
        let moved = copy.at(&turned)[1] - before[1][1];
        assert!((moved.abs() - 50.0).abs() < 1e-9, "{moved}");
    }

    #[test]
    fn positions_and_joints_may_begin_elsewhere() {
        let start = Axes::from([10.0, -5.0, 30.0, 20.0, 0.0, -40.0, 0.0, 0.0, 0.0]);
        let elsewhere = joints().beginning_at(&start);
        assert_eq!(elsewhere.at(&[0.0; 9]), [0.0; 9]);
        let place = Axes::from([1.0, 2.0, 3.0, 30.0, 0.0, 50.0, 0.0, 0.0, 0.0]);
        let begun = joints().at(&start.into());
        let there = joints().at(&(start + place).into());
        let expected: Position = std::array::from_fn(|joint| there[joint] - begun[joint]);
        assert_eq!(elsewhere.at(&place.into()), expected);
        // the module is asked for the joints of the machine
        let mut moved = [0.0; JOINT_COUNT];
        assert!(elsewhere.move_to(&place, &mut moved));
        assert_eq!(moved[..9], there);
        assert!((elsewhere.position(&moved, &place) - place).amax() < 1e-12);
        assert!(elsewhere.reaches(&place));
        let rates = [Axes::repeat(2.0), Axes::repeat(-1.0), Axes::repeat(3.0)];
        let expected = joints().derivatives(&(start + place), &rates, &rates);
        assert_eq!(elsewhere.derivatives(&place, &rates, &rates), expected);
        assert_eq!(elsewhere.exact_derivatives(&place, &rates), Some(expected));
        let bytes = postcard::to_stdvec(&elsewhere).expect("bytes");
        assert_eq!(postcard::from_bytes(&bytes), Ok(elsewhere));
    }

    #[test]
    fn derivatives_are_those_of_the_joints() {
        let (joints, period) = (joints(), 1e-3);
        let rate = [5.0, -4.0, 3.0, 20.0, 0.0, -30.0, 0.0, 0.0, 0.0];
        let at = |time: f64| rate.map(|rate| rate * time);
        let mut differences = Differences::new(joints.at(&at(0.0)), period);
        let mut rates = differences.step(&joints.at(&at(period)));
        for cycle in 2..=4 {
            rates = differences.step(&joints.at(&at(f64::from(cycle) * period)));
        }
        let along = [Axes::from(rate), Axes::zeros(), Axes::zeros()];
        let shares = [Axes::repeat(1.0); 3];
        let exact = joints.derivatives(&Axes::from(at(4.0 * period)), &along, &shares);
        for (found, exact) in rates.orders.iter().zip(&exact).take(2) {
            let off = (Axes::from(*found) - exact).amax();
            assert!(off < 0.1, "{found:?} for {exact}");
        }
    }

    #[test]
    fn jerk_of_another_number() {
        let with = joints().with_jerk(Jerk::Accelerations(20.0), 1.0);
        assert_eq!(with.limits()[2], [20_000.0; 9]);
        let without = with.with_jerk(Jerk::Unlimited, 1.0);
        assert_eq!(without.limits(), joints().limits());
        let inches = with.with_jerk(Jerk::Value(2540.0), 1.0 / 25.4);
        assert_eq!(
            inches.limits()[2][..5],
            [100.0, 100.0, 100.0, 2540.0, 2540.0]
        );
    }
}
