//! Calls of the planner in the order and with the values that bytes say.

use std::ffi::c_int;
use std::ptr::{null, null_mut};

use framepath::abi::linuxcnc::{FS_ENABLED, TP_STRUCT, cmd_code_t};
use framepath::abi::planner::add::{framepath_planner_add_rigid_tap, framepath_planner_error_text};
use framepath::abi::planner::joint_limits::{
    FRAMEPATH_JOINTS_UNKNOWN, framepath_planner_set_joint_limits,
};
use framepath::abi::planner::run::{
    framepath_planner_abort, framepath_planner_clear, framepath_planner_fault_text,
    framepath_planner_pause, framepath_planner_position, framepath_planner_queue_full,
    framepath_planner_resume, framepath_planner_run_cycle,
};
use framepath::abi::planner::settings::{
    framepath_planner_set_cycle_time, framepath_planner_set_jerk,
    framepath_planner_set_machine_map, framepath_planner_set_position,
    framepath_planner_set_run_direction,
};
use framepath::abi::planner::soft_limits::{
    FRAMEPATH_STAYS_IN_RANGE, framepath_planner_finding_place, framepath_planner_range_finding,
};
use framepath::abi::planner::{Handle, framepath_planner_create};
use framepath::axes::AXIS_COUNT;

use super::choices::Choices;
use super::judge::{Judge, Kind, coordinates};
use super::motion::{Inverse, Shared};
use super::moves::pose_of;
use super::standing;

/// Servo periods and calls of a case, at most.
pub(super) const MOST_CYCLES: usize = 4_000;
const MOST_CALLS: usize = 2_500;

pub type Position = [f64; AXIS_COUNT];

/// Commands without values.
#[derive(Clone, Copy, Debug)]
pub enum Target {
    Pause,
    Resume,
    Abort,
    Clear,
}

/// A spindle as it turns.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spindle {
    /// Turns a second.
    pub(super) speed: f64,
    /// Servo periods to the index.
    pub(super) index_in: u8,
}

/// The planner with the motion controller in front of it.
pub struct Calls {
    pub shared: Shared,
    pub judge: Judge,
    /// Adaptive feed, 0 for feed hold.
    pub adaptive: f64,
    /// The number of the last command.
    pub(super) number: c_int,
    pub(super) spindles: [Spindle; 8],
    pub(super) cycles: usize,
    /// Whether the limits were always such as a machine has them.
    pub(super) sound: bool,
    /// Whether each call is printed.
    pub(super) told: bool,
}

/// Runs a case: no panic, and everything that [`Judge`] looks at. With FRAMEPATH_TELL in the environment each call is
/// printed.
pub fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let mut calls = Calls::new();
    calls.begin(&mut choices);
    for _ in 0..MOST_CALLS {
        if choices.is_spent() || calls.cycles > MOST_CYCLES {
            break;
        }
        calls.call(&mut choices);
    }
    if calls.sound {
        standing::abort_ends(&mut calls);
    }
    standing::goes_on(&mut calls);
}

impl Calls {
    fn new() -> Self {
        Self {
            shared: Shared::new(),
            judge: Judge::new(),
            adaptive: 1.0,
            number: 0,
            spindles: [Spindle::default(); 8],
            cycles: 0,
            sound: true,
            told: std::env::var_os("FRAMEPATH_TELL").is_some(),
        }
    }

    /// As motmod begins, with limits of this case.
    fn begin(&mut self, choices: &mut Choices) {
        let status = self.shared.status();
        (status.feed_scale, status.rapid_scale, status.enables_new) = (1.0, 1.0, 0x0f);
        for joint in &mut status.joint_status {
            (joint.min_pos_limit, joint.max_pos_limit) = (-1e4, 1e4);
        }
        let config = self.shared.config();
        (config.numJoints, config.numSpindles) = (9, 2);
        self.choose_limits(choices);
        self.choose_jerk(choices);
        let period = choices.one_of([1e-3, 1e-3, 1e-4, 2e-3, 1e-2]);
        self.set_cycle_time(period);
        self.set_velocity_limit(1e3);
        if choices.flag() {
            self.shared.hand_over_inverse(Some(Inverse::Identity));
        }
        self.check(Kind::Command);
    }

    pub fn check(&mut self, kind: Kind) {
        self.judge.check(&mut self.shared, kind);
    }

