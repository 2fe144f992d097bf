//! The soft limits of the machine as blendtp looks at them: near one the path keeps to the inner side of the program.

use super::lines::Line;
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
    /// [warning](Self::warnings). The move stands in this line.
    pub fn admit(&mut self, shape: &Shape, line: &Line) {
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
                "{}:{}: joint {} goes to {:.3}, beyond [JOINT_{2}]{key} = {}: LinuxCNC refuses the program (is the work offset \
                 set?); planned without that limit",
                line.file.display(),
                line.number,
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

    /// Looks at more of the moves, before each servo period. Answers with LinuxCNC's number of one that goes beyond a limit, which
    /// none does that was [admitted](Self::admit).
    pub fn look(&mut self, planner: &mut Planner) -> Option<i32> {
        let (range, joints) = (self.range, self.joints(&planner.status().position));
        let finding = planner.check_range(&range, &joints, self);
        match finding {
            Some(Finding::Leaves { id, .. }) => Some(id),
            _ => None,
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use framepath::axes::AxisLimits;
    use framepath::moves::{MotionType, StateTag};
    use framepath::planner::MoveRequest;

    /// More than the planner, which is made in place.
    const STACK: usize = 64 << 20;

    fn number_of_the_one_beyond() -> Option<i32> {
        let mut limits = SoftLimits {
            axes: vec![0],
            range: JointRange::NONE,
            keeps_lines: false,
            warnings: Vec::new(),
        };
        limits.range.greatest[0] = 10.0;
        limits.range.count = 1;
        let mut planner = Box::new(Planner::new());
        assert!(planner.set_cycle_time(0.001));
        planner.set_limits(&AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(20_000.0),
        });
        planner.wait_for_range_check(true);
        let request = MoveRequest {
            motion_type: MotionType::Feed,
            feed: 10.0,
            max_velocity: 100.0,
            path_jerk: f64::INFINITY,
            enables: 0,
            wait_for_spindle: false,
            indexer_joint: None,
            tag: StateTag::EMPTY,
        };
        for (id, x) in [(1, 5.0), (2, 20.0), (3, 1.0)] {
            let mut end = Axes::zeros();
            end[0] = x;
            planner.set_id(id);
            planner.add_line(&end, &request).expect("taken");
        }
        (0..100).find_map(|_| limits.look(&mut planner))
    }

    #[test]
    fn the_move_that_goes_beyond_is_named_not_the_last_one() {
        let thread = std::thread::Builder::new().stack_size(STACK);
        let thread = thread.spawn(number_of_the_one_beyond).expect("a thread");
        assert_eq!(thread.join().expect("an end"), Some(2));
    }
}
