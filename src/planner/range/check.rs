//! The look along the queued moves, one behind the other.

use super::joints::{Finding, JointRange, JointSolver, Joints, Jump, OutOfRange};
use super::margin::{Beside, Deviation};
use super::sweep::{RangeVerdict, Sweep};
use crate::axes::Axes;
use crate::machine::JOINT_COUNT;
use crate::moves::shape::Shape;
use crate::moves::{Move, MoveQueue, NearLimit, TerminationCondition};

/// Moves that need no look inside are passed over, so many in a servo period.
const MOVES_A_CYCLE: usize = 16;

/// How far the queued moves have been looked at.
#[derive(Debug)]
pub struct RangeCheck {
    /// Whether moves wait until they have been looked at.
    on: bool,
    /// Serial number of the move that is looked at.
    next: u64,
    /// The move that the machine stood still before, from which the joints were followed.
    origin: Option<u64>,
    /// The joints where the machine comes from to that move, and whether they are those at its start.
    near: Joints,
    at_start: bool,
    sweep: Option<Sweep>,
    /// What the joints do beside the program.
    beside: Beside,
    range: JointRange,
}

impl RangeCheck {
    /// Nothing waits for it.
    pub const OFF: Self = Self {
        on: false,
        next: 0,
        origin: None,
        near: [0.0; JOINT_COUNT],
        at_start: false,
        sweep: None,
        beside: Beside::UNKNOWN,
        range: JointRange::NONE,
    };

    /// Chooses whether moves wait until they have been looked at.
    pub fn set_on(&mut self, on: bool) {
        self.on = on;
    }

    /// Whether they do.
    pub fn is_on(&self) -> bool {
        self.on
    }

    /// Looks at more of the moves, as much as the solver may be asked in a servo period, and releases
    /// those that have been looked at. `machine` are the joints of the machine, `deviation` is how far the path may be from
    /// a move.
    ///
    /// Where the limits of the joints have changed it begins again with the move that runs.
    pub fn go_on(
        &mut self,
        queue: &mut MoveQueue,
        range: &JointRange,
        machine: &Joints,
        deviation: impl Fn(&Move) -> Deviation,
        solver: &mut impl JointSolver,
    ) -> Option<Finding> {
        let changed = !self.range.is(range);
        if self.origin != Some(queue.cleared()) || changed && queue.first_serial() < self.next {
            self.next = queue.first_serial();
            self.origin = None;
            self.sweep = None;
        } else if changed {
            self.sweep = None;
        }
        self.range = *range;
        let mut calls = solver.calls_a_cycle();
        let mut finding = None;
        for _ in 0..MOVES_A_CYCLE {
            let Some(queued) = queue.get(self.next) else {
                break;
            };
            if self.origin.is_none() {
                (self.near, self.at_start) = (*machine, false);
                solver.begin(&queued.shape.position(0.0), machine);
                self.origin = Some(queue.cleared());
                self.beside = Beside::UNKNOWN;
            }
            if self.sweep.is_none() && solver.renew() {
                self.at_start = false;
            }
            let deviation = deviation(queued);
            let Some(margins) = self.margins(&queued.shape, &deviation, &mut calls, solver) else {
                break;
            };
            let Some(verdict) = self.look(&queued.shape, &margins, &mut calls, solver) else {
                break;
            };
            let near_limit = match verdict {
                Passed::Stays { comes_near: true } => NearLimit::BOTH,
                Passed::Stays { comes_near: false } => NearLimit {
                    end: self.ends_near(queued, &margins, solver),
                    ..NearLimit::NONE
                },
                Passed::Unknown => {
                    finding = Some(Finding::Unknown { id: queued.id });
                    NearLimit::BOTH
                }
                Passed::Refused(why) => return Some(self.refusal(why, queued.id)),
            };
            queue.release_near_limit(self.next, near_limit);
            self.next += 1;
        }
        finding
    }

