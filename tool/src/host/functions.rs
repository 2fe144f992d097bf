//! The functions of a planner module (LinuxCNC's `tp.h`), found by name as motmod's loader does.

use crate::loaded::module::Module;
use framepath::abi::linuxcnc::{
    EmcPose, PmCartesian, TC_QUEUE_STRUCT, TP_STRUCT, emcmot_config_t, emcmot_status_t, state_tag_t,
};
use std::ffi::{c_char, c_int, c_long, c_uchar};

macro_rules! planner_functions {
    ($($(#[$only:meta])* $name:ident: fn($($argument:ty),*) $(-> $result:ty)?;)*) => {
        /// The functions of a module.
        #[allow(non_snake_case, reason = "the names are LinuxCNC's")]
        pub(super) struct Functions {
            $($(#[$only])* pub $name: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
        }

        impl Functions {
            fn find(module: Module) -> Result<Self, String> {
                Ok(Self {
                    $($(#[$only])* $name: {
                        let name = concat!(stringify!($name), "\0");
                        let address = module.symbol(name).ok_or(concat!(
                            "it is not a planner: ", stringify!($name), " is missing"
                        ))?;
                        // SAFETY: a planner module has this function with the type of tp.h.
                        unsafe {
                            std::mem::transmute::<
                                *mut libc::c_void,
                                unsafe extern "C" fn($($argument),*) $(-> $result)?,
                            >(address)
                        }
                    },)*
                })
            }
        }
    };
}

type Tp = *mut TP_STRUCT;

planner_functions! {
    tpMotFunctions: fn(
        extern "C" fn(c_int, c_char),
        extern "C" fn(c_int, f64),
        extern "C" fn(c_int, c_int),
        extern "C" fn(c_int) -> c_int,
        extern "C" fn(c_int) -> f64,
        extern "C" fn(c_int) -> f64
    );
    tpMotData: fn(*mut emcmot_status_t, *mut emcmot_config_t);
    tpCreate: fn(Tp, c_int, c_int) -> c_int;
    tpSetCycleTime: fn(Tp, f64) -> c_int;
    tpSetVmax: fn(Tp, f64, f64) -> c_int;
    tpSetVlimit: fn(Tp, f64) -> c_int;
    tpSetAmax: fn(Tp, f64) -> c_int;
    tpSetId: fn(Tp, c_int) -> c_int;
    tpSetTermCond: fn(Tp, c_int, f64) -> c_int;
    tpSetPos: fn(Tp, *const EmcPose) -> c_int;
    tpSetSpindleSync: fn(Tp, c_int, f64, c_int) -> c_int;
    #[cfg(not(linuxcnc_move_jerk))]
    tpAddLine: fn(
        Tp, EmcPose, c_int, f64, f64, f64, c_uchar, c_char, c_int, state_tag_t
    ) -> c_int;
    #[cfg(not(linuxcnc_move_jerk))]
    tpAddCircle: fn(
        Tp, EmcPose, PmCartesian, PmCartesian, c_int, c_int, f64, f64, f64, c_uchar, c_char,
        state_tag_t
    ) -> c_int;
    #[cfg(not(linuxcnc_move_jerk))]
    tpAddRigidTap: fn(Tp, EmcPose, f64, f64, f64, c_uchar, f64, state_tag_t) -> c_int;
    #[cfg(linuxcnc_move_jerk)]
    tpAddLine: fn(
        Tp, EmcPose, c_int, f64, f64, f64, f64, c_uchar, c_char, c_int, state_tag_t
    ) -> c_int;
    #[cfg(linuxcnc_move_jerk)]
    tpAddCircle: fn(
        Tp, EmcPose, PmCartesian, PmCartesian, c_int, c_int, f64, f64, f64, f64, c_uchar, c_char,
        state_tag_t
    ) -> c_int;
    #[cfg(linuxcnc_move_jerk)]
    tpAddRigidTap: fn(Tp, EmcPose, f64, f64, f64, f64, c_uchar, f64, state_tag_t) -> c_int;
    tpRunCycle: fn(Tp, c_long) -> c_int;
    tpPause: fn(Tp) -> c_int;
    tpResume: fn(Tp) -> c_int;
    tpAbort: fn(Tp) -> c_int;
    tpGetPos: fn(*const TP_STRUCT, *mut EmcPose) -> c_int;
    tpGetExecId: fn(Tp) -> c_int;
    tpGetExecTag: fn(Tp) -> state_tag_t;
    tpGetMotionType: fn(Tp) -> c_int;
    tpIsDone: fn(Tp) -> c_int;
    tpQueueDepth: fn(Tp) -> c_int;
    tpActiveDepth: fn(Tp) -> c_int;
    tcqFull: fn(*const TC_QUEUE_STRUCT) -> c_int;
}

/// Calls a function that adds a move, with what comes before, among and behind the limits of the
/// move. Since LinuxCNC 2.10 the last limit is that of the jerk along the path: 0, not limited.
macro_rules! add_move {
    ($function:expr, [$($before:expr),*], [$($limit:expr),*], [$($behind:expr),*]) => {{
        #[cfg(linuxcnc_move_jerk)]
        let result = $function($($before,)* $($limit,)* 0.0, $($behind),*);
        #[cfg(not(linuxcnc_move_jerk))]
        let result = $function($($before,)* $($limit,)* $($behind),*);
        result
    }};
}
pub(super) use add_move;

/// Loads a module and starts it as LinuxCNC does.
pub(super) fn load(file: &str) -> Result<Functions, String> {
    // as LinuxCNC's rtapi_app
    let module = Module::open(file, libc::RTLD_GLOBAL)?;
    let functions = Functions::find(module)?;
    if let Some(start) = module.symbol("rtapi_app_main\0") {
        // SAFETY: every module has this function with this type.
        let start: unsafe extern "C" fn() -> c_int = unsafe { std::mem::transmute(start) };
        // SAFETY: called once, before all others.
        let result = unsafe { start() };
        if result < 0 {
            return Err(format!("rtapi_app_main returned {result}"));
        }
    }
    Ok(functions)
}
