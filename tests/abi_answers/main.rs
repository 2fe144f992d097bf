//! What the C interface of blendtp answers to single calls: each code, each word, each value handed on.
#![allow(unsafe_code)]

#[path = "../abi_calls/mod.rs"]
mod abi_calls;
mod spindle;

use std::ffi::c_int;
use std::sync::{Mutex, MutexGuard, PoisonError};

use abi_calls::motion::{Inverse, Shared};
use abi_calls::moves::{pose_of, tag};
use abi_calls::words;
use framepath::abi::linuxcnc::{
    EMCMOT_MOTION_ERROR_BIT, EMCMOT_MOTION_INPOS_BIT, PmCartesian, cmd_code_t, state_tag_t,
    tp_err_t,
};
use framepath::abi::planner::add::{
    framepath_planner_add_circle, framepath_planner_add_line, framepath_planner_add_rigid_tap,
    framepath_planner_error_text,
};
use framepath::abi::planner::run::{
    framepath_planner_abort, framepath_planner_clear, framepath_planner_queue_full,
    framepath_planner_run_cycle,
};
use framepath::abi::planner::settings::{
    framepath_planner_set_analog_output, framepath_planner_set_digital_output,
    framepath_planner_set_machine_map, framepath_planner_set_spindle_sync,
};
use framepath::abi::planner::soft_limits::{
    FRAMEPATH_LEAVES_RANGE, FRAMEPATH_STAYS_IN_RANGE, framepath_planner_range_finding,
};
use framepath::moves::{INCHES, INVERSE_TIME, UNITS_PER_MINUTE};

const IDENTITY: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// There is one planner in a process.
static ONE: Mutex<()> = Mutex::new(());

/// A planner that is ready for moves, at the origin.
struct Machine {
    shared: Shared,
    _one: MutexGuard<'static, ()>,
}

fn machine() -> Machine {
    let one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    let mut shared = Shared::new();
    shared.make_ready();
    assert_eq!(shared.tp().cycleTime, 1e-3);
    Machine { shared, _one: one }
}

