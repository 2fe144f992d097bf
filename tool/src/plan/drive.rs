//! Drives the planner of blendtp as the servo thread would, in place of task and motion controller,
//! faster than real time.

use super::arrivals::Arrivals;
use super::error::{PlanError, move_refused, refusal, spindle_error, stopped, stuck};
use super::joint_way::JointWay;
use super::joints;
use super::kinds::{Kind, Kinds};
use super::lines::{Line, Lines};
use super::sample::{Activity, Sample};
use super::setup::Setup;
use super::soft_limits::SoftLimits;
use super::source::Source;
use super::spindle::Spindle;
use super::supply::Supply;
use crate::canon::call::PathMode;
use crate::layer::program::{self, Move, Operation, Piece};
use crate::machine::limits::is_rotary;
use framepath::axes::{AXIS_COUNT, Axes, AxisLimits};
use framepath::moves::shape::{Circle, Shape, ShapeError};
use framepath::moves::{FeedWord, MotionType, StateTag, TerminationCondition};
use framepath::planner::{CycleInputs, MoveRequest, Planner, Status};
use nalgebra::Vector3;
use std::path::Path;
use std::sync::Arc;

/// Which overrides apply, as LinuxCNC begins a program: of spindle and feed, and feed hold; the adaptive
/// one (4) after M52 only.
const OVERRIDES: u8 = 0x0b;

/// Cycles without any travel after which the plan counts as stuck.
const STUCK: u64 = 100_000;

/// Longer dwells are not planned cycle by cycle, s.
const LONGEST_DWELL: f64 = 1e6;

/// Cycles for planning what is in the queue, while the machine is held at the start.
const SETTLING: u64 = 1000;

/// Travel of an axis below it counts as none, mm or degrees.
const NO_TRAVEL: f64 = 1e-8;

/// A move on its way through the planner, with what the program says of it.
pub struct Handed {
    pub(super) a_move: Move,
    pub(super) pieces: Vec<Piece>,
}

/// The planner and the program that it runs.
pub struct Drive<'a> {
    setup: &'a Setup,
    planner: Box<Planner>,
    soft_limits: Option<SoftLimits>,
    /// The joints on the way of moves, where they might jump.
    joint_way: Option<JointWay>,
    spindle: Spindle,
    kinds: Kinds,
    /// How far the moves to come go in a turn of the spindle, machine units; 0: they do not follow it.
    per_turn: f64,
    inputs: CycleInputs,
    cycle: u64,
    dwell_until: Option<u64>,
    /// Held at the start while the queue fills: until this cycle, which every move puts off.
    hold_until: Option<u64>,
    /// When moves come, where that was recorded.
    arrivals: Option<Arrivals>,
    /// Moves that the planner was given.
    moves: usize,
    lines: Lines,
    last_position: Axes,
    last_change: u64,
    finished: bool,
}

impl<'a> Drive<'a> {
    /// The planner as the motion controller sets it up. `supply` says when moves come.
    ///
    /// # Errors
    /// Settings that the planner does not take.
    pub fn new(file: &Path, setup: &'a Setup, supply: Supply) -> Result<Self, PlanError> {
        let mut planner = Box::new(Planner::new());
        let refused = |what: &str| PlanError::Option(format!("the planner refuses {what}"));
        let unit = |axis: usize| setup.scale(axis);
        let scaled =
            |values: &[f64; AXIS_COUNT]| Axes::from_fn(|axis, _| values[axis] * unit(axis));
        if !planner.set_cycle_time(setup.period) {
            return Err(refused("the servo period"));
        }
        planner.set_limits(&AxisLimits {
            velocity: scaled(&setup.limits.velocity),
            acceleration: scaled(&setup.limits.acceleration),
            jerk: scaled(&setup.jerk),
        });
        if let Some(joints) = setup.joints.limited() {
            // That of the program before is not in the spindle.
            joints.set_tool_length(0.0);
            if !planner.set_joints(Some(joints::map(joints))) {
                return Err(refused("the limits of joints"));
            }
        }
        let length = 1.0 / setup.millimetres;
        planner
            .set_blending(
                length,
                setup.rotary_tolerance,
                setup.default_tolerance * length,
            )
            .map_err(|_| refused("the tolerances: they must be 0 or positive"))?;
        planner.set_tilt_axis(setup.tool_tilt_axis);
        planner.set_corners_inside(setup.corners_inside);
        let joint_way = setup.joints.limited().and_then(JointWay::new);
        planner.wait_for_range_check(setup.soft_limits.is_some() || joint_way.is_some());
        planner.set_velocity_limit(setup.velocity_limit * length);
        planner
            .set_position(&scaled(&setup.surroundings.start))
            .map_err(|_| refused("the start: [JOINT_n]HOME"))?;
        Ok(Drive {
            setup,
            planner,
            soft_limits: setup.soft_limits.clone(),
            joint_way,
            spindle: Spindle::new(setup.spindle),
            kinds: Kinds::default(),
            per_turn: 0.0,
            inputs: CycleInputs::default(),
            cycle: 0,
            dwell_until: None,
            hold_until: matches!(supply, Supply::BeforeStart).then_some(SETTLING),
            arrivals: match supply {
                Supply::Recorded(arrivals) => Some(arrivals),
                _ => None,
            },
            moves: 0,
            lines: Lines::new(file),
            last_position: Axes::zeros(),
            last_change: 0,
            finished: false,
        })
    }

