//! What holds after each call of the planner.

use std::ffi::CStr;

use framepath::abi::linuxcnc::EmcPose;
use framepath::abi::planner::run::{
    framepath_planner_fault_text, framepath_planner_position, framepath_planner_spindle_error_text,
};
use framepath::abi::planner::survey::{
    FRAMEPATH_LIMIT_AXIS_JERK, FRAMEPATH_LIMIT_AXIS_VELOCITY, FRAMEPATH_LIMIT_BETWEEN,
    FramepathSurvey, framepath_planner_survey,
};
use framepath::axes::AXIS_COUNT;
use nalgebra::Matrix3;

use super::VELOCITY_EXCESS;
use super::motion::Shared;

/// Room in the queue, with the margin for moves that are on their way when it says that it is full.
const MOST_QUEUED: usize = 4096;

/// What may have happened to the position in a call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A servo period.
    Cycle,
    /// The position was set.
    Placed,
    /// Anything else.
    Command,
}

/// What the planner was told, as far as it limits what it may do.
pub struct Judge {
    position: [f64; AXIS_COUNT],
    was_done: bool,
    /// Seconds.
    pub period: f64,
    pub jerk: [f64; AXIS_COUNT],
    /// The last usable velocity limits.
    held: [f64; AXIS_COUNT],
    /// The greatest since the machine last had nothing to do.
    greatest: [f64; AXIS_COUNT],
    /// From the axes of the program to those of the machine.
    map: Matrix3<f64>,
    /// The ids of the moves since the machine last had nothing to do.
    ids: Vec<i32>,
    pub next_id: i32,
    /// The greatest number in positions and moves since the position was set: what is computed with it is rounded.
    size: f64,
}

pub fn coordinates(pose: &EmcPose) -> [f64; AXIS_COUNT] {
    let tran = &pose.tran;
    [
        tran.x, tran.y, tran.z, pose.a, pose.b, pose.c, pose.u, pose.v, pose.w,
    ]
}

fn all_finite(pose: &EmcPose) -> bool {
    coordinates(pose).iter().all(|value| value.is_finite())
}

impl Judge {
    pub fn new() -> Self {
        Self {
            position: [0.0; AXIS_COUNT],
            was_done: true,
            period: 0.0,
            jerk: [f64::INFINITY; AXIS_COUNT],
            held: [f64::INFINITY; AXIS_COUNT],
            greatest: [f64::INFINITY; AXIS_COUNT],
            map: Matrix3::identity(),
            ids: Vec::new(),
            next_id: 0,
            size: 1.0,
        }
    }

    /// The planner has asked for the limits.
    pub fn limits_asked(&mut self, [velocity, acceleration]: [[f64; AXIS_COUNT]; 2]) {
        for axis in 0..AXIS_COUNT {
            if velocity[axis] >= 1e-9 && acceleration[axis] >= 1e-3 && self.jerk[axis] > 0.0 {
                self.held[axis] = velocity[axis];
                self.greatest[axis] = self.greatest[axis].max(velocity[axis]);
            }
        }
    }

    /// A frame was handed over.
    pub fn mapped(&mut self, map: &[f64; 9]) {
        if self.was_done && map.iter().all(|element| element.abs() <= 1e4) {
            self.map = Matrix3::from_row_slice(map);
        }
    }

    /// The planner computes with these numbers.
    pub fn reaches(&mut self, numbers: &[f64]) {
        for number in numbers.iter().filter(|number| number.is_finite()) {
            self.size = self.size.max(number.abs());
        }
    }

    /// A move was taken, which makes the queue one longer, or it was not.
    pub fn added(&mut self, shared: &Shared, queued: bool, before: i32) {
        let depth = shared.tp().depth;
        assert_eq!(depth, before + i32::from(queued), "the queue");
        if queued {
            self.ids.push(self.next_id);
            self.next_id = self.next_id.wrapping_add(1);
        }
    }

    /// Judges everything that is reported.
    pub fn check(&mut self, shared: &mut Shared, kind: Kind) {
        self.check_numbers(shared);
        self.check_faults(shared);
        check_survey(shared);
        let position = coordinates(&shared.tp().currentPos);
        match kind {
            Kind::Cycle => self.check_way(&position),
            Kind::Command => assert_eq!(position, self.position, "moved by a command"),
            Kind::Placed => self.size = 1.0,
        }
        self.reaches(&position);
        self.position = position;
        let done = shared.tp().done != 0;
        if kind == Kind::Cycle && done && self.was_done {
            assert_eq!(position, self.position, "moved with nothing to do");
        }
        self.check_queue(shared);
        if done {
            self.greatest = self.held;
            self.ids.clear();
        }
        self.was_done = done;
    }