    /// How near a limit counts as near on a move, `None` if finding that takes longer.
    fn margins(
        &mut self,
        shape: &Shape,
        deviation: &Deviation,
        calls: &mut usize,
        solver: &mut impl JointSolver,
    ) -> Option<Joints> {
        let start = shape.position(0.0);
        let known = self.sweep.is_some()
            || deviation.is_none()
            || self.beside.find(&start, &self.near, calls, solver);
        known.then(|| self.beside.margins(deviation))
    }

    /// Whether joints are nearer to a limit than their margins where a move ends. Where the machine comes to rest no path leads
    /// beyond one.
    fn ends_near(&self, queued: &Move, margins: &Joints, solver: &mut impl JointSolver) -> bool {
        if queued.termination == TerminationCondition::Stop {
            return false;
        }
        // What was looked at all along ends with the joints there.
        let joints = if self.at_start {
            Some(self.near)
        } else {
            solver.solve(&queued.shape.end(), &self.near)
        };
        let is_near = |joints: Joints| {
            let limits = self.range.least.iter().zip(&self.range.greatest);
            let joints = joints.iter().zip(margins);
            let mut limited = joints.zip(limits).take(self.range.count);
            limited.any(|((joint, margin), (least, greatest))| {
                !(least + margin < *joint && *joint < greatest - margin)
            })
        };
        joints.is_none_or(is_near)
    }

    /// Why the motion stops before the move with this number.
    fn refusal(&self, why: Refused, id: i32) -> Finding {
        match why {
            Refused::Leaves(found) => Finding::Leaves {
                found: self.with_limit(found),
                id,
            },
            Refused::Jumps(jump) => Finding::Jumps { jump, id },
            Refused::Unreached(place) => Finding::Unreached { place, id },
        }
    }

    /// The limit itself, where the move began beyond it.
    fn with_limit(&self, found: OutOfRange) -> OutOfRange {
        let limits = if found.position > found.limit {
            &self.range.greatest
        } else {
            &self.range.least
        };
        let limit = limits.get(found.joint).copied();
        OutOfRange {
            limit: limit.unwrap_or(found.limit),
            ..found
        }
    }

    /// Looks along a move, `None` if that takes longer.
    fn look(
        &mut self,
        shape: &Shape,
        margins: &Joints,
        calls: &mut usize,
        solver: &mut impl JointSolver,
    ) -> Option<Passed> {
        if matches!(shape, Shape::Line(_)) && solver.keeps_lines() {
            self.at_start = false;
            return Some(Passed::Stays { comes_near: false });
        }
        let mut sweep = match self.sweep.take() {
            Some(sweep) => sweep,
            None if self.at_start => Sweep::behind_start(shape, &self.range, &self.near),
            None => Sweep::new(shape, &self.range, &self.near),
        }
        .with_margins(*margins);
        while *calls > 0 {
            *calls -= 1;
            match sweep.step(shape, solver) {
                None => {}
                Some(RangeVerdict::Stays(joints)) => {
                    (self.near, self.at_start) = (joints, true);
                    let comes_near = sweep.comes_near();
                    return Some(Passed::Stays { comes_near });
                }
                Some(RangeVerdict::Leaves(found)) => {
                    return Some(Passed::Refused(Refused::Leaves(found)));
                }
                Some(RangeVerdict::Jumps(jump)) => {
                    return Some(Passed::Refused(Refused::Jumps(jump)));
                }
                Some(RangeVerdict::Unreached(place)) => {
                    return Some(Passed::Refused(Refused::Unreached(place)));
                }
                Some(RangeVerdict::Unknown) => {
                    self.at_start = false;
                    return Some(Passed::Unknown);
                }
            }
        }
        self.sweep = Some(sweep);
        None
    }
}

/// What became of a move.
enum Passed {
    Stays { comes_near: bool },
    Refused(Refused),
    Unknown,
}

/// Why one is not entered.
enum Refused {
    Leaves(OutOfRange),
    Jumps(Jump),
    Unreached(Axes),
}
