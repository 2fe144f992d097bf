//! Moves of every kind, with values that bytes say.

use std::ffi::{CStr, c_char, c_int};

use framepath::abi::linuxcnc::{EmcPose, PmCartesian, state_tag_t};
use framepath::abi::planner::add::{
    framepath_planner_add_circle, framepath_planner_add_line, framepath_planner_add_rigid_tap,
    framepath_planner_error_text,
};

use super::choices::Choices;
use super::judge::{Kind, coordinates};
use super::motion::Shared;
use super::planner::{Calls, MOST_CYCLES, Position};

/// LinuxCNC's number of a move at feed.
const EMC_MOTION_TYPE_FEED: c_int = 2;

pub fn pose_of(position: &Position) -> EmcPose {
    let [x, y, z, a, b, c, u, v, w] = *position;
    EmcPose {
        tran: PmCartesian { x, y, z },
        a,
        b,
        c,
        u,
        v,
        w,
    }
}

/// A tag without a code.
pub fn tag() -> state_tag_t {
    // SAFETY: plain numbers.
    unsafe { std::mem::zeroed() }
}

impl Shared {
    /// Adds a line at a feed of 90 to X and Y.
    pub fn add_line(&mut self, x: f64, y: f64) {
        let end = pose_of(&[x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        // SAFETY: a handle, and structures.
        assert_eq!(0, unsafe {
            framepath_planner_add_line(
                self.handle,
                self.tp,
                &end,
                EMC_MOTION_TYPE_FEED,
                90.0,
                100.0,
                0.0,
                0xff,
                0,
                -1,
                &tag(),
            )
        });
    }
}

impl Calls {
    /// motmod takes the next command.
    pub(super) fn take(&mut self) {
        self.number = self.number.wrapping_add(1);
        self.shared.status().commandNumEcho = self.number;
        self.judge.limits_asked(self.shared.limits());
    }

    /// What an added move has to leave behind.
    pub(super) fn added(&mut self, answer: c_int, before: c_int) {
        assert!([0, 5, -1].contains(&answer), "{answer}");
        self.judge.added(&self.shared, answer == 0, before);
        if answer == -1 {
            // SAFETY: a handle of the planner, which answers with a static string.
            let text = unsafe { CStr::from_ptr(framepath_planner_error_text(self.shared.handle)) };
            assert!(!text.is_empty(), "refused without a reason");
        }
        self.check(Kind::Command);
    }

    fn line(&mut self, end: &Position, request: &Request) -> c_int {
        self.tell(format_args!("line to {end:?} {request}"));
        self.judge.reaches(end);
        self.take();
        let before = self.shared.tp().depth;
        // SAFETY: a handle of the planner, and structures.
        let answer = unsafe {
            framepath_planner_add_line(
                self.shared.handle,
                self.shared.tp,
                &pose_of(end),
                request.motion_type,
                request.feed,
                request.max_velocity,
                request.path_jerk,
                request.enables,
                request.at_speed,
                request.indexer,
                &request.tag,
            )
        };
        self.added(answer, before);
        answer
    }

    pub fn plain_line(&mut self, end: &Position, feed: f64) -> c_int {
        let request = Request {
            feed,
            ..Request::plain()
        };
        self.line(end, &request)
    }

    pub(super) fn choose_line(&mut self, choices: &mut Choices) {
        let end = self.choose_end(choices);
        let request = Request::choose(choices);
        self.line(&end, &request);
    }

    /// A place not far from the end of the last move.
    pub(super) fn choose_end(&mut self, choices: &mut Choices) -> Position {
        let mut end = coordinates(&self.shared.tp().goalPos);
        let axes = choices.one_of([0b1, 0b11, 0b111, 0b10, 0b1_0000, 0b1_1111_1111, 0b100_0111]);
        let size = choices.magnitude(1e-6, 100.0);
        for (axis, coordinate) in end.iter_mut().enumerate() {
            if axes >> axis & 1 == 1 {
                *coordinate += choices.between(-1.0, 1.0) * size;
            }
        }
        for coordinate in &mut end {
            *coordinate = choices.or_strange(*coordinate);
        }
        end
    }

    pub(super) fn choose_arc(&mut self, choices: &mut Choices) {
        let start = coordinates(&self.shared.tp().goalPos);
        let radius = choices.magnitude(1e-3, 50.0);
        let [from, angle] = [(); 2].map(|()| choices.between(0.0, std::f64::consts::TAU));
        let plane = choices.one_of([[0, 1, 2], [1, 2, 0], [2, 0, 1]]);
        let mut center = [start[0], start[1], start[2]];
        center[plane[0]] -= radius * from.cos();
        center[plane[1]] -= radius * from.sin();
        let mut end = start;
        end[plane[0]] = center[plane[0]] + radius * (from + angle).cos();
        end[plane[1]] = center[plane[1]] + radius * (from + angle).sin();
        end[plane[2]] += choices.one_of([0.0, 0.0, 1.0, -0.3]);
        end[5] += choices.one_of([0.0, 0.0, 0.0, 30.0]);
        if choices.rarely(6) {
            end = self.choose_end(choices);
        }
        let mut normal = [0.0; 3];
        normal[plane[2]] = 1.0;
        for value in center.iter_mut().chain(&mut normal) {
            *value = choices.or_strange(*value);
        }
        let turn = choices.one_of([0, 0, -1, 1, 3]);
        let turn = choices.integer(turn);
        let request = Request::choose(choices);
        self.tell(format_args!(
            "arc to {end:?} about {center:?} normal {normal:?} turn {turn} {request}"
        ));
        self.judge.reaches(&end);
        self.judge.reaches(&center);
        let cartesian = |[x, y, z]: [f64; 3]| PmCartesian { x, y, z };
        self.take();
        let before = self.shared.tp().depth;
        // SAFETY: a handle of the planner, and structures.
        let answer = unsafe {
            framepath_planner_add_circle(
                self.shared.handle,
                self.shared.tp,
                &pose_of(&end),
                &cartesian(center),
                &cartesian(normal),
                turn,
                request.motion_type,
                request.feed,
                request.max_velocity,
                request.path_jerk,
                request.enables,
                request.at_speed,
                &request.tag,
            )
        };
        self.added(answer, before);
    }

    /// Dense code, or more moves than there is room for.
    pub(super) fn choose_short_moves(&mut self, choices: &mut Choices) {
        let count = choices.one_of([8, 20, 60, 200]);
        let count = if choices.rarely(30) { 4200 } else { count };
        let length = choices.magnitude(1e-5, 0.5);
        let turn = choices.between(-0.3, 0.3);
        let request = Request::choose(choices);
        let fast = choices.flag();
        let mut end = coordinates(&self.shared.tp().goalPos);
        for index in 0..count {
            let angle = turn * f64::from(index);
            end[0] += length * angle.cos();
            end[1] += length * angle.sin();
            self.line(&end, &request);
            if !fast && self.cycles <= MOST_CYCLES {
                self.cycle();
            }
        }
    }

    pub(super) fn choose_tap(&mut self, choices: &mut Choices) {
        if !choices.rarely(4) {
            let pitch = choices.between(0.2, 2.0);
            self.set_spindle(0, pitch, 0);
        }
        let mut end = coordinates(&self.shared.tp().goalPos);
        end[2] -= choices.between(0.5, 20.0);
        let scale = choices.between(0.5, 2.0);
        let max_velocity = choices.between(1.0, 300.0);
        let path_jerk = choose_path_jerk(choices);
        self.tell(format_args!(
            "tap to {end:?} {scale} {max_velocity}, jerk {path_jerk}"
        ));
        self.take();
        let before = self.shared.tp().depth;
        // SAFETY: a handle of the planner, and structures.
        let answer = unsafe {
            framepath_planner_add_rigid_tap(
                self.shared.handle,
                self.shared.tp,
                &pose_of(&end),
                max_velocity,
                path_jerk,
                0x0f,
                scale,
                &tag(),
            )
        };
        self.added(answer, before);
    }
}

/// A limit of jerk along the path: mostly none, seldom one that makes no sense.
fn choose_path_jerk(choices: &mut Choices) -> f64 {
    if choices.rarely(4) {
        choices.magnitude(100.0, 1e7)
    } else if choices.rarely(8) {
        choices.one_of([-1.0, f64::NAN, f64::INFINITY, 1e-9])
    } else {
        0.0
    }
}

/// What comes with a move.
struct Request {
    motion_type: c_int,
    feed: f64,
    max_velocity: f64,
    path_jerk: f64,
    enables: u8,
    at_speed: c_char,
    indexer: c_int,
    tag: state_tag_t,
}

impl Request {
    /// A feed move.
    fn plain() -> Self {
        Self {
            motion_type: 2,
            feed: 10.0,
            max_velocity: 250.0,
            path_jerk: 0.0,
            enables: 0x0f,
            at_speed: 0,
            indexer: -1,
            tag: tag(),
        }
    }

    fn choose(choices: &mut Choices) -> Self {
        let mut request = Self::plain();
        request.feed = choices.magnitude(0.1, 300.0);
        if choices.rarely(4) {
            let kind = choices.one_of([1, 3, 5, 6, 4]);
            request.motion_type = choices.integer(kind);
            request.max_velocity = choices.magnitude(1.0, 1e4);
            request.path_jerk = choose_path_jerk(choices);
            request.enables = choices.byte();
            request.at_speed = choices.one_of([0, 0, 0, 1]);
            let joint = choices.one_of([-1, -1, 3]);
            request.indexer = choices.integer(joint);
            request.tag.fields[1] = choices.one_of([10, 530, 280, 0]);
        }
        request
    }
}

impl std::fmt::Display for Request {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let Self {
            motion_type,
            feed,
            max_velocity,
            path_jerk,
            enables,
            at_speed,
            indexer,
            tag,
        } = self;
        let code = tag.fields[1];
        write!(
            f,
            "F{feed} of {max_velocity}, jerk {path_jerk}: kind {motion_type}, enables {enables:#x}, "
        )?;
        write!(f, "at speed {at_speed}, indexer {indexer}, code {code}")
    }
}