    /// One servo cycle; `None` when the program has come to its end. `handed` gets the moves that
    /// the planner is given in it.
    ///
    /// # Errors
    /// What the interpreter or the planner refuses.
    pub fn step(
        &mut self,
        source: &mut Source,
        mut handed: impl FnMut(Handed),
    ) -> Result<Option<Sample>, PlanError> {
        if self.finished {
            return Ok(None);
        }
        if let Some(arrivals) = &mut self.arrivals {
            arrivals.pass_to(self.cycle);
        }
        self.task(source, &mut handed)?;
        let dwells = self.dwell_until.is_some();
        if self.hold_until.is_some_and(|until| self.cycle >= until) {
            self.hold_until = None;
        }
        // As with the pin motion.feed-inhibit.
        self.inputs.net_feed_scale = match &self.arrivals {
            Some(arrivals) => arrivals.scale(),
            None if self.hold_until.is_some() => 0.0,
            None => 1.0,
        };
        self.inputs.spindles[0] = self.spindle.turn(self.setup.period);
        self.look_for_soft_limits()?;
        self.look_at_joints()?;
        let status = *self.planner.cycle(&self.inputs);
        let x = status.position[0] / self.setup.scale(0);
        self.spindle.obey(&status, x);
        self.judge(&status)?;
        self.cycle += 1;
        let at_end = !dwells && status.done && source.peek()?.is_none();
        self.finished = at_end;
        Ok(Some(self.sample(&status, dwells)))
    }

    /// The task controller and the command handler: what may be handed over in this cycle, one
    /// move at most.
    fn task(
        &mut self,
        source: &mut Source,
        handed: &mut impl FnMut(Handed),
    ) -> Result<(), PlanError> {
        if self.dwell_until.is_some_and(|until| self.cycle >= until) {
            self.dwell_until = None;
        }
        while self.dwell_until.is_none() {
            let Some(next) = source.peek()? else { break };
            let status = self.planner.status();
            let waits = match (next, &self.arrivals) {
                (Operation::Move(_), Some(arrivals)) => {
                    let late = self.moves >= arrivals.moves();
                    if late && status.done {
                        arrivals.expect_more()?;
                    }
                    late
                }
                (Operation::Move(_), None) => status.queue_full,
                (Operation::WaitForMotion, _) => !status.done,
                _ => false,
            };
            if waits {
                break;
            }
            let Some((operation, pieces)) = source.take() else {
                break;
            };
            self.last_change = self.cycle;
            match operation {
                Operation::Move(a_move) => {
                    self.add(&a_move, Arc::clone(source.file_of(&a_move)))?;
                    self.moves += 1;
                    if let Some(until) = &mut self.hold_until {
                        *until = self.cycle + SETTLING;
                    }
                    let a_move = *a_move;
                    handed(Handed { a_move, pieces });
                    if self.arrivals.is_none() {
                        break;
                    }
                }
                Operation::WaitForMotion => {}
                Operation::ToolLength(length) => self.set_tool_length(length)?,
                // The next move was recorded behind it.
                Operation::Dwell(_) if self.arrivals.is_some() => {}
                Operation::Dwell(seconds) => {
                    if seconds > LONGEST_DWELL {
                        let behind = self.lines.last();
                        return Err(PlanError::Dwell {
                            file: behind.file.to_path_buf(),
                            line: behind.number,
                            seconds,
                        });
                    }
                    let cycles = (seconds / self.setup.period).round().max(0.0);
                    self.dwell_until = Some(self.cycle + cycles as u64);
                }
                Operation::Termination(mode, tolerance) => self.set_termination(mode, tolerance),
                Operation::Synchronise {
                    per_revolution,
                    velocity_mode,
                } => {
                    let per_turn = per_revolution / self.setup.millimetres;
                    self.planner
                        .set_spindle_synchronisation(0, per_turn, velocity_mode);
                    self.per_turn = per_turn;
                }
                Operation::Spindle(command) => self.spindle.command(command),
            }
        }
        Ok(())
    }

