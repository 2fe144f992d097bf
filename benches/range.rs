//! What the look along each move costs on a five-axis mill, through the functions that motmod calls and with LinuxCNC's own
//! xyzac-trt-kins: a move added, and a servo period with it. Printed with the look and without. Each time is the least
//! of some runs, since other programs must not count.
#![allow(unsafe_code)]

mod stock;

use std::ffi::c_void;
use std::mem::MaybeUninit;
use std::ptr;
use std::time::Duration;

use framepath::abi::linuxcnc::{
    EmcPose, KINEMATICS_TYPE, PmCartesian, TP_STRUCT, emcmot_config_t, emcmot_status_t, state_tag_t,
};
use framepath::abi::planner::{
    framepath_planner_create, framepath_planner_motion_data, framepath_planner_motion_functions,
};
use stock::StockKinematics;

type Inverse = unsafe extern "C" fn(*const EmcPose, *mut f64, *const u64, *mut u64) -> i32;
type Forward = unsafe extern "C" fn(*const f64, *mut EmcPose, *const u64, *mut u64) -> i32;

// As in framepath.h.
unsafe extern "C" {
    safe fn framepath_planner_kinematics(
        inverse: Option<Inverse>,
        forward: Option<Forward>,
        kinematics_type: u32,
    );
    fn framepath_planner_set_cycle_time(
        handle: *mut c_void,
        tp: *mut TP_STRUCT,
        seconds: f64,
    ) -> i32;
    fn framepath_planner_set_position(
        handle: *mut c_void,
        tp: *mut TP_STRUCT,
        position: *const EmcPose,
    ) -> i32;
    fn framepath_planner_set_termination(
        handle: *mut c_void,
        condition: i32,
        tolerance: f64,
    ) -> i32;
    fn framepath_planner_set_id(handle: *mut c_void, id: i32) -> i32;
    fn framepath_planner_add_line(
        handle: *mut c_void,
        tp: *mut TP_STRUCT,
        end: *const EmcPose,
        motion_type: i32,
        feed: f64,
        max_velocity: f64,
        enables: u8,
        at_speed: i8,
        indexer: i32,
        tag: *const state_tag_t,
    ) -> i32;
    fn framepath_planner_run_cycle(handle: *mut c_void, tp: *mut TP_STRUCT) -> i32;
    fn framepath_planner_queue_full(handle: *mut c_void) -> i32;
}

const RUNS: usize = 5;
const MOVES: usize = 20_000;

/// motmod's side.
struct Motion {
    handle: *mut c_void,
    tp: Box<TP_STRUCT>,
    status: Box<emcmot_status_t>,
    config: Box<emcmot_config_t>,
}

fn zeroed<T>() -> Box<T> {
    // SAFETY: LinuxCNC's structures are plain numbers and null pointers where all bytes are zero.
    Box::new(unsafe { MaybeUninit::zeroed().assume_init() })
}

unsafe extern "C" fn velocity(_axis: i32) -> f64 {
    200.0
}

unsafe extern "C" fn acceleration(_axis: i32) -> f64 {
    2000.0
}

impl Motion {
    fn new(kinematics: Option<&StockKinematics>) -> Self {
        let mut motion = Self {
            handle: ptr::null_mut(),
            tp: zeroed(),
            status: zeroed(),
            config: zeroed(),
        };
        motion.config.numJoints = 5;
        (
            motion.status.feed_scale,
            motion.status.rapid_scale,
            motion.status.net_feed_scale,
        ) = (1.0, 1.0, 1.0);
        for joint in &mut motion.status.joint_status {
            (joint.min_pos_limit, joint.max_pos_limit) = (-1000.0, 1000.0);
        }
        let (inverse, forward) = kinematics.map_or((None, None), |module| {
            (Some(module.inverse), Some(module.forward))
        });
        framepath_planner_motion_functions(
            None,
            None,
            None,
            None,
            Some(velocity),
            Some(acceleration),
        );
        framepath_planner_kinematics(inverse, forward, KINEMATICS_TYPE::KINEMATICS_BOTH);
        // SAFETY: structures that live as long as the planner is used.
        unsafe {
            framepath_planner_motion_data(&raw mut *motion.status, &raw mut *motion.config);
            motion.handle = framepath_planner_create(&raw mut *motion.tp, 2000).cast();
            framepath_planner_set_cycle_time(motion.handle, &raw mut *motion.tp, 1e-3);
            framepath_planner_set_position(motion.handle, &raw mut *motion.tp, &pose(0));
            framepath_planner_set_termination(motion.handle, 2, 0.01);
        }
        motion
    }

