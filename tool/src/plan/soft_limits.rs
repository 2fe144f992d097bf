//! The soft limits of the machine as blendtp looks at them: near one the path keeps to the inner side of the program.

use crate::joints::are_axes;
use crate::machine::IniError;
use crate::machine::configuration::{AXIS_LETTERS, Machine};
use crate::machine::ini::Ini;
use crate::wiring::joints::JointSettings;
use framepath::axes::Axes;
use framepath::machine::JOINT_COUNT;
use framepath::moves::shape::Shape;
use framepath::planner::Planner;
use framepath::planner::range::{Finding, JointRange, JointSolver, Joints, RangeVerdict, Sweep};
use std::path::Path;

/// What blendtp asks in a servo period.
const CALLS_A_CYCLE: usize = 16;

/// Soft limits of joints that are the axes.
#[derive(Clone, Debug)]
pub struct SoftLimits {
    /// The axis of each joint, 0 to 8.
    axes: Vec<usize>,
    /// Machine units, degrees.
    range: JointRange,
    /// Whether the kinematics say that they keep lines, so that blendtp does not look into these.
    keeps_lines: bool,
    warnings: Vec<String>,
}

impl SoftLimits {
    /// From `[JOINT_n]MIN_LIMIT` and `MAX_LIMIT`; what is not there is no limit. `None` where the joints are not the axes.
    ///
    /// # Errors
    /// A limit that is no number.
    pub fn from_ini(
        ini: &Ini,
        machine: &Machine,
        settings: &JointSettings,
    ) -> Result<Option<SoftLimits>, IniError> {
        if !are_axes(settings) {
            return Ok(None);
        }
        let mut limits = SoftLimits {
            axes: Vec::new(),
            range: JointRange::NONE,
            keeps_lines: settings.kinematics == "trivkins",
            warnings: Vec::new(),
        };
        for (number, joint) in machine.joints.iter().enumerate().take(JOINT_COUNT) {
            let Some(axis) = AXIS_LETTERS.find(joint.letter) else {
                continue;
            };
            let section = format!("JOINT_{number}");
            let limit = |key| ini.number(&section, key);
            limits.axes.push(axis);
            limits.range.least[number] = limit("MIN_LIMIT")?.unwrap_or(f64::NEG_INFINITY);
            limits.range.greatest[number] = limit("MAX_LIMIT")?.unwrap_or(f64::INFINITY);
            limits.range.count = number + 1;
        }
        Ok(Some(limits))
    }

    /// A limit that a move goes beyond, which LinuxCNC refuses, is none from there on: the rest is planned as well, with a
    /// [warning](Self::warnings). The move stands in a line of a file.
    pub fn admit(&mut self, shape: &Shape, file: &Path, line: i32) {
        let start = self.joints(&shape.position(0.0));
        for _ in 0..2 * JOINT_COUNT {
            let mut sweep = Sweep::new(shape, &self.range, &start);
            let verdict = loop {
                if let Some(verdict) = sweep.step(shape, self) {
                    break verdict;
                }
            };
            let RangeVerdict::Leaves(found) = verdict else {
                return;
            };
            let key = if found.position > found.limit {
                self.range.greatest[found.joint] = f64::INFINITY;
                "MAX_LIMIT"
            } else {
                self.range.least[found.joint] = f64::NEG_INFINITY;
                "MIN_LIMIT"
            };
            self.warnings.push(format!(
                "{}:{line}: joint {} goes to {:.3}, beyond [JOINT_{1}]{key} = {}: LinuxCNC refuses the program (is the work offset \
                 set?); planned without that limit",
                file.display(),
                found.joint,
                found.position,
                found.limit,
            ));
        }
    }

    /// The limits that moves go beyond, a sentence for each.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// Looks at more of the moves, before each servo period. Answers whether one goes beyond a limit, which none does that was
    /// [admitted](Self::admit).
    pub fn look(&mut self, planner: &mut Planner) -> bool {
        let (range, joints) = (self.range, self.joints(&planner.status().position));
        let finding = planner.check_range(&range, &joints, self);
        matches!(finding, Some(Finding::Leaves { .. }))
    }

    fn joints(&self, position: &Axes) -> Joints {
        let mut joints = [0.0; JOINT_COUNT];
        for (joint, axis) in joints.iter_mut().zip(&self.axes) {
            *joint = position[*axis];
        }
        joints
    }
}

impl JointSolver for SoftLimits {
    fn begin(&mut self, _position: &Axes, _joints: &Joints) {}

    fn solve(&mut self, position: &Axes, _near: &Joints) -> Option<Joints> {
        Some(self.joints(position))
    }

    fn calls_a_cycle(&self) -> usize {
        CALLS_A_CYCLE
    }

    fn keeps_lines(&self) -> bool {
        self.keeps_lines
    }
}
