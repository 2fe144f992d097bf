//! The planner as hal-component/blendtp.c sees it: LinuxCNC's structures in, LinuxCNC's return codes out.
//!
//! There is one planner in a module, in static memory: motmod has one coordinated planner, and a module must not
//! allocate. LinuxCNC calls all of this either while modules are loaded or from the servo thread, never from two threads
//! at a time.

mod acknowledgement;
pub mod add;
pub mod run;
pub mod settings;
pub mod soft_limits;

use core::cell::UnsafeCell;
use core::ffi::CStr;
use core::mem::MaybeUninit;
use core::ptr;
use core::sync::atomic::{AtomicI32, AtomicU8};

use libc::{c_char, c_double, c_int};

use acknowledgement::{Acknowledgement, Answer};
use soft_limits::Kinematics;

use super::linuxcnc::{TP_STRUCT, emcmot_config_t, emcmot_status_t, tp_err_t};
use crate::axes::{AXIS_COUNT, Axes, AxisLimits};
use crate::planner::Planner;
use crate::planner::range::Finding;

/// The most moves that motmod may ask room for (it asks for 2000).
pub const FRAMEPATH_QUEUE_CAPACITY: c_int = 2000;

/// Functions of the motion controller that the planner calls.
type WriteDigital = Option<unsafe extern "C" fn(c_int, c_char)>;
type WriteAnalog = Option<unsafe extern "C" fn(c_int, c_double)>;
type SetUnlock = Option<unsafe extern "C" fn(c_int, c_int)>;
type GetUnlock = Option<unsafe extern "C" fn(c_int) -> c_int>;
type AxisLimit = Option<unsafe extern "C" fn(c_int) -> c_double>;

/// The planner of the module, with what LinuxCNC handed over for it.
pub struct Handle {
    planner: Planner,
    status: *mut emcmot_status_t,
    config: *mut emcmot_config_t,
    write_digital: WriteDigital,
    write_analog: WriteAnalog,
    set_unlock: SetUnlock,
    get_unlock: GetUnlock,
    velocity_limit: AxisLimit,
    acceleration_limit: AxisLimit,
    kinematics: Kinematics,
    jerk: Axes,
    /// Whether a programmed frame is in force.
    framed: bool,
    acknowledgement: Acknowledgement,
    refused: &'static CStr,
    /// What was found of the soft limits in the last servo period.
    finding: Option<Finding>,
}

/// Memory for the one planner of a module.
struct Memory(UnsafeCell<Handle>);

// SAFETY: LinuxCNC calls the planner from one thread at a time, see the head of this file.
unsafe impl Sync for Memory {}

static MEMORY: Memory = Memory(UnsafeCell::new(Handle {
    planner: Planner::new(),
    status: ptr::null_mut(),
    config: ptr::null_mut(),
    write_digital: None,
    write_analog: None,
    set_unlock: None,
    get_unlock: None,
    velocity_limit: None,
    acceleration_limit: None,
    kinematics: Kinematics::NONE,
    jerk: Axes::from_array_storage(nalgebra::ArrayStorage([[f64::INFINITY; AXIS_COUNT]])),
    framed: false,
    acknowledgement: Acknowledgement::NONE,
    refused: c"",
    finding: None,
}));

/// The planner of the module.
fn module() -> &'static mut Handle {
    // SAFETY: one thread at a time, and no function of this file hands the reference on or calls another one with it.
    unsafe { &mut *MEMORY.0.get() }
}

impl Handle {
    /// What motmod's status says of commands, if there is one.
    fn answer_to_task(&self) -> Option<Answer<'static>> {
        if self.status.is_null() {
            return None;
        }
        // SAFETY: motmod's status in shared memory for as long as the module is loaded. Only the servo thread writes it,
        // and who else has it mapped reads these at any time.
        unsafe {
            Some(Answer {
                command: AtomicI32::from_ptr(&raw mut (*self.status).commandNumEcho),
                changes: AtomicU8::from_ptr(&raw mut (*self.status).head),
            })
        }
    }

    /// Whether motmod hands over once more what is in the queue already; it has to take the answer of the first time.
    fn is_repeated(&self) -> bool {
        self.answer_to_task()
            .is_some_and(|answer| self.acknowledgement.is_repeated(&answer))
    }

    /// What each axis is able to do now; LinuxCNC's limits may be changed at any time through its ini.* pins.
    fn limits(&self) -> AxisLimits {
        let ask = |function: AxisLimit, axis: usize| match function {
            // SAFETY: motmod's own function for axis numbers 0 to 8, handed over by it.
            Some(function) => unsafe { function(axis as c_int) },
            None => 0.0,
        };
        AxisLimits {
            velocity: Axes::from_fn(|axis, _| ask(self.velocity_limit, axis)),
            acceleration: Axes::from_fn(|axis, _| ask(self.acceleration_limit, axis)),
            jerk: self.jerk,
        }
    }
}

