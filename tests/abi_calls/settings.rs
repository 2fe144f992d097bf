//! What motmod, HAL and the operator set, with values that bytes say.

use std::ffi::c_int;

use framepath::abi::planner::settings::{
    framepath_planner_set_analog_output, framepath_planner_set_blending,
    framepath_planner_set_corners_inside, framepath_planner_set_cycle_time,
    framepath_planner_set_digital_output, framepath_planner_set_id, framepath_planner_set_jerk,
    framepath_planner_set_machine_map, framepath_planner_set_spindle_sync,
    framepath_planner_set_termination, framepath_planner_set_tool_tilt_axis,
    framepath_planner_set_velocity_limit,
};
use framepath::axes::AXIS_COUNT;
use framepath::planner::JerkLimit;

use super::choices::Choices;
use super::judge::Kind;
use super::motion::Inverse;
use super::planner::Calls;

impl Calls {
    pub fn set_termination(&mut self, condition: c_int, tolerance: f64) {
        self.tell(format_args!("termination {condition} {tolerance}"));
        // SAFETY: a handle of the planner.
        let answer =
            unsafe { framepath_planner_set_termination(self.shared.handle, condition, tolerance) };
        let sound = tolerance >= 0.0 && tolerance.is_finite() && (0..4).contains(&condition);
        assert_eq!(answer, if sound { 0 } else { -1 });
    }

    pub(super) fn choose_termination(&mut self, choices: &mut Choices) {
        let condition = choices.one_of([2, 2, 2, 0, 1, 3]);
        let condition = choices.integer(condition);
        let tolerance = choices.magnitude(1e-5, 5.0);
        let tolerance = choices.one_of([tolerance, tolerance, 0.0]);
        self.set_termination(condition, tolerance);
        self.check(Kind::Command);
    }

    pub fn set_spindle(&mut self, number: c_int, per_turn: f64, velocity_mode: c_int) {
        self.tell(format_args!("spindle {number} {per_turn} {velocity_mode}"));
        // SAFETY: a handle of the planner.
        let answer = unsafe {
            framepath_planner_set_spindle_sync(self.shared.handle, number, per_turn, velocity_mode)
        };
        assert_eq!(answer, 0);
    }

    pub(super) fn choose_spindle(&mut self, choices: &mut Choices) {
        let pitch = choices.magnitude(1e-2, 5.0);
        let per_turn = choices.one_of([0.0, 0.0, pitch]);
        let number = choices.one_of([0, 0, 1, 5]);
        let number = choices.integer(number);
        self.set_spindle(number, per_turn, choices.one_of([1, 0]));
        self.check(Kind::Command);
    }

    /// The spindles are told to turn, or do what they want.
    pub(super) fn choose_turning(&mut self, choices: &mut Choices) {
        let number = choices.below(2);
        let speed = choices.one_of([600.0, 60.0, 3000.0, 0.0, -600.0]);
        let speed = choices.or_strange(speed);
        let at_speed = choices.one_of([1, 1, 0]);
        self.tell(format_args!("spindle {number} at {speed}, {at_speed}"));
        let kind = choices.below(8);
        self.spindles[number].speed = match kind {
            6 => 0.0,
            7 => -self.spindles[number].speed,
            _ => self.spindles[number].speed,
        };
        let turns = choices.or_strange(0.0);
        let shown = &mut self.shared.status().spindle_status[number];
        shown.speed = speed;
        shown.direction = if speed < 0.0 { -1 } else { 1 };
        shown.at_speed = at_speed;
        shown.spindleRevs += turns;
        let count = choices.one_of([2, 2, 1, 8]);
        self.shared.config().numSpindles = choices.integer(count);
        self.check(Kind::Command);
    }

    pub(super) fn choose_scales(&mut self, choices: &mut Choices) {
        let scale = choices.one_of([1.0, 0.0, 0.5, 1.2, 2.0, 1e-3]);
        let scale = choices.or_strange(scale);
        self.tell(format_args!("a scale of {scale}"));
        match choices.below(4) {
            0 => self.shared.status().feed_scale = scale,
            1 => self.shared.status().rapid_scale = scale,
            2 => self.adaptive = scale,
            _ => self.shared.status().enables_new = choices.byte(),
        }
    }