    fn look_for_soft_limits(&mut self) -> Result<(), PlanError> {
        let limits = self.soft_limits.as_mut();
        match limits.and_then(|limits| limits.look(&mut self.planner)) {
            Some(id) => {
                let reason = "a joint would go beyond a soft limit ([JOINT_n]MIN_LIMIT, MAX_LIMIT)";
                Err(stopped(self.lines.of(id), reason.to_owned()))
            }
            None => Ok(()),
        }
    }

    fn look_at_joints(&mut self) -> Result<(), PlanError> {
        let way = self.joint_way.as_mut();
        match way.and_then(|way| way.look(&mut self.planner)) {
            Some(refused) => Err(move_refused(self.lines.of(refused.id), refused.reason)),
            None => Ok(()),
        }
    }

    /// What LinuxCNC would refuse for a soft limit is planned all the same, with a word.
    fn admit(&mut self, shape: Result<Shape, ShapeError>) {
        if let (Some(limits), Ok(shape)) = (&mut self.soft_limits, shape) {
            limits.admit(&shape, self.lines.last());
        }
    }

    /// What the user should know of the program.
    pub fn warnings(&self) -> &[String] {
        self.soft_limits.as_ref().map_or(&[], SoftLimits::warnings)
    }

    fn set_termination(&mut self, mode: PathMode, tolerance: f64) {
        self.planner.set_termination(match mode {
            PathMode::ExactStop => TerminationCondition::Stop,
            PathMode::ExactPath => TerminationCondition::Exact,
            PathMode::Continuous => TerminationCondition::Continuous {
                tolerance: tolerance / self.setup.millimetres,
            },
        });
    }

    /// The machine stands, as behind `WaitForMotion`.
    fn set_tool_length(&mut self, millimetres: f64) -> Result<(), PlanError> {
        let length = millimetres / self.setup.millimetres;
        let position = self.planner.status().position;
        joints::set_tool_length(&self.setup.joints, length, &position)
            .map_err(|why| move_refused(self.lines.last(), why.to_owned()))
    }

    /// The line of the move stands in `file`.
    fn add(&mut self, a_move: &Move, file: Arc<Path>) -> Result<(), PlanError> {
        let length = 1.0 / self.setup.millimetres;
        let is_rotary = self.turns_only(a_move);
        self.kinds.add(
            a_move.index,
            Kind {
                per_turn: self.per_turn,
                is_rotary,
            },
        );
        let rate = if is_rotary { 1.0 } else { length };
        let request = MoveRequest {
            motion_type: match a_move.motion_type {
                program::MotionType::Traverse => MotionType::Traverse,
                program::MotionType::Feed => MotionType::Feed,
                program::MotionType::Arc => MotionType::Arc,
                program::MotionType::Probing => MotionType::Probing,
            },
            feed: a_move.velocity * rate,
            max_velocity: a_move.greatest_velocity * rate,
            path_jerk: f64::INFINITY,
            enables: OVERRIDES,
            wait_for_spindle: a_move.at_speed,
            indexer_joint: None,
            tag: StateTag::EMPTY,
        };
        let id = id_of(a_move.index);
        self.planner.set_id(id);
        let number = a_move.line;
        self.lines.note(id, Line { file, number });
        let end = Axes::from_fn(|axis, _| a_move.end[axis] * self.setup.scale(axis));
        if let Some(joints) = self.setup.joints.limited()
            && !joints.reaches(&end)
        {
            return Err(move_refused(
                self.lines.last(),
                format!("{} has no joints for where it ends", joints.told()),
            ));
        }
        let tag = &a_move.tag;
        self.planner
            .set_feed_word(FeedWord::of_tag(tag.feed, tag.flags));
        let vector = |values: [f64; 3]| Vector3::from(values);
        let added = match a_move.shape {
            program::Shape::Line => {
                self.admit(self.planner.line_to(&end));
                self.planner.add_line(&end, &request)
            }
            program::Shape::Arc {
                centre,
                normal,
                turn,
            } => {
                let circle = Circle {
                    center: vector(centre) * length,
                    normal: vector(normal),
                    revolutions: turn,
                };
                self.admit(self.planner.arc_to(&end, &circle));
                self.planner.add_circle(&end, &circle, &request)
            }
            program::Shape::Tap => {
                self.admit(self.planner.line_to(&end));
                let request = MoveRequest {
                    feed: request.max_velocity,
                    wait_for_spindle: true,
                    ..request
                };
                self.planner.add_rigid_tap(&end, 1.0, &request)
            }
        };
        added
            .map(|_| ())
            .map_err(|error| move_refused(self.lines.last(), refusal(&error)))
    }

