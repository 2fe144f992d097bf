//! Short programs of all kinds of moves, from a nanometre on, on machines of all kinds.

use framepath::axes::{AXIS_COUNT, Axes, AxisLimits};
use framepath::moves::shape::Circle;
use framepath::moves::{MotionType, TerminationCondition};
use framepath::planner::MoveRequest;
use nalgebra::Vector3;
use proptest::prelude::*;

use crate::common::{Extremes, Machine, PERIOD, feed_move};

/// What is asked of all programs, and of which machines.
struct Asked {
    /// The least share of the greatest limit of jerk that an axis has.
    least_jerk: f64,
    /// How often one axis has no limit of jerk among axes that have one.
    free_axis: f64,
    /// The most over the limits.
    velocity: f64,
    acceleration: f64,
    jerk: f64,
    /// The most over F.
    feed: f64,
}

/// Limits of jerk over three decades, and one axis in ten machines without any.
const ASKED: Asked = Asked {
    least_jerk: 1e-3,
    free_axis: 0.1,
    velocity: 1.001,
    acceleration: 1.001,
    jerk: 1.05,
    feed: 1.001,
};

/// Servo periods after which a program that is not done never will be.
const NEVER: usize = 100_000;

/// A line, or an arc with a height that makes a helix of it.
#[derive(Clone, Debug)]
pub enum Way {
    Line(Axes),
    Arc {
        /// Of the center from the start.
        center: [f64; 2],
        /// The axis across the plane: 0 to 2.
        across: usize,
        angle: f64,
        height: f64,
        /// The way of the other axes, as a share of the radius.
        others: [f64; 6],
    },
}

/// A move of a program.
#[derive(Clone, Debug)]
pub struct ShortMove {
    pub way: Way,
    /// Units a second.
    pub feed: f64,
    pub rapid: bool,
    /// G61, G61.1 or G64 before it.
    pub mode: Option<TerminationCondition>,
}

/// What the operator does in a servo period.
#[derive(Clone, Copy, Debug)]
pub enum Act {
    Pause,
    Resume,
    Override(f64),
}

/// A program, the machine it runs on, and what the operator does meanwhile.
#[derive(Clone, Debug)]
pub struct ShortProgram {
    pub limits: AxisLimits,
    pub moves: Vec<ShortMove>,
    /// Servo periods between two moves.
    pub supply: usize,
    pub acts: Vec<(usize, Act)>,
}

fn decades(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|exponent| 10f64.powf(exponent))
}

/// Limits over three decades, the jerk of all axes from one of five classes.
fn any_limits() -> impl Strategy<Value = AxisLimits> {
    (
        prop::array::uniform9(decades(0.0, 3.0)),
        prop::array::uniform9(decades(1.0, 4.0)),
        prop::array::uniform9(decades(ASKED.least_jerk.log10(), 0.0)),
        prop::sample::select(vec![f64::INFINITY, 1e300, 1e6, 1e5, 2e4]),
        (0.0..1.0f64, 0..AXIS_COUNT),
    )
        .prop_map(|(velocity, acceleration, shares, jerk, free)| {
            let mut jerk = Axes::from(shares) * jerk;
            if free.0 < ASKED.free_axis {
                jerk[free.1] = f64::INFINITY;
            }
            AxisLimits {
                velocity: Axes::from(velocity),
                acceleration: Axes::from(acceleration),
                jerk,
            }
        })
}

fn any_way() -> impl Strategy<Value = Way> {
    let axes = prop_oneof![4 => 1usize..8, 1 => 1usize..512];
    let size = || decades(-6.0, 2.0);
    prop_oneof![
        3 => (prop::array::uniform9(-1.0..1.0f64), axes, size()).prop_map(|(way, axes, size)| {
            Way::Line(Axes::from_fn(|axis, _| if axes >> axis & 1 == 0 { 0.0 } else { way[axis] * size }))
        }),
        1 => (
            (size(), 0.0..std::f64::consts::TAU, 0usize..3),
            prop_oneof![-6.2..6.2f64, -20.0..20.0f64],
            prop_oneof![2 => Just(0.0), 1 => -1.0..1.0f64],
            prop_oneof![4 => Just([0.0; 6]), 1 => prop::array::uniform6(-1.0..1.0f64)],
        )
            .prop_map(|((radius, direction, across), angle, height, others)| Way::Arc {
                center: [radius * direction.cos(), radius * direction.sin()],
                across,
                angle,
                height: height * radius,
                others,
            }),
    ]
}

