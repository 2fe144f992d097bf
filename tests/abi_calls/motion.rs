//! The motion controller's side of the planner: the structures that it shares, the functions that it hands over, and the
//! machine behind it.

use std::cell::{Cell, RefCell};
use std::ffi::{c_char, c_int, c_ulong};
use std::mem::MaybeUninit;
use std::sync::OnceLock;

use framepath::abi::linuxcnc::{
    EmcPose, KINEMATICS_TYPE, TP_STRUCT, emcmot_config_t, emcmot_status_t,
};
use framepath::abi::planner::settings::framepath_planner_set_cycle_time;
use framepath::abi::planner::soft_limits::framepath_planner_kinematics;
use framepath::abi::planner::{
    Handle, framepath_planner_create, framepath_planner_motion_data,
    framepath_planner_motion_functions,
};
use framepath::axes::AXIS_COUNT;

/// What an inverse kinematics does.
#[derive(Clone, Copy, Debug)]
pub enum Inverse {
    Identity,
    Refuses,
    NotANumber,
}

/// An output that the planner has written.
#[derive(Clone, Copy, Debug)]
pub struct Written {
    pub index: c_int,
    pub value: f64,
}

thread_local! {
    /// Velocity and acceleration of each axis.
    static LIMITS: Cell<[[f64; AXIS_COUNT]; 2]> = const { Cell::new([[0.0; AXIS_COUNT]; 2]) };
    static UNLOCKED: Cell<bool> = const { Cell::new(false) };
    static INVERSE: Cell<Inverse> = const { Cell::new(Inverse::Identity) };
    static WRITTEN: RefCell<Vec<Written>> = const { RefCell::new(Vec::new()) };
}

extern "C" fn write_digital(index: c_int, value: c_char) {
    let value = f64::from(value);
    WRITTEN.with_borrow_mut(|written| written.push(Written { index, value }));
}

extern "C" fn write_analog(index: c_int, value: f64) {
    WRITTEN.with_borrow_mut(|written| written.push(Written { index, value }));
}

extern "C" fn set_unlock(_joint: c_int, unlock: c_int) {
    UNLOCKED.set(unlock != 0);
}

extern "C" fn get_unlock(_joint: c_int) -> c_int {
    UNLOCKED.get().into()
}

fn limit(kind: usize, axis: c_int) -> f64 {
    let axis = usize::try_from(axis).expect("an axis");
    LIMITS.get()[kind][axis]
}

extern "C" fn velocity_limit(axis: c_int) -> f64 {
    limit(0, axis)
}

extern "C" fn acceleration_limit(axis: c_int) -> f64 {
    limit(1, axis)
}

unsafe extern "C" fn inverse(
    pose: *const EmcPose,
    joints: *mut f64,
    _: *const c_ulong,
    _: *mut c_ulong,
) -> c_int {
    // SAFETY: the planner hands over a pose and room for 16 joints.
    unsafe {
        let tran = (*pose).tran;
        for (joint, value) in [tran.x, tran.y, tran.z].into_iter().enumerate() {
            *joints.add(joint) = match INVERSE.get() {
                Inverse::Identity | Inverse::Refuses => value,
                Inverse::NotANumber => f64::NAN,
            };
        }
    }
    match INVERSE.get() {
        Inverse::Identity | Inverse::NotANumber => 0,
        Inverse::Refuses => -1,
    }
}

/// What is shared with the planner. Raw, since the planner keeps pointers to it as well.
pub struct Shared {
    pub handle: *mut Handle,
    pub tp: *mut TP_STRUCT,
    pub status: *mut emcmot_status_t,
    pub config: *mut emcmot_config_t,
}

impl Shared {
    /// A planner as it is when the module has been loaded, handed everything that motmod hands over.
    pub fn new() -> Self {
        let tp = zeroed();
        let mut shared = Self {
            handle: std::ptr::null_mut(),
            tp,
            status: zeroed(),
            config: zeroed(),
        };
        LIMITS.set([[0.0; AXIS_COUNT]; 2]);
        UNLOCKED.set(false);
        INVERSE.set(Inverse::Identity);
        shared.take_written();
        as_loaded(tp);
        shared.hand_over_functions(true);
        shared.hand_over_data(true);
        // SAFETY: `tp` lives as long as `shared`.
        shared.handle = unsafe { framepath_planner_create(tp, 2000) };
        shared
    }