    fn add(&mut self, k: usize) {
        let tag = MaybeUninit::<state_tag_t>::zeroed();
        // SAFETY: as motmod calls it.
        let answer = unsafe {
            framepath_planner_set_id(self.handle, k as i32);
            framepath_planner_add_line(
                self.handle,
                &raw mut *self.tp,
                &pose(k),
                2,
                100.0,
                200.0,
                0x0f,
                0,
                -1,
                tag.as_ptr(),
            )
        };
        assert_eq!(answer, 0, "move {k}");
    }

    fn cycle(&mut self) {
        // SAFETY: as motmod calls it.
        unsafe {
            framepath_planner_run_cycle(self.handle, &raw mut *self.tp);
            framepath_planner_queue_full(self.handle);
        }
    }
}

/// A finishing pass of .2 mm moves in all five axes.
fn pose(k: usize) -> EmcPose {
    let s = 0.2 * k as f64;
    let tran = PmCartesian {
        x: 40.0 * (s / 40.0).sin(),
        y: 30.0 * (s / 35.0).cos(),
        z: 5.0 * (s / 11.0).sin(),
    };
    EmcPose {
        tran,
        a: 20.0 * (s / 60.0).sin(),
        b: 0.0,
        c: 90.0 * (s / 80.0).sin(),
        u: 0.0,
        v: 0.0,
        w: 0.0,
    }
}

/// What this thread has used of the processor so far.
fn now() -> Duration {
    let mut time = libc::timespec {
        tv_sec: 0,
        tv_nsec: 0,
    };
    // SAFETY: the address is that of a timespec, which the call fills.
    unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &mut time) };
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

/// For each servo period what a move took that was added in it, and the whole.
fn run(kinematics: Option<&StockKinematics>) -> Vec<[f64; 2]> {
    let mut motion = Motion::new(kinematics);
    let (mut spent, mut k) = (Vec::new(), 0);
    while k < MOVES {
        assert!(spent.len() < 20 * MOVES, "the machine does not move");
        let begin = now();
        if motion.tp.depth < 1000 {
            k += 1;
            motion.add(k);
        }
        let added = now();
        motion.cycle();
        let done = now();
        spent.push([added - begin, done - begin].map(|time| time.as_secs_f64() * 1e6));
    }
    spent
}

fn report(name: &str, times: impl Iterator<Item = f64>) {
    let mut times: Vec<f64> = times.collect();
    times.sort_by(f64::total_cmp);
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
    println!(
        "{name:44} mean {mean:6.2}  99.9 % {:6.2}  greatest {:6.2} microseconds",
        at(0.999),
        at(1.0)
    );
}

fn main() {
    let stock = StockKinematics::load("xyzac-trt-kins", "XYZAC");
    for (name, kinematics) in [("without the look", None), ("with it", Some(&stock))] {
        let mut least = run(kinematics);
        for _ in 1..RUNS {
            for (least, again) in least.iter_mut().zip(run(kinematics)) {
                *least = [least[0].min(again[0]), least[1].min(again[1])];
            }
        }
        report(
            &format!("a move added, {name}"),
            least.iter().map(|times| times[0]),
        );
        report(
            &format!("servo period and move, {name}"),
            least.iter().map(|times| times[1]),
        );
    }
}
