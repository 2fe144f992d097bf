//! What motmod sets between moves.

use core::ops::RangeInclusive;

use libc::{c_double, c_int, c_uchar, c_uint};
use nalgebra::Matrix3;

use super::handle::{Handle, command, with};
use crate::abi::linuxcnc::{EmcPose, TP_STRUCT, tc_direction_t, tp_err_t};
use crate::abi::pose::axes_of;
use crate::axes::{AXIS_COUNT, Axes};
use crate::machine_map::MachineMap;
use crate::moves::{OUTPUT_COUNT, TerminationCondition};
use crate::planner::{Blending, BlendingError, DirectionError, JerkLimit};

/// Sets the greatest jerk of each of the nine axes, 0 = not limited. Returns -1, or the number of the first axis whose
/// value makes no sense; then nothing changes, and `least` is the smallest one that would. In `unlimited` a bit is set for
/// each axis, 1 for the first one, whose value is more than can be used: it counts as not limited.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `jerk` has nine numbers; the others point to one each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_jerk(
    handle: *mut Handle,
    jerk: *const c_double,
    least: *mut c_double,
    unlimited: *mut c_uint,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(jerk), Some(least), Some(unlimited)) = (unsafe {
        (
            handle.as_mut(),
            jerk.cast::<[f64; AXIS_COUNT]>().as_ref(),
            least.as_mut(),
            unlimited.as_mut(),
        )
    }) else {
        return 0;
    };
    let limits = handle.limits();
    let period = handle.planner.period();
    *unlimited = 0;
    let mut usable = Axes::zeros();
    for (axis, value) in jerk.iter().enumerate() {
        match JerkLimit::new(*value, limits.acceleration[axis], period) {
            JerkLimit::Limited(limit) => usable[axis] = limit,
            JerkLimit::Unlimited { asked } => {
                usable[axis] = f64::INFINITY;
                *unlimited |= c_uint::from(asked) << axis;
            }
            JerkLimit::Refused { smallest } => {
                *least = smallest;
                return axis as c_int;
            }
        }
    }
    handle.jerk = usable;
    -1
}

/// What [`framepath_planner_set_blending`] answers where the length of a millimetre makes no sense.
pub const FRAMEPATH_BAD_MILLIMETRE: c_int = 1;
/// The same for the tolerance of rotary axes.
pub const FRAMEPATH_BAD_ROTARY_TOLERANCE: c_int = 2;
/// The same for the tolerance of G64 without P.
pub const FRAMEPATH_BAD_DEFAULT_TOLERANCE: c_int = 3;
/// The run cannot be reversed here: no moves are remembered, or one that does not run backwards.
pub const FRAMEPATH_NOTHING_TO_REVERSE: c_int = -2;

/// The run is turned at rest only, and the machine moves.
pub const FRAMEPATH_TURNED_AT_REST_ONLY: c_int = -3;

/// The tolerance of runs of short moves under G64 without P where the configuration says nothing, machine units.
pub const FRAMEPATH_DEFAULT_TOLERANCE: c_double = 0.02;
const _: () = assert!(FRAMEPATH_DEFAULT_TOLERANCE == Blending::DEFAULT_TOLERANCE);

/// Sets the length of a millimetre in machine units, how far rotary axes may leave the program (degrees, 0 = as many as
/// P has millimetres), and the tolerance of runs of short moves under G64 without P (machine units). Holds from the next
/// rest on. Returns 0, or one of the codes above; then nothing changes.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_blending(
    handle: *mut Handle,
    millimetre: c_double,
    rotary_tolerance: c_double,
    default_tolerance: c_double,
) -> c_int {
    with(handle, |handle| {
        let set = handle
            .planner
            .set_blending(millimetre, rotary_tolerance, default_tolerance);
        match set {
            Ok(()) => 0,
            Err(BlendingError::Millimetre) => FRAMEPATH_BAD_MILLIMETRE,
            Err(BlendingError::RotaryTolerance) => FRAMEPATH_BAD_ROTARY_TOLERANCE,
            Err(BlendingError::DefaultTolerance) => FRAMEPATH_BAD_DEFAULT_TOLERANCE,
        }
    })
}

/// Says whether corners are rounded on their inner side only: where not 0 none swings out. Holds from the next rest on.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_corners_inside(handle: *mut Handle, inside: c_int) {
    // SAFETY: see above.
    if let Some(handle) = unsafe { handle.as_mut() } {
        handle.planner.set_corners_inside(inside != 0);
    }
}

/// Says which axis tilts the tool while C turns it, 3 for A, 4 for B, where the coordinates of the program are those of its
/// tip: the tolerance of rotary axes is then one of the tool axis. Any other number: none does. Holds from the next rest on.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_tool_tilt_axis(handle: *mut Handle, axis: c_int) {
    // SAFETY: see above.
    if let Some(handle) = unsafe { handle.as_mut() } {
        handle.planner.set_tilt_axis(usize::try_from(axis).ok());
    }
}

/// Says whether a frame is in force, and how the axes of the program lie to those of the machine behind it: three rows
/// of a 3x3 map of X Y Z. The map is taken while nothing is queued, since a frame changes only at standstill; otherwise it is left as it is. Behind one with an element that is not a number or greater than 1e4 no move is taken.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `map` has nine numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_machine_map(
    handle: *mut Handle,
    framed: c_int,
    map: *const c_double,
) {
    // SAFETY: see above.
    let (Some(handle), Some(map)) = (unsafe { (handle.as_mut(), map.cast::<[f64; 9]>().as_ref()) })
    else {
        return;
    };
    handle.framed = framed != 0;
    let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = *map;
    let map = Matrix3::new(xx, xy, xz, yx, yy, yz, zx, zy, zz);
    handle.usable_map = MachineMap::new(&map).is_some();
    handle.planner.set_machine_map(&map);
}

