//! Short programs of all kinds of moves, from a nanometre on, on machines of all kinds.

use framepath::axes::{AXIS_COUNT, Axes, AxisLimits};
use framepath::moves::{MotionType, TerminationCondition};
use proptest::prelude::*;

use crate::program::{Asked, Event, Program, Programmed, Shape};
use crate::random_program::in_periods;

/// The least share of the greatest limit of jerk that an axis has.
const LEAST_JERK: f64 = 1e-3;

/// How often one axis has no limit of jerk among axes that have one.
const FREE_AXIS: f64 = 0.1;

/// The most over F.
const MOST_FEED: f64 = 1.001;

/// Servo periods after which a program that is not done never will be.
const NEVER: usize = 100_000;

/// No move is faster, units a second.
const MAX_VELOCITY: f64 = 2e3;

/// A line, or an arc with a height that makes a helix of it.
#[derive(Clone, Debug)]
enum Way {
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
struct ShortMove {
    way: Way,
    /// Units a second.
    feed: f64,
    rapid: bool,
    /// G61, G61.1 or G64 before it.
    mode: Option<TerminationCondition>,
}

fn decades(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|exponent| 10f64.powf(exponent))
}

/// Limits over three decades, the jerk of all axes from one of five classes.
fn any_limits() -> impl Strategy<Value = AxisLimits> {
    (
        prop::array::uniform9(decades(0.0, 3.0)),
        prop::array::uniform9(decades(1.0, 4.0)),
        prop::array::uniform9(decades(LEAST_JERK.log10(), 0.0)),
        prop::sample::select(vec![f64::INFINITY, 1e300, 1e6, 1e5, 2e4]),
        (0.0..1.0f64, 0..AXIS_COUNT),
    )
        .prop_map(|(velocity, acceleration, shares, jerk, free)| {
            let mut jerk = Axes::from(shares) * jerk;
            if free.0 < FREE_AXIS {
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

fn any_act() -> impl Strategy<Value = Event> {
    prop_oneof![
        Just(Event::Pause),
        Just(Event::Resume),
        prop_oneof![0.0..2.0f64, Just(0.0), Just(2.0)].prop_map(Event::FeedOverride),
    ]
}

/// A short program.
pub fn any_program() -> impl Strategy<Value = Program> {
    (
        any_limits(),
        prop::collection::vec((any_move(), decades(-3.0, -0.3)), 1..8),
        prop_oneof![4 => Just(1usize), 1 => 1usize..100],
        prop_oneof![
            3 => Just(Vec::new()),
            1 => prop::collection::vec((1usize..300, any_act()), 1..6),
        ],
    )
        .prop_map(|(limits, moves, supply, acts)| {
            let moves: Vec<_> = moves
                .into_iter()
                .map(|(one, time)| one.within(time, &limits))
                .collect();
            let plain = acts.is_empty() && moves.iter().all(ShortMove::is_spatial);
            Program {
                limits,
                max_velocity: MAX_VELOCITY,
                slider: None,
                mode: TerminationCondition::Continuous { tolerance: 0.05 },
                supply,
                moves: moves.into_iter().map(Programmed::from).collect(),
                events: in_periods(acts.first().map_or(0, |(gap, _)| *gap), &acts),
                asked: Asked {
                    feed: plain.then_some(MOST_FEED),
                    periods: Some(NEVER),
                    ..Asked::LIMITS
                },
            }
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

    /// Whether X Y Z are the only axes that move.
    fn is_spatial(&self) -> bool {
        match &self.way {
            Way::Line(way) => way.iter().skip(3).all(|way| *way == 0.0),
            Way::Arc { others, .. } => *others == [0.0; 6],
        }
    }
}

impl From<ShortMove> for Programmed {
    fn from(one: ShortMove) -> Self {
        let mut programmed = Self {
            mode: one.mode,
            ..Self::feed(Shape::from(one.way), one.feed)
        };
        if one.rapid {
            programmed.motion_type = MotionType::Traverse;
            programmed.feed = MAX_VELOCITY;
        }
        programmed
    }
}

impl From<Way> for Shape {
    fn from(way: Way) -> Self {
        match way {
            Way::Line(way) => Self::Line(way),
            Way::Arc {
                center,
                across,
                angle,
                height,
                others,
            } => Self::Turn {
                center,
                across,
                angle,
                height,
                others: others.map(|other| other * center[0].hypot(center[1])),
            },
        }
    }
}