impl Machine {
    fn line(&mut self, x: f64, kind: c_int, tag: &state_tag_t) -> c_int {
        let end = pose_of(&[x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        // SAFETY: a handle, and structures.
        unsafe {
            framepath_planner_add_line(
                self.shared.handle,
                self.shared.tp,
                &end,
                kind,
                50.0,
                100.0,
                0.0,
                0,
                0,
                -1,
                tag,
            )
        }
    }

    fn half_circle(&mut self, x: f64, kind: c_int, tag: &state_tag_t) -> c_int {
        self.half_circle_at([50.0, 100.0], x, kind, tag)
    }

    fn half_circle_at(
        &mut self,
        [feed, greatest]: [f64; 2],
        x: f64,
        kind: c_int,
        tag: &state_tag_t,
    ) -> c_int {
        let end = pose_of(&[x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let center = PmCartesian {
            x: (self.shared.tp().goalPos.tran.x + x) / 2.0,
            y: 0.0,
            z: 0.0,
        };
        let normal = PmCartesian {
            x: 0.0,
            y: 0.0,
            z: 1.0,
        };
        // SAFETY: a handle, and structures.
        unsafe {
            framepath_planner_add_circle(
                self.shared.handle,
                self.shared.tp,
                &end,
                &center,
                &normal,
                0,
                kind,
                feed,
                greatest,
                0.0,
                0,
                0,
                tag,
            )
        }
    }

    fn tap(&mut self, z: f64, scale: f64, tag: &state_tag_t) -> c_int {
        let end = pose_of(&[0.0, 0.0, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        // SAFETY: a handle, and structures.
        unsafe {
            framepath_planner_add_rigid_tap(
                self.shared.handle,
                self.shared.tp,
                &end,
                100.0,
                0.0,
                0,
                scale,
                tag,
            )
        }
    }

    fn follow_spindle(&mut self, spindle: c_int, per_turn: f64, velocity_mode: c_int) {
        // SAFETY: a handle.
        assert_eq!(0, unsafe {
            framepath_planner_set_spindle_sync(self.shared.handle, spindle, per_turn, velocity_mode)
        });
    }

    fn reason(&self) -> &str {
        // SAFETY: a handle.
        words(unsafe { framepath_planner_error_text(self.shared.handle) })
    }

    fn cycle(&mut self) -> c_int {
        // SAFETY: a handle and motmod's structure.
        unsafe { framepath_planner_run_cycle(self.shared.handle, self.shared.tp) }
    }

    /// Periods until there is nothing to do, with what is written in them.
    fn run(&mut self) -> Vec<(c_int, f64)> {
        let mut written = Vec::new();
        for _ in 0..5000 {
            self.cycle();
            let now = self.shared.take_written();
            written.extend(now.iter().map(|written| (written.index, written.value)));
            if self.shared.tp().done != 0 {
                return written;
            }
        }
        panic!("not done");
    }

    /// As task commands it.
    fn abort(&mut self) {
        self.shared.status().commandEcho = cmd_code_t::EMCMOT_ABORT;
        // SAFETY: a handle and motmod's structure.
        unsafe { framepath_planner_abort(self.shared.handle, self.shared.tp) };
    }

    fn set_map(&mut self, framed: bool) {
        self.scale_by(framed, 1.0);
    }

    fn scale_by(&mut self, framed: bool, scale: f64) {
        let map = IDENTITY.map(|element| element * scale);
        // SAFETY: a handle and nine numbers.
        unsafe {
            framepath_planner_set_machine_map(self.shared.handle, framed.into(), map.as_ptr());
        }
    }
}

fn coded(code: c_int) -> state_tag_t {
    let mut tag = tag();
    tag.fields[1] = code;
    tag
}

/// LinuxCNC hands over a small arc with what leaves room for the acceleration towards its centre.
#[test]
fn an_arc_that_was_slowed_down_is_as_fast_as_other_moves_with_the_same_f() {
    for (handed, number, flags, expected) in [
        ([20.0, 20.0], 3000.0, UNITS_PER_MINUTE, 50.0),
        ([20.0, 20.0], 3000.0, UNITS_PER_MINUTE | INCHES, 20.0),
        ([20.0, 20.0], 3000.0, UNITS_PER_MINUTE | INVERSE_TIME, 20.0),
        ([20.0, 20.0], 1800.0, UNITS_PER_MINUTE, 20.0),
        ([20.0, 25.0], 3000.0, UNITS_PER_MINUTE, 20.0),
    ] {
        let mut machine = machine();
        let of = |number, flags| {
            let mut tag = tag();
            tag.fields_float[1] = number;
            tag.packed_flags = flags;
            tag
        };
        assert_eq!(machine.line(1.0, 2, &of(3000.0, UNITS_PER_MINUTE)), 0);
        let tag = of(number, flags);
        assert_eq!(machine.half_circle_at(handed, 61.0, 3, &tag), 0);
        let mut greatest = 0.0f64;
        while machine.shared.tp().done == 0 || greatest == 0.0 {
            machine.cycle();
            if machine.shared.tp().execId == 1 {
                greatest = greatest.max(machine.shared.status().current_vel);
            }
        }
        assert!(
            (greatest - expected).abs() < 0.05,
            "{greatest}, not {expected}"
        );
    }
}

#[test]
fn what_means_the_machine_is_refused_in_a_frame_only() {
    let mut machine = machine();
    for code in [280, 300, 530] {
        machine.set_map(true);
        assert_eq!(machine.line(1.0, 1, &coded(code)), tp_err_t::TP_ERR_FAIL);
        assert!(machine.reason().contains("G28, G30 and G53"));
        assert_eq!(
            machine.half_circle(1.0, 3, &coded(code)),
            tp_err_t::TP_ERR_FAIL
        );
        machine.follow_spindle(0, 1.0, 0);
        assert_eq!(machine.tap(-5.0, 1.0, &coded(code)), tp_err_t::TP_ERR_FAIL);
        assert!(machine.reason().contains("G28, G30 and G53"));
        machine.follow_spindle(0, 0.0, 0);
        assert_eq!(machine.shared.tp().depth, 0);
        // A probing move has the tag of the move before it.
        assert_eq!(machine.line(1.0, 5, &coded(code)), 0);
        machine.run();
        assert_eq!(machine.line(0.0, 1, &tag()), 0);
        machine.run();
        machine.set_map(false);
        assert_eq!(machine.line(1.0, 1, &coded(code)), 0);
        machine.run();
        assert_eq!(machine.line(0.0, 1, &tag()), 0);
        machine.run();
    }
    machine.set_map(true);
    for code in [0, 10, 281, 531, -1] {
        assert_eq!(machine.line(1.0, 1, &coded(code)), 0);
        machine.run();
        assert_eq!(machine.line(0.0, 1, &tag()), 0);
        machine.run();
    }
}

#[test]
fn behind_a_frame_without_sense_no_move_is_taken() {
    let mut machine = machine();
    for scale in [f64::NAN, f64::INFINITY, 1.1e4, -1e300] {
        machine.scale_by(true, scale);
        assert_eq!(machine.line(1.0, 2, &tag()), tp_err_t::TP_ERR_FAIL);
        assert!(machine.reason().contains("the frame in force scales"));
        assert_eq!(machine.half_circle(1.0, 2, &tag()), tp_err_t::TP_ERR_FAIL);
        assert_eq!(machine.shared.tp().depth, 0);
        machine.scale_by(true, -3.0);
        assert_eq!(machine.line(1.0, 2, &tag()), 0);
        machine.run();
        assert_eq!(machine.line(0.0, 2, &tag()), 0);
        machine.run();
    }
}

#[test]
fn each_refusal_has_its_words() {
    let mut machine = machine();
    for kind in [0, 7, -1] {
        assert_eq!(machine.line(1.0, kind, &tag()), tp_err_t::TP_ERR_FAIL);
        assert!(machine.reason().contains("a line of a kind"));
        assert_eq!(machine.half_circle(1.0, kind, &tag()), -1);
        assert!(machine.reason().contains("an arc of a kind"));
    }
    assert_eq!(machine.line(0.0, 2, &tag()), tp_err_t::TP_ERR_ZERO_LENGTH);
    assert_eq!(machine.line(f64::NAN, 2, &tag()), -1);
    assert!(machine.reason().contains("not a number"));
    assert_eq!(machine.line(1e10, 2, &tag()), -1);
    assert!(machine.reason().contains("further than 1e7 units"));
    assert_eq!(machine.tap(-5.0, 1.0, &tag()), -1);
    assert!(machine.reason().contains("G33.1"));
    machine.follow_spindle(0, 1.0, 0);
    assert_eq!(machine.tap(-5.0, 0.0, &tag()), -1);
    assert!(machine.reason().contains("G33.1"));
    machine.follow_spindle(8, 1.0, 1);
    assert_eq!(machine.line(1.0, 2, &tag()), -1);
    assert!(machine.reason().contains("spindle that does not exist"));
    machine.follow_spindle(0, -1.0, 1);
    assert_eq!(machine.line(1.0, 2, &tag()), -1);
    assert!(machine.reason().contains("feed per turn"));
    machine.follow_spindle(0, 0.0, 0);
    machine.shared.set_limits([[0.0; 9], [1000.0; 9]]);
    assert_eq!(machine.line(1.0, 2, &tag()), -1);
    assert!(machine.reason().contains("MAX_VELOCITY"));
    machine.shared.set_limits([[100.0; 9], [1000.0; 9]]);
    assert_eq!(machine.line(10.0, 2, &tag()), 0);
    for _ in 0..50 {
        machine.cycle();
    }
    machine.abort();
    assert_eq!(machine.line(1.0, 2, &tag()), -1);
    assert!(machine.reason().contains("after an abort"));
}

#[test]
fn a_joint_beyond_its_soft_limit_is_named() {
    let mut machine = machine();
    machine.shared.hand_over_inverse(Some(Inverse::Identity));
    machine.shared.config().numJoints = 3;
    for joint in &mut machine.shared.status().joint_status {
        (joint.min_pos_limit, joint.max_pos_limit) = (-100.0, 100.0);
    }
    let finding = |machine: &Machine| {
        let (mut line, mut joint) = (0, -1);
        let (mut position, mut limit) = (0.0, 0.0);
        // SAFETY: a handle, and numbers.
        let code = unsafe {
            framepath_planner_range_finding(
                machine.shared.handle,
                &mut line,
                &mut joint,
                &mut position,
                &mut limit,
            )
        };
        (code, joint, position, limit)
    };
    assert_eq!(machine.half_circle(20.0, 3, &tag()), 0);
    machine.run();
    assert_eq!(finding(&machine).0, FRAMEPATH_STAYS_IN_RANGE);
    machine.shared.status().joint_status[1].max_pos_limit = 9.0;
    // Back over the other side: found before the machine begins with it, and said in one period.
    assert_eq!(machine.half_circle(0.0, 3, &tag()), 0);
    let mut found = Vec::new();
    for _ in 0..200 {
        machine.cycle();
        let period = finding(&machine);
        if period.0 != FRAMEPATH_STAYS_IN_RANGE {
            found.push(period);
        }
    }
    let [(code, joint, position, limit)] = found[..] else {
        panic!("{found:?}");
    };
    assert_eq!((code, joint, limit), (FRAMEPATH_LEAVES_RANGE, 1, 9.0));
    assert!((position - 10.0).abs() < 1e-6, "{position}");
    assert_eq!(machine.shared.tp().currentPos.tran.x, 20.0);
    let flags = machine.shared.status().motionFlag;
    assert_ne!(flags & EMCMOT_MOTION_ERROR_BIT as u16, 0);
    assert_eq!(machine.line(1.0, 2, &tag()), -1);
    assert!(machine.reason().contains("an error had stopped the motion"));
    machine.abort();
    machine.cycle();
    // An extra joint is none of the kinematics.
    machine.shared.config().numExtraJoints = 2;
    assert_eq!(machine.half_circle(0.0, 3, &tag()), 0);
    machine.run();
    assert_eq!(machine.shared.tp().currentPos.tran.x, 0.0);
}

#[test]
fn outputs_are_written_when_their_move_starts() {
    let mut machine = machine();
    // SAFETY: a handle.
    unsafe {
        let handle = machine.shared.handle;
        assert_eq!(framepath_planner_set_digital_output(handle, 63, 1), 0);
        assert_eq!(framepath_planner_set_digital_output(handle, 5, 0), 0);
        assert_eq!(framepath_planner_set_digital_output(handle, 64, 1), -1);
        assert_eq!(framepath_planner_set_digital_output(handle, -1, 1), -1);
        assert_eq!(framepath_planner_set_analog_output(handle, 63, 2.5), 0);
        assert_eq!(framepath_planner_set_analog_output(handle, 64, 2.5), -1);
        assert_eq!(framepath_planner_set_analog_output(handle, 0, f64::NAN), -1);
    }
    // Motion says that it has none of these; what is no number never reaches it.
    let told = machine.shared.take_written();
    let told: Vec<c_int> = told.iter().map(|written| written.index).collect();
    assert_eq!(told, [64, -1, 64]);
    assert_eq!(machine.line(1.0, 2, &tag()), 0);
    assert_eq!(machine.run(), [(5, 0.0), (63, 1.0), (63, 2.5)]);
}

#[test]
fn the_status_says_what_is_done() {
    let mut machine = machine();
    machine.shared.status().enables_new = 0x05;
    assert_eq!(machine.cycle(), tp_err_t::TP_ERR_WAITING);
    assert_eq!(machine.shared.status().enables_queued, 0x05);
    let mut marked = tag();
    marked.fields[3] = 77;
    assert_eq!(machine.line(10.0, 2, &marked), 0);
    assert_eq!(machine.shared.tp().goalPos.tran.x, 10.0);
    assert_eq!(machine.cycle(), tp_err_t::TP_ERR_OK);
    for _ in 0..100 {
        machine.cycle();
    }
    let tp = *machine.shared.tp();
    assert_eq!((tp.depth, tp.activeDepth, tp.motionType), (1, 1, 2));
    assert_eq!((tp.queue._len, tp.done, tp.reverse_run), (1, 0, 0));
    assert_eq!(tp.execTag.fields[3], 77);
    assert_eq!(tp.spindle.waiting_for_index, c_int::MIN);
    assert_eq!(tp.spindle.waiting_for_atspeed, c_int::MIN);
    let status = *machine.shared.status();
    assert!(status.current_vel > 10.0 && status.requested_vel == 50.0);
    assert!((status.distance_to_go - (10.0 - tp.currentPos.tran.x)).abs() < 1e-9);
    assert!((status.dtg.tran.x - status.distance_to_go).abs() < 1e-9);
    assert_eq!((status.enables_queued, status.tcqlen), (0, 1));
    assert_eq!(status.spindleSync, 0);
    machine.shared.status().motionFlag = 0;
    // SAFETY: a handle and motmod's structure.
    unsafe { framepath_planner_clear(machine.shared.handle, machine.shared.tp) };
    let flag = u32::from(machine.shared.status().motionFlag);
    assert_eq!(flag, EMCMOT_MOTION_INPOS_BIT);
    assert_eq!(machine.cycle(), tp_err_t::TP_ERR_WAITING);
}

#[test]
fn a_full_queue_is_said() {
    let mut machine = machine();
    let full = |machine: &Machine| {
        // SAFETY: a handle.
        unsafe { framepath_planner_queue_full(machine.shared.handle) }
    };
    for count in 0..2000 {
        assert_eq!(full(&machine), 0);
        assert_eq!(machine.line(f64::from(count + 1), 2, &tag()), 0);
        machine.shared.status().commandNumEcho = count;
    }
    assert_eq!(full(&machine), 1);
}