    pub fn set_velocity_limit(&mut self, velocity: f64) {
        self.tell(format_args!("slider {velocity}"));
        // SAFETY: a handle of the planner.
        let answer = unsafe { framepath_planner_set_velocity_limit(self.shared.handle, velocity) };
        assert_eq!(answer, 0);
    }

    pub(super) fn choose_slider(&mut self, choices: &mut Choices) {
        let slow = choices.magnitude(1e-2, 1e3);
        let velocity = choices.one_of([1e3, slow, slow, 0.0]);
        let velocity = choices.or_strange(velocity);
        self.set_velocity_limit(velocity);
        self.check(Kind::Command);
    }

    pub(super) fn choose_limits(&mut self, choices: &mut Choices) {
        let velocity = choices.magnitude(3.0, 300.0);
        let acceleration = choices.magnitude(200.0, 20_000.0);
        let scale: [f64; AXIS_COUNT] = std::array::from_fn(|_| choices.one_of([1.0, 0.5, 0.2]));
        let limits = [scale.map(|s| s * velocity), scale.map(|s| s * acceleration)];
        self.set_limits(limits);
    }

    pub(super) fn choose_limits_of_one(&mut self, choices: &mut Choices) {
        let mut limits = self.shared.limits();
        let axis = choices.below(AXIS_COUNT);
        limits[0][axis] = choices.magnitude(1.0, 300.0);
        limits[1][axis] = choices.magnitude(100.0, 20_000.0);
        self.set_limits(limits);
    }

    pub(super) fn set_limits(&mut self, limits: [[f64; AXIS_COUNT]; 2]) {
        self.tell(format_args!("limits {limits:?}"));
        let [velocity, acceleration] = limits;
        self.sound &= velocity.iter().all(|v| (0.5..400.0).contains(v));
        self.sound &= acceleration.iter().all(|a| (20.0..3e4).contains(a));
        self.shared.set_limits(limits);
    }

    pub fn set_jerk(&mut self, jerk: &[f64; AXIS_COUNT]) {
        self.tell(format_args!("jerk {jerk:?}"));
        let [_, acceleration] = self.shared.limits();
        let period = self.shared.tp().cycleTime;
        let meant: [JerkLimit; AXIS_COUNT] =
            std::array::from_fn(|axis| JerkLimit::new(jerk[axis], acceleration[axis], period));
        let (mut least, mut unlimited) = (f64::NAN, 0);
        // SAFETY: a handle of the planner, and numbers.
        let refused = unsafe {
            framepath_planner_set_jerk(
                self.shared.handle,
                jerk.as_ptr(),
                &mut least,
                &mut unlimited,
            )
        };
        let wrong = meant
            .iter()
            .position(|limit| matches!(limit, JerkLimit::Refused { .. }));
        assert_eq!(refused, wrong.map_or(-1, |axis| axis as c_int));
        assert!(wrong.is_none() || least >= 0.0);
        if wrong.is_none() {
            self.judge.jerk = meant.map(|limit| match limit {
                JerkLimit::Limited(limit) => limit,
                _ => f64::INFINITY,
            });
            self.sound &= jerk.iter().all(|j| *j == 0.0 || (1e3..1e9).contains(j));
        }
    }

    pub(super) fn choose_jerk(&mut self, choices: &mut Choices) {
        let all = choices.magnitude(3e3, 1e7);
        let all = choices.one_of([all, all, 0.0]);
        let mut jerk = [all; AXIS_COUNT];
        if choices.flag() {
            jerk[choices.below(3)] = choices.magnitude(2e3, 1e6);
        }
        self.set_jerk(&jerk);
        self.check(Kind::Command);
    }

    pub fn set_cycle_time(&mut self, seconds: f64) -> c_int {
        self.tell(format_args!("period {seconds}"));
        // SAFETY: a handle of the planner and motmod's structure.
        let answer = unsafe {
            framepath_planner_set_cycle_time(self.shared.handle, self.shared.tp, seconds)
        };
        assert!(answer == 0 || answer == -1);
        if answer == 0 {
            assert!(seconds > 0.0 && seconds.is_finite());
            self.judge.period = seconds;
            self.sound &= (5e-5..2e-2).contains(&seconds);
        }
        answer
    }

