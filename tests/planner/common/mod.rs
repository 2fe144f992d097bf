//! A planner driven cycle by cycle, and a judge of what it did.

pub mod lathe;
pub mod path_check;
pub mod seeded_runner;
pub mod zigzag;

use framepath::axes::{AXIS_COUNT, Axes, AxisLimits};
use framepath::machine::JOINT_COUNT;
use framepath::moves::shape::Circle;
use framepath::moves::{MotionType, StateTag, TerminationCondition};
use framepath::planner::range::Joints;
use framepath::planner::{AddError, Added, CycleInputs, MoveRequest, Planner, Status};

pub const PERIOD: f64 = 1e-3;

/// 100 mm/s, 1000 mm/s2 and the given jerk on all axes.
pub fn equal_limits(jerk: f64) -> AxisLimits {
    AxisLimits {
        velocity: Axes::repeat(100.0),
        acceleration: Axes::repeat(1000.0),
        jerk: Axes::repeat(jerk),
    }
}

/// A feed move at `feed` with all overrides enabled.
pub fn feed_move(feed: f64) -> MoveRequest {
    MoveRequest {
        motion_type: MotionType::Feed,
        feed,
        max_velocity: 1e6,
        path_jerk: f64::INFINITY,
        enables: 0x0f,
        wait_for_spindle: false,
        indexer_joint: None,
        tag: StateTag::EMPTY,
    }
}

/// Bytes of stack that a test with planners takes at most.
const ROOM: usize = 256 << 20;

/// Runs a test where a planner, some 18 MB, has room on the stack.
pub fn with_room<R: Send>(test: impl FnOnce() -> R + Send) -> R {
    if has_room() {
        return here(test);
    }
    std::thread::scope(|scope| {
        let handle = std::thread::Builder::new()
            .stack_size(ROOM)
            .spawn_scoped(scope, test)
            .expect("a thread");
        handle
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

/// Not inlined: the room would be taken before it is known whether it is there.
#[inline(never)]
fn here<R>(test: impl FnOnce() -> R) -> R {
    test()
}

/// Whether the threads of tests have it: with `RUST_MIN_STACK`, as `make test` sets it. What a stack of its own for each run costs,
/// memory that is new to it, is more than many a test. The first thread has what the system gives it.
fn has_room() -> bool {
    let bytes = std::env::var("RUST_MIN_STACK").ok();
    let is_enough =
        bytes.is_some_and(|bytes| bytes.parse().is_ok_and(|bytes: usize| bytes >= ROOM));
    is_enough && std::thread::current().name() != Some("main")
}

/// A position in the XY plane.
pub fn at(x: f64, y: f64) -> Axes {
    Axes::from([x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}

/// The same with Z.
pub fn xyz(x: f64, y: f64, z: f64) -> Axes {
    Axes::from([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}

/// The joints of a machine whose joints are its axes.
pub fn joints_at(position: &Axes) -> Joints {
    let mut joints = [0.0; JOINT_COUNT];
    joints
        .iter_mut()
        .zip(position.iter())
        .for_each(|(joint, axis)| *joint = *axis);
    joints
}

/// Runs a test on a machine with 100 mm/s, 1000 mm/s2, 20000 mm/s3.
pub fn with_machine(test: impl FnOnce(&mut Machine) + Send) {
    with_room(|| test(&mut Machine::new(equal_limits(20_000.0))));
}

/// A planner with everything it did.
pub struct Machine {
    pub planner: Planner,
    pub inputs: CycleInputs,
    pub limits: AxisLimits,
    pub positions: Vec<Axes>,
    pub ids: Vec<i32>,
}

impl Machine {
    /// At the origin, with a period of [`PERIOD`], in G61.1.
    pub fn new(limits: AxisLimits) -> Self {
        let mut planner = Planner::new();
        assert!(planner.set_cycle_time(PERIOD));
        planner.set_limits(&limits);
        planner.set_termination(TerminationCondition::Stop);
        Self {
            planner,
            inputs: CycleInputs::default(),
            limits,
            positions: vec![Axes::zeros(); 4],
            ids: Vec::new(),
        }
    }

    pub fn line(&mut self, end: Axes, request: &MoveRequest) -> Result<Added, AddError> {
        self.planner.add_line(&end, request)
    }

    pub fn circle(
        &mut self,
        end: Axes,
        circle: &Circle,
        request: &MoveRequest,
    ) -> Result<Added, AddError> {
        self.planner.add_circle(&end, circle, request)
    }

    /// One cycle, with the product that LinuxCNC's motion controller makes of the scales.
    pub fn cycle(&mut self) -> Status {
        self.scaled_cycle(1.0)
    }

    /// One cycle with adaptive feed, 0 for feed hold.
    pub fn scaled_cycle(&mut self, adaptive: f64) -> Status {
        let before = self.planner.status();
        self.inputs.net_feed_scale = adaptive
            * match (before.enables.unwrap_or(0x0f) & 2 != 0, before.motion_type) {
                (false, _) => 1.0,
                (true, Some(MotionType::Traverse)) => self.inputs.rapid_scale,
                (true, _) => self.inputs.feed_scale,
            };
        let status = *self.planner.cycle(&self.inputs);
        assert_eq!(status.fault, None);
        assert!(
            status
                .position
                .iter()
                .all(|coordinate| coordinate.is_finite())
        );
        self.positions.push(status.position);
        if self.ids.last() != Some(&status.exec_id) {
            self.ids.push(status.exec_id);
        }
        status
    }

    /// Cycles until everything is done, with the number of cycles.
    pub fn run(&mut self, most: usize) -> usize {
        for cycle in 1..=most {
            if self.cycle().done {
                return cycle;
            }
        }
        panic!("not done after {most} cycles: {:?}", self.planner.status());
    }

    /// Greatest velocity, acceleration and jerk of any axis over its limit, from differences of
    /// the positions at rest before and after.
    pub fn extremes(&self) -> Extremes {
        let last = *self.positions.last().expect("a position");
        let mut positions = self.positions.clone();
        positions.extend([last; 4]);
        let limits = &self.limits;
        let mut extremes = Extremes::default();
        for window in positions.windows(4) {
            extremes.periods += usize::from(window[3] != window[2]);
            let first = (window[3] - window[2]) / PERIOD;
            let second = (window[3] - window[2] * 2.0 + window[1]) / PERIOD.powi(2);
            let third =
                (window[3] - window[2] * 3.0 + window[1] * 3.0 - window[0]) / PERIOD.powi(3);
            for axis in 0..AXIS_COUNT {
                let over = |value: &Axes, limit: &Axes| value[axis].abs() / limit[axis];
                extremes.velocity = extremes.velocity.max(over(&first, &limits.velocity));
                extremes.acceleration = extremes
                    .acceleration
                    .max(over(&second, &limits.acceleration));
                extremes.jerk = extremes.jerk.max(over(&third, &limits.jerk));
            }
        }
        extremes
    }
}

/// Greatest values over their limits.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extremes {
    pub velocity: f64,
    pub acceleration: f64,
    pub jerk: f64,
    /// Servo periods with motion that this is about, in sum.
    pub periods: usize,
}

impl Extremes {
    pub fn join(&mut self, other: &Self) {
        self.velocity = self.velocity.max(other.velocity);
        self.acceleration = self.acceleration.max(other.acceleration);
        self.jerk = self.jerk.max(other.jerk);
        self.periods += other.periods;
    }
}