/// A page is at least so many bytes.
const PAGE: usize = 4096;

/// Writes to each page of the planner's memory what is there: the kernel fetches a page when it is first written to, which
/// takes longer than a servo cycle should, and is done here instead, before there is a servo thread.
fn touch_memory() {
    let memory = MEMORY.0.get().cast::<MaybeUninit<u8>>();
    let mut offset = 0;
    while offset < size_of::<Handle>() {
        // SAFETY: a byte of the planner, which keeps its value; one thread at a time, see the head of this file.
        unsafe {
            let byte = memory.add(offset);
            byte.write_volatile(byte.read_volatile());
        }
        offset += PAGE;
    }
}

/// Makes the planner ready for a queue of `queue_size` moves. Null if that is more than there is room for.
///
/// # Safety
/// `tp` is motmod's planner structure, or null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_create(
    tp: *mut TP_STRUCT,
    queue_size: c_int,
) -> *mut Handle {
    // SAFETY: see above.
    let Some(tp) = (unsafe { tp.as_mut() }) else {
        return ptr::null_mut();
    };
    if !(0..=FRAMEPATH_QUEUE_CAPACITY).contains(&queue_size) {
        return ptr::null_mut();
    }
    touch_memory();
    let handle = module();
    handle.planner.clear();
    handle.report(tp);
    MEMORY.0.get()
}

/// The functions of the motion controller: motmod hands them over before it creates the planner.
#[unsafe(no_mangle)]
pub extern "C" fn framepath_planner_motion_functions(
    write_digital: Option<unsafe extern "C" fn(c_int, c_char)>,
    write_analog: Option<unsafe extern "C" fn(c_int, c_double)>,
    set_rotary_unlock: Option<unsafe extern "C" fn(c_int, c_int)>,
    get_rotary_unlock: Option<unsafe extern "C" fn(c_int) -> c_int>,
    velocity_limit: Option<unsafe extern "C" fn(c_int) -> c_double>,
    acceleration_limit: Option<unsafe extern "C" fn(c_int) -> c_double>,
) {
    let handle = module();
    handle.write_digital = write_digital;
    handle.write_analog = write_analog;
    handle.set_unlock = set_rotary_unlock;
    handle.get_unlock = get_rotary_unlock;
    handle.velocity_limit = velocity_limit;
    handle.acceleration_limit = acceleration_limit;
}

/// The motion controller's status and configuration: motmod hands them over before it creates the planner.
///
/// # Safety
/// Both live as long as the module, or are null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_motion_data(
    status: *mut emcmot_status_t,
    config: *mut emcmot_config_t,
) {
    let handle = module();
    handle.status = status;
    handle.config = config;
}

/// Does something with the planner, if there is one.
fn with(handle: *mut Handle, action: impl FnOnce(&mut Handle) -> c_int) -> c_int {
    // SAFETY: every caller promises a handle from `framepath_planner_create`, or null.
    unsafe { handle.as_mut() }.map_or(tp_err_t::TP_ERR_FAIL, action)
}

/// Does something with the planner, and reports its new state at once.
fn command(handle: *mut Handle, tp: *mut TP_STRUCT, action: impl FnOnce(&mut Handle)) -> c_int {
    // SAFETY: every caller promises a handle from `framepath_planner_create` and motmod's planner structure, or null.
    let (Some(handle), Some(tp)) = (unsafe { (handle.as_mut(), tp.as_mut()) }) else {
        return tp_err_t::TP_ERR_FAIL;
    };
    action(handle);
    handle.report(tp);
    tp_err_t::TP_ERR_OK
}