fn any_mode() -> impl Strategy<Value = Option<TerminationCondition>> {
    let continuous = |tolerance| Some(TerminationCondition::Continuous { tolerance });
    prop_oneof![
        8 => Just(None),
        1 => Just(Some(TerminationCondition::Stop)),
        1 => Just(Some(TerminationCondition::Exact)),
        1 => Just(continuous(0.0)),
        3 => decades(-3.0, 0.5).prop_map(continuous),
    ]
}

/// A move that this machine needs some tenths of a second for at most.
fn any_move() -> impl Strategy<Value = ShortMove> {
    // .01 to 1e5 mm/min.
    let feed = decades(-3.778, 3.222);
    (any_way(), feed, prop::bool::weighted(0.15), any_mode()).prop_map(
        |(way, feed, rapid, mode)| ShortMove {
            way,
            feed,
            rapid,
            mode,
        },
    )
}

fn any_act() -> impl Strategy<Value = Act> {
    prop_oneof![
        Just(Act::Pause),
        Just(Act::Resume),
        prop_oneof![0.0..2.0f64, Just(0.0), Just(2.0)].prop_map(Act::Override),
    ]
}

/// A short program.
pub fn any_program() -> impl Strategy<Value = ShortProgram> {
    (
        any_limits(),
        prop::collection::vec((any_move(), decades(-3.0, -0.3)), 1..8),
        prop_oneof![4 => Just(1usize), 1 => 1usize..100],
        prop_oneof![
            3 => Just(Vec::new()),
            1 => prop::collection::vec((1usize..300, any_act()), 1..6),
        ],
    )
        .prop_map(|(limits, moves, supply, acts)| ShortProgram {
            moves: moves
                .into_iter()
                .map(|(one, time)| one.within(time, &limits))
                .collect(),
            limits,
            supply,
            acts,
        })
}

impl Way {
    fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Line(way) => Self::Line(way * factor),
            Self::Arc {
                center,
                across,
                angle,
                height,
                others,
            } => Self::Arc {
                center: center.map(|place| place * factor),
                across,
                angle,
                height: height * factor,
                others,
            },
        }
    }

    /// About how far each axis goes, shape (9).
    fn travel(&self) -> Axes {
        match self {
            Self::Line(way) => way.abs(),
            Self::Arc {
                center: [x, y],
                across,
                angle,
                height,
                others,
            } => {
                let radius = x.hypot(*y);
                let mut travel = Axes::repeat(radius * angle.abs());
                travel[*across] = height.abs();
                for (place, other) in travel.iter_mut().skip(3).zip(others) {
                    *place = other.abs() * radius;
                }
                travel
            }
        }
    }
}

impl ShortMove {
    /// The same, made so short that it takes about `time` seconds at most.
    fn within(mut self, time: f64, limits: &AxisLimits) -> Self {
        let travel = self.way.travel();
        let length = travel.norm();
        let mut factor = f64::min(1.0, self.feed * time / length);
        if self.rapid {
            factor = 1.0;
        }
        for axis in 0..AXIS_COUNT {
            if travel[axis] > 0.0 {
                let most = (limits.velocity[axis] * time)
                    .min(limits.acceleration[axis] * time * time / 4.0)
                    .min(limits.jerk[axis] * time * time * time / 32.0);
                factor = factor.min(most / travel[axis]);
            }
        }
        self.way = self.way.scaled(factor);
        self
    }
}