    pub(super) fn choose_period(&mut self, choices: &mut Choices) {
        let seconds = choices.one_of([1e-3, 5e-4, 1e-4, 2e-3, 1e-2, 0.0]);
        let seconds = choices.or_strange(seconds);
        self.set_cycle_time(seconds);
        self.check(Kind::Command);
    }

    pub fn set_map(&mut self, framed: bool, map: &[f64; 9]) {
        self.tell(format_args!("map {framed} {map:?}"));
        // SAFETY: a handle of the planner, and nine numbers.
        unsafe {
            framepath_planner_set_machine_map(self.shared.handle, framed.into(), map.as_ptr());
        }
        self.judge.mapped(map);
    }

    pub(super) fn choose_map(&mut self, choices: &mut Choices) {
        let angle = choices.between(0.0, std::f64::consts::TAU);
        let scale = choices.one_of([1.0, 1.0, 2.0, 0.5, -1.0]);
        let (sin, cos) = angle.sin_cos();
        let mut map = [scale * cos, -sin, 0.0, scale * sin, cos, 0.0, 0.0, 0.0, 1.0];
        for element in &mut map {
            *element = choices.or_strange(*element);
        }
        self.sound &= map.iter().all(|element| element.abs() < 3.0);
        self.set_map(choices.flag(), &map);
        self.check(Kind::Command);
    }

    pub(super) fn choose_blending(&mut self, choices: &mut Choices) {
        let millimetre = choices.one_of([1.0, 1.0 / 25.4]);
        let millimetre = choices.or_strange(millimetre);
        let rotary = choices.one_of([0.0, 0.01, 1.0]);
        let rotary = choices.or_strange(rotary);
        let default = choices.magnitude(1e-4, 1.0);
        self.tell(format_args!("blending {millimetre} {rotary} {default}"));
        // SAFETY: a handle of the planner.
        let answer = unsafe {
            framepath_planner_set_blending(self.shared.handle, millimetre, rotary, default)
        };
        assert!((0..=3).contains(&answer));
        let tilt = choices.one_of([-1, 3, 4]);
        let tilt = choices.integer(tilt);
        self.tell(format_args!("tilt {tilt}"));
        // SAFETY: a handle of the planner.
        unsafe { framepath_planner_set_tool_tilt_axis(self.shared.handle, tilt) };
        // SAFETY: as above.
        unsafe { framepath_planner_set_corners_inside(self.shared.handle, tilt) };
        self.check(Kind::Command);
    }

    pub(super) fn choose_outputs(&mut self, choices: &mut Choices) {
        let index = choices.one_of([0, 1, 63]);
        let index = choices.integer(index);
        let value = choices.between(-10.0, 10.0);
        // SAFETY: a handle of the planner.
        unsafe {
            if choices.flag() {
                let answer =
                    framepath_planner_set_digital_output(self.shared.handle, index, choices.byte());
                assert_eq!(answer, if (0..64).contains(&index) { 0 } else { -1 });
            } else {
                let answer =
                    framepath_planner_set_analog_output(self.shared.handle, index as u8, value);
                let taken = index as u8 <= 63 && value.is_finite();
                assert_eq!(answer, if taken { 0 } else { -1 });
            }
        }
        // Motion is asked to write what it has not, and tells the operator.
        for told in self.shared.take_written() {
            assert!(!(0..64).contains(&told.index), "{}", told.index);
        }
        self.check(Kind::Command);
    }

    pub fn set_id(&mut self, id: c_int) {
        // SAFETY: a handle of the planner.
        assert_eq!(0, unsafe {
            framepath_planner_set_id(self.shared.handle, id)
        });
        self.judge.next_id = id;
    }

    /// Soft limits and kinematics of the joints.
    pub(super) fn choose_kinematics(&mut self, choices: &mut Choices) {
        let kinematics = choices.one_of([
            None,
            Some(Inverse::Identity),
            Some(Inverse::Refuses),
            Some(Inverse::NotANumber),
        ]);
        self.shared.hand_over_inverse(kinematics);
        let joint = choices.below(3);
        let reach = choices.magnitude(1.0, 1e4);
        let joint = &mut self.shared.status().joint_status[joint];
        (joint.min_pos_limit, joint.max_pos_limit) = (-reach, reach);
        self.shared.config().numJoints = choices.one_of([9, 3, 16, 0]);
        self.shared.config().numExtraJoints = choices.one_of([0, 0, 1, 16]);
    }
}