    /// Whether nothing but rotary axes moves. A full circle ends where it begins.
    fn turns_only(&self, a_move: &Move) -> bool {
        let travels = |axis| (a_move.end[axis] - self.program_position(axis)).abs() > NO_TRAVEL;
        let mut linear = (0..AXIS_COUNT).filter(|axis| !is_rotary(*axis));
        !matches!(a_move.shape, program::Shape::Arc { .. }) && !linear.any(travels)
    }

    /// Where the last move that was handed over ends, mm and degrees.
    fn program_position(&self, axis: usize) -> f64 {
        self.planner.goal()[axis] / self.setup.scale(axis)
    }

    /// The least and the greatest speed of the spindle in motion with a constant surface speed, turns a minute.
    pub fn surface_speeds(&self) -> Option<[f64; 2]> {
        self.spindle.surface_speeds()
    }

    /// The line that runs in a cycle.
    pub fn line(&self, sample: &Sample) -> &Line {
        let id = sample.running.map(id_of);
        id.map_or(self.lines.last(), |id| self.lines.of(id))
    }

    /// The number of the move that runs.
    fn runs(status: &Status) -> Option<usize> {
        let id = (status.active_depth > 0).then_some(status.exec_id)?;
        usize::try_from(id).ok()?.checked_sub(1)
    }

    /// What must not happen.
    fn judge(&mut self, status: &Status) -> Result<(), PlanError> {
        let stops = |reason| Err(stopped(self.lines.of(status.exec_id), reason));
        if let Some(fault) = status.fault {
            return stops(format!(
                "{fault:?}. This is a fault of blendtp: please report it with the program"
            ));
        }
        if let Some(error) = status.spindle_error {
            return stops(spindle_error(&error));
        }
        // Whatever creeps by less than this in so long a time has no end.
        let moves = (self.last_position - status.position).amax() > NO_TRAVEL;
        if moves || self.dwell_until.is_some() || self.hold_until.is_some() || status.done {
            self.last_change = self.cycle;
            self.last_position = status.position;
        }
        let held = || self.arrivals.as_ref().map_or(Ok(false), Arrivals::hold);
        if self.cycle - self.last_change > STUCK && !held()? {
            let per_turn = Self::runs(status).map_or(0.0, |at| self.kinds.running(at).per_turn);
            let stands = self.spindle.speed() == 0.0;
            return stops(stuck(status, per_turn != 0.0 && stands).to_owned());
        }
        Ok(())
    }

    fn sample(&mut self, status: &Status, dwells: bool) -> Sample {
        let running = Self::runs(status);
        // Where motion follows the spindle the planner counts on more, should the spindle become faster.
        let kind = running.map_or(Kind::default(), |index| self.kinds.running(index));
        let path_velocity = match kind.is_rotary {
            true => f64::INFINITY,
            false => self.setup.velocity_limit,
        };
        let asked = match kind.per_turn == 0.0 {
            true => status.requested_velocity,
            false => kind.per_turn * self.spindle.speed(),
        }
        .min(path_velocity / self.setup.millimetres);
        Sample {
            time: self.cycle as f64 * self.setup.period,
            position: std::array::from_fn(|axis| status.position[axis] / self.setup.scale(axis)),
            running,
            share_of_feed: if asked > 0.0 {
                status.current_velocity / asked
            } else {
                0.0
            },
            path_velocity,
            awaits_spindle: status.waiting_for_spindle || status.waiting_for_index,
            moves_done: self.planner.moves_done(),
            distance_to_go: status.distance_to_go,
            activity: if dwells {
                Activity::Dwells
            } else if status.done {
                Activity::Waits
            } else {
                Activity::Moves
            },
        }
    }
}

/// LinuxCNC's number of a move, which itself counts from 0.
fn id_of(index: usize) -> i32 {
    i32::try_from(index + 1).unwrap_or(i32::MAX)
}
