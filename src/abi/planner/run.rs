//! The servo cycle, the operator's commands, and what is reported after them.

use core::mem::MaybeUninit;
use core::ptr;

use libc::{c_char, c_double, c_int};

use super::handle::{Handle, command};
use crate::abi::linuxcnc::{
    EMCMOT_MAX_AIO, EMCMOT_MAX_DIO, EMCMOT_MOTION_ERROR_BIT, EMCMOT_MOTION_INPOS_BIT, EmcPose,
    TP_STRUCT, cmd_code_t, emcmot_status_t, state_tag_t, tc_direction_t, tp_err_t,
};
use crate::abi::pose::pose_of;
use crate::moves::{SPINDLE_COUNT, STATE_TAG_SIZE, StateTag};
use crate::planner::{CycleInputs, Fault, SpindleError, SpindleInputs};

/// LinuxCNC's number for "no move" where 0 is a number of a move.
const NO_MOVE: c_int = c_int::MIN;

impl Handle {
    /// Writes what motmod and the screens read: every cycle and after every command.
    pub(super) fn report(&mut self, tp: &mut TP_STRUCT) {
        let now = self.planner.status();
        tp.currentPos = pose_of(&now.position);
        tp.goalPos = pose_of(self.planner.goal());
        tp.execId = now.exec_id;
        tp.execTag = tag_out(&now.tag);
        tp.motionType = now.motion_type.map_or(0, |kind| kind as c_int);
        tp.done = now.done.into();
        tp.depth = now.queue_depth as c_int;
        tp.activeDepth = now.active_depth as c_int;
        tp.pausing = now.pausing.into();
        tp.aborting = now.aborting.into();
        tp.reverse_run = if now.backwards {
            tc_direction_t::TC_DIR_REVERSE
        } else {
            tc_direction_t::TC_DIR_FORWARD
        } as c_int;
        tp.queue._len = now.queue_depth as c_int;
        tp.spindle.waiting_for_index = if now.waiting_for_index {
            now.exec_id
        } else {
            NO_MOVE
        };
        tp.spindle.waiting_for_atspeed = if now.waiting_for_spindle {
            now.exec_id
        } else {
            NO_MOVE
        };
        // SAFETY: null, or motmod's status in shared memory for as long as the module is loaded.
        if let Some(status) = unsafe { self.status.as_mut() } {
            status.current_vel = now.current_velocity;
            status.requested_vel = now.requested_velocity;
            status.distance_to_go = now.distance_to_go;
            status.dtg = pose_of(&now.axis_distance_to_go);
            status.enables_queued = now.enables.unwrap_or(status.enables_new);
            status.tcqlen = now.queue_depth as u32;
            status.spindleSync = now.following_spindle.into();
        }
    }

    /// Tells the motion controller what the planner wants of spindles and of the locks of indexers.
    fn command_spindles(&mut self) {
        let now = self.planner.status();
        if let (Some((joint, unlock)), Some(set)) = (now.indexer, self.set_unlock) {
            // SAFETY: motmod's own function; it checks that the joint has a lock.
            unsafe { set(joint, unlock.into()) };
        }
        // SAFETY: null, or motmod's status in shared memory for as long as the module is loaded.
        let Some(status) = (unsafe { self.status.as_mut() }) else {
            return;
        };
        if let Some(spindle) = now
            .index_request
            .and_then(|number| status.spindle_status.get_mut(number))
        {
            spindle.spindle_index_enable = 1;
        }
        if let Some((number, factor)) = now.spindle_factor
            && let Some(spindle) = status.spindle_status.get_mut(number)
        {
            spindle.speed *= factor;
        }
        if self.planner.is_stopped_for_error() {
            // LinuxCNC's task then aborts the program.
            status.motionFlag |= EMCMOT_MOTION_ERROR_BIT as u16;
        }
    }

    /// The spindles as motmod knows them.
    fn spindles(&self, status: &emcmot_status_t, count: usize) -> [SpindleInputs; SPINDLE_COUNT] {
        let mut spindles = [SpindleInputs::STANDSTILL; SPINDLE_COUNT];
        for (inputs, spindle) in spindles.iter_mut().zip(&status.spindle_status).take(count) {
            *inputs = SpindleInputs {
                turns: spindle.spindleRevs,
                // spindle.N.speed-in counts turns a second, whatever LinuxCNC's header says.
                speed: spindle.spindleSpeedIn,
                commanded: spindle.speed.abs() / 60.0,
                reverse: spindle.direction < 0,
                awaits_index: spindle.spindle_index_enable != 0,
            };
        }
        spindles
    }