/// Queues a move from where the last one ends. `false` if it goes nowhere.
fn queue(machine: &mut Machine, one: &ShortMove) -> bool {
    if let Some(mode) = one.mode {
        machine.planner.set_termination(mode);
    }
    let mut request = MoveRequest {
        max_velocity: 2e3,
        ..feed_move(one.feed)
    };
    if one.rapid {
        request.motion_type = MotionType::Traverse;
        request.feed = request.max_velocity;
    }
    let start = *machine.planner.goal();
    let added = match &one.way {
        Way::Line(way) => machine.line(start + way, &request),
        Way::Arc {
            center,
            across,
            angle,
            height,
            others,
        } => {
            let (first, second) = ((across + 1) % 3, (across + 2) % 3);
            let mut middle = Vector3::from(start.fixed_rows::<3>(0));
            middle[first] += center[0];
            middle[second] += center[1];
            let (sine, cosine) = angle.sin_cos();
            let radius = center[0].hypot(center[1]);
            let mut end = start;
            end[first] = middle[first] - cosine * center[0] + sine * center[1];
            end[second] = middle[second] - cosine * center[1] - sine * center[0];
            end[*across] += height;
            for (place, other) in end.iter_mut().skip(3).zip(others) {
                *place += other * radius;
            }
            let mut normal = Vector3::zeros();
            normal[*across] = 1.0;
            let turns = (angle.abs() / std::f64::consts::TAU) as i32;
            let circle = Circle {
                center: middle,
                normal,
                revolutions: if *angle > 0.0 { turns } else { -1 - turns },
            };
            machine.circle(end, &circle, &request)
        }
    };
    // An arc of less than LinuxCNC's rounding is no arc; such a program leaves the move out.
    added.is_ok()
}

/// Runs a program to its end, with the greatest values over their limits.
///
/// # Errors
/// What is wrong with it.
pub fn run(program: &ShortProgram) -> Result<Extremes, TestCaseError> {
    let mut machine = Machine::new(program.limits);
    machine
        .planner
        .set_termination(TerminationCondition::Continuous { tolerance: 0.05 });
    let mut feeds = vec![f64::INFINITY];
    let mut moves = program.moves.iter();
    let mut acts = program.acts.iter();
    let mut next_act = program.acts.first().map_or(0, |(gap, _)| *gap);
    let mut before = *machine.planner.status();
    let mut fastest = 0.0_f64;
    // The move that ran last.
    let mut reached = 1;
    let spatial = program.moves.iter().all(ShortMove::is_spatial);
    for cycle in 0.. {
        prop_assert!(cycle < NEVER, "not done: {:?}", machine.planner.status());
        if cycle == next_act {
            match acts.next() {
                Some((gap, act)) => {
                    match act {
                        Act::Pause => machine.planner.pause(),
                        Act::Resume => machine.planner.resume(),
                        Act::Override(scale) => machine.inputs.feed_scale = *scale,
                    }
                    next_act += gap;
                }
                // The operator goes home and leaves everything at 100 %.
                None => {
                    machine.planner.resume();
                    machine.inputs.feed_scale = 1.0;
                }
            }
        }
        if cycle % program.supply == 0 {
            machine.planner.set_id(feeds.len() as i32);
            if let Some(one) = moves.next()
                && queue(&mut machine, one)
            {
                let feed = if one.rapid { f64::INFINITY } else { one.feed };
                feeds.push(feed);
            }
        }
        let status = machine.cycle();
        if spatial && program.acts.is_empty() {
            let way = (status.position - before.position)
                .fixed_rows::<3>(0)
                .norm();
            // Where none runs any more the last ones may have begun and ended within this period.
            let last = match status.exec_id {
                1.. => status.exec_id as usize,
                _ => feeds.len() - 1,
            };
            let feed = feeds[reached.min(last)..=last]
                .iter()
                .copied()
                .fold(0.0, f64::max);
            fastest = fastest.max(way / PERIOD / feed);
        }
        reached = reached.max(status.exec_id.max(0) as usize);
        before = status;
        if status.done && moves.len() == 0 && acts.len() == 0 && cycle > next_act {
            break;
        }
    }
    prop_assert_eq!(machine.planner.status().position, *machine.planner.goal());
    prop_assert!(fastest <= ASKED.feed, "{} of F", fastest);
    let extremes = machine.extremes();
    prop_assert!(extremes.velocity <= ASKED.velocity, "{extremes:?}");
    prop_assert!(extremes.acceleration <= ASKED.acceleration, "{extremes:?}");
    prop_assert!(extremes.jerk <= ASKED.jerk, "{extremes:?}");
    Ok(extremes)
}

impl ShortMove {
    /// Whether X Y Z are the only axes that move.
    fn is_spatial(&self) -> bool {
        match &self.way {
            Way::Line(way) => way.iter().skip(3).all(|way| *way == 0.0),
            Way::Arc { others, .. } => *others == [0.0; 6],
        }
    }
}
