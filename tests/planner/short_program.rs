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

/// Servo periods after which a program that is not done never will be. A blend of a line that is to take half a second
/// may take in 500 times its length, at its feed.
const NEVER: usize = 300_000;

/// No move is faster, units a second.
const MAX_VELOCITY: f64 = 2e3;

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

/// A line, or an arc with a height that makes a helix of it.
fn any_shape() -> impl Strategy<Value = Shape> {
    let axes = prop_oneof![4 => 1usize..8, 1 => 1usize..512];
    let size = || decades(-6.0, 2.0);
    prop_oneof![
        3 => (prop::array::uniform9(-1.0..1.0f64), axes, size()).prop_map(|(way, axes, size)| {
            Shape::Line(Axes::from_fn(|axis, _| if axes >> axis & 1 == 0 { 0.0 } else { way[axis] * size }))
        }),
        1 => (
            (size(), 0.0..std::f64::consts::TAU, 0usize..3),
            prop_oneof![-6.2..6.2f64, -20.0..20.0f64],
            prop_oneof![2 => Just(0.0), 1 => -1.0..1.0f64],
            prop_oneof![4 => Just([0.0; 6]), 1 => prop::array::uniform6(-1.0..1.0f64)],
        )
            .prop_map(|((radius, direction, across), angle, height, others)| Shape::Turn {
                center: [radius * direction.cos(), radius * direction.sin()],
                across,
                angle,
                height: height * radius,
                others: others.map(|other| other * radius),
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

fn any_move() -> impl Strategy<Value = Programmed> {
    // .01 to 1e5 mm/min.
    let feed = decades(-3.778, 3.222);
    (any_shape(), feed, prop::bool::weighted(0.15), any_mode()).prop_map(
        |(shape, feed, rapid, mode)| {
            let mut programmed = Programmed::feed(shape, feed);
            if rapid {
                programmed.motion_type = MotionType::Traverse;
                programmed.feed = MAX_VELOCITY;
            }
            Programmed { mode, ..programmed }
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
                .map(|(programmed, time)| within(programmed, time, &limits))
                .collect();
            let plain = acts.is_empty() && moves.iter().all(is_spatial);
            Program {
                limits,
                max_velocity: MAX_VELOCITY,
                slider: None,
                mode: TerminationCondition::Continuous { tolerance: 0.05 },
                supply,
                moves,
                events: in_periods(acts.first().map_or(0, |(gap, _)| *gap), &acts),
                asked: Asked {
                    feed: plain.then_some(MOST_FEED),
                    periods: Some(NEVER),
                    ..Asked::LIMITS
                },
            }
        })
}

/// The same in another size.
fn scaled(shape: Shape, factor: f64) -> Shape {
    match shape {
        Shape::Line(way) => Shape::Line(way * factor),
        Shape::Turn {
            center,
            across,
            angle,
            height,
            others,
        } => Shape::Turn {
            center: center.map(|place| place * factor),
            across,
            angle,
            height: height * factor,
            others: others.map(|other| other * factor),
        },
        Shape::Arc { .. } => unreachable!("short programs turn across an axis"),
    }
}

/// About how far each axis goes, shape (9).
fn travel(shape: &Shape) -> Axes {
    match shape {
        Shape::Line(way) => way.abs(),
        Shape::Turn {
            center: [x, y],
            across,
            angle,
            height,
            others,
        } => {
            let mut travel = Axes::repeat(x.hypot(*y) * angle.abs());
            travel[*across] = height.abs();
            for (place, other) in travel.iter_mut().skip(3).zip(others) {
                *place = other.abs();
            }
            travel
        }
        Shape::Arc { .. } => unreachable!("short programs turn across an axis"),
    }
}

/// The same, made so short that it takes about `time` seconds at most on this machine.
fn within(programmed: Programmed, time: f64, limits: &AxisLimits) -> Programmed {
    let travel = travel(&programmed.shape);
    let mut factor = match programmed.motion_type {
        MotionType::Traverse => 1.0,
        _ => f64::min(1.0, programmed.feed * time / travel.norm()),
    };
    for axis in 0..AXIS_COUNT {
        if travel[axis] > 0.0 {
            let most = (limits.velocity[axis] * time)
                .min(limits.acceleration[axis] * time * time / 4.0)
                .min(limits.jerk[axis] * time * time * time / 32.0);
            factor = factor.min(most / travel[axis]);
        }
    }
    Programmed {
        shape: scaled(programmed.shape, factor),
        ..programmed
    }
}

/// Whether X Y Z are the only axes that move.
fn is_spatial(programmed: &Programmed) -> bool {
    travel(&programmed.shape)
        .iter()
        .skip(3)
        .all(|way| *way == 0.0)
}