    fn check_numbers(&self, shared: &mut Shared) {
        let mut pose = shared.tp().goalPos;
        assert!(all_finite(&pose), "goal {:?}", coordinates(&pose));
        // SAFETY: a handle of the planner, and a pose.
        assert_eq!(0, unsafe {
            framepath_planner_position(shared.handle, &mut pose)
        });
        let position = coordinates(&pose);
        assert!(all_finite(&pose), "position {position:?}");
        assert_eq!(position, coordinates(&shared.tp().currentPos));
        let status = shared.status();
        for (name, value) in [
            ("velocity", status.current_vel),
            ("requested velocity", status.requested_vel),
            ("distance to go", status.distance_to_go),
        ] {
            assert!(value.is_finite() && value >= 0.0, "{name} is {value}");
        }
        let to_go = coordinates(&status.dtg);
        assert!(all_finite(&status.dtg), "distances to go {to_go:?}");
        for written in shared.take_written() {
            assert!((0..64).contains(&written.index) && written.value.is_finite());
        }
    }

    /// Whatever was asked for, the planner itself does not go wrong.
    fn check_faults(&self, shared: &mut Shared) {
        let (mut asked, mut greatest) = (f64::NAN, f64::NAN);
        // SAFETY: a handle of the planner, and numbers.
        let (fault, spindle) = unsafe {
            (
                framepath_planner_fault_text(shared.handle),
                framepath_planner_spindle_error_text(shared.handle, &mut asked, &mut greatest),
            )
        };
        assert!(asked.is_finite() && greatest.is_finite());
        // SAFETY: null or a static string.
        let text = |text| unsafe { CStr::from_ptr(text) }.to_string_lossy();
        if !spindle.is_null() {
            assert!(!text(spindle).is_empty());
        }
        if !fault.is_null() {
            panic!("a fault of the planner: {}", text(fault));
        }
    }

    /// No axis goes further in a servo period than its velocity allows.
    fn check_way(&self, position: &[f64; AXIS_COUNT]) {
        let mut way: [f64; AXIS_COUNT] = std::array::from_fn(|i| position[i] - self.position[i]);
        let linear = self.map * nalgebra::Vector3::new(way[0], way[1], way[2]);
        way[..3].copy_from_slice(linear.as_slice());
        let scale = self.map.abs().max().max(1.0);
        for (axis, way) in way.iter().enumerate() {
            let most = self.greatest[axis] * self.period * (1.0 + VELOCITY_EXCESS);
            let rounding = 1e-9 + 1e-13 * self.size * scale;
            assert!(
                way.abs() <= most + rounding,
                "axis {axis} goes {way} in a period of {}, {most} at most",
                self.period
            );
        }
    }

    fn check_queue(&self, shared: &mut Shared) {
        let tp = *shared.tp();
        let depth = usize::try_from(tp.depth).expect("a depth");
        assert!(depth <= MOST_QUEUED, "{depth} moves");
        assert_eq!(tp.queue._len, tp.depth);
        assert!((0..=1).contains(&tp.activeDepth) && tp.activeDepth <= tp.depth);
        for truth in [tp.done, tp.pausing, tp.aborting, tp.reverse_run] {
            assert!((0..=1).contains(&truth));
        }
        assert!((0..=6).contains(&tp.motionType));
        let status = shared.status();
        assert_eq!(status.tcqlen as usize, depth);
        if tp.done != 0 {
            assert_eq!((depth, tp.activeDepth, tp.motionType), (0, 0, 0));
            assert_eq!((tp.execId, status.current_vel), (0, 0.0));
            return;
        }
        if depth > 0 {
            let running = self.ids.len().checked_sub(depth).map(|at| self.ids[at]);
            assert_eq!(running, Some(tp.execId), "the id of the first of {depth}");
        }
    }
}

/// What the operator sees is possible.
fn check_survey(shared: &mut Shared) {
    let mut survey = FramepathSurvey::default();
    // SAFETY: a handle of the planner, and room for what is answered.
    assert_eq!(0, unsafe {
        framepath_planner_survey(shared.handle, &mut survey)
    });
    let limits = FRAMEPATH_LIMIT_AXIS_VELOCITY..=FRAMEPATH_LIMIT_AXIS_JERK;
    assert!((0..=FRAMEPATH_LIMIT_BETWEEN).contains(&survey.limit));
    let axes = if limits.contains(&survey.limit) {
        0..AXIS_COUNT as i32
    } else {
        -1..0
    };
    assert!(axes.contains(&survey.axis), "{survey:?}");
    assert_eq!(survey.moves_queued, shared.tp().depth);
    for seconds in [survey.seconds_ahead, survey.seconds_queued, survey.to_go] {
        assert!(seconds.is_finite() && seconds >= 0.0, "{survey:?}");
    }
    assert!(survey.moves_ahead >= 0, "{survey:?}");
}
