//! The planner as hal-component/blendtp.c sees it: LinuxCNC's structures in, LinuxCNC's return codes out.
//!
//! There is one planner in a module, in static memory: motmod has one coordinated planner, and a module must not
//! allocate. LinuxCNC calls all of this while modules are loaded, and later from the threads of its two functions. Those have to
//! be one: hal-component/blendtp.c takes no command on another thread than that of motion-controller
//! (hal-component/motion_threads.h), so that what is here is never called from two threads at a time.

mod acknowledgement;
pub mod add;
mod handle;
pub mod joint_kinematics;
pub mod joint_limits;
pub mod kinematics_module;
mod path_motion;
pub mod run;
pub mod settings;
pub mod soft_limits;
pub mod survey;

use core::ptr;

use libc::{c_char, c_double, c_int};

pub use handle::Handle;
use handle::{address, module, touch_memory};

use super::linuxcnc::{TP_STRUCT, emcmot_config_t, emcmot_status_t};

/// The most moves that motmod may ask room for (it asks for 2000).
pub const FRAMEPATH_QUEUE_CAPACITY: c_int = 2000;

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
    address()
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