    fn call(&mut self, choices: &mut Choices) {
        match choices.below(128) {
            0..30 => self.choose_line(choices),
            30..40 => self.choose_arc(choices),
            40..62 => {
                for _ in 0..choices.one_of([1, 1, 3, 10, 30, 100]) {
                    self.cycle();
                }
            }
            62..66 => self.choose_short_moves(choices),
            66..69 => self.choose_tap(choices),
            69..76 => self.choose_termination(choices),
            76..80 => self.choose_spindle(choices),
            80..85 => self.choose_scales(choices),
            85..88 => self.command(Target::Pause),
            88..93 => self.command(Target::Resume),
            93..95 => self.command(Target::Abort),
            95 => self.command(Target::Clear),
            96..98 => self.choose_position(choices),
            98..102 => self.choose_direction(choices),
            102..104 => self.step(),
            104..107 => self.choose_limits_of_one(choices),
            107 => self.choose_limits(choices),
            108 => self.choose_jerk(choices),
            109..111 => self.choose_period(choices),
            111..114 => self.choose_slider(choices),
            114..116 => self.choose_map(choices),
            116..118 => self.choose_blending(choices),
            118..121 => self.choose_outputs(choices),
            121 => self.set_id(choices.integer(100)),
            122..124 => self.choose_turning(choices),
            124 => self.choose_kinematics(choices),
            125 => self.create_again(choices),
            126 => self.hand_over_less(choices),
            _ => self.call_with_nothing(),
        }
    }

    /// Prints a call, with the servo period that it is made in.
    pub(super) fn tell(&self, what: std::fmt::Arguments) {
        if self.told {
            eprintln!("{:5} {what}", self.cycles);
        }
    }

    // ---- servo periods ----

    pub fn cycle(&mut self) {
        self.cycles += 1;
        self.turn_spindles();
        let tp = *self.shared.tp();
        let adaptive = self.adaptive;
        let status = self.shared.status();
        let overridden = match tp.motionType {
            1 => status.rapid_scale,
            _ => status.feed_scale,
        };
        let enabled = u32::from(status.enables_queued) & FS_ENABLED != 0;
        status.net_feed_scale = adaptive * if enabled { overridden } else { 1.0 };
        self.judge.limits_asked(self.shared.limits());
        // SAFETY: a handle of the planner and motmod's structure.
        let answer = unsafe { framepath_planner_run_cycle(self.shared.handle, self.shared.tp) };
        let now = *self.shared.tp();
        assert_eq!(answer, if now.depth == 0 { 4 } else { 0 });
        self.check(Kind::Cycle);
        if self.shared.status().stepping != 0 && now.execId != tp.execId {
            self.shared.status().stepping = 0;
            self.command(Target::Pause);
        }
        self.end_period();
    }

    /// motmod asks for room at the end of the period; then its answer has to stand.
    fn end_period(&mut self) {
        // SAFETY: a handle of the planner.
        let full = unsafe { framepath_planner_queue_full(self.shared.handle) };
        assert_eq!(full != 0, self.shared.tp().depth >= 2000);
        assert_eq!(self.shared.status().commandNumEcho, self.number);
    }

    fn turn_spindles(&mut self) {
        let period = self.judge.period;
        let status = self.shared.status();
        for (spindle, shown) in self.spindles.iter_mut().zip(&mut status.spindle_status) {
            let wanted = shown.speed / 60.0;
            spindle.speed += (wanted - spindle.speed) * 0.05;
            shown.spindleSpeedIn = spindle.speed;
            shown.spindleRevs += spindle.speed * period;
            if shown.spindle_index_enable != 0 {
                spindle.index_in = spindle.index_in.saturating_sub(1);
                if spindle.index_in == 0 {
                    (shown.spindle_index_enable, shown.spindleRevs) = (0, 0.0);
                }
            } else {
                spindle.index_in = 20;
            }
        }
    }

    // ---- what an operator does ----

    pub fn command(&mut self, target: Target) {
        self.tell(format_args!("{target:?}"));
        let (handle, tp) = (self.shared.handle, self.shared.tp);
        // SAFETY: a handle of the planner and motmod's structure.
        let answer = unsafe {
            match target {
                Target::Pause => framepath_planner_pause(handle, tp),
                Target::Resume => framepath_planner_resume(handle, tp),
                Target::Abort => {
                    self.shared.status().commandEcho = cmd_code_t::EMCMOT_ABORT;
                    framepath_planner_abort(handle, tp)
                }
                Target::Clear => framepath_planner_clear(handle, tp),
            }
        };
        assert_eq!(answer, 0);
        if matches!(target, Target::Clear) {
            self.judge.next_id = 0;
            assert!(self.shared.tp().done != 0);
        }
        self.check(Kind::Command);
    }

    pub fn place(&mut self, position: &Position) {
        self.tell(format_args!("position {position:?}"));
        // SAFETY: a handle of the planner, and structures.
        let answer = unsafe {
            framepath_planner_set_position(self.shared.handle, self.shared.tp, &pose_of(position))
        };
        let finite = position.iter().all(|value| value.is_finite());
        assert_eq!(answer, if finite { 0 } else { -1 });
        if finite {
            assert_eq!(coordinates(&self.shared.tp().currentPos), *position);
        }
        self.check(if finite { Kind::Placed } else { Kind::Command });
    }

