//! What the planner reports after each servo period.

use nalgebra::ArrayStorage;

use super::spindle::SpindleError;
use crate::axes::{AXIS_COUNT, Axes};
use crate::moves::{MotionType, StateTag, SynchronisedOutputs};

pub(super) const ORIGIN: Axes = Axes::from_array_storage(ArrayStorage([[0.0; AXIS_COUNT]]));

/// What must never happen: the planner broke its own rules and stopped the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The executor refused a servo period of the reference.
    CellRefused,
    /// The executor had nothing left to run on.
    Starved,
    /// The executor refused the limits of the axes.
    LimitsRefused,
    /// No path can be made with the limits and tolerances there are.
    SettingsRefused,
    /// A move could not be put on the path.
    MoveRefused,
    /// No plan was found that keeps the limits.
    NoPlan,
}

/// The state of the planner after the last cycle or command.
#[derive(Clone, Copy, Debug)]
pub struct Status {
    /// Where the machine is to be, shape (9).
    pub position: Axes,
    /// LinuxCNC's number of the move that runs, or waits for the spindle; 0 if there is none.
    pub exec_id: i32,
    /// The tag of the last move that started, or that waits for nothing but to be planned or for the operator; it stays after
    /// the end, as with LinuxCNC's planner.
    pub tag: StateTag,
    /// The kind of the move that runs, `None` if there is none (LinuxCNC's 0).
    pub motion_type: Option<MotionType>,
    /// How many moves are queued, the running one included.
    pub queue_depth: usize,
    /// Whether no more moves should be sent.
    pub queue_full: bool,
    /// How many moves have been started and have not ended: 1 while a move runs, else 0.
    pub active_depth: usize,
    /// Whether there is nothing left to do and the machine is at rest.
    pub done: bool,
    /// Speed along the path, units of the move's measure per second.
    pub current_velocity: f64,
    /// The feed that the running move asks for at 100 %, 0 if there is none.
    pub requested_velocity: f64,
    /// What is left of the running move, units of its measure.
    pub distance_to_go: f64,
    /// End of the running move less position, shape (9).
    pub axis_distance_to_go: Axes,
    /// The override bits of the running move, `None` if there is none: those in effect now apply.
    pub enables: Option<u8>,
    /// Whether the next move waits for the spindles to be at speed.
    pub waiting_for_spindle: bool,
    /// Whether the machine is held, or is to come to rest, because of a pause.
    pub pausing: bool,
    /// Whether the moves are run back along the path.
    pub backwards: bool,
    /// Whether the machine is coming to rest after an abort; moves are refused.
    pub aborting: bool,
    /// Whether the next move waits for the index of its spindle.
    pub waiting_for_index: bool,
    /// Whether the machine moves with the angle of a spindle.
    pub following_spindle: bool,
    /// The spindle whose index is to be asked for in this cycle.
    pub index_request: Option<usize>,
    /// The spindle whose commanded speed is to be multiplied in this cycle, and by what.
    pub spindle_factor: Option<(usize, f64)>,
    /// Why a motion with a spindle was stopped in this cycle.
    pub spindle_error: Option<SpindleError>,
    /// What the lock of a rotary indexer is told in this cycle: its joint, and whether to unlock.
    pub indexer: Option<(i32, bool)>,
    /// What went wrong inside: the motion was stopped for it. Until an abort.
    pub fault: Option<Fault>,
    /// The outputs to be written in this cycle.
    pub outputs: SynchronisedOutputs,
}

impl Status {
    /// At the origin, with nothing to do.
    pub(super) const IDLE: Self = Self {
        position: ORIGIN,
        exec_id: 0,
        tag: StateTag::EMPTY,
        motion_type: None,
        queue_depth: 0,
        queue_full: false,
        active_depth: 0,
        done: true,
        current_velocity: 0.0,
        requested_velocity: 0.0,
        distance_to_go: 0.0,
        axis_distance_to_go: ORIGIN,
        enables: None,
        waiting_for_spindle: false,
        waiting_for_index: false,
        following_spindle: false,
        index_request: None,
        spindle_factor: None,
        spindle_error: None,
        indexer: None,
        pausing: false,
        backwards: false,
        aborting: false,
        fault: None,
        outputs: SynchronisedOutputs::NONE,
    };
}