    /// Writes the synchronised outputs of the move that has just started.
    fn write_outputs(&self) {
        let outputs = &self.planner.status().outputs;
        if outputs.is_empty() {
            return;
        }
        if let Some(write) = self.write_digital {
            for (index, value) in outputs
                .digital()
                .take_while(|(index, _)| *index < EMCMOT_MAX_DIO as usize)
            {
                // SAFETY: motmod's own function; it checks the number against the outputs there are.
                unsafe { write(index as c_int, value.into()) };
            }
        }
        if let Some(write) = self.write_analog {
            for (index, value) in outputs
                .analog()
                .take_while(|(index, _)| *index < EMCMOT_MAX_AIO as usize)
            {
                // SAFETY: as above.
                unsafe { write(index as c_int, value) };
            }
        }
    }
}

fn tag_out(tag: &StateTag) -> state_tag_t {
    // SAFETY: of the same size, and either the bytes of a tag or zeros: plain numbers, for which every bit pattern is valid.
    unsafe { core::mem::transmute_copy::<[MaybeUninit<u8>; STATE_TAG_SIZE], state_tag_t>(&tag.0) }
}

/// What went wrong inside the planner, null if nothing did. The motion was stopped for it; an abort ends that.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_fault_text(handle: *const Handle) -> *const c_char {
    // SAFETY: see above.
    let fault = unsafe { handle.as_ref() }.and_then(|handle| handle.planner.status().fault);
    match fault {
        None => ptr::null(),
        Some(Fault::CellRefused) => c"the executor refused a period of the plan".as_ptr(),
        Some(Fault::Starved) => c"the executor had nothing left to run on".as_ptr(),
        Some(Fault::MoveRefused) => c"a move could not be put on the path".as_ptr(),
        Some(Fault::NoPlan) => c"no plan was found that keeps the limits".as_ptr(),
        Some(Fault::SettingsRefused) => {
            c"no path can be made with these limits and tolerances".as_ptr()
        }
        Some(Fault::LimitsRefused) => c"the executor refused the limits of the axes".as_ptr(),
    }
}

/// Why the motion with a spindle was stopped in the last servo period, null if it was not; with the numbers that belong to it: what the
/// thread asks for and what the axes allow, units per second.
///
/// # Safety
/// `handle` from `framepath_planner_create`; the others point to numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_spindle_error_text(
    handle: *const Handle,
    asked: *mut c_double,
    greatest: *mut c_double,
) -> *const c_char {
    // SAFETY: see above.
    let (Some(handle), Some(asked_out), Some(greatest_out)) =
        (unsafe { (handle.as_ref(), asked.as_mut(), greatest.as_mut()) })
    else {
        return ptr::null();
    };
    (*asked_out, *greatest_out) = (0.0, 0.0);
    match handle.planner.status().spindle_error {
        None => ptr::null(),
        Some(SpindleError::Stalled) => c"the spindle came to a stop in a thread or tap".as_ptr(),
        Some(SpindleError::Reversed) => c"the spindle turned back in a thread".as_ptr(),
        Some(SpindleError::Jumped) => {
            c"the angle of the spindle jumped in a thread or tap: look at spindle.N.revs, the encoder and its cable".as_ptr()
        }
        Some(SpindleError::NotReversed) => {
            c"the spindle did not turn back within ten turns of the end of a tap".as_ptr()
        }
        Some(SpindleError::NoIndex) => {
            c"the index of the spindle did not come, or its angle does not change in the direction that was commanded: look at spindle.N.index-enable and spindle.N.revs".as_ptr()
        }
        Some(SpindleError::Outrun { asked, greatest }) => {
            (*asked_out, *greatest_out) = (asked, greatest);
            c"the spindle is too fast for the thread: the axes would have to move faster than they are able to".as_ptr()
        }
    }
}

