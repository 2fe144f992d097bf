//! The joints on the way of each move, as blendtp looks at them where they have limits of their own: none may jump, and there have to
//! be joints all along.

use crate::joints::LimitedJoints;
use framepath::abi::planner::kinematics_module::KinematicsModule;
use framepath::axes::{AXIS_LETTERS, Axes};
use framepath::planner::Planner;
use framepath::planner::range::{Finding, JointRange, JointSolver, Joints, Jump};

/// Axes that a place is told with: U V W have joints of their own.
const TOLD_AXES: usize = 6;

/// Joints behind a kinematics module, in machine units.
#[derive(Debug)]
pub struct JointWay {
    module: KinematicsModule,
    /// Its name.
    name: String,
    range: JointRange,
    /// Where the machine is.
    joints: Joints,
}

/// Why a move is not taken.
#[derive(Debug)]
pub struct Refused {
    /// LinuxCNC's number of it.
    pub id: i32,
    /// For the reader.
    pub reason: String,
}

impl JointWay {
    /// `None` for joints that do not jump.
    pub(super) fn new(joints: &LimitedJoints) -> Option<JointWay> {
        let (module, home) = joints.on_the_way()?;
        Some(JointWay {
            module,
            name: joints.told(),
            range: JointRange {
                count: joints.count(),
                may_not_jump: true,
                ..JointRange::NONE
            },
            joints: home,
        })
    }

    /// Looks at more of the moves, before each servo period. Why one is not taken, if that is found.
    pub(super) fn look(&mut self, planner: &mut Planner) -> Option<Refused> {
        let position = planner.status().position;
        if let Some(joints) = self.module.solve(&position, &self.joints) {
            self.joints = joints;
        }
        let finding = planner.check_range(&self.range, &self.joints, &mut self.module)?;
        let (id, reason) = match finding {
            Finding::Jumps { jump, id } => (id, self.jumps(&jump)),
            Finding::Unreached { place, id } => (id, self.unreached(&place)),
            Finding::Leaves { .. } | Finding::Unknown { .. } => return None,
        };
        Some(Refused { id, reason })
    }

    fn jumps(&self, jump: &Jump) -> String {
        format!(
            "joint {}, which has limits, would jump by {:.3} at{}, where {} turns to other joints: keep clear of that place, or pass \
             it with another arm",
            jump.joint,
            jump.way,
            told(&jump.place),
            self.name,
        )
    }

    fn unreached(&self, place: &Axes) -> String {
        format!(
            "{} has no joints that lead to{}, which is on its way, and joints have limits: keep within reach",
            self.name,
            told(place),
        )
    }
}

/// A place in machine coordinates.
fn told(place: &Axes) -> String {
    let axes = AXIS_LETTERS.iter().zip(place).take(TOLD_AXES);
    let words: Vec<String> = axes
        .map(|(letter, value)| format!("{letter}{value:.4}"))
        .collect();
    format!(" G53 {}", words.join(" "))
}
