//! The planner of the module, with what LinuxCNC handed over for it.

use core::cell::UnsafeCell;
use core::ffi::CStr;
use core::mem::MaybeUninit;
use core::ptr;
use core::sync::atomic::{AtomicI32, AtomicU8};

use libc::{c_char, c_double, c_int};

use super::acknowledgement::{Acknowledgement, Answer};
use super::kinematics_module::KinematicsModule;
use super::path_motion::PathMotion;
use crate::abi::linuxcnc::{TP_STRUCT, emcmot_config_t, emcmot_status_t, tp_err_t};
use crate::axes::{AXIS_COUNT, Axes, AxisLimits};
use crate::planner::Planner;
use crate::planner::range::Finding;

/// Functions of the motion controller that the planner calls.
type WriteDigital = Option<unsafe extern "C" fn(c_int, c_char)>;
type WriteAnalog = Option<unsafe extern "C" fn(c_int, c_double)>;
type SetUnlock = Option<unsafe extern "C" fn(c_int, c_int)>;
type GetUnlock = Option<unsafe extern "C" fn(c_int) -> c_int>;
type AxisLimit = Option<unsafe extern "C" fn(c_int) -> c_double>;

/// The planner of the module, with what LinuxCNC handed over for it.
pub struct Handle {
    pub(super) planner: Planner,
    pub(super) status: *mut emcmot_status_t,
    pub(super) config: *mut emcmot_config_t,
    pub(super) write_digital: WriteDigital,
    pub(super) write_analog: WriteAnalog,
    pub(super) set_unlock: SetUnlock,
    pub(super) get_unlock: GetUnlock,
    pub(super) velocity_limit: AxisLimit,
    pub(super) acceleration_limit: AxisLimit,
    pub(super) kinematics: KinematicsModule,
    pub(super) jerk: Axes,
    /// Whether joints have limits of their own, now or from the next rest on.
    pub(super) joints_limited: bool,
    /// Whether a programmed frame is in force.
    pub(super) framed: bool,
    /// Whether limits can be kept behind that frame.
    pub(super) usable_map: bool,
    pub(super) acknowledgement: Acknowledgement,
    pub(super) refused: &'static CStr,
    /// How it goes along the path.
    pub(super) path_motion: PathMotion,
    /// What was found of the soft limits in the last servo period.
    pub(super) finding: Option<Finding>,
}

/// Memory for the one planner of a module.
struct PlannerMemory(UnsafeCell<Handle>);

// SAFETY: LinuxCNC calls the planner from one thread at a time, see [`super`].
unsafe impl Sync for PlannerMemory {}

static MEMORY: PlannerMemory = PlannerMemory(UnsafeCell::new(Handle {
    planner: Planner::new(),
    status: ptr::null_mut(),
    config: ptr::null_mut(),
    write_digital: None,
    write_analog: None,
    set_unlock: None,
    get_unlock: None,
    velocity_limit: None,
    acceleration_limit: None,
    kinematics: KinematicsModule::NONE,
    jerk: Axes::from_array_storage(nalgebra::ArrayStorage([[f64::INFINITY; AXIS_COUNT]])),
    joints_limited: false,
    framed: false,
    usable_map: true,
    acknowledgement: Acknowledgement::NONE,
    refused: c"",
    path_motion: PathMotion::NONE,
    finding: None,
}));

/// The planner of the module.
pub(super) fn module() -> &'static mut Handle {
    // SAFETY: one thread at a time, and no function of this folder hands the reference on or calls another one with it.
    unsafe { &mut *MEMORY.0.get() }
}

impl Handle {
    /// What motmod's status says of commands, if there is one.
    pub(super) fn answer_to_task(&self) -> Option<Answer<'static>> {
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
    pub(super) fn is_repeated(&self) -> bool {
        self.answer_to_task()
            .is_some_and(|answer| self.acknowledgement.is_repeated(&answer))
    }

    /// What each axis is able to do now; LinuxCNC's limits may be changed at any time through its ini.* pins.
    pub(super) fn limits(&self) -> AxisLimits {
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
pub(super) fn touch_memory() {
    let memory = MEMORY.0.get().cast::<MaybeUninit<u8>>();
    let mut offset = 0;
    while offset < size_of::<Handle>() {
        // SAFETY: a byte of the planner, which keeps its value; there is no servo thread yet.
        unsafe {
            let byte = memory.add(offset);
            byte.write_volatile(byte.read_volatile());
        }
        offset += PAGE;
    }
}

/// Does something with the planner, if there is one.
pub(super) fn with(handle: *mut Handle, action: impl FnOnce(&mut Handle) -> c_int) -> c_int {
    // SAFETY: every caller promises a handle from `framepath_planner_create`, or null.
    unsafe { handle.as_mut() }.map_or(tp_err_t::TP_ERR_FAIL, action)
}

/// Does something with the planner, and reports its new state at once.
pub(super) fn command(
    handle: *mut Handle,
    tp: *mut TP_STRUCT,
    action: impl FnOnce(&mut Handle),
) -> c_int {
    // SAFETY: every caller promises a handle from `framepath_planner_create` and motmod's planner structure, or null.
    let (Some(handle), Some(tp)) = (unsafe { (handle.as_mut(), tp.as_mut()) }) else {
        return tp_err_t::TP_ERR_FAIL;
    };
    action(handle);
    handle.report(tp);
    tp_err_t::TP_ERR_OK
}

/// The memory of the planner, as C gets to see it.
pub(super) fn address() -> *mut Handle {
    MEMORY.0.get()
}