/// Servo periods that motion can be planned for, seconds.
const PERIODS: RangeInclusive<f64> = 1e-5..=0.1;

/// Sets the duration of a servo period in seconds. -1 if that is not possible now, or not one from 10 microseconds to 0.1 s.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_cycle_time(
    handle: *mut Handle,
    tp: *mut TP_STRUCT,
    seconds: c_double,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(tp)) = (unsafe { (handle.as_mut(), tp.as_mut()) }) else {
        return tp_err_t::TP_ERR_FAIL;
    };
    if !PERIODS.contains(&seconds) || !handle.planner.set_cycle_time(seconds) {
        return tp_err_t::TP_ERR_FAIL;
    }
    tp.cycleTime = seconds;
    tp_err_t::TP_ERR_OK
}

/// Sets what no move may exceed along its path, machine units per second.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_velocity_limit(
    handle: *mut Handle,
    velocity: c_double,
) -> c_int {
    with(handle, |handle| {
        handle.planner.set_velocity_limit(velocity);
        tp_err_t::TP_ERR_OK
    })
}

/// Sets LinuxCNC's number for the next move.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_id(handle: *mut Handle, id: c_int) -> c_int {
    with(handle, |handle| {
        handle.planner.set_id(id);
        tp_err_t::TP_ERR_OK
    })
}

/// Sets how the moves to come meet the next one (LinuxCNC's number, and P). -1 if the number or P makes no sense.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_termination(
    handle: *mut Handle,
    condition: c_int,
    tolerance: c_double,
) -> c_int {
    with(handle, |handle| {
        match TerminationCondition::from_number(condition, tolerance) {
            Some(termination) => {
                handle.planner.set_termination(termination);
                tp_err_t::TP_ERR_OK
            }
            None => tp_err_t::TP_ERR_FAIL,
        }
    })
}

/// Starts from a position, with everything else dropped. -1 if it has a coordinate that is not finite.
///
/// # Safety
/// `handle` from `framepath_planner_create`; the others point to LinuxCNC's structures.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_position(
    handle: *mut Handle,
    tp: *mut TP_STRUCT,
    position: *const EmcPose,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(tp), Some(position)) =
        (unsafe { (handle.as_mut(), tp.as_mut(), position.as_ref()) })
    else {
        return tp_err_t::TP_ERR_FAIL;
    };
    if handle.planner.set_position(&axes_of(position)).is_err() {
        return tp_err_t::TP_ERR_FAIL;
    }
    handle.report(tp);
    tp_err_t::TP_ERR_OK
}

/// Which spindle the moves to come follow, by how far in a turn of it (0: none), and whether by its speed only (feed per
/// turn) or by its angle (threads and rigid taps).
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_spindle_sync(
    handle: *mut Handle,
    spindle: c_int,
    distance_per_turn: c_double,
    velocity_mode: c_int,
) -> c_int {
    with(handle, |handle| {
        handle
            .planner
            .set_spindle_synchronisation(spindle, distance_per_turn, velocity_mode != 0);
        tp_err_t::TP_ERR_OK
    })
}

/// Gives the next move an analog output to write at its start. -1 if there is none of this number, which motion then tells
/// the operator, as of M68.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_analog_output(
    handle: *mut Handle,
    index: c_uchar,
    value: c_double,
) -> c_int {
    with(handle, |handle| {
        if handle.planner.set_analog_output(index.into(), value) {
            return tp_err_t::TP_ERR_OK;
        }
        if let Some(write) = handle
            .write_analog
            .filter(|_| usize::from(index) >= OUTPUT_COUNT)
        {
            // SAFETY: motmod's own function, which says that it has no output of this number, and writes none.
            unsafe { write(index.into(), value) };
        }
        tp_err_t::TP_ERR_FAIL
    })
}

/// Gives the next move a digital output to write at its start. -1 if there is none of this number, which motion then tells
/// the operator, as of M64 and M65.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_digital_output(
    handle: *mut Handle,
    index: c_int,
    value: c_uchar,
) -> c_int {
    with(handle, |handle| {
        let set = usize::try_from(index)
            .is_ok_and(|index| handle.planner.set_digital_output(index, value != 0));
        if set {
            return tp_err_t::TP_ERR_OK;
        }
        if let Some(write) = handle.write_digital {
            // SAFETY: motmod's own function, as for analog outputs.
            unsafe { write(index, (value != 0).into()) };
        }
        tp_err_t::TP_ERR_FAIL
    })
}

/// Chooses the direction of the run, see [`Planner::run_backwards`](crate::planner::Planner::run_backwards).
/// [`FRAMEPATH_TURNED_AT_REST_ONLY`] in motion, [`FRAMEPATH_NOTHING_TO_REVERSE`] where there is no way back.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `tp` motmod's planner structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_set_run_direction(
    handle: *mut Handle,
    tp: *mut TP_STRUCT,
    direction: c_int,
) -> c_int {
    let backwards = match direction {
        _ if direction == tc_direction_t::TC_DIR_FORWARD as c_int => false,
        _ if direction == tc_direction_t::TC_DIR_REVERSE as c_int => true,
        _ => return tp_err_t::TP_ERR_FAIL,
    };
    let mut turned = Ok(());
    let reported = command(handle, tp, |handle| {
        turned = handle.planner.run_backwards(backwards);
    });
    match turned {
        Ok(()) => reported,
        Err(DirectionError::Moving) => FRAMEPATH_TURNED_AT_REST_ONLY,
        Err(DirectionError::NoWayBack) => FRAMEPATH_NOTHING_TO_REVERSE,
    }
}
