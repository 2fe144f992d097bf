//! What an operator sees of the planner.

use libc::{c_double, c_int};

use super::handle::Handle;
use crate::planner::{Quantity, SpeedLimit};

/// There is nothing to do.
pub const FRAMEPATH_LIMIT_NOTHING: c_int = 0;
/// The machine rests between moves.
pub const FRAMEPATH_LIMIT_REST: c_int = 1;
/// Pause, feed hold or an abort.
pub const FRAMEPATH_LIMIT_HOLD: c_int = 2;
/// It waits for a spindle, or follows its angle.
pub const FRAMEPATH_LIMIT_SPINDLE: c_int = 3;
/// The feed of the program.
pub const FRAMEPATH_LIMIT_FEED: c_int = 4;
/// An override below 100 %.
pub const FRAMEPATH_LIMIT_OVERRIDE: c_int = 5;
/// The greatest velocity along the path.
pub const FRAMEPATH_LIMIT_PATH_VELOCITY: c_int = 6;
/// The velocity of an axis, or of a joint where joints have limits.
pub const FRAMEPATH_LIMIT_AXIS_VELOCITY: c_int = 7;
/// The acceleration of one.
pub const FRAMEPATH_LIMIT_AXIS_ACCELERATION: c_int = 8;
/// The jerk of one.
pub const FRAMEPATH_LIMIT_AXIS_JERK: c_int = 9;
/// On the way between two limits.
pub const FRAMEPATH_LIMIT_BETWEEN: c_int = 10;

/// What stands for no axis and no joint.
const NO_AXIS: c_int = -1;

/// What an operator sees, after a servo period.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FramepathSurvey {
    /// What keeps the machine from being faster: one of `FRAMEPATH_LIMIT_..`.
    pub limit: c_int,
    /// The axis whose limit it is, 0 to 8 (X Y Z A B C U V W of the machine), or -1.
    pub axis: c_int,
    /// The joint whose limit it is, from 0, or -1.
    pub joint: c_int,
    /// Moves that are queued, the running one included.
    pub moves_queued: c_int,
    /// Those of them that are planned.
    pub moves_ahead: c_int,
    /// Moves that have left the queue since the start of the machine, modulo 2^32: the number of the running one.
    pub moves_done: u32,
    /// LinuxCNC's number of the running or next move: its line in the program; 0 if there is none.
    pub line: c_int,
    /// Whether the machine stands still.
    pub stands: bool,
    /// What F counts until the end of that move, machine units or degrees.
    pub to_go: c_double,
    /// Seconds until the rest at the end of what is planned, at an override of 100 %.
    pub seconds_ahead: c_double,
    /// Seconds until the end of what is queued, at an override of 100 %.
    pub seconds_queued: c_double,
}

/// LinuxCNC counts in `int`; a queue of 2000 fits.
fn count(moves: usize) -> c_int {
    c_int::try_from(moves).unwrap_or(c_int::MAX)
}

/// The number of a limit, and the axis and the joint whose it is.
fn number_of(limit: SpeedLimit) -> [c_int; 3] {
    let of_quantity = |quantity| match quantity {
        Quantity::Velocity => FRAMEPATH_LIMIT_AXIS_VELOCITY,
        Quantity::Acceleration => FRAMEPATH_LIMIT_AXIS_ACCELERATION,
        Quantity::Jerk => FRAMEPATH_LIMIT_AXIS_JERK,
    };
    let number = match limit {
        SpeedLimit::Nothing => FRAMEPATH_LIMIT_NOTHING,
        SpeedLimit::Rest => FRAMEPATH_LIMIT_REST,
        SpeedLimit::Hold => FRAMEPATH_LIMIT_HOLD,
        SpeedLimit::Spindle => FRAMEPATH_LIMIT_SPINDLE,
        SpeedLimit::Feed => FRAMEPATH_LIMIT_FEED,
        SpeedLimit::Override => FRAMEPATH_LIMIT_OVERRIDE,
        SpeedLimit::PathVelocity => FRAMEPATH_LIMIT_PATH_VELOCITY,
        SpeedLimit::Between => FRAMEPATH_LIMIT_BETWEEN,
        SpeedLimit::Axis { axis, quantity } => {
            return [of_quantity(quantity), count(axis), NO_AXIS];
        }
        SpeedLimit::Joint { joint, quantity } => {
            return [of_quantity(quantity), NO_AXIS, count(joint)];
        }
    };
    [number, NO_AXIS, NO_AXIS]
}

/// What an operator sees after the last servo period. Returns 0, or -1 without a planner.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `survey` points to one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_survey(
    handle: *const Handle,
    survey: *mut FramepathSurvey,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(out)) = (unsafe { (handle.as_ref(), survey.as_mut()) }) else {
        return -1;
    };
    let survey = handle.planner.surveyed();
    let status = handle.planner.status();
    let [limit, axis, joint] = number_of(survey.limit);
    *out = FramepathSurvey {
        limit,
        axis,
        joint,
        moves_queued: count(status.queue_depth),
        moves_ahead: count(survey.moves_ahead),
        moves_done: handle.planner.moves_done() as u32,
        line: status.exec_id,
        stands: handle.planner.stands(),
        to_go: status.distance_to_go,
        seconds_ahead: survey.seconds_ahead,
        seconds_queued: survey.seconds_queued,
    };
    0
}
