//! What a planner module shares with the motion controller: its own structure, status and
//! configuration, as motmod sets them up.

use super::job::Job;
use crate::canon::call::Tag;
use crate::path::Position;
use framepath::abi::linuxcnc::{
    EMCMOT_MOTION_COORD_BIT, EMCMOT_MOTION_ENABLE_BIT, EMCMOT_MOTION_INPOS_BIT, EmcPose,
    FH_ENABLED, FS_ENABLED, KINEMATICS_TYPE, PmCartesian, SS_ENABLED, StateFieldFloat, TP_STRUCT,
    emcmot_config_t, emcmot_error_t, emcmot_internal_t, emcmot_status_t, state_tag_t,
};
use framepath::abi::pose::axes_of;
use std::alloc::{Layout, alloc_zeroed, handle_alloc_error};
use std::ffi::{c_char, c_int};
use std::sync::OnceLock;

/// No limit of position is meant to bind, mm and degrees.
const FAR: f64 = 1e6;

/// Velocity and acceleration of each axis, for the module's questions.
static LIMITS: OnceLock<crate::machine::limits::Limits> = OnceLock::new();

pub(super) extern "C" fn write_digital(_index: c_int, _value: c_char) {}
pub(super) extern "C" fn write_analog(_index: c_int, _value: f64) {}
pub(super) extern "C" fn set_rotary_unlock(_axis: c_int, _unlock: c_int) {}
pub(super) extern "C" fn rotary_unlocked(_axis: c_int) -> c_int {
    1
}
pub(super) extern "C" fn velocity_limit(axis: c_int) -> f64 {
    let limits = LIMITS.get().copied().unwrap_or_default();
    let axis = usize::try_from(axis).unwrap_or(usize::MAX);
    limits.velocity.get(axis).copied().unwrap_or(0.0)
}
pub(super) extern "C" fn acceleration_limit(axis: c_int) -> f64 {
    let limits = LIMITS.get().copied().unwrap_or_default();
    let axis = usize::try_from(axis).unwrap_or(usize::MAX);
    limits.acceleration.get(axis).copied().unwrap_or(0.0)
}

/// The shared structures; they never move and never go.
pub(super) struct Machine {
    pub tp: *mut TP_STRUCT,
    pub status: *mut emcmot_status_t,
    pub config: *mut emcmot_config_t,
}

/// The same as motmod has them in shared memory, one behind the other: blendtp looks at that.
#[repr(C)]
struct Shared {
    status: emcmot_status_t,
    config: emcmot_config_t,
    error: emcmot_error_t,
    internal: emcmot_internal_t,
}

/// Memory for a C structure, all zero, as static memory in motmod is.
fn zeroed<T>() -> *mut T {
    let layout = Layout::new::<T>();
    // SAFETY: none of the structures is empty.
    let memory = unsafe { alloc_zeroed(layout) };
    if memory.is_null() {
        handle_alloc_error(layout);
    }
    memory.cast()
}

impl Machine {
    pub(super) fn new(job: &Job) -> Self {
        LIMITS.get_or_init(|| job.limits);
        let shared = zeroed::<Shared>();
        // SAFETY: memory of this type; addresses only.
        let machine = unsafe {
            Machine {
                tp: &raw mut (*shared).internal.coord_tp,
                status: &raw mut (*shared).status,
                config: &raw mut (*shared).config,
            }
        };
        machine.configure(job);
        machine.make_ready();
        machine
    }

    /// The settings of an INI file that says nothing about them.
    fn configure(&self, job: &Job) {
        // SAFETY: memory of this type, all zero, which nobody else knows yet.
        let config = unsafe { &mut *self.config };
        (config.numJoints, config.kinType) = match &job.joints {
            Some(joints) => (joints.count() as c_int, KINEMATICS_TYPE::KINEMATICS_BOTH),
            None => (9, KINEMATICS_TYPE::KINEMATICS_IDENTITY),
        };
        config.numSpindles = 1;
        config.numDIO = 4;
        config.numAIO = 4;
        config.trajCycleTime = job.period;
        config.servoCycleTime = job.period;
        config.interpolationRate = 1;
        config.limitVel = job.velocity_limit;
        config.arcBlendEnable = 1;
        config.arcBlendFallbackEnable = 0;
        config.arcBlendOptDepth = 50;
        config.arcBlendGapCycles = 4;
        config.arcBlendRampFreq = 100.0;
        config.arcBlendTangentKinkRatio = 0.1;
        config.maxFeedScale = job.greatest_override();
    }

    fn make_ready(&self) {
        // SAFETY: memory of this type, all zero, which nobody else knows yet.
        let status = unsafe { &mut *self.status };
        status.feed_scale = 1.0;
        status.rapid_scale = 1.0;
        status.net_feed_scale = 1.0;
        let enables = (FS_ENABLED | SS_ENABLED | FH_ENABLED) as u8;
        status.enables_new = enables;
        status.enables_queued = enables;
        status.motionFlag =
            (EMCMOT_MOTION_ENABLE_BIT | EMCMOT_MOTION_COORD_BIT | EMCMOT_MOTION_INPOS_BIT) as _;
        status.carte_pos_cmd_ok = 1;
        status.carte_pos_fb_ok = 1;
        for spindle in &mut status.spindle_status {
            spindle.scale = 1.0;
            spindle.net_scale = 1.0;
            spindle.at_speed = 1;
        }
        for axis in &mut status.axis_status {
            axis.max_pos_limit = FAR;
            axis.min_pos_limit = -FAR;
        }
        for joint in &mut status.joint_status {
            joint.max_pos_limit = FAR;
            joint.min_pos_limit = -FAR;
        }
    }
}

pub(super) fn pose(at: &Position) -> EmcPose {
    EmcPose {
        tran: point(&[at[0], at[1], at[2]]),
        a: at[3],
        b: at[4],
        c: at[5],
        u: at[6],
        v: at[7],
        w: at[8],
    }
}

pub(super) fn point(at: &[f64; 3]) -> PmCartesian {
    PmCartesian {
        x: at[0],
        y: at[1],
        z: at[2],
    }
}

pub(super) fn position(pose: &EmcPose) -> Position {
    axes_of(pose).into()
}

/// The state tag of a move, with P and Q as the interpreter put them there.
pub(super) fn state_tag(tag: &Tag, line: i32) -> state_tag_t {
    // SAFETY: plain numbers; LinuxCNC 2.10 has more of them.
    let mut made: state_tag_t = unsafe { std::mem::zeroed() };
    for (field, number) in [
        (StateFieldFloat::GM_FIELD_FLOAT_LINE_NUMBER, f64::from(line)),
        (StateFieldFloat::GM_FIELD_FLOAT_FEED, tag.feed),
        (StateFieldFloat::GM_FIELD_FLOAT_SPEED, tag.speed),
        (
            StateFieldFloat::GM_FIELD_FLOAT_PATH_TOLERANCE,
            tag.path_tolerance,
        ),
        (
            StateFieldFloat::GM_FIELD_FLOAT_NAIVE_CAM_TOLERANCE,
            tag.naive_cam_tolerance,
        ),
    ] {
        made.fields_float[field as usize] = number as _;
    }
    made.fields = tag.fields;
    made.packed_flags = tag.flags;
    made
}