    /// Axes of 100 units a second and 1000 units per second squared, overrides of 100 %, a servo period of 1 ms.
    pub fn make_ready(&mut self) {
        self.set_limits([[100.0; AXIS_COUNT], [1000.0; AXIS_COUNT]]);
        let status = self.status();
        (status.feed_scale, status.rapid_scale, status.net_feed_scale) = (1.0, 1.0, 1.0);
        // SAFETY: a handle and motmod's structure.
        assert_eq!(0, unsafe {
            framepath_planner_set_cycle_time(self.handle, self.tp, 1e-3)
        });
    }

    pub fn status(&mut self) -> &mut emcmot_status_t {
        // SAFETY: lives as long as self; the planner does not run while the reference is in use.
        unsafe { &mut *self.status }
    }

    pub fn config(&mut self) -> &mut emcmot_config_t {
        // SAFETY: as above.
        unsafe { &mut *self.config }
    }

    pub fn tp(&self) -> &TP_STRUCT {
        // SAFETY: as above.
        unsafe { &*self.tp }
    }

    pub fn hand_over_functions(&self, present: bool) {
        if present {
            framepath_planner_motion_functions(
                Some(write_digital),
                Some(write_analog),
                Some(set_unlock),
                Some(get_unlock),
                Some(velocity_limit),
                Some(acceleration_limit),
            );
        } else {
            framepath_planner_motion_functions(None, None, None, None, None, None);
        }
    }

    pub fn hand_over_data(&self, present: bool) {
        let null = (std::ptr::null_mut(), std::ptr::null_mut());
        let (status, config) = if present {
            (self.status, self.config)
        } else {
            null
        };
        // SAFETY: they live as long as self, which is the last to call the planner.
        unsafe { framepath_planner_motion_data(status, config) }
    }

    pub fn hand_over_inverse(&self, kinematics: Option<Inverse>) {
        INVERSE.set(kinematics.unwrap_or(Inverse::Identity));
        // Lines are looked at, too.
        framepath_planner_kinematics(
            kinematics.map(|_| inverse as _),
            None,
            KINEMATICS_TYPE::KINEMATICS_BOTH,
        );
    }

    pub fn limits(&self) -> [[f64; AXIS_COUNT]; 2] {
        LIMITS.get()
    }

    pub fn set_limits(&self, limits: [[f64; AXIS_COUNT]; 2]) {
        LIMITS.set(limits);
    }

    pub fn set_unlocked(&self, unlocked: bool) {
        UNLOCKED.set(unlocked);
    }

    /// What the planner has written since the last time.
    pub fn take_written(&self) -> Vec<Written> {
        WRITTEN.take()
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        self.hand_over_data(false);
        // SAFETY: made from boxes, and the planner has let go of them.
        unsafe {
            drop(Box::from_raw(self.tp));
            drop(Box::from_raw(self.status));
            drop(Box::from_raw(self.config));
        }
    }
}

/// A structure of plain numbers and truth values, for all of which zero is a value.
fn zeroed<T: Copy>() -> *mut T {
    // SAFETY: see above.
    Box::into_raw(Box::new(unsafe { std::mem::zeroed() }))
}

/// The planner's memory as it was when the program began: what a case leaves in it must not reach the next one.
fn as_loaded(tp: *mut TP_STRUCT) {
    struct Image(Box<MaybeUninit<Handle>>);
    // SAFETY: only copied from; the pointers in it are null.
    unsafe impl Send for Image {}
    // SAFETY: as above.
    unsafe impl Sync for Image {}
    static LOADED: OnceLock<Image> = OnceLock::new();
    // SAFETY: `tp` is a planner structure.
    let memory = unsafe { framepath_planner_create(tp, 0) };
    let loaded = LOADED.get_or_init(|| {
        let mut image = Box::new_uninit();
        // SAFETY: the planner owns no memory elsewhere; `memory` is its only instance.
        unsafe { std::ptr::copy_nonoverlapping(memory, image.as_mut_ptr(), 1) };
        Image(image)
    });
    // SAFETY: as above, the other way.
    unsafe { std::ptr::copy_nonoverlapping(loaded.0.as_ptr(), memory, 1) };
}