    fn choose_position(&mut self, choices: &mut Choices) {
        let mut position = [0.0; AXIS_COUNT];
        for coordinate in &mut position {
            *coordinate = choices.between(-100.0, 100.0);
        }
        // As motmod does it; otherwise something has to stand that does.
        if choices.flag() {
            self.command(Target::Clear);
        }
        self.place(&position);
    }

    fn choose_direction(&mut self, choices: &mut Choices) {
        let direction = choices.one_of([1, 0]);
        let direction = choices.integer(direction);
        // SAFETY: a handle of the planner and motmod's structure.
        let answer = unsafe {
            framepath_planner_set_run_direction(self.shared.handle, self.shared.tp, direction)
        };
        self.tell(format_args!("direction {direction}: {answer}"));
        assert!((-3..=0).contains(&answer));
        let turned = self.shared.tp().reverse_run == direction;
        assert!(answer != 0 || turned, "the direction was not taken");
        self.check(Kind::Command);
    }

    fn step(&mut self) {
        self.tell(format_args!("step"));
        self.shared.status().stepping = 1;
        self.command(Target::Resume);
    }

    fn create_again(&mut self, choices: &mut Choices) {
        let size = choices.one_of([2000, 32, 0]);
        let size = choices.integer(size);
        // SAFETY: motmod's structure.
        let handle = unsafe { framepath_planner_create(self.shared.tp, size) };
        assert_eq!(handle.is_null(), !(0..=2000).contains(&size));
        if !handle.is_null() {
            assert_eq!(handle, self.shared.handle);
            self.judge.next_id = 0;
        }
        self.check(Kind::Command);
    }

    /// Without what motmod hands over.
    fn hand_over_less(&mut self, choices: &mut Choices) {
        if choices.flag() {
            self.shared.hand_over_data(false);
            // SAFETY: a handle of the planner and motmod's structure.
            let answer = unsafe { framepath_planner_run_cycle(self.shared.handle, self.shared.tp) };
            assert_eq!(answer, -1);
            self.shared.hand_over_data(true);
        } else {
            let limits = self.shared.limits();
            self.shared.hand_over_functions(false);
            self.shared.set_limits([[0.0; AXIS_COUNT]; 2]);
            let end = self.choose_end(choices);
            self.plain_line(&end, 10.0);
            self.cycle();
            self.shared.set_limits(limits);
            self.shared.hand_over_functions(true);
        }
        self.check(Kind::Command);
    }

    /// Every function with null pointers: nothing happens.
    fn call_with_nothing(&mut self) {
        let (handle, tp) = (null_mut::<Handle>(), null_mut::<TP_STRUCT>());
        let here = self.shared.handle;
        // SAFETY: null pointers are permitted.
        unsafe {
            assert!(framepath_planner_create(tp, 10).is_null());
            assert_eq!(framepath_planner_run_cycle(handle, tp), -1);
            assert_eq!(framepath_planner_run_cycle(here, tp), -1);
            assert_eq!(framepath_planner_abort(here, tp), -1);
            assert_eq!(framepath_planner_clear(handle, self.shared.tp), -1);
            assert_eq!(framepath_planner_position(here, null_mut()), -1);
            assert_eq!(framepath_planner_queue_full(handle), 1);
            assert!(framepath_planner_fault_text(handle).is_null());
            assert!(!framepath_planner_error_text(handle).is_null());
            assert_eq!(
                framepath_planner_set_jerk(here, null(), null_mut(), null_mut()),
                0
            );
            framepath_planner_set_machine_map(here, 1, null());
            assert_eq!(
                framepath_planner_set_joint_limits(here, null_mut()),
                FRAMEPATH_JOINTS_UNKNOWN
            );
            assert_eq!(framepath_planner_set_position(here, tp, null()), -1);
            assert_eq!(framepath_planner_set_cycle_time(here, tp, 1e-3), -1);
            let (line, joint) = (null_mut(), null_mut());
            let (position, limit) = (null_mut(), null_mut());
            assert_eq!(
                framepath_planner_range_finding(handle, line, joint, position, limit),
                FRAMEPATH_STAYS_IN_RANGE
            );
            assert_eq!(framepath_planner_finding_place(handle, position), -1);
            assert_eq!(framepath_planner_finding_place(here, position), -1);
            assert_eq!(
                framepath_planner_add_rigid_tap(here, tp, null(), 1.0, 0.0, 0, 1.0, null()),
                -1
            );
        }
        self.check(Kind::Command);
    }
}