/// One servo period. Returns 0, or LinuxCNC's code 4 (waiting) while there is nothing to move.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_run_cycle(
    handle: *mut Handle,
    tp: *mut TP_STRUCT,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(tp)) = (unsafe { (handle.as_mut(), tp.as_mut()) }) else {
        return tp_err_t::TP_ERR_FAIL;
    };
    // SAFETY: null, or motmod's own structures for as long as the module is loaded.
    let (Some(status), Some(config)) =
        (unsafe { (handle.status.as_ref(), handle.config.as_ref()) })
    else {
        return tp_err_t::TP_ERR_FAIL;
    };
    let spindles = usize::try_from(config.numSpindles).unwrap_or(0);
    let inputs = CycleInputs {
        feed_scale: status.feed_scale,
        rapid_scale: status.rapid_scale,
        net_feed_scale: status.net_feed_scale,
        stepping: status.stepping != 0,
        spindles_at_speed: status
            .spindle_status
            .iter()
            .take(spindles)
            .all(|spindle| spindle.at_speed != 0),
        spindles: handle.spindles(status, spindles),
        indexer_unlocked: match (handle.planner.indexer_joint(), handle.get_unlock) {
            // SAFETY: motmod's own function; it checks that the joint has a lock.
            (Some(joint), Some(is_unlocked)) => (unsafe { is_unlocked(joint) }) != 0,
            _ => false,
        },
    };
    handle.renew_limits();
    handle.follow_joints();
    handle.check_range();
    handle.planner.cycle(&inputs);
    handle.planner.survey(&inputs);
    let now = handle.planner.status();
    let velocity = now.motion_type.map(|_| now.current_velocity);
    handle
        .path_motion
        .pass(velocity, &now.position, handle.planner.period());
    handle.write_outputs();
    handle.command_spindles();
    handle.report(tp);
    if handle.planner.status().queue_depth == 0 {
        tp_err_t::TP_ERR_WAITING
    } else {
        tp_err_t::TP_ERR_OK
    }
}

/// The acceleration along the path, units per second squared, its jerk, units per second cubed, and where X Y Z go, a
/// vector of length 1; all 0 without a move. Returns 0, or -1 without a planner.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `direction` has three numbers, the others point to one each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_path_motion(
    handle: *const Handle,
    acceleration: *mut c_double,
    jerk: *mut c_double,
    direction: *mut c_double,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(acceleration), Some(jerk), Some(direction)) = (unsafe {
        (
            handle.as_ref(),
            acceleration.as_mut(),
            jerk.as_mut(),
            direction.cast::<[f64; 3]>().as_mut(),
        )
    }) else {
        return -1;
    };
    let motion = &handle.path_motion;
    *acceleration = motion.acceleration;
    *jerk = motion.jerk;
    *direction = motion.direction.into();
    0
}

/// cbindgen:ignore
/// Has the planner fail, for tests of what happens then: see hal-component/fault_injection.h.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[cfg(feature = "fault-injection")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_inject_fault(handle: *mut Handle) {
    // SAFETY: see above.
    if let Some(handle) = unsafe { handle.as_mut() } {
        handle.planner.inject(Fault::NoPlan);
    }
}

/// Drops all moves.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_clear(handle: *mut Handle, tp: *mut TP_STRUCT) -> c_int {
    command(handle, tp, |handle| {
        handle.planner.clear();
        // SAFETY: null, or motmod's status for as long as the module is loaded.
        if let Some(status) = unsafe { handle.status.as_mut() } {
            status.motionFlag |= EMCMOT_MOTION_INPOS_BIT as u16;
        }
    })
}

/// Comes to rest on the path and stays there.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_pause(handle: *mut Handle, tp: *mut TP_STRUCT) -> c_int {
    command(handle, tp, |handle| handle.planner.pause())
}

/// Goes on after a pause.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_resume(
    handle: *mut Handle,
    tp: *mut TP_STRUCT,
) -> c_int {
    command(handle, tp, |handle| handle.planner.resume())
}

/// Comes to rest on the path, then drops all moves. Where an error has stopped the motion, only an abort that task
/// commands lifts that: motmod itself also calls this when it refuses a move.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `tp` is motmod's planner structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_abort(handle: *mut Handle, tp: *mut TP_STRUCT) -> c_int {
    command(handle, tp, |handle| {
        // SAFETY: null, or motmod's status for as long as the module is loaded.
        let commanded = unsafe { handle.status.as_ref() }
            .is_none_or(|status| status.commandEcho == cmd_code_t::EMCMOT_ABORT);
        if commanded {
            handle.planner.abort();
        } else {
            handle.planner.stop();
        }
    })
}

/// Where the machine is to be.
///
/// # Safety
/// `handle` from `framepath_planner_create`; `position` points to a pose.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_position(
    handle: *const Handle,
    position: *mut EmcPose,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(position)) = (unsafe { (handle.as_ref(), position.as_mut()) }) else {
        return tp_err_t::TP_ERR_FAIL;
    };
    *position = pose_of(&handle.planner.status().position);
    tp_err_t::TP_ERR_OK
}

/// Whether no more moves should be sent. motmod asks when the rest of its status is complete, at the end of a servo
/// period: from here on task may know that a move has been taken.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_queue_full(handle: *mut Handle) -> c_int {
    // SAFETY: see above.
    let Some(handle) = (unsafe { handle.as_mut() }) else {
        return 1;
    };
    if let Some(answer) = handle.answer_to_task() {
        handle.acknowledgement.give(&answer);
    }
    handle.planner.status().queue_full.into()
}
